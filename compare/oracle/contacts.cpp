#include "oracle/contacts.hpp"

#include "oracle/claims.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/hanging.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace paperproof::compare::detail {
namespace {

/// Below this gap at the end of the motion the controller may call it a contact already [m]: its hit distance, with
/// room for the rounding of the comparison.
constexpr double hit_reach = 1.01e-7;
/// Cosine of the angle between two normals of one face, as far as Box2D's floats and its rounded corners know it.
constexpr double same_face = 0.9;
/// A smaller share of the speed is rounding: Box2D's floats have 24 bits.
constexpr double least_loss = 1e-5;

}  // namespace

Side side_along(const Vec2d& normal, const Vec2d& up) {
  constexpr double rounding = 1e-12;
  const auto clean = [](double component) { return std::abs(component) <= rounding ? 0 : component; };
  return side_of_normal(clean(cross_of(normal, up)), clean(normal.dot(up)));
}

bool is_exact(const StepJudgement& judgement, const Contact& reported) {
  return std::any_of(judgement.contacts.begin(), judgement.contacts.end(), [&](const ExactContact& one) {
    return one.collider == reported.collider && one.side == reported.side;
  });
}

namespace {

double degrees_between(const Vec2d& a, const Vec2d& b) {
  return std::atan2(std::abs(cross_of(a, b)), a.dot(b)) * 180 / std::numbers::pi;
}

}  // namespace

ContactJudge::ContactJudge(const TraceHeader& header, const ExactScenery& scenery, const ExactScenery* grown_scenery,
                           const TraceStep& step)
    : header_(header),
      scenery_(scenery),
      grown_scenery_(grown_scenery),
      step_(step),
      up_(up_in(step, header)),
      right_(right_of(up_)),
      promises_(party_of(header) == Party::promising),
      touch_(promises_ ? guaranteed_touch : own_reach(header)),
      hit_(promises_ ? hit_reach : std::max(hit_reach, tolerance_named(header, "unit"))) {}

Vec2d ContactJudge::wanted(ColliderIndex collider) const {
  const MoverIndex mover = scenery_.scenery().colliders[collider].mover;
  if (mover == no_mover) return step_.requested;
  return step_.requested - (step_.movers[mover].to - step_.movers[mover].from);
}

/// What is passed on purpose is no contact.
bool ContactJudge::dropped_through(ColliderIndex collider) const {
  const std::vector<ColliderIndex>& passed = step_.dropped_through;
  return std::find(passed.begin(), passed.end(), collider) != passed.end();
}

void ContactJudge::judge(bool starts_free, StepJudgement& judgement) const {
  std::vector<ColliderIndex> met;  // by the requested motion
  const std::size_t begin = first_corner();
  for (std::size_t i = 0; i < step_.path.size(); ++i) {
    const Vec2d& position = step_.path[i].position;
    const bool end = i == 0 || i + 1 == step_.path.size();
    if (!header_.path_exact && !end) continue;
    if (i > begin && step_.movers.empty() && position == step_.path[i - 1].position) continue;
    const std::vector<ExactImpact> impacts = impacts_from(i);
    if (i == begin) {
      for (const ExactImpact& impact : impacts) met.push_back(impact.collider);
      add_first_impacts(impacts, starts_free, judgement);
    }
    add_contacts_at(i, impacts, met, judgement);
  }
  add_gaps(judgement);
  add_dont_care(judgement);
  add_ghosts(judgement);
  add_normal_error(judgement);
  measure_motion(starts_free, judgement);
  // What a crush stops is not stopped by nothing.
  if (judgement.crushed.empty()) judgement.ghost_speed_loss = ghost_speed_loss(starts_free, judgement);
}

Side ContactJudge::side_of(const ExactImpact& impact) const { return side_along(impact.normal, up_); }

