#include "runs/lane.hpp"

#include "records/verdict.hpp"
#include "runs/peers.hpp"
#include "runs/technique_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {

Lane::Lane(std::string contender, ScalarKind scalar, const Scene& scene, const Scenery& scenery,
           const Planning& planning, const std::string& mode, const std::string& trace_stem, const ReplayLimit& replay)
    : limit_(replay), steps_vary_(!scene.dt_list.empty()) {
  row_.scene = scene.name;
  row_.contender = std::move(contender);
  row_.scalar = is_reference(row_.contender) ? name_of(ScalarKind::binary32) : name_of(scalar);
  row_.mode = mode;
  row_.source = scene.source;
  row_.parameters = scene.parameters;
  const TechniqueEntry* technique = find_technique(row_.contender);
  const CharacterDef character =
      technique != nullptr ? rules_for(*technique, scene, planning.knobs) : rules_for_twin(scene);
  row_.parameters.emplace_back("jump_rules", jump_rules_in_force(character));
  try {
    if (mode == "lockstep" && !scene.others.empty())
      throw NotApplicable(
          fmt::format("lockstep is between one character and its twin, and here are {}", character_count(scene)));
    contender_ = make_contender(row_.contender, scalar, scene, scenery, planning);
    row_.knob = header().knob;
    row_.scalar = header().scalar;
    records_.resize(header().characters);
    placed_.assign(records_.size(), TraceState{});
    hung_.resize(records_.size());
    judge_ = std::make_unique<RunJudge>(header_as_run(), metrics_for(scene, planning).measured);
    if (is_reference(row_.contender)) bodies_ = std::make_unique<BodyJudge>(scene, header());
    if (bodies_ && !bodies_->any()) bodies_.reset();
    if (limit_.most > 0) {
      replay_.header = header_as_run();
      replay_.others.resize(header().characters - 1);
      replay_.every = std::max(1, (limit_.steps + limit_.most - 1) / limit_.most);
    }
  } catch (const NotApplicable& reason) {
    fail(Verdict::not_applicable, reason.what());
  } catch (const std::exception& error) {
    fail(Verdict::failed, error.what());
  }
  // A trace that cannot be written ends the command, not the lane.
  if (running() && !trace_stem.empty())
    trace_ =
        std::make_unique<TraceWriter>(trace_path(trace_stem, row_.scene, row_.contender, row_.scalar), header_as_run());
}

/// A contender does not know in which mode it runs, nor how long.
TraceHeader Lane::header_as_run() const {
  TraceHeader as_run = header();
  as_run.mode = row_.mode;
  // In lockstep a run ends with its twin's, and its trace does not say so.
  if (as_run.mode != "lockstep") as_run.steps = limit_.steps;
  return as_run;
}

void Lane::fail(Verdict verdict, const std::string& reason) {
  row_.verdict = verdict;
  row_.reason = reason;
  contender_.reset();
}

/// What ran is scored; the row says that it ended before its time.
void Lane::end_early(const std::string& reason) {
  write_metrics();
  add_fault(row_, Axis::validity, Verdict::flagged, reason);
  conclude();
  contender_.reset();
}

void Lane::expect(const std::vector<Answer>& answers) {
  if (running()) answers_.emplace(answers, header());
}

void Lane::place(const Pose& pose, std::size_t character) {
  contender_->place(pose, character);
  placed_[character] = pose.state;
  // A character of ours forgets its ride when it is placed.
  if (!is_reference(row_.contender)) placed_[character]->ride.reset();
}

void Lane::launch(const Vec2d& velocity, std::size_t character) {
  contender_->launch(velocity, character);
  placed_[character] = contender_->pose(character).state;
}

void Lane::respawn(const Start& start, const Respawn& when) {
  place(pose_at(start), when.character);
  respawns_.push_back(when);
}

bool Lane::is_free(const Vec2d& position, std::size_t character) const {
  std::vector<Vec2d> positions;
  for (std::size_t k = 0; k < records_.size(); ++k)
    positions.push_back(k == character ? position : contender_->pose(k).position);
  return judge_->is_free(positions, character);
}

/// What was put somewhere in between did not get there by itself.
void Lane::begin_records(int step, const StepInput& input) {
  for (std::size_t k = 0; k < records_.size(); ++k) {
    records_[k].step = step;
    if (steps_vary_) records_[k].dt = input.dt;
    records_[k].character = static_cast<CharacterIndex>(k);
    records_[k].input = input.players[k];
    records_[k].up = input.up != header().up ? std::optional(input.up) : std::nullopt;
    records_[k].gravity = input.gravity != header().gravity ? std::optional(input.gravity) : std::nullopt;
    records_[k].respawn = placed_[k] && step > 0;
    records_[k].from = records_[k].respawn ? placed_[k] : std::nullopt;
  }
}

