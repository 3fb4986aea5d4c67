/// Holds the runs of a random test against every clause of the guarantee, and writes them as traces.
#pragma once

#include "agreement/known_and_open.hpp"
#include "records/trace_writer.hpp"
#include "runs/run_judge.hpp"

#include <gtest/gtest.h>
#include <paperproof/character.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::test {

/// What the runs of a program broke, by kind of run: see tests/known_and_open.json.
class BrokenByRuns {
 public:
  static BrokenByRuns& all() {
    static BrokenByRuns broken;
    return broken;
  }
  void count(const std::string& kind, int steps, const compare::Breaches& breaches) {
    steps_[kind] += steps;
    for (const auto& [clause, breach] : breaches) broken_[{kind, clause}] += breach.steps;
  }
  /// On how many steps the runs of a kind broke a clause; forgets them all.
  [[nodiscard]] int take(const std::string& kind, compare::Clause clause) {
    EXPECT_GT(steps_[kind], 0) << "no run of " << kind;
    const int steps = broken_[{kind, clause}];
    broken_.clear();
    steps_.clear();
    return steps;
  }
  /// Fails the test that runs where more was broken than is known and open, and forgets it.
  /// @param family of all the runs, where tests/known_and_open.json knows families.
  void expect_only_what_is_known(const std::string& family = {}) {
    for (const auto& [what, steps] : broken_) {
      const auto& [kind, clause] = what;
      EXPECT_LE(steps, most_broken(kind, clause, steps_[kind], family))
          << name_of(clause) << " in " << kind << " runs of " << steps_[kind] << " steps";
    }
    broken_.clear();
    steps_.clear();
  }

 private:
  std::map<std::string, int> steps_;
  std::map<std::pair<std::string, compare::Clause>, int> broken_;
};

/// One run of octagon_sweep in double. What it breaks is printed with the run's name. It is written only where
/// PAPERPROOF_GUARANTEE_TRACES names a folder.
class RunTrace {
 public:
  /// @param header with scenery, points, limits and gravity. Where it has no scripts, movers go as the records say.
  ///   @param kind of run, as tests/known_and_open.json
  ///   has it. @param run names it.
  RunTrace(compare::TraceHeader header, std::string kind, std::string run)
      : kind_(std::move(kind)), run_(std::move(run)) {
    header.scene = run_;
    header.contender = "octagon_sweep";
    header.scalar = "double";
    header.guarantees = compare::every_clause();
    header.ids.clear();
    for (std::size_t i = 0; i < header.scenery.colliders.size(); ++i) header.ids.push_back(std::to_string(i));
    if (header.scripts.empty()) header.scripts = of_bodies(header.scenery);
    header_ = std::move(header);
  }
  ~RunTrace() {
    if (judge_) {
      compare::Breaches breaches = judge_->breaches();
      breaches.erase(compare::Clause::continuity);  // the test launches the character
      for (const auto& [clause, breach] : breaches)
        std::printf("breaks %s: %s %s, step %d, %d steps: %s\n", std::string(name_of(clause)).c_str(), kind_.c_str(),
                    run_.c_str(), breach.first_step, breach.steps, breach.first.c_str());
      BrokenByRuns::all().count(kind_, steps_, breaches);
    }
    if (writer_) writer_->commit();
  }
  RunTrace(const RunTrace&) = delete;
  RunTrace& operator=(const RunTrace&) = delete;

  /// A test that gives a character another velocity begins a new run there, in the same file.
  /// @param before the states with which the step began, one of each character. @param launched the test has changed
  ///   the state since the last step.
  void write(std::vector<compare::TraceStep> records, std::span<const CharacterState<double>> before,
             std::span<const Input> inputs, const std::vector<bool>& launched) {
    if (!judge_) {
      header_.characters = records.size();
      for (const CharacterState<double>& state : before) header_.starts.push_back({state.position, state.velocity});
      for (MoverIndex i = 0; i < header_.scripts.size(); ++i)
        if (header_.scripts[i].body && header_.turning.empty())
          header_.scripts[i].path.assign(1, {.time = 0, .at = records.front().movers[i].from});
      judge_.emplace(header_, compare::Measured{});
      if (const char* folder = std::getenv("PAPERPROOF_GUARANTEE_TRACES"))
        writer_.emplace(std::string(folder) + "/" + kind_ + "_" + run_ + ".jsonl", header_);
    }
    for (std::size_t i = 0; i < records.size(); ++i) {
      records[i].character = static_cast<CharacterIndex>(i);
      records[i].input = inputs[i];
      records[i].step = steps_;
      if (steps_ > 0 && launched[i]) begin_anew(records[i], before[i]);
    }
    ++steps_;
    judge_->add(records);
    if (writer_)
      for (const compare::TraceStep& record : records) writer_->write(record);
  }
  void write(const compare::TraceStep& step, const CharacterState<double>& before, const Input& input, bool launched) {
    write({step}, {&before, 1}, {&input, 1}, {launched});
  }

 private:
  static std::vector<compare::MoverScript> of_bodies(const SceneryDef& scenery) {
    std::vector<compare::MoverScript> scripts;
    for (ColliderIndex i = 0; i < scenery.colliders.size(); ++i) {
      const MoverIndex mover = scenery.colliders[i].mover;
      if (mover == no_mover) continue;
      scripts.resize(std::max(scripts.size(), std::size_t{mover} + 1));
      scripts[mover].colliders.push_back(i);
      scripts[mover].body = true;
    }
    return scripts;
  }

  static void begin_anew(compare::TraceStep& record, const CharacterState<double>& before) {
    record.respawn = true;
    record.from = {.velocity = before.velocity,
                   .grounded = before.grounded,
                   .jumping = before.jumping,
                   .jump_held = before.jump_held,
                   .jump_pending = before.jump_pending};
    if (before.ride.ground != Ride<double>::none) record.from->ride = {before.ride.ground, before.ride.velocity};
  }

  std::string kind_;
  std::string run_;
  compare::TraceHeader header_;
  std::optional<compare::RunJudge> judge_;
  std::optional<compare::TraceWriter> writer_;
  int steps_ = 0;
};

}  // namespace paperproof::test
