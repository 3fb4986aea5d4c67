/// What is true of all runs of a comparison together.
#pragma once

#include "runs/peers.hpp"
#include "words.hpp"

#include <paperproof/techniques.hpp>

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What was found over all scenes, for the closing line and the exit status.
class Totals {
 public:
  void add(const Row& row) {
    failed_ += is_our_failure(row);
    if (row.contender != "octagon_sweep") return;
    Count& count = row.scalar == "double" ? in_double_ : in_float_;
    const bool violates = row.verdict == Verdict::violates;
    const bool breaks =
        row.verdict == Verdict::tunnels || (row.verdict == Verdict::flagged && row.steps_ending_inside.value_or(0) > 0);
    count.steps += row.steps;
    count.asked_for = true;
    count.runs += row.verdict != Verdict::not_applicable;
    count.broken += row.scalar == "double" ? violates : breaks;
    if (row.scalar == "double" && violates)
      for (const auto& [clause, steps] : row.broken) broken_[clause] += steps;
  }
  [[nodiscard]] bool trouble() const { return in_double_.broken > 0 || failed_ > 0; }
  /// One line for each number type that ran.
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> all;
    if (in_double_.asked_for)
      all.push_back(fmt::format("octagon_sweep in double: {}, {} with a violation of the guarantee",
                                in_double_.extent(), counted(in_double_.broken, "run")) +
                    clauses());
    if (in_float_.asked_for)
      all.push_back(
          fmt::format("octagon_sweep in float, for which nothing is guaranteed: {}, {} with a step through or "
                      "into a solid",
                      in_float_.extent(), counted(in_float_.broken, "run")));
    return all;
  }

 private:
  struct Count {
    long long steps = 0;
    bool asked_for = false;
    int runs = 0;
    int broken = 0;
    [[nodiscard]] std::string extent() const { return counted(steps, "step") + " in " + counted(runs, "run"); }
  };
  /// The broken clauses, each with the number of steps that broke it.
  [[nodiscard]] std::string clauses() const {
    std::string words;
    for (const auto& [clause, steps] : broken_)
      words += fmt::format("{}{} on {}", words.empty() ? ": " : ", ", clause, counted(steps, "step"));
    return words;
  }

  std::map<std::string, long long> broken_;
  Count in_double_;
  Count in_float_;
  int failed_ = 0;
};

}  // namespace paperproof::compare
