#include "metrics/ledger_step.hpp"

#include "contains.hpp"
#include "metrics/rest.hpp"
#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// Cosine of the angle between two normals of one face, as far as Box2D's rounded corners know it.
constexpr double same_face = 0.9;
constexpr double ulp_of_float = 0x1p-23;

/// Met by the motion from the start alone, which something else may have turned before.
bool is_only_foreseen(const StepJudgement& judged, const Contact& touch) {
  return std::ranges::all_of(judged.contacts, [&](const ExactContact& exact) {
    return exact.collider != touch.collider || exact.side != touch.side || exact.foreseen;
  });
}

std::vector<ColliderIndex> crossed(const StepJudgement& judged) {
  std::vector<ColliderIndex> all = judged.tunnelled;
  for (const std::vector<ColliderIndex>* more : {&judged.entered, &judged.one_way_broken})
    for (const ColliderIndex collider : *more)
      if (!contains(all, collider)) all.push_back(collider);
  return all;
}

}  // namespace

StepLedger::StepLedger(const LedgerParty& mine, const LedgerParty& reference, const Ledger::View& view,
                       const Known& known)
    : mine_(mine),
      reference_(reference),
      known_(known),
      now_(view.now()),
      m_(now_.mine.step),
      r_(now_.reference.step),
      mine_solids_(*mine.header, *mine.solids, m_),
      reference_solids_(*reference.header, *reference.solids, r_),
      dt_(length_of(m_, *mine.header)) {
  const auto at = [&](std::size_t k, int step) -> const Ledger::Moment* {
    return k < view.around.size() && view.around[k].mine.step.step == step ? &view.around[k] : nullptr;
  };
  before_ = view.centre > 0 ? at(view.centre - 1, m_.step - 1) : nullptr;
  after_ = at(view.centre + 1, m_.step + 1);
  const Vec2d aside = r_.path.front().position - m_.path.front().position;
  apart_ = std::max(aside.norm(), (r_.requested - m_.requested).norm());
  double ulp = 0;
  for (const TraceStep* step : {&m_, &r_})
    for (const PathPoint* end : {&step->path.front(), &step->path.back()})
      ulp = std::max(ulp, ulp_at(*reference.header, end->position));
  rounding_ = ulps * (ulp + ulp_of_float * r_.requested.norm());
}

std::vector<StepLedger::Event> StepLedger::events() {
  match();
  add_crossings();
  add_contacts();
  add_time();
  add_toggle();
  add_stop();
  settle();
  return std::move(events_);
}

bool StepLedger::same_surface(const Contact& a, const Contact& b) const {
  if (!(a.normal.dot(b.normal) > same_face)) return false;
  return a.collider == b.collider || std::abs((a.point - b.point).dot(b.normal)) <= box2d_skin + rounding_;
}

void StepLedger::match() {
  std::vector<bool> taken(r_.contacts.size());
  for (const Contact& touch : m_.contacts) {
    bool found = false;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      const Contact& other = r_.contacts[i];
      if (!same_surface(touch, other)) continue;
      found = taken[i] = true;
      if (touch.collider == other.collider && touch.side == other.side) both_.emplace_back(&touch, &other);
    }
    if (!found) only_mine_.push_back(&touch);
  }
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (!taken[i]) only_reference_.push_back(&r_.contacts[i]);
}

std::string StepLedger::named(const Contact& touch) const {
  return fmt::format("{} `{}`, normal ({:.3g}, {:.3g}), at {:.4g}", name_of(touch.side),
                     mine_.header->ids[touch.collider], touch.normal.x(), touch.normal.y(), touch.fraction);
}

/// A gap that Box2D's skin explains, or its rounding.
std::optional<Cause> StepLedger::within_skin(double gap) const {
  if (gap > 0 && gap <= box2d_skin) return Cause::skin;
  if (gap > -rounding_ && gap <= box2d_skin + rounding_) return Cause::float_rounding;
  return std::nullopt;
}

