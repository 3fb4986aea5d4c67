/// A situation: a scene, what happens in it, and numbers that follow by a formula. README.md has the format.
#pragma once

#include "scenes/formula.hpp"

#include <nlohmann/json.hpp>

#include <ostream>
#include <string>
#include <vector>

namespace paperproof::test {

using compare::Values;

/// One situation with the numbers of one of its cases.
struct SituationCase {
  std::string title;     ///< The numbers that tell it from the others; empty where there is one case.
  Values values;         ///< Of `for` and `let`.
  nlohmann::json scene;  ///< As a scene file.
  std::string contender;
  bool in_float = false;            ///< It computes in `float`.
  std::vector<std::string> knobs;   ///< Those that are turned: `name=value`.
  nlohmann::json expected;          ///< A list, formulas not computed.
  std::vector<std::string> breaks;  ///< Clauses that the judge finds broken, because that is known and open.
};

struct Situation {
  std::string file;  ///< Without folder and ending.
  std::string name;
  nlohmann::ordered_json text;                                       ///< As it stands in the file.
  nlohmann::ordered_json shared = nlohmann::ordered_json::object();  ///< Of all in the file: `scene` and `let`.
};

/// For GoogleTest, which prints bytes otherwise.
inline void PrintTo(const Situation& situation, std::ostream* out) { *out << situation.name; }

/// All situations of a folder, by file. @throws std::exception that names the file.
[[nodiscard]] std::vector<Situation> read_situations(const std::string& folder);

/// Its cases, with all numbers computed.
[[nodiscard]] std::vector<SituationCase> cases_of(const Situation& situation);

/// A sentence for each expectation that a run misses.
/// @param records the steps of its trace, one after the other.
[[nodiscard]] std::vector<std::string> missed(const SituationCase& situation,
                                              const std::vector<nlohmann::json>& records);

}  // namespace paperproof::test
