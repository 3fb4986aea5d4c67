/// The part of the judge of contacts that says which a step should have reported.
#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/hanging.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// Of one collider and side there may be several normals: two slopes of one polygon.
void add_contact(const ExactImpact& impact, Side side, double fraction, StepJudgement& judgement,
                 bool foreseen = false) {
  for (ExactContact& known : judgement.contacts) {
    if (known.collider != impact.collider || known.side != side || known.normal != impact.normal) continue;
    known.fraction = std::min(known.fraction, fraction);
    known.first = known.first || foreseen;
    known.foreseen = known.foreseen && foreseen;
    return;
  }
  judgement.contacts.push_back({.collider = impact.collider,
                                .side = side,
                                .normal = impact.normal,
                                .fraction = fraction,
                                .foreseen = foreseen,
                                .first = foreseen});
}

}  // namespace

/// Where the motion begins: a start that is nearer to something than a motion may come is moved away from it first.
std::size_t ContactJudge::first_corner() const {
  if (!header_.path_exact || step_.path.size() < 2 || step_.path[1].fraction > 0) return 0;
  const bool is_short = (step_.path[1].position - step_.path[0].position).norm() <= contact_reach;
  return is_short && !scenery_.near_parts(place(0), hit_).empty() ? 1 : 0;
}

/// What the requested motion enters from a corner. What is overlapped already is left, not met.
std::vector<ExactImpact> ContactJudge::impacts_from(std::size_t corner) const {
  std::vector<ExactImpact> impacts = scenery_.impacts(place(corner), step_.requested);
  std::erase_if(impacts, [&](const ExactImpact& impact) {
    return dropped_through(impact.collider) ||
           (header_.path_exact && scenery_.overlaps(place(corner), impact.collider));
  });
  return impacts;
}

/// What a contact may leave of the requested motion, by the laws that there are: it slides, without steering or
/// momentum across up or with it; on ground its part across up goes on along it.
std::vector<Vec2d> ContactJudge::left_by(ColliderIndex collider, const Vec2d& n) const {
  const Vec2d& motion = step_.requested;
  const Vec2d own = motion - wanted(collider);
  const auto slid = [&](const Vec2d& d) { return Vec2d(d - n * std::min(0.0, (d - own).dot(n))); };
  if (is_walkable(n, header_, up_)) {
    const double along = across(motion - own);
    return {slid(motion), own + in_world({along, -along * n.dot(right_) / n.dot(up_)}, up_)};
  }
  return {slid(motion), slid(motion - step_.steered * right_), slid(up_ * motion.dot(up_))};
}

/// Whether each of some motions from a place enters a collider on the side of a contact.
bool ContactJudge::all_enter(const ExactImpact& contact, const Place& from, std::span<const Vec2d> ways,
                             const ExactScenery& scenery) const {
  return std::all_of(ways.begin(), ways.end(), [&](const Vec2d& way) {
    const std::optional<ExactImpact> impact = scenery.time_of_impact(from, way, contact.collider);
    return impact && side_of(*impact) == side_of(contact);
  });
}

/// Whether the motion comes to a contact, whatever it meets before from the same corner, and whichever law it follows.
/// @param impacts of the motion from the corner. @param scenery that they are with.
bool ContactJudge::comes_to(const ExactImpact& contact, std::size_t corner, std::span<const ExactImpact> impacts,
                            const ExactScenery& scenery) const {
  return std::all_of(impacts.begin(), impacts.end(), [&](const ExactImpact& before) {
    if (!before.exposed || !(before.fraction < contact.fraction)) return true;
    Place there = place(corner);
    there.position += step_.requested * static_cast<double>(before.fraction);
    return all_enter(contact, there, left_by(before.collider, before.normal), scenery);
  });
}

/// The same for an octagon that is larger by the distance within which a motion may be said to hit: where the two
/// differ the contact may be another one.
bool ContactJudge::comes_to_when_grown(const ExactImpact& contact, std::size_t corner) const {
  if (grown_scenery_ == nullptr || grown_scenery_->overlaps(place(corner), contact.collider)) return true;
  const std::vector<ExactImpact> impacts = grown_scenery_->impacts(place(corner), step_.requested);
  return std::any_of(impacts.begin(), impacts.end(), [&](const ExactImpact& grown) {
    return grown.collider == contact.collider && side_of(grown) == side_of(contact) &&
           comes_to(grown, corner, impacts, *grown_scenery_);
  });
}