bool ContactJudge::reports(const ExactImpact& impact) const {
  const Side side = side_of(impact);
  return std::any_of(step_.contacts.begin(), step_.contacts.end(), [&](const Contact& contact) {
    return contact.collider == impact.collider && contact.side == side;
  });
}

/// Whether its way, from the start, is not the requested one: a mover would leave it no room there.
bool ContactJudge::gives_way() const {
  if (!header_.path_exact || step_.movers.empty() || step_.path.size() < 2) return false;
  const PathPoint& corner = step_.path[1];
  const Vec2d expected = step_.path[0].position + step_.requested * corner.fraction;
  return (corner.position - expected).cwiseAbs().maxCoeff() > contact_reach;
}

/// The smallest separation over the corners of the way [m].
double ContactJudge::nearest(ColliderIndex collider) const {
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < step_.path.size(); ++i) {
    if (i > 0 && step_.movers.empty() && step_.path[i].position == step_.path[i - 1].position) continue;
    gap = std::min(gap, scenery_.separation(place(i), collider));
  }
  return gap;
}

void ContactJudge::add_gaps(StepJudgement& judgement) const {
  for (const Contact& contact : step_.contacts) {
    judgement.max_contact_gap = std::max(judgement.max_contact_gap, nearest(contact.collider));
  }
}

double ContactJudge::ghost_speed_loss(bool starts_free, const StepJudgement& judgement) const {
  const double wanted = across(step_.requested) / length_of(step_, header_);
  const double loss = std::clamp(1 - across(step_.velocity) / wanted, 0.0, 1.0);
  const bool is_rounding = !(loss * std::abs(wanted) * length_of(step_, header_) > rounding_across());
  return is_rounding || loss < least_loss || !starts_free || is_opposed(wanted, judgement) ? 0 : loss;
}

/// What is missing of the wanted horizontal displacement, and whether something exact is in the way of it.
void ContactJudge::measure_motion(bool starts_free, StepJudgement& judgement) const {
  const double wanted = across(step_.requested);
  judgement.motion_wanted = std::abs(wanted);
  if (std::abs(wanted) <= rounding_across() || !starts_free || !judgement.crushed.empty() || is_capped(step_, header_))
    return;
  const double made = across(step_.path.back().position - step_.path.front().position) + judgement.remainder_made;
  const double lost = std::clamp(std::abs(wanted) - std::copysign(1.0, wanted) * made, 0.0, std::abs(wanted));
  const double rounding = ulp_at(header_, step_.path.front().position) + least_loss * std::abs(wanted);
  if (lost > rounding && !is_opposed(wanted, judgement)) judgement.motion_lost = lost;
}

/// Of a motion straight along an up that is rounded this much may seem to go across [m].
double ContactJudge::rounding_across() const { return 1e-12 * step_.requested.norm(); }

/// Whether a solid is in the way of the wanted horizontal motion, from any corner of the path: of the motion as
/// requested, or at the height that it was left (ground may hold it).
bool ContactJudge::is_opposed(double wanted, const StepJudgement& judgement) const {
  // Ground that rests keeps what leads across up, but between it and another surface a motion may end.
  const auto is_ground = [this](const Contact& contact) {
    return header_.scenery.colliders[contact.collider].mover == no_mover && is_walkable(contact.normal, header_, up_);
  };
  const bool on_ground_alone =
      promises_ && !step_.contacts.empty() && std::all_of(step_.contacts.begin(), step_.contacts.end(), is_ground);
  // A contact that exact arithmetic has, or that an exact one deflected the motion into, may take it.
  for (const Contact& contact : step_.contacts) {
    const std::pair touch(contact.collider, contact.side);
    const bool confirmed =
        is_exact(judgement, contact) ||
        std::find(judgement.deflected.begin(), judgement.deflected.end(), touch) != judgement.deflected.end();
    if (promises_ && !on_ground_alone && (confirmed || comes_near(contact)) && across(contact.normal) * wanted < 0 &&
        has_face(contact))
      return true;
  }
  const double beyond = std::copysign(promises_ ? contact_reach : own_reach(header_), wanted);
  const double rise = (step_.path.back().position - step_.path.front().position).dot(up_);
  for (const double up : {step_.requested.dot(up_), rise}) {
    const Vec2d motion = right_ * (across(step_.requested) + beyond) + up_ * up;
    for (std::size_t i = 0; i < step_.path.size(); ++i) {
      for (const ExactImpact& impact : scenery_.impacts(place(i), motion)) {
        const bool may_end_it = !on_ground_alone || !is_walkable(impact.normal, header_, up_);
        if (impact.exposed && across(impact.normal) * wanted < 0 && may_end_it) return true;
      }
    }
  }
  return !header_.path_exact && pushed_by_skin(wanted);
}

