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
  bool in_float = false;           ///< It computes in `float`.
  nlohmann::json rules;            ///< Numbers of its character that no scene file has, by name.
  std::vector<std::string> knobs;  ///< Those that are turned: `name=value`.
  nlohmann::json expected;         ///< A list, formulas not computed; of a hero its story, with expectations in it.
  bool is_story = false;
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

/// All of them; two where few steps are asked for, one under sanitizers.
[[nodiscard]] std::vector<SituationCase> some_cases_of(const Situation& situation);

/// The part of a record that a name or a pointer names: -1 is the last of a list, # how many it has; null where there
/// is none.
[[nodiscard]] nlohmann::json part_of(const nlohmann::json& record, const std::string& of);

/// What a formula may name in a step: its number, and where and how fast the character is after it and the one before.
[[nodiscard]] Values in_step(int step, const std::vector<nlohmann::json>& records, Values values);

/// A sentence for each expectation that a run misses.
/// @param records the steps of its trace, one after the other. @param first from which they are counted.
[[nodiscard]] std::vector<std::string> missed(const SituationCase& situation,
                                              const std::vector<nlohmann::json>& records, std::size_t first = 0);

}  // namespace paperproof::test
