/// Judges a run from what its trace holds, clause by clause of the guarantee.
#pragma once

#include "metrics/metrics.hpp"
#include "oracle/company.hpp"
#include "oracle/in_turns.hpp"
#include "oracle/intent.hpp"
#include "oracle/judge.hpp"
#include "oracle/met_surfaces.hpp"
#include "oracle/mover_way.hpp"

#include <memory>

namespace paperproof::compare {

/// Feed it every step of one run in order, then write the row. What a record says that was requested is compared with
/// what scene, input and state ask for, and the latter is judged. Not thread-safe.
class RunJudge {
 public:
  RunJudge(const TraceHeader& header, const Measured& measured);
  RunJudge(const RunJudge&) = delete;
  RunJudge& operator=(const RunJudge&) = delete;

  /// @param records one of each character, in order. What they overlapped when the step began is written into them.
  void add(std::span<TraceStep> records);
  /// A record says what it overlapped when the step began that `add` judged last; others are given the truth.
  void check_start(const TraceStep& claimed, const TraceStep& judged);
  /// A step that was refused, and changed nothing.
  void add_refused(const TraceStep& record);

  /// Of the scene.
  [[nodiscard]] const ExactScenery& solids() const noexcept {
    return of_scene_ ? of_scene_->scenery() : followers_.front().judge->scenery();
  }
  [[nodiscard]] const StepJudgement& judgement(std::size_t character) const noexcept { return judgements_[character]; }
  /// Whether no other character would be overlapped there.
  /// @param positions of all.
  [[nodiscard]] bool is_free(std::span<const Vec2d> positions, std::size_t character) const;
  /// In words, where the run begins inside something; in order of characters.
  [[nodiscard]] const std::vector<std::string>& begins_inside() const noexcept { return begins_inside_; }

  /// Writes the metrics, what was broken of the guarantee, and where the run falls short.
  void write(Row& row) const;
  /// Every clause that a step broke, whether it was promised or not.
  [[nodiscard]] Breaches breaches() const;

 private:
  /// What is remembered of one character from step to step.
  struct Follower {
    std::unique_ptr<Judge> judge;
    Intent intent;
    Wanted wanted{};
    std::vector<ColliderIndex> inside{};  ///< What the octagon overlaps now, exactly.
    std::vector<TraceStep> last{};        ///< Two steps, the earlier one first; none before the first step.
    Wanted last_wanted{};                 ///< In the later of them.
    bool begins = true;                   ///< The next step does not continue one.
    int steps_alone = 0;                  ///< So many in a row none is near that went since the one before.
    std::optional<Vec2d> stood_at{};      ///< Where it has begun to stand still, as it says.
    Vec2d crept{Vec2d::Zero()};           ///< Over its steps, less a share of its way: see `StepJudgement::crept` [m].
  };

  void note(Clause clause, const TraceStep& record, const std::string& what);
  void note_begin(const std::vector<TraceStep>& records);
  void judge_course(const TraceStep& record, Follower& follower);
  void judge_wish(const TraceStep& record, const Wanted& wanted, const Follower& follower);
  void judge_rest(const TraceStep& record, const Follower& follower);
  void judge_standing(const TraceStep& record, Follower& follower);
  void judge_creeping(const TraceStep& record, const StepJudgement& judged, Follower& follower);
  void judge_ride(const TraceStep& record, const Follower& follower);
  void judge_carrier(const SolidsInStep& there, const Follower& follower);
  [[nodiscard]] bool is_ground_velocity_invented(const TraceStep& record, const Follower& follower) const;
  [[nodiscard]] bool is_carried_unsaid(const TraceStep& record, const Follower& follower) const;
  [[nodiscard]] bool moves_or_conveys(const NearPart& part) const;
  void judge_clauses(const TraceStep& record, const StepJudgement& judged);
  void judge_velocity(const SolidsInStep& there, const StepJudgement& judged, const Follower& follower);
  void judge_movers(std::span<TraceStep> records);
  void judge_times(const TraceStep& record, const StepJudgement& judged, const Wanted& wanted);
  void judge_places(const TraceStep& record, const StepJudgement& judged);
  void judge_drops(const TraceStep& record);
  void judge_met(const TraceStep& record);
  [[nodiscard]] bool is_beside_what_turns(const TraceStep& record) const;
  [[nodiscard]] bool stands(const TraceStep& record) const;
  [[nodiscard]] bool may_respawn(const TraceStep& record, const Follower& follower) const;
  void write_faults(Row& row) const;

  [[nodiscard]] bool is_beside_another(const TraceStep& turn, const Follower& follower) const;
  void begin_turns(const TraceStep& record);
  void judge_carrying(std::span<const TraceStep> records);
  void leave_bodies_out(StepJudgement& judgement) const;
  /// What a step is judged among: in turns with the bodies of the others.
  [[nodiscard]] const ExactScenery& scenery() const noexcept { return followers_.front().judge->scenery(); }

  TraceHeader header_;  ///< Where they take turns, with their bodies.
  const Measured measured_;
  std::optional<InTurns> in_turns_;
  std::unique_ptr<Judge> of_scene_;        ///< Null where they take no turns.
  std::unique_ptr<CompanyJudge> company_;  ///< Null for one character.
  std::optional<Metrics> metrics_;
  std::vector<Follower> followers_;
  std::optional<MoverWayJudge> ways_;  ///< None where no script is known.
  double arc_error_ = 0;               ///< See `MoverWayJudgement` [m].
  int disagreements_ = 0;              ///< Steps on which two methods of the judge's own differ.
  std::vector<StepJudgement> judgements_;
  std::vector<std::string> begins_inside_;
  Breaches breaches_;
  bool refused_ = false;  ///< A step: the run ends there.
  int steps_ = 0;
  int steps_broken_ = 0;  ///< Steps that entered a solid, passed one, or passed a one-way chain backwards.
  int steps_capped_ = 0;
  int steps_far_ = 0;           ///< Steps that begin or go farther than what is guaranteed: exempted.
  bool broke_company_ = false;  ///< Some of `steps_broken_` are with another character.
};

}  // namespace paperproof::compare