void ContactJudge::add_normal_error(StepJudgement& judgement) const {
  for (const Contact& contact : step_.contacts) {
    std::optional<double> least;
    for (const ExactContact& exact : judgement.contacts) {
      if (exact.collider != contact.collider || exact.side != contact.side) continue;
      const double error = degrees_between(exact.normal, contact.normal);
      least = std::min(least.value_or(error), error);
    }
    // Of who promises it the normal of a contact that is excused, too: of one that no face is known of none is asked.
    const bool asks_face = least ? *least > 0 : promises_;
    if (const std::optional<Vec2d> face = asks_face ? face_of(contact) : std::nullopt) {
      const double error = degrees_between(*face, contact.normal);
      least = std::min(least.value_or(error), error);
    }
    if (least) judgement.normal_error = std::max(judgement.normal_error.value_or(0), *least);
  }
}

/// Box2D pushes out of what is within its skin: whether a reported contact against the motion has a real face there.
bool ContactJudge::pushed_by_skin(double wanted) const {
  return std::any_of(step_.contacts.begin(), step_.contacts.end(),
                     [&](const Contact& contact) { return across(contact.normal) * wanted < 0 && has_face(contact); });
}

/// The face of the solids taken together that is there to be touched along the reported normal: its own normal. There
/// is one beside a corner of the way, or where a leg would come to if it went on. A one-way chain is there for a leg
/// that began above it: where the leg ends, beside its tip, the octagon is not above it any more.
std::optional<Vec2d> ContactJudge::find_face(const Contact& contact) const {
  const double reach = header_.path_exact ? 2 * std::max(contact_reach, touch_) : box2d_skin;
  std::optional<Vec2d> most_alike;
  bool is_own = false;  // of two that abut the face may be the other's, but both are there
  const auto look = [&](const ExactImpact& impact) {
    const double alike = impact.normal.dot(contact.normal);
    if (!(alike > same_face)) return;
    is_own = is_own || impact.collider == contact.collider;
    if (!impact.exposed) return;
    if (!most_alike || alike > most_alike->dot(contact.normal)) most_alike = impact.normal;
  };
  for (std::size_t i = 0; i < step_.path.size(); ++i) {
    Place beside = place(i);
    beside.position -= contact.normal * reach;
    for (const ExactScenery* scenery : {&scenery_, grown_scenery_})
      if (scenery != nullptr)
        for (const ExactImpact& impact : scenery->impacts_between(place(i), beside)) look(impact);
    if (i == 0 || !header_.path_exact || dropped_through(contact.collider)) continue;
    Place beyond = place(i);
    const Vec2d leg = beyond.position - place(i - 1).position;
    const double approach = -contact.normal.dot(leg);
    if (approach >= least_approach * leg.norm() && approach > 0) beyond.position += leg * (reach / approach);
    if (scenery_.separation(place(i), contact.collider) > reach) continue;
    for (const Place& to : {beside, beyond})
      if (const auto impact = scenery_.impact_between(place(i - 1), to, contact.collider)) look(*impact);
  }
  return is_own || !promises_ ? most_alike : std::nullopt;
}

