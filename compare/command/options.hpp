/// Options that several commands have, each written once. The variables are to live until the command line is parsed.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

void add_contenders(CLI::App& command, std::vector<std::string>& names, const std::string& help = "Only these");
void add_scalars(CLI::App& command, std::vector<std::string>& scalars);
void add_knobs(CLI::App& command, std::vector<std::string>& knobs);
void add_settings(CLI::App& command, std::vector<std::string>& settings);
void add_steps(CLI::App& command, std::optional<int>& steps);
void add_input(CLI::App& command, std::optional<std::string>& input);
void add_grid_size(CLI::App& command, std::string& grid);
void add_jobs(CLI::App& command, int& jobs);
/// `--log`: how far the work is, in a file.
void add_log(CLI::App& command, std::string& path);
/// `--rows` and `--report`.
void add_outputs(CLI::App& command, std::string& rows, std::string& report);

/// The option is given or not: a value behind it is refused.
template <class Variable>
void add_flag(CLI::App& command, const std::string& name, Variable& variable, const std::string& help) {
  command.add_flag(name, variable, help)->disable_flag_override();
}

}  // namespace paperproof::compare
