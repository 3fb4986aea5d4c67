/// A Case: everything that decides what one run gives. One Case gives one Row.
#pragma once

#include "records/row.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

struct Case {
  /// A number or word that is set, or a knob that is turned, by the name under which it is typed.
  struct Setting {
    std::string key;
    std::string value;  ///< As it was typed, or the shortest text that reads back to the same number.
  };
  std::string scene;  ///< A built-in scene, a family, or a file.
  std::vector<Setting> parameters;
  std::string contender;
  std::string peer{};  ///< The command of a contender that is a peer; empty for others.
  std::string scalar = "double";
  std::vector<Setting> knobs;
  std::optional<std::uint64_t> seed;  ///< Of random input, instead of the scene's.
  std::optional<int> steps;           ///< Instead of the scene's.
  std::string mode = "free";
  bool full_plan = false;  ///< Nothing is left out.
  bool reference = false;  ///< The Box2D twin runs beside it: the row says how far they agree.
};

/// `hash_of` its command: the same for the same Case on every machine.
[[nodiscard]] std::string id_of(const Case& one);

/// The shell command that runs it alone: `paperproof compare paper --set speed=40 --contender mask --no-reference`.
[[nodiscard]] std::string command_of(const Case& one);

/// The Case that a command runs: the inverse of `command_of`.
/// @return nothing where the text is no such command.
[[nodiscard]] std::optional<Case> case_of_command(std::string_view command);

/// Gives a row the id and the command of its Case, and those of the knobs and the seed that are numbers as parameters.
void put_case(const Case& one, Row& row);

/// 16 hexadecimal digits (FNV-1a, 64 bit: Fowler, Noll and Vo 1991).
[[nodiscard]] std::string hash_of(std::string_view text);

}  // namespace paperproof::compare