/// As for the contender's recall: another collider of the same side stands for the same floor.
bool StepLedger::is_missed_by_mine(const Contact& touch) const {
  const StepJudgement& judged = now_.mine.judged;
  if (m_.stuck || !is_exact(judged, touch) || is_only_foreseen(judged, touch)) return false;
  return std::ranges::none_of(
      m_.contacts, [&](const Contact& reported) { return reported.side == touch.side && is_exact(judged, reported); });
}

bool StepLedger::is_right_of_mine(const Contact& touch) const {
  const StepJudgement& judged = now_.mine.judged;
  if (is_exact(judged, touch) || contains(judged.deflected, std::pair(touch.collider, touch.side))) return true;
  return (contains(judged.dont_care, touch.collider) && !is_ghost(judged, touch)) || judged.beside_another;
}

bool StepLedger::reports_next(const Contact& touch) const {
  if (after_ == nullptr) return false;
  const std::vector<Contact>& next = after_->reference.step.contacts;
  return std::ranges::any_of(next, [&](const Contact& later) { return same_surface(touch, later); });
}

/// Whether Box2D's cap ends its way before it comes to what exact arithmetic says it would meet.
bool StepLedger::is_capped_before(const Contact& touch) const {
  if (!r_.capped || !(r_.requested.norm() > longest_way)) return false;
  const auto impact =
      reference_.solids->time_of_impact(Place(r_.path.front(), r_.movers), r_.requested, touch.collider);
  return impact && static_cast<double>(impact->fraction) * r_.requested.norm() > longest_way - box2d_skin;
}

StepLedger::Event StepLedger::of_reference(const Contact& touch, EventKind kind) const {
  const StepJudgement& judged = now_.reference.judged;
  const double gap = reference_solids_.gap_on_way(touch.collider);
  const double mine = mine_solids_.gap_on_way(touch.collider);
  Event event{.kind = kind,
              .words = fmt::format("only Box2D reports {}; it is {:.3g} m away, {} {:.3g} m", named(touch), gap,
                                   mine_.header->contender, mine),
              .gap = gap};
  if (is_missed_by_mine(touch)) {
    event.cause = Cause::error_of_ours;
  } else if (is_ghost(judged, touch)) {
    event.cause = Cause::ghost_collision;
  } else if (is_exact(judged, touch) && (kind == EventKind::contact || apart_ > within_skins + rounding_)) {
    event.both_right = true;
  } else if (const std::optional<Cause> near = within_skin(gap)) {
    // From the edge of the skin another surface of the same collider may be the nearest.
    if (mine <= within_skins + rounding_) event.cause = near;
    event.both_right = true;
  } else if (!is_exact(judged, touch) && !is_crushed(judged) && !is_inside(r_)) {
    event.cause = Cause::error_of_box2d;
  } else {
    event.both_right = true;
  }
  return event;
}

StepLedger::Event StepLedger::of_mine(const Contact& touch) const {
  const StepJudgement& judged = now_.reference.judged;
  const double gap = reference_solids_.gap_on_way(touch.collider);
  Event event{
      .words = fmt::format("only {} reports {}; Box2D is {:.3g} m away", mine_.header->contender, named(touch), gap),
      .gap = gap};
  const bool met = is_exact(judged, touch);
  const bool inside = contains(r_.start_overlap, touch.collider);
  const std::optional<Cause> near = within_skin(gap);
  if (!is_right_of_mine(touch)) {
    event.cause = Cause::error_of_ours;
  } else if (is_capped_before(touch)) {
    event.cause = Cause::travel_cap;
  } else if (contains(crossed(judged), touch.collider)) {
    event.cause = Cause::error_of_box2d;
  } else if (met && near && reports_next(touch)) {
    event.cause = Cause::event_latency;
  } else if (near) {
    event.cause = near;
  } else {
    // What Box2D foresaw from its start it need not meet if something turned it before, or if it is inside already.
    event.both_right = !met || inside || (is_only_foreseen(judged, touch) && !r_.contacts.empty());
  }
  return event;
}