/// @param impacts from the corner. @param met what the requested motion of the step enters, from its start.
void ContactJudge::add_contacts_at(std::size_t corner, std::span<const ExactImpact> impacts,
                                   std::span<const ColliderIndex> met, StepJudgement& judgement) const {
  const double fraction = step_.path[corner].fraction;
  // What the step only comes near to is entered in the next one, if the motion goes on.
  const auto in_time = [&](const ExactImpact& impact) {
    return !header_.path_exact || impact.fraction + fraction <= 1 ||
           (fraction < 1 && std::find(met.begin(), met.end(), impact.collider) != met.end());
  };
  // What an earlier contact took of the motion does not come this far.
  const std::vector<ExactContact> known = judgement.contacts;
  const auto is_left = [&](const ExactImpact& impact) {
    return std::all_of(known.begin(), known.end(), [&](const ExactContact& one) {
      return !(one.fraction < fraction) ||
             all_enter(impact, place(corner), left_by(one.collider, one.normal), scenery_);
    });
  };
  const auto is_met = [&](const ExactImpact& impact) {
    if (!in_time(impact) || !header_.path_exact) return in_time(impact);
    return corner >= first_corner() && is_left(impact) && comes_to(impact, corner, impacts, scenery_) &&
           comes_to_when_grown(impact, corner);
  };
  for (const ExactImpact& impact : impacts) {
    const double way = static_cast<double>(impact.fraction) * std::abs(wanted(impact.collider).dot(impact.normal));
    if (way > contact_reach) continue;
    // A motion that grazes may have far to go although it is near along the normal.
    if (header_.path_exact && scenery_.separation(place(corner), impact.collider) > contact_reach) continue;
    const bool is_reported = reports(impact);
    const bool demanded = impact.exposed && is_met(impact);
    if (!demanded && !(impact.exposed && is_reported)) {
      judgement.dont_care.push_back(impact.collider);
      continue;
    }
    const auto is_it = [&](const ExactContact& one) {
      return one.collider == impact.collider && one.side == side_of(impact);
    };
    const bool is_known = std::any_of(judgement.contacts.begin(), judgement.contacts.end(), is_it);
    add_contact(impact, side_of(impact), fraction, judgement);
    if (!is_known && !demanded) judgement.ahead.emplace_back(impact.collider, side_of(impact));
  }
}

void ContactJudge::add_first_impacts(const std::vector<ExactImpact>& impacts, bool starts_free,
                                     StepJudgement& judgement) const {
  const auto first = std::min_element(impacts.begin(), impacts.end(), [](const ExactImpact& a, const ExactImpact& b) {
    return a.fraction < b.fraction;
  });
  if (first == impacts.end() || is_closed_before(*first)) return;
  for (const ExactImpact& impact : impacts) {
    if (impact.fraction != first->fraction || !impact.exposed) continue;
    if (!comes_to_when_grown(impact, first_corner()) && !reports(impact)) continue;
    add_contact(impact, side_of(impact), static_cast<double>(impact.fraction), judgement, true);
  }
  if (!starts_free) return;
  const double fraction = static_cast<double>(first->fraction);
  const Vec2d relative = wanted(first->collider);
  const double approach = std::abs(relative.dot(first->normal));
  judgement.first_impact = fraction;
  if (!step_.stuck && !gives_way()) judgement.first_approach = approach;
  judgement.first_impact_comparable = !step_.stuck && !gives_way() &&
                                      fraction * approach > (header_.path_exact ? contact_reach : box2d_skin) &&
                                      approach >= least_approach * relative.norm();
}

/// Whether the way to the first impact leads through an opening that counts as closed, or past a rim that is nearer
/// than a contact may be.
bool ContactJudge::is_closed_before(const ExactImpact& first) const {
  if (grown_scenery_ == nullptr) return false;
  const Place start = place(first_corner());
  const double fraction = static_cast<double>(first.fraction);
  const double along = std::abs(wanted(first.collider).dot(first.normal));
  if (!(along * fraction > 2 * contact_reach)) return false;  // it is at the start
  const double until = fraction - 2 * contact_reach / along;
  const Place there(start.position + step_.requested * until, step_.movers, until);
  const std::vector<ColliderIndex> touched = grown_scenery_->overlapped(start);
  const std::vector<ColliderIndex> met = grown_scenery_->met(start, there);
  return std::any_of(met.begin(), met.end(), [&](ColliderIndex collider) {
    return collider != first.collider && std::find(touched.begin(), touched.end(), collider) == touched.end() &&
           !dropped_through(collider);
  });
}

}  // namespace paperproof::compare::detail
