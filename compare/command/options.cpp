#include "command/options.hpp"

#include "command/compare_command.hpp"
#include "command/option_checks.hpp"
#include "runs/peers.hpp"
#include "scenes/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace paperproof::compare {
namespace {

constexpr const char* set_words = "Turns a parameter of the scenes (see `paperproof list parameters`)";

}  // namespace

void check_by_type(CLI::Option& option, const std::string& type) {
  std::vector<std::string> parts;
  std::istringstream text(type);
  for (std::string part; std::getline(text, part, '|');) parts.push_back(part);
  if (std::none_of(type.begin(), type.end(), [](unsigned char letter) { return std::isupper(letter) != 0; })) {
    option.check(expect_one_of(parts));
  } else if (type.starts_with("FILE") || type == "STEM") {
    option.check(expect_file_name());
    std::vector<std::string> endings;
    for (const std::string& part : parts)
      if (const std::size_t dot = part.find('.'); dot != std::string::npos) endings.push_back(part.substr(dot));
    if (!endings.empty()) option.check(expect_ending(endings));
  }
}

void add_flag_off(CLI::App& command, const std::string& name, bool& variable, const std::string& help) {
  command
      .add_flag_callback(
          name, [&variable] { variable = false; }, help)
      ->disable_flag_override();
}

void add_contenders(CLI::App& command, std::vector<std::string>& names, const std::string& help) {
  add_option(command, "--contender", names, "NAME", help + ", each by its own option or with commas")
      .delimiter(',')
      ->allow_extra_args(false);
  const auto take = [](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) try {
        add_peer(parse_peer(text));
      } catch (const std::invalid_argument& reason) {
        throw InputError(fmt::format("--peer {}: {}", text, reason.what()));
      }
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--peer", take, "Also a program of yours (see compare/peers/README.md), each by its own option")
      ->type_name("[NAME=]COMMAND")
      ->allow_extra_args(false);
}

void add_scalars(CLI::App& command, std::vector<std::string>& scalars) {
  add_option(command, "--scalar", scalars, "double|float", "Number type of the techniques")
      .delimiter(',')
      ->allow_extra_args(false);
}

void add_knobs(CLI::App& command, std::vector<std::string>& knobs) {
  add_option(command, "--knob", knobs, "NAME=VALUE",
             "Turns a knob of the contenders that have it (see `paperproof list knobs`), each by its own option")
      .allow_extra_args(false);
}

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  add_option(command, "--set", settings, "KEY=VALUE", set_words).allow_extra_args(false);
}

void add_settings(CLI::App& command, std::vector<ParameterSetting>& settings) {
  const auto take = [&settings](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) settings.push_back(parse_setting(text));
  };
  command.add_option_function<std::vector<std::string>>("--set", take, set_words)
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_steps(CLI::App& command, std::optional<int>& steps) {
  add_option(command, "--steps", steps, "N", "Instead of the scene's").check(expect_whole_number(1'000'000'000));
}

void add_input(CLI::App& command, std::optional<std::uint64_t>& seed) {
  const auto take = [&seed](const std::string& text) { seed = parse_random_input(text); };
  command.add_option_function<std::string>("--input", take, "Replaces the scene's input by one at random")
      ->type_name("random:SEED");
}

void add_outputs(CLI::App& command, std::string& rows, std::string& report) {
  add_option(command, "--rows", rows, "FILE.json|.jsonl|.csv",
             "Write all rows to this file; .jsonl grows line by line as results come");
  add_option(command, "--report", report, "FILE.html", "Write one self-contained HTML page to this file");
}

}  // namespace paperproof::compare