std::optional<Vec2d> ContactJudge::face_of(const Contact& contact) const {
  const auto [face, is_new] = faces_.try_emplace(&contact);
  if (is_new) face->second = find_face(contact);
  return face->second;
}

/// Whether a climb leads on at a corner: its way up ends there, and took no time.
bool ContactJudge::climbs_to(std::size_t corner) const {
  if (!(header_.character.step_height > 0) || corner == 0) return false;
  const Vec2d way = step_.path[corner].position - step_.path[corner - 1].position;
  return step_.path[corner].fraction == step_.path[corner - 1].fraction && way.dot(up_) > 0 &&
         std::abs(across(way)) <= ulp_at(header_, step_.path[corner].position);
}

/// Whether the way that was travelled leads against the reported normal, and stops there: what an earlier contact left
/// of the motion was stopped, or ground was followed. A climb may end along the top of its stair.
bool ContactJudge::ran_into(const Contact& contact) const {
  for (std::size_t i = 1; i < step_.path.size(); ++i) {
    const Vec2d leg = step_.path[i].position - step_.path[i - 1].position;
    const double most = climbs_to(i - 1) ? ulp_at(header_, step_.path[i].position) : 0;
    if (contact.normal.dot(leg) < most && scenery_.separation(place(i), contact.collider) <= contact_reach) return true;
  }
  return false;
}

void ContactJudge::add_ghosts(StepJudgement& judgement) const {
  for (const Contact& contact : step_.contacts) {
    const bool dont_care = std::binary_search(judgement.dont_care.begin(), judgement.dont_care.end(), contact.collider);
    if (dont_care && !is_exact(judgement, contact) && !has_face(contact))
      judgement.ghosts.emplace_back(contact.collider, contact.side);
  }
}

/// Whether what another contact leaves of the requested motion, or what a mover adds to it by pushing, leads into a
/// collider that is touched: which part that is belongs to the contender's law of response, not to geometry. (In a
/// corner of a wall and a slope, pushing down along the slope: it runs along the slope and into the wall; what is left
/// of it falls onto the slope.)
bool ContactJudge::met_after_another(const Contact& contact, std::span<const ExactContact> others) const {
  const Vec2d own = step_.requested - wanted(contact.collider);
  const Vec2d unsteered = step_.requested - step_.steered * right_;
  // A steep face takes steering out of the motion, and an impact the momentum across up.
  const std::array<Vec2d, 4> left_over{step_.requested, unsteered, up_ * step_.requested.dot(up_),
                                       right_ * step_.requested.dot(right_)};
  // What moves adds to the motion what it pushes, and ground carries.
  const auto leads_in = [&](const Vec2d& d, const ExactContact& one) {
    const Vec2d pushed = step_.requested - wanted(one.collider);
    if (is_walkable(one.normal, header_, up_) && contact.normal.dot(pushed - own) < 0) return true;
    // Where an impact ends the motion, the character moves on with the face, along the normal of that face.
    if (contact.normal.dot(one.normal * pushed.dot(one.normal) - own) < 0) return true;
    const Vec2d along = d - one.normal * std::min(0.0, (d - pushed).dot(one.normal)) - own;
    return std::min({contact.normal.dot(along), contact.normal.dot(right_) * (d - own).dot(right_),
                     contact.normal.dot(up_) * (d - own).dot(up_)}) < 0;
  };
  const bool deflected = std::any_of(others.begin(), others.end(), [&](const ExactContact& one) {
    return std::any_of(left_over.begin(), left_over.end(), [&](const Vec2d& d) { return leads_in(d, one); });
  });
  return deflected && nearest(contact.collider) <= contact_reach;
}