void Lane::judge_step() {
  judge_->add(records_);
  std::ranges::fill(placed_, std::nullopt);
  if (records_.front().step == 0)
    row_.findings.insert(row_.findings.end(), judge_->begins_inside().begin(), judge_->begins_inside().end());
  if (answers_)
    for (const TraceStep& record : records_) answers_->add(record);
  if (bodies_) bodies_->add(records_.front());
}

bool Lane::is_finite() const {
  return std::ranges::all_of(records_, [](const TraceStep& record) {
    return record.velocity.allFinite() &&
           std::ranges::all_of(record.path, [](const auto& corner) { return corner.position.allFinite(); });
  });
}

void Lane::step(int step, const StepInput& input) {
  try {
    begin_records(step, input);
    contender_->step(input, records_);
    row_.finite = is_finite();
    if (!*row_.finite)
      return fail(Verdict::failed, fmt::format("step {}: a position or velocity that is no number", step));
    judge_step();
  } catch (const StepRefused& reason) {
    records_.front().refused = reason.what();
    judge_->add_refused(records_.front());
    if (trace_) trace_->write(records_.front());
    return end_early(fmt::format("step {}: {}", step, reason.what()));
  } catch (const std::exception& error) {
    return fail(Verdict::failed, fmt::format("step {}: {}", step, error.what()));
  }
  ++row_.steps;
  if (trace_)
    for (const TraceStep& record : records_) trace_->write(record);
  if (limit_.most > 0) keep_for_replay();
}

void Lane::keep_for_replay() {
  const std::size_t before = replay_.events.size();
  for (std::size_t k = 0; k < records_.size(); ++k) note_events(k);
  const int step = records_.front().step;
  // The beginning is kept whole: it is what people look at, and can be judged as a trace.
  const bool kept =
      step < limit_.most / 2 || step % replay_.every == 0 || step + 1 == limit_.steps || replay_.events.size() > before;
  if (!kept) return;
  replay_.steps.push_back(records_.front());
  for (std::size_t k = 1; k < records_.size(); ++k) replay_.others[k - 1].push_back(records_[k]);
}

void Lane::note_events(std::size_t character) {
  const TraceStep& record = records_[character];
  const StepJudgement& judged = judgement(character);
  const std::string who = characters() > 1 ? fmt::format("character {} ", character) : "";
  const auto tell = [&](ReportEvent::Kind kind, const std::string& words, std::optional<ColliderIndex> collider = {}) {
    if (replay_.events.size() < static_cast<std::size_t>(limit_.most))
      replay_.events.push_back({record.step, kind, who + words, record.character, collider});
  };
  const auto note = [&](ReportEvent::Kind kind, const char* what, const std::vector<ColliderIndex>& colliders,
                        const std::vector<CharacterIndex>& others = {}) {
    if (!colliders.empty()) tell(kind, fmt::format("{} {}", what, header().ids[colliders.front()]), colliders.front());
    if (!others.empty()) tell(kind, fmt::format("{} character {}", what, others.front()));
  };
  note(ReportEvent::Kind::tunnel, "passes", judged.tunnelled, judged.company.passed);
  note(ReportEvent::Kind::clipped, "clips", judged.clipped, judged.company.clipped);
  note(ReportEvent::Kind::one_way, "passes against its normal:", judged.one_way_broken);
  note(ReportEvent::Kind::crush, "is crushed by", record.crushed);
  note(ReportEvent::Kind::drop, "drops through", record.dropped_through);
  for (const SensorEvent& event : record.sensors)
    tell(ReportEvent::Kind::sensor,
         fmt::format("{} {}{}", event.change == SensorEvent::Change::enter ? "enters" : "leaves",
                     header().ids[event.sensor],
                     header().path_exact ? fmt::format(" at {:.6g} of the step", event.fraction)
                                         : ", seen when the step begins"),
         event.sensor);
  note(ReportEvent::Kind::inside, "ends inside", judged.entered, judged.company.entered);
  if (judged.hangs && !hung_[character]) tell(ReportEvent::Kind::hanging, "hangs in the air");
  hung_[character] = judged.hangs;
}

void Lane::write_metrics() {
  judge_->write(row_);
  contender_->write_notes(row_);
  const bool is_peer = find_peer(row_.contender) != nullptr;
  if (answers_ && is_peer && row_.contact_steps == 0) answers_->ask_no_contacts();
  if (answers_) answers_->write(row_);
  if (is_peer) {
    row_.sensor_errors.reset();  // it is not asked
    row_.broken.erase(std::string(name_of(Clause::sensor)));
  }
}

void Lane::finish() {
  if (running()) {
    write_metrics();
    if (const std::size_t bytes = contender_->memory_bytes(); bytes > 0) row_.memory_bytes = bytes;
    conclude();
  }
  if (trace_) trace_->commit();
}

void Lane::conclude() {
  if (!row_.answer_ok.value_or(true)) add_fault(row_, Axis::answer, Verdict::flagged, row_.answer);
  if (bodies_) bodies_->write(row_);
  settle(row_);
}

}  // namespace paperproof::compare
