#include "command/options.hpp"

#include "command/option_checks.hpp"

namespace paperproof::compare {

void add_contenders(CLI::App& command, std::vector<std::string>& names, const std::string& help) {
  command.add_option("--contender", names, help + ", each by its own option or with commas")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_scalars(CLI::App& command, std::vector<std::string>& scalars) {
  command.add_option("--scalar", scalars, "Number type of the techniques")
      ->type_name("double|float")
      ->check(expect_one_of({"double", "float"}))
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_knobs(CLI::App& command, std::vector<std::string>& knobs) {
  command
      .add_option("--knob", knobs,
                  "Turns a knob of the contenders that have it (see `paperproof list knobs`), each by its own option")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command.add_option("--set", settings, "Turns a parameter of the scenes (see `paperproof list parameters`)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_steps(CLI::App& command, std::optional<int>& steps) {
  command.add_option("--steps", steps, "Instead of the scene's")
      ->type_name("N")
      ->check(expect_whole_number(1'000'000'000));
}

void add_grid_size(CLI::App& command, std::string& grid) {
  command.add_option("--grid", grid, "How many cases")
      ->type_name("quick|standard|full")
      ->check(expect_one_of({"quick", "standard", "full"}));
}

void add_input(CLI::App& command, std::optional<std::string>& input) {
  command.add_option("--input", input, "Replaces the scene's input by one at random")->type_name("random:SEED");
}

void add_outputs(CLI::App& command, std::string& rows, std::string& report) {
  command.add_option("--rows", rows, "Write all rows to this file; .jsonl grows line by line as results come")
      ->type_name("FILE.json|.jsonl|.csv")
      ->check(expect_file_name())
      ->check(expect_ending({".json", ".jsonl", ".csv"}));
  command.add_option("--report", report, "Write one self-contained HTML page to this file")
      ->type_name("FILE.html")
      ->check(expect_file_name())
      ->check(expect_ending({".html"}));
}

void add_log(CLI::App& command, std::string& path) {
  command.add_option("--log", path, "Write how far the work is to this file, a line every 5 s")
      ->type_name("FILE")
      ->check(expect_file_name());
}

void add_jobs(CLI::App& command, int& jobs) {
  command.add_option("--jobs", jobs, "Processes at a time; one for each core where it is not given")
      ->type_name("N")
      ->check(expect_whole_number(1024));
}

}  // namespace paperproof::compare
