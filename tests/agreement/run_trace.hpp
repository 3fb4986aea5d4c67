/// Holds the runs of a random test against every clause of the guarantee, and writes them as traces.
#pragma once

#include "records/trace_writer.hpp"
#include "runs/run_judge.hpp"

#include <gtest/gtest.h>
#include <paperproof/character.hpp>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>

namespace paperproof::test {

/// How many runs broke a clause, over the whole program.
inline std::map<compare::Clause, int>& runs_that_broke() {
  static std::map<compare::Clause, int> counts;
  return counts;
}

/// One run of octagon_sweep in double. What it breaks is printed with the run's name. It is written only where
/// PAPERPROOF_GUARANTEE_TRACES names a folder.
class RunTrace {
 public:
  /// @param header with scenery, points, limits, gravity and scripts. @param run names it.
  RunTrace(compare::TraceHeader header, const std::string& run) : run_(run) {
    header.scene = run;
    header.contender = "octagon_sweep";
    header.scalar = "double";
    header.guarantees = compare::every_clause();
    header.ids.clear();
    for (std::size_t i = 0; i < header.scenery.colliders.size(); ++i) header.ids.push_back(std::to_string(i));
    header_ = std::move(header);
  }
  ~RunTrace() {
    if (judge_) {
      for (const auto& [clause, breach] : judge_->breaches()) {
        if (clause == compare::Clause::continuity) continue;  // launched
        ++runs_that_broke()[clause];
        std::printf("breaks %s: %s, step %d, %d steps: %s\n", std::string(name_of(clause)).c_str(), run_.c_str(),
                    breach.first_step, breach.steps, breach.first.c_str());
      }
    }
    if (writer_) writer_->commit();
  }
  RunTrace(const RunTrace&) = delete;
  RunTrace& operator=(const RunTrace&) = delete;

  /// A test that gives the character another velocity begins a new run there, in the same file.
  /// @param before the state with which the step began. @param launched the test has changed it since the last step.
  void write(compare::TraceStep step, const CharacterState<double>& before, const Input& input, bool launched) {
    step.input = input;
    step.step = steps_++;
    if (!judge_) {
      header_.starts = {{before.position, before.velocity}};
      judge_.emplace(header_, compare::Measured{});
      if (const char* folder = std::getenv("PAPERPROOF_GUARANTEE_TRACES"))
        writer_.emplace(std::string(folder) + "/" + run_ + ".jsonl", header_);
    } else if (launched) {
      step.respawn = true;
      step.from = {.velocity = before.velocity,
                   .grounded = before.grounded,
                   .jumping = before.jumping,
                   .jump_held = before.jump_held,
                   .jump_pending = before.jump_pending};
      if (before.ride.ground != Ride<double>::none) step.from->ride = {before.ride.ground, before.ride.velocity};
    }
    judge_->add({&step, 1});
    if (writer_) writer_->write(step);
  }

 private:
  std::string run_;
  compare::TraceHeader header_;
  std::optional<compare::RunJudge> judge_;
  std::optional<compare::TraceWriter> writer_;
  int steps_ = 0;
};

}  // namespace paperproof::test
