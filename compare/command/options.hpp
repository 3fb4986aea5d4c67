/// Options that several commands have, each written once. The variables are to live until the command line is parsed.
#pragma once

#include "scenes/parameters.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// Asks for what the type's name says: FILE or STEM: any name of a file; FILE.a|.b: one with such an end, or without
/// any; a|b, in small letters: one of these words. What other types mean is for others to ask.
void check_by_type(CLI::Option& option, const std::string& type);

/// An option, or an argument, that takes a value.
template <class Variable>
CLI::Option& add_option(CLI::App& command, const std::string& name, Variable& variable, const std::string& type,
                        const std::string& help) {
  CLI::Option& option = *command.add_option(name, variable, help)->type_name(type);
  check_by_type(option, type);
  return option;
}

/// The option is given or not: a value behind it is refused.
template <class Variable>
void add_flag(CLI::App& command, const std::string& name, Variable& variable, const std::string& help) {
  command.add_flag(name, variable, help)->disable_flag_override();
}
/// One that turns something off.
void add_flag_off(CLI::App& command, const std::string& name, bool& variable, const std::string& help);

void add_contenders(CLI::App& command, std::vector<std::string>& names, const std::string& help = "Only these");
void add_scalars(CLI::App& command, std::vector<std::string>& scalars);
void add_knobs(CLI::App& command, std::vector<std::string>& knobs);
/// `--set`, as typed.
void add_settings(CLI::App& command, std::vector<std::string>& settings);
void add_settings(CLI::App& command, std::vector<ParameterSetting>& settings);
void add_steps(CLI::App& command, std::optional<int>& steps);
/// `--input random:SEED`.
void add_input(CLI::App& command, std::optional<std::uint64_t>& seed);
/// `--rows` and `--report`.
void add_outputs(CLI::App& command, std::string& rows, std::string& report);

}  // namespace paperproof::compare
