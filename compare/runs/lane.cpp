#include "runs/lane.hpp"

#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// The guarantee of octagon_sweep covers starts this near to the origin [m].
constexpr double guaranteed_range = 1e6;
/// The largest gap that it may leave at a contact [m].
constexpr double guaranteed_gap = 1e-6;
/// The first steps are kept for the replay one by one: a start is what people look at.
constexpr int first_steps = 60;

}  // namespace

Lane::Lane(std::string contender, ScalarKind scalar, const Scene& scene, const Scenery<double>& scenery,
           const Planning& planning, const std::string& mode, const std::string& trace_stem, const ReplayLimit& replay)
    : limit_(replay) {
  row_.scene = scene.name;
  row_.contender = std::move(contender);
  row_.scalar = is_reference(row_.contender) ? name_of(ScalarKind::binary32) : name_of(scalar);
  row_.mode = mode;
  try {
    contestant_ = make_contestant(row_.contender, scalar, scene, scenery, planning);
    judge_ = std::make_unique<Judge>(header());
    metrics_ = std::make_unique<Metrics>(header(), metrics_for(scene, planning).measured);
    if (limit_.most > 0) {
      replay_.header = header();
      replay_.every = std::max(1, (limit_.steps + limit_.most - 1) / limit_.most);
    }
  } catch (const NotApplicable& reason) {
    fail(Verdict::not_applicable, reason.what());
  } catch (const std::exception& error) {
    fail(Verdict::failed, error.what());
  }
  // A trace that cannot be written ends the command, not the lane.
  if (running() && !trace_stem.empty())
    trace_ = std::make_unique<TraceWriter>(trace_path(trace_stem, row_.scene, row_.contender, row_.scalar), header());
}

void Lane::note_start() {
  if (inside_.empty()) return;
  begins_inside_ = fmt::format("the run begins inside `{}`", header().ids[inside_.front()]);
  if (inside_.size() > 1) begins_inside_ += " and " + counted(inside_.size() - 1, "other collider");
  row_.findings.push_back(begins_inside_);
}

void Lane::fail(Verdict verdict, const std::string& reason) {
  row_.verdict = verdict;
  row_.reason = reason;
  contestant_.reset();
}

/// What ran is scored; the row says that it ended before its time.
void Lane::end_early(const std::string& reason) {
  metrics_->write(row_);
  conclude();
  if (row_.verdict == Verdict::holds) {
    row_.verdict = Verdict::flagged;
    row_.reason = reason;
  } else {
    row_.findings.push_back(reason);
  }
  contestant_.reset();
}

void Lane::place(const Pose& pose) {
  contestant_->place(pose);
  placed_ = true;
}

void Lane::step(int step, const StepInput& input) {
  try {
    record_.step = step;
    record_.respawn = placed_ && step > 0;
    contestant_->step(input, record_);
    // What moves stands where the last step left it: who was not put elsewhere begins in what he ended in.
    if (placed_) inside_ = solids().overlapped({record_.path.front(), record_.movers});
    placed_ = false;
    record_.start_overlap = inside_;
    if (step == 0) note_start();
    judgement_ = judge_->judge(record_);
    metrics_->add(record_, judgement_);
  } catch (const LeftRange& reason) {
    return end_early(fmt::format("step {}: {}", step, reason.what()));
  } catch (const std::exception& error) {
    return fail(Verdict::failed, fmt::format("step {}: {}", step, error.what()));
  }
  ++row_.steps;
  inside_ = judgement_.end_overlap;
  if (!judgement_.crushed_with_room.empty()) ++steps_miscalled_;
  if (judgement_.broke()) ++steps_broken_;
  if (record_.capped) ++steps_capped_;
  if (trace_) trace_->write(record_);
  if (limit_.most > 0) keep_for_replay();
}

