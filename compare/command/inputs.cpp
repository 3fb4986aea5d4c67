#include "command/inputs.hpp"

#include "scenes/input_error.hpp"

#include <iostream>
#include <sstream>

namespace paperproof::compare {
namespace {

/// Up to this many arguments their scenes are kept in memory; more are read once to be checked and again to be run.
constexpr std::size_t kept_in_memory = 16;

}  // namespace

std::vector<std::string> names_from(const std::string& file) {
  const std::string text = file == "-" ? read_all(std::cin, "--files-from -") : read_text(file, file);
  refuse_zero_bytes(text, "--files-from " + file);
  std::istringstream lines(text);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) names.push_back(line);
  }
  if (names.empty()) refuse("--files-from " + file, "expected the names of scenes, one per line; there is none");
  return names;
}

void Inputs::check(Progress& progress, const Use& look, const Refuse& refuse) {
  const bool keep = names_.size() <= kept_in_memory;
  if (keep) kept_.resize(names_.size());
  for (std::size_t i = 0; i < names_.size(); ++i) {
    progress.show("checking " + names_[i], static_cast<double>(i) / static_cast<double>(names_.size()));
    try {
      std::vector<Scene> scenes = load_scenes(names_[i], settings_);
      for (const Scene& scene : scenes) look(names_[i], scene);
      if (keep) kept_[i] = std::move(scenes);
    } catch (const InputError& error) {
      progress.clear();
      usable_[i] = false;
      refuse(names_[i], error);
    }
  }
  progress.clear();
}

void Inputs::run(const Use& use, const Refuse& refuse) {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!usable_[i]) continue;
    std::vector<Scene> scenes;
    try {
      scenes = kept_.empty() ? load_scenes(names_[i], settings_) : std::move(kept_[i]);
    } catch (const InputError& error) {  // it changed since it was checked
      refuse(names_[i], error);
    }
    for (const Scene& scene : scenes) use(names_[i], scene);
  }
}

}  // namespace paperproof::compare