void StepLedger::add_contacts() {
  const auto with = [](const std::vector<const Contact*>& some, const Contact& touch) {
    const auto found = std::ranges::find(some, touch.collider, &Contact::collider);
    return found == some.end() ? nullptr : *found;
  };
  for (const Contact* touch : only_reference_) {
    const Contact* other = with(only_mine_, *touch);
    Event event = of_reference(*touch, other != nullptr ? EventKind::side : EventKind::contact);
    if (other != nullptr && !is_right_of_mine(*other)) event.cause = Cause::error_of_ours;
    events_.push_back(std::move(event));
  }
  for (const Contact* touch : only_mine_)
    if (with(only_reference_, *touch) == nullptr) events_.push_back(of_mine(*touch));
}

/// Relative to what the collider goes along with [m].
Vec2d StepLedger::wanted_of_reference(const Contact& touch) const {
  return r_.requested - reference_solids_.moved(touch.collider, touch.point, touch.fraction);
}

/// From where Box2D was at the time that it reports, to the collider [m].
double StepLedger::gap_when_reported(const Contact& touch) const {
  const auto next = std::find_if(r_.path.begin() + 1, r_.path.end() - 1,
                                 [&](const PathPoint& corner) { return corner.fraction >= touch.fraction; });
  const PathPoint& from = *(next - 1);
  const double length = next->fraction - from.fraction;
  const double share = length > 0 ? std::clamp((touch.fraction - from.fraction) / length, 0.0, 1.0) : 1;
  return reference_solids_.at(touch.fraction)
      .separation(Place(from.position + share * (next->position - from.position), r_.movers, touch.fraction),
                  touch.collider);
}

/// Of the colliders and sides that both report, the one whose earliest times differ most.
void StepLedger::add_time() {
  double most = same_event;
  const Contact* mine = nullptr;
  const Contact* reference = nullptr;
  for (const auto& [m, r] : both_) {
    const auto is_it = [touch = r](const Contact& other) {
      return other.collider == touch->collider && other.side == touch->side;
    };
    double first = m->fraction;
    for (const Contact& other : m_.contacts)
      if (is_it(other)) first = std::min(first, other.fraction);
    const double apart = std::abs(first - r->fraction) * std::abs(wanted_of_reference(*r).dot(m->normal));
    if (!(apart > most)) continue;
    most = apart;
    mine = m;
    reference = r;
  }
  if (mine == nullptr) return;
  Event event{.kind = EventKind::time,
              .both_right = true,
              .words = fmt::format("{}: at {:.6g} for {}, at {:.6g} for Box2D, {:.3g} m apart", named(*mine),
                                   mine->fraction, mine_.header->contender, reference->fraction, most),
              .gap = gap_when_reported(*reference)};
  const std::optional<Cause> near = within_skin(event.gap);
  if (most <= rounding_) {
    event.cause = Cause::float_rounding;
  } else if (near && most <= within_skins + rounding_) {
    event.cause = near;
  } else if (!near && !is_inside(r_)) {
    event.cause = Cause::sampled_time;
  }
  events_.push_back(std::move(event));
}

void StepLedger::add_crossings() {
  for (const ColliderIndex collider : crossed(now_.mine.judged))
    events_.push_back({EventKind::crossing, Cause::error_of_ours, false,
                       fmt::format("{} passes or enters `{}`", mine_.header->contender, mine_.header->ids[collider])});
  for (const ColliderIndex collider : crossed(now_.reference.judged)) {
    const double depth = reference_solids_.at(1).penetration(Place(r_.path.back(), r_.movers), collider);
    const bool rounded = depth > 0 && depth <= rounding_;
    events_.push_back({EventKind::crossing, rounded ? Cause::float_rounding : Cause::error_of_box2d, false,
                       fmt::format("Box2D passes or enters `{}`, {:.3g} m deep at the end of the step",
                                   mine_.header->ids[collider], depth)});
  }
  for (const ColliderIndex collider : now_.reference.judged.clipped)
    events_.push_back({EventKind::crossing, Cause::skin, false,
                       fmt::format("Box2D clips `{}` no deeper than its skin", mine_.header->ids[collider])});
}

