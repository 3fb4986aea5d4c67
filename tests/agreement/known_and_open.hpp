/// What random runs may break of the guarantee, because it is known and open: tests/known_and_open.json.
#pragma once

#include "records/clause.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>

namespace paperproof::test {

/// How many of so many steps may break a clause. The share is that of all families together, and one family may have all
/// of it; what one run breaks it breaks for many steps.
/// @param runs as the file names them: "static", "any_up", "movers", "movers_any_up", "turning", "presses".
[[nodiscard]] inline int most_broken(const std::string& runs, compare::Clause clause, int steps) {
  static const nlohmann::json known = nlohmann::json::parse(std::ifstream(PAPERPROOF_KNOWN_AND_OPEN));
  for (const nlohmann::json& entry : known.at("random"))
    if (entry.at("runs") == runs && entry.at("clause") == std::string(name_of(clause))) {
      constexpr int families = 15;
      constexpr int steps_of_one_run = 40;
      const double expected = entry.at("steps_in_a_million").get<double>() * steps / 1e6 * families;
      return static_cast<int>(steps_of_one_run + expected + 4 * std::sqrt(expected));
    }
  return 0;
}

}  // namespace paperproof::test
