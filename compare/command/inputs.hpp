/// The scenes that a comparison is asked for.
#pragma once

#include "command/progress.hpp"
#include "scenes/load.hpp"

#include <functional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// The names in a file, one per line; `-` reads standard input. Empty lines say nothing.
/// @throws InputError
[[nodiscard]] std::vector<std::string> names_from(const std::string& file);

/// All are checked before the first one runs, and then handed out one after another.
class Inputs {
 public:
  /// What to do with one that cannot be used. It may throw: then nothing runs.
  using Refuse = std::function<void(const std::string& name, const InputError& error)>;
  using Use = std::function<void(const std::string& name, const Scene& scene)>;

  /// @param settings parameters that are turned, of each scene.
  explicit Inputs(std::vector<std::string> names, std::vector<ParameterSetting> settings = {})
      : names_(std::move(names)), settings_(std::move(settings)), usable_(names_.size(), true) {}

  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  /// Loads every scene once. @param look may refuse it by throwing InputError, too.
  void check(Progress& progress, const Use& look, const Refuse& refuse);
  /// Those that can be used, in their order. More than a few are read again, so that not all are in memory at once.
  void run(const Use& use, const Refuse& refuse);

 private:
  std::vector<std::string> names_;
  std::vector<ParameterSetting> settings_;
  std::vector<bool> usable_;
  std::vector<std::vector<Scene>> kept_;  ///< Empty where they are many.
};

}  // namespace paperproof::compare