/// Whether the requested motion leads against the reported normal, and the collider is held already or comes within the
/// contender's hit distance on the way.
bool ContactJudge::comes_near(const Contact& contact) const {
  if (contact.normal.dot(wanted(contact.collider)) >= 0) return false;
  const auto is_it = [&contact](const ExactImpact& impact) { return impact.collider == contact.collider; };
  for (std::size_t i = 0; i < step_.path.size(); ++i) {
    const double gap = scenery_.separation(place(i), contact.collider);
    if (gap >= 0 && gap <= touch_) return true;
    Place nearer = place(i);
    nearer.position -= contact.normal * hit_;
    const std::vector<ExactImpact> impacts = scenery_.impacts(nearer, step_.requested);
    if (std::any_of(impacts.begin(), impacts.end(), is_it)) return true;
  }
  return false;
}

/// The other contacts that there are: exact ones, and those that a motion comes within the hit distance of.
std::vector<ExactContact> ContactJudge::contacts_besides(const Contact& contact, const StepJudgement& judgement) const {
  std::vector<ExactContact> others = judgement.contacts;
  for (const Contact& other : step_.contacts)
    if (&other != &contact && comes_near(other) && has_face(other))
      others.push_back({.collider = other.collider, .side = other.side, .normal = other.normal});
  return others;
}

/// Whether the collider is held, and the motion along the ground goes against it or away from it by no more than a
/// slanted up, which is rounded, makes of a motion straight down.
bool ContactJudge::is_led_into_by_rounding(const Contact& contact, std::span<const ExactContact> others) const {
  const bool is_slanted = up_.x() != 0 && up_.y() != 0;
  return is_slanted && std::abs(across(step_.requested)) <= rounding_across() && nearest(contact.collider) <= touch_ &&
         std::any_of(others.begin(), others.end(),
                     [&](const ExactContact& one) { return is_walkable(one.normal, header_, up_); });
}

void ContactJudge::add_dont_care(StepJudgement& judgement) const {
  if (!header_.path_exact) {
    const Place start = place(0);
    const Place end = place(step_.path.size() - 1);
    for (const ColliderIndex collider : scenery_.near(start, end, box2d_skin)) {
      const double gap = std::min(scenery_.separation(start, collider), scenery_.separation(end, collider));
      if (gap <= box2d_skin) judgement.dont_care.push_back(collider);
    }
  }
  for (const Contact& contact : step_.contacts) {
    if (!header_.path_exact || is_exact(judgement, contact)) continue;
    // Nothing but another contact turns a motion aside; ground is followed.
    const std::vector<ExactContact> others = contacts_besides(contact, judgement);
    const bool turned_aside = !others.empty() || is_walkable(contact.normal, header_, up_);
    const bool deflected = met_after_another(contact, others) || (turned_aside && ran_into(contact));
    if (deflected && has_face(contact)) judgement.deflected.emplace_back(contact.collider, contact.side);
    const bool near = comes_near(contact) || (!deflected && is_led_into_by_rounding(contact, others));
    if (promises_ && near && has_face(contact)) judgement.contact_band.emplace_back(contact.collider, contact.side);
    if (deflected || near) judgement.dont_care.push_back(contact.collider);
  }
  std::sort(judgement.dont_care.begin(), judgement.dont_care.end());
  judgement.dont_care.erase(std::unique(judgement.dont_care.begin(), judgement.dont_care.end()),
                            judgement.dont_care.end());
  // A collider that is met on one side may be held, or deflect the motion, on another: a valley.
  const auto is_met_as_reported = [&](ColliderIndex collider) {
    const auto is_it = [&](const auto& one) { return one.collider == collider; };
    return std::any_of(judgement.contacts.begin(), judgement.contacts.end(), is_it) &&
           std::all_of(step_.contacts.begin(), step_.contacts.end(),
                       [&](const Contact& one) { return !is_it(one) || is_exact(judgement, one); });
  };
  std::erase_if(judgement.dont_care, is_met_as_reported);
}

}  // namespace paperproof::compare::detail