/// After settling, one changes the sides of its contacts. Exact arithmetic has a reason where its own sides change too.
void StepLedger::add_toggle() {
  if (before_ == nullptr) return;
  const auto toggles = [](const Ledger::Says& before, const Ledger::Says& now, int rests) {
    return rests > Rest::settling_steps + 1 && sides_of(before.step.contacts) != sides_of(now.step.contacts);
  };
  const auto has_reason = [](const Ledger::Says& before, const Ledger::Says& now) {
    return sides_of(before.judged.contacts) != sides_of(now.judged.contacts);
  };
  const bool mine = toggles(before_->mine, now_.mine, now_.rests_mine);
  const bool reference = toggles(before_->reference, now_.reference, now_.rests_reference);
  if (mine == reference) return;
  const bool reason = mine ? has_reason(before_->mine, now_.mine) : has_reason(before_->reference, now_.reference);
  Event event{.kind = mine ? EventKind::toggle_ours : EventKind::toggle_box2d,
              .both_right = reason,
              .words = fmt::format("at rest {} changes the sides of its contacts, exact arithmetic has {} reason",
                                   mine ? mine_.header->contender : "Box2D", reason ? "a" : "no")};
  if (mine && !reason) event.cause = Cause::error_of_ours;
  if (reference && !reason) {
    event.cause = Cause::skin;
    for (const Ledger::Moment* moment : {before_, &now_})
      for (const Contact& touch : moment->reference.step.contacts)
        if (!within_skin(SolidsInStep(*reference_.header, *reference_.solids, moment->reference.step)
                             .gap_on_way(touch.collider)))
          event.cause.reset();
  }
  events_.push_back(std::move(event));
}

/// Gives causes to what its own predicates left open: first by another event of the step, where they began alike or no
/// further apart than their skins; then by the circumstances; last, in lockstep, by the start that the skin needs.
void StepLedger::settle() {
  const bool together = apart_ <= within_skins + rounding_;
  const auto cause_of = [this](auto&& is_one) {
    const auto found = std::ranges::find_if(events_, [&](const Event& one) { return one.cause && is_one(one); });
    return found == events_.end() ? std::nullopt : found->cause;
  };
  const std::optional<Cause> of_contact = cause_of([](const Event& one) {
    return (one.kind == EventKind::contact || one.kind == EventKind::side) && one.cause != Cause::error_of_ours;
  });
  for (Event& event : events_) {
    if (event.cause || event.kind != EventKind::stop) continue;
    if (event.both_right && together) event.cause = of_contact;
    if (!event.cause && (!event.both_right || together)) event.cause = circumstance_of_stop();
    event.both_right = event.both_right || is_inside(r_);  // the way out of what it should not have entered
  }
  const std::optional<Cause> of_stop = cause_of([](const Event& one) { return one.kind == EventKind::stop; });
  for (Event& event : events_) {
    if (event.cause || !event.both_right) continue;
    if (together && event.kind != EventKind::stop) event.cause = of_stop;
    if (!event.cause && event.kind == EventKind::time &&
        (is_crushed(now_.mine.judged) || is_crushed(now_.reference.judged)))
      event.cause = Cause::crush;
    if (!event.cause && known_.lockstep && apart_ > rounding_)
      event.cause = within_skin(event.gap).value_or(Cause::remaining_lockstep);
  }
}

}  // namespace paperproof::compare::detail
