#include "metrics/ledger.hpp"

#include "metrics/ledger_step.hpp"

#include <fmt/format.h>

#include <array>

namespace paperproof::compare {
namespace {

/// Whether a step wants no sideways motion, ends on the ground, and nothing else acts on the character.
bool rests(const TraceStep& step, const StepJudgement& judged) {
  return step.grounded && step.requested.x() == 0 && step.met.empty() && judged.crushed.empty() &&
         judged.pressed.empty();
}

}  // namespace

std::string_view name_of(EventKind kind) noexcept {
  constexpr auto names =
      std::to_array<std::string_view>({"contact", "side", "time", "crossing", "stop", "toggle_ours", "toggle_box2d"});
  static_assert(names.size() == static_cast<std::size_t>(EventKind::toggle_box2d) + 1);
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(Cause cause) noexcept {
  constexpr auto names = std::to_array<std::string_view>(
      {"skin", "travel_cap", "event_latency", "response_law", "solver_iterations", "outline", "sampled_time", "intent",
       "ghost_collision", "float", "start_inside", "crush", "company", "error_of_box2d", "error_of_ours",
       "remaining_lockstep", "after_divergence", "unexplained"});
  static_assert(names.size() == static_cast<std::size_t>(Cause::unexplained) + 1);
  return names[static_cast<std::size_t>(cause)];
}

Ledger::Ledger(const LedgerParty& mine, const LedgerParty& reference, bool lockstep)
    : mine_(mine), reference_(reference), lockstep_(lockstep) {
  for (const ColliderDef& collider : reference.header->scenery.colliders)
    for (std::size_t i = 0; i < collider.points.size(); ++i) {
      const std::size_t next = (i + 1) % collider.points.size();
      const bool close = (collider.points[next] - collider.points[i]).norm() < detail::least_edge;
      has_close_vertices_ = has_close_vertices_ || (collider.points.size() > 1 && close);
    }
}

void Ledger::add(const TraceStep& mine, const StepJudgement& mine_judged, const TraceStep& reference,
                 const StepJudgement& reference_judged, bool beside_another) {
  rests_mine_ = rests(mine, mine_judged) ? rests_mine_ + 1 : 0;
  rests_reference_ = rests(reference, reference_judged) ? rests_reference_ + 1 : 0;
  window_.add({{mine, mine_judged}, {reference, reference_judged}, rests_mine_, rests_reference_, beside_another},
              [this](const View& view) { judge(view); });
}

void Ledger::finish() {
  window_.last([this](const View& view) { judge(view); });
}

void Ledger::judge(const View& view) {
  detail::StepLedger step(mine_, reference_, view,
                          {.lockstep = lockstep_, .close_vertices = has_close_vertices_, .entered = entered_});
  const int number = view.now().mine.step.step;
  const bool together = step.apart() <= step.rounding();
  if (together) {
    divergence_.reset();
    apart_for_ = 0;
  }
  ++apart_for_;
  // Rounding adds up, at most by as much in every step.
  if (!together && !divergence_ && !lockstep_ && step.apart() <= apart_for_ * step.rounding())
    divergence_ = Divergence{number, Cause::float_rounding};
  entered_ = entered_ && !view.now().reference.step.start_overlap.empty();
  const std::optional<Divergence> before = divergence_;
  for (detail::StepLedger::Event& event : step.events()) {
    Cause cause = event.cause.value_or(Cause::unexplained);
    if (!event.cause && event.both_right && before) {
      cause = Cause::after_divergence;
      event.words += fmt::format("; apart since step {} ({})", before->step, name_of(before->cause));
    }
    const bool crosses = event.kind == EventKind::crossing && cause == Cause::error_of_box2d;
    entered_ = entered_ || crosses;
    if (!lockstep_ && !divergence_ && event.cause && (crosses || event.kind == EventKind::stop))
      divergence_ = Divergence{number, *event.cause};
    Disagreements& sum = sums_[{cause, event.kind}];
    if (sum.count++ == 0) {
      sum.first_step = number;
      sum.first = std::move(event.words);
    }
  }
}

void Ledger::write(Row& row) const {
  for (const auto& [key, sum] : sums_) {
    Disagreements& all = row.disagreements[fmt::format("{}.{}", name_of(key.first), name_of(key.second))];
    if (all.count == 0 || sum.first_step < all.first_step) all = {all.count, sum.first_step, sum.first};
    all.count += sum.count;
  }
}

}  // namespace paperproof::compare
