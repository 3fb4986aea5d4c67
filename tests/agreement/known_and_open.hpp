/// What random runs may break of the guarantee, because it is known and open: tests/known_and_open.json.
#pragma once

#include "records/clause.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>

namespace paperproof::test {

[[nodiscard]] inline const nlohmann::json& known_and_open() {
  static const nlohmann::json known = nlohmann::json::parse(std::ifstream(PAPERPROOF_KNOWN_AND_OPEN));
  return known;
}

/// How many of so many steps of a family may break a clause. The file has the share of each family that broke it where
/// that was measured: no other may; or of all runs together, where there are no families. What one run breaks it breaks
/// for several steps: runs come by chance, their number varies by its root, and each counts for as many steps as the
/// worst did.
/// @param runs as the file names them: "static", "any_up", "movers", "turning", "crowd" and so on.
[[nodiscard]] inline int most_broken(const std::string& runs, compare::Clause clause, int steps,
                                     const std::string& family = {}) {
  for (const nlohmann::json& entry : known_and_open().at("random")) {
    if (entry.at("runs") != runs || entry.at("clause") != std::string(name_of(clause))) continue;
    const double share = entry.contains("families") ? entry.at("families").value(family, 0.0)
                                                    : entry.at("steps_in_a_million").get<double>();
    const double expected = share * steps / 1e6;
    const double worst = entry.at("steps_of_one_run").get<double>();
    return expected > 0 ? static_cast<int>(expected + 4 * std::sqrt(expected * worst) + worst) : 0;
  }
  return 0;
}

}  // namespace paperproof::test
