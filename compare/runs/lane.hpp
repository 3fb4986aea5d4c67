/// Runs one contender and feeds every step to judge, metrics, trace and replay.
#pragma once

#include "metrics/answers.hpp"
#include "records/scene_result.hpp"
#include "records/trace_writer.hpp"
#include "runs/body_judge.hpp"
#include "runs/contender.hpp"
#include "runs/cost.hpp"
#include "runs/run_judge.hpp"

#include <memory>
#include <optional>

namespace paperproof::compare {

/// How many steps a replay keeps, and which.
struct ReplayLimit {
  int steps = 0;  ///< That run.
  int most = 0;   ///< To keep; 0: none.
};

/// Steps a contender, has every step judged, and collects what a row, a trace and a replay need. Whatever goes wrong
/// ends the lane with a row that says why. Not thread-safe.
class Lane {
 public:
  Lane(std::string contender, ScalarKind scalar, const Scene& scene, const Scenery& scenery, const Planning& planning,
       const std::string& mode, const std::string& trace_stem, const ReplayLimit& replay);

  [[nodiscard]] bool running() const noexcept { return contender_ != nullptr; }
  [[nodiscard]] const std::string& contender_name() const noexcept { return row_.contender; }
  [[nodiscard]] Contender& contender() noexcept { return *contender_; }
  [[nodiscard]] const TraceHeader& header() const noexcept { return contender_->header(); }
  [[nodiscard]] const ExactScenery& solids() const noexcept { return judge_->solids(); }
  [[nodiscard]] std::size_t characters() const noexcept { return records_.size(); }
  [[nodiscard]] const TraceStep& record(std::size_t character = 0) const noexcept { return records_[character]; }
  [[nodiscard]] const StepJudgement& judgement(std::size_t character = 0) const noexcept {
    return judge_->judgement(character);
  }
  /// Every clause that a step broke so far, whether it was promised or not.
  [[nodiscard]] Breaches breaches() const { return judge_ ? judge_->breaches() : Breaches{}; }
  [[nodiscard]] Row& row() noexcept { return row_; }
  /// In words; empty where the run begins free.
  [[nodiscard]] std::string begins_inside() const {
    return judge_ && !judge_->begins_inside().empty() ? judge_->begins_inside().front() : "";
  }
  [[nodiscard]] ReportRun& replay() noexcept { return replay_; }

  /// What the run must come to.
  void expect(const std::vector<Answer>& answers);
  /// Puts a character somewhere; the next step begins a new story.
  void place(const Pose& pose, std::size_t character = 0);
  /// Gives a character another velocity [m/s]; the next step begins a new story with all else that it had.
  void launch(const Vec2d& velocity, std::size_t character);
  /// Puts a character back to a start, before a step, and remembers it.
  void respawn(const Start& start, const Respawn& when);
  [[nodiscard]] const std::vector<Respawn>& respawns() const noexcept { return respawns_; }
  /// Whether no other character would be overlapped there.
  [[nodiscard]] bool is_free(const Vec2d& position, std::size_t character) const;
  /// The run cannot be made; its row is `not_applicable` and says why.
  void give_up(const std::string& reason) { fail(Verdict::not_applicable, reason); }
  void step(int step, const StepInput& input);
  /// Writes metrics and verdict into the row and the trace to its place.
  void finish();

 private:
  [[nodiscard]] TraceHeader header_as_run() const;
  void write_metrics();
  void begin_records(int step, const StepInput& input);
  [[nodiscard]] bool is_finite() const;
  void judge_step();
  void fail(Verdict verdict, const std::string& reason);
  void end_early(const std::string& reason);
  void keep_for_replay();
  void note_events(std::size_t character);
  void conclude();

  Row row_;
  ReportRun replay_;
  ReplayLimit limit_;
  bool steps_vary_;  ///< Each step has a length of its own.
  std::unique_ptr<Contender> contender_;
  std::unique_ptr<RunJudge> judge_;
  std::optional<AnswerCheck> answers_;  ///< None where nothing is asked.
  std::unique_ptr<BodyJudge> bodies_;   ///< Null where none are Box2D's own.
  std::unique_ptr<TraceWriter> trace_;
  // By character:
  std::vector<TraceStep> records_;
  std::vector<std::optional<TraceState>> placed_;  ///< Since the last step, with this state.
  std::vector<bool> hung_;                         ///< In the step before.
  std::vector<Respawn> respawns_;
};

}  // namespace paperproof::compare