void Lane::keep_for_replay() {
  const std::size_t before = replay_.events.size();
  const auto note = [this](ReportEvent::Kind kind, const std::vector<ColliderIndex>& colliders, const char* what,
                           const std::string& when = "") {
    if (!colliders.empty() && replay_.events.size() < static_cast<std::size_t>(limit_.most))
      replay_.events.push_back(
          {record_.step, kind, fmt::format("{} {}{}", what, header().ids[colliders.front()], when)});
  };
  note(ReportEvent::Kind::tunnel, judgement_.tunnelled, "passes");
  note(ReportEvent::Kind::corner_cut, judgement_.corner_cut, "cuts a corner of");
  note(ReportEvent::Kind::one_way, judgement_.one_way_broken, "passes against its normal:");
  note(ReportEvent::Kind::crush, record_.crushed, "is crushed by");
  for (const SensorEvent<double>& event : record_.sensors)
    note(ReportEvent::Kind::sensor, {event.sensor},
         event.change == SensorEvent<double>::Change::enter ? "enters" : "leaves",
         header().path_exact ? fmt::format(" at {:.6g} of the step", event.fraction) : ", seen when the step begins");
  if (inside_ != record_.start_overlap) note(ReportEvent::Kind::inside, inside_, "ends inside");
  const bool kept = record_.step < first_steps || record_.step % replay_.every == 0 ||
                    record_.step + 1 == limit_.steps || replay_.events.size() > before;
  if (kept) replay_.steps.push_back(record_);
}

void Lane::finish() {
  if (running()) {
    metrics_->write(row_);
    if (const std::size_t bytes = contestant_->memory_bytes(); bytes > 0) row_.memory_bytes = bytes;
    conclude();
  }
  if (trace_) trace_->commit();
}

bool Lane::guaranteed() const {
  if (row_.contender != paperproof::name_of(TechniqueKind::octagon_sweep) ||
      row_.scalar != name_of(ScalarKind::binary64))
    return false;
  const auto within = [](const Vec2d& p) { return p.cwiseAbs().maxCoeff() <= guaranteed_range; };
  const std::vector<ColliderDef>& colliders = header().scenery.colliders;
  return std::all_of(colliders.begin(), colliders.end(), [&](const ColliderDef& collider) {
    return std::all_of(collider.points.begin(), collider.points.end(), within);
  });
}

void Lane::conclude() {
  const int inside = row_.steps_ending_inside.value_or(0);
  const double gap = row_.max_contact_gap_m.value_or(0);
  const bool wide_gap = gap > guaranteed_gap;
  const std::string miscalled = fmt::format("a crush with room to give way on {}", counted(steps_miscalled_, "step"));
  if (guaranteed() && (steps_broken_ > 0 || steps_miscalled_ > 0 || wide_gap)) {
    row_.verdict = Verdict::violates;
    row_.reason = steps_broken_ > 0      ? fmt::format("{} into or through a solid", counted(steps_broken_, "step"))
                  : steps_miscalled_ > 0 ? miscalled
                                         : fmt::format("a contact is {:.3g} m away", gap);
  } else if (steps_capped_ > 0) {
    row_.verdict = Verdict::flagged;
    row_.reason =
        fmt::format("{} beyond Box2D's travel cap of 2 m per step, not scored", counted(steps_capped_, "step"));
  } else if (row_.tunnels.value_or(0) > 0) {
    row_.verdict = Verdict::tunnels;
    row_.reason = fmt::format("{} through a solid", counted(*row_.tunnels, "step"));
    if (!row_.findings.empty()) {  // the first passage in words says more
      row_.reason = row_.findings.front();
      row_.findings.erase(row_.findings.begin());
    }
  } else if (steps_broken_ > 0) {
    row_.verdict = Verdict::flagged;
    row_.reason = inside > 0
                      ? fmt::format("ends {} inside a solid, up to {:.3g} m deep", counted(inside, "step"),
                                    row_.max_penetration_m.value_or(0))
                      : fmt::format("passes a one-way chain against its normal on {}", counted(steps_broken_, "step"));
  } else if (steps_miscalled_ > 0) {
    row_.verdict = Verdict::flagged;
    row_.reason = miscalled;
  }
}

}  // namespace paperproof::compare
