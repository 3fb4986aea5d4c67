/// What random runs may break of the guarantee, because it is known and open: tests/known_and_open.json.
#pragma once

#include "records/clause.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>

namespace paperproof::test {

/// How many of so many steps may break a clause. A few more than the stated share: runs are short, and chance is
/// uneven.
/// @param runs as the file names them: "static", "any_up", "movers", "movers_any_up", "turning", "presses".
[[nodiscard]] inline int most_broken(const std::string& runs, compare::Clause clause, int steps) {
  static const nlohmann::json known = nlohmann::json::parse(std::ifstream(PAPERPROOF_KNOWN_AND_OPEN));
  for (const nlohmann::json& entry : known.at("random"))
    if (entry.at("runs") == runs && entry.at("clause") == std::string(name_of(clause))) {
      const double expected = entry.at("steps_in_a_million").get<double>() * steps / 1e6;
      return static_cast<int>(3 + expected + 4 * std::sqrt(expected));
    }
  return 0;
}

}  // namespace paperproof::test
