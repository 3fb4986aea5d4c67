#include "oracle/met_contacts.hpp"

#include "oracle/hanging.hpp"

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

struct MetContacts : ContactScene {
  const std::size_t begin = first_corner();

  [[nodiscard]] Side side_of(const ExactImpact& impact) const { return side_along(impact.normal, up); }

  [[nodiscard]] bool reports(const ExactImpact& impact) const {
    return std::ranges::any_of(step.contacts, [&](const Contact& contact) {
      return contact.collider == impact.collider && contact.side == side_of(impact);
    });
  }

  /// Whether its way, from the start, is not the requested one: a mover would leave it no room there.
  [[nodiscard]] bool gives_way() const {
    if (!header.path_exact || step.movers.empty() || step.path.size() < 2) return false;
    const PathPoint& corner = step.path[1];
    const Vec2d expected = step.path[0].position + step.requested * corner.fraction;
    return (corner.position - expected).cwiseAbs().maxCoeff() > contact_reach;
  }

  /// Where the motion begins: a start that is nearer to something than a motion may come is moved away from it first.
  [[nodiscard]] std::size_t first_corner() const {
    if (!header.path_exact || step.path.size() < 2 || step.path[1].fraction > 0) return 0;
    const bool is_short = (step.path[1].position - step.path[0].position).norm() <= contact_reach;
    return is_short && !scenery.near_parts(place(0), hit).empty() ? 1 : 0;
  }

  /// What the requested motion enters from a corner. What is overlapped already is left, not met.
  [[nodiscard]] std::vector<ExactImpact> impacts_from(std::size_t corner) const {
    std::vector<ExactImpact> impacts = scenery.impacts(place(corner), step.requested);
    std::erase_if(impacts, [&](const ExactImpact& impact) {
      return is_dropped_through(impact.collider) ||
             (header.path_exact && scenery.overlaps(place(corner), impact.collider));
    });
    return impacts;
  }

  /// What a contact may leave of the requested motion, by the laws that there are: it slides, without steering or
  /// momentum across up or with it; on ground its part across up goes on along it.
  [[nodiscard]] std::vector<Vec2d> left_by(ColliderIndex collider, const Vec2d& n) const {
    const Vec2d& motion = step.requested;
    const Vec2d own = motion - wanted(collider);
    const auto slid = [&](const Vec2d& d) { return Vec2d(d - n * std::min(0.0, (d - own).dot(n))); };
    if (is_walkable(n, header, up)) {
      const double along = across(motion - own);
      return {slid(motion), own + in_world({along, -along * n.dot(right) / n.dot(up)}, up)};
    }
    return {slid(motion), slid(motion - step.steered * right), slid(up * motion.dot(up))};
  }

  /// Whether each of some motions from a place enters a collider on the side of a contact.
  [[nodiscard]] bool all_enter(const ExactImpact& contact, const Place& from, std::span<const Vec2d> ways,
                               const ExactScenery& solids) const {
    return std::ranges::all_of(ways, [&](const Vec2d& way) {
      const std::optional<ExactImpact> impact = solids.time_of_impact(from, way, contact.collider);
      return impact && side_of(*impact) == side_of(contact);
    });
  }

  /// Whether the motion comes to a contact, whatever it meets before from the same corner, and whichever law it
  /// follows.
  /// @param impacts of the motion from the corner. @param solids that they are with.
  [[nodiscard]] bool comes_to(const ExactImpact& contact, std::size_t corner, std::span<const ExactImpact> impacts,
                              const ExactScenery& solids) const {
    return std::ranges::all_of(impacts, [&](const ExactImpact& before) {
      if (!before.exposed || !(before.fraction < contact.fraction)) return true;
      Place there = place(corner);
      there.position += step.requested * static_cast<double>(before.fraction);
      return all_enter(contact, there, left_by(before.collider, before.normal), solids);
    });
  }

  /// The same for an octagon that is larger by the distance within which a motion may be said to hit: where the two
  /// differ the contact may be another one.
  [[nodiscard]] bool comes_to_when_grown(const ExactImpact& contact, std::size_t corner) const {
    if (grown == nullptr || grown->overlaps(place(corner), contact.collider)) return true;
    const std::vector<ExactImpact> impacts = grown->impacts(place(corner), step.requested);
    return std::ranges::any_of(impacts, [&](const ExactImpact& other) {
      return other.collider == contact.collider && side_of(other) == side_of(contact) &&
             comes_to(other, corner, impacts, *grown);
    });
  }

  /// @param impacts from the corner. @param met what the requested motion of the step enters, from its start.
  void add_contacts_at(std::size_t corner, std::span<const ExactImpact> impacts, std::span<const ColliderIndex> met,
                       StepJudgement& judgement) const {
    const double fraction = step.path[corner].fraction;
    // What the step only comes near to is entered in the next one, if the motion goes on.
    const auto in_time = [&](const ExactImpact& impact) {
      return !header.path_exact || impact.fraction + fraction <= 1 || (fraction < 1 && contains(met, impact.collider));
    };
    // What an earlier contact took of the motion does not come this far.
    const std::vector<ExactContact> known = judgement.contacts;
    const auto is_left = [&](const ExactImpact& impact) {
      return std::ranges::all_of(known, [&](const ExactContact& one) {
        return !(one.fraction < fraction) ||
               all_enter(impact, place(corner), left_by(one.collider, one.normal), scenery);
      });
    };
    const auto is_met = [&](const ExactImpact& impact) {
      if (!in_time(impact) || !header.path_exact) return in_time(impact);
      return corner >= begin && is_left(impact) && comes_to(impact, corner, impacts, scenery) &&
             comes_to_when_grown(impact, corner);
    };
    for (const ExactImpact& impact : impacts) {
      const double way = static_cast<double>(impact.fraction) * std::abs(wanted(impact.collider).dot(impact.normal));
      if (way > contact_reach) continue;
      // A motion that grazes may have far to go although it is near along the normal.
      if (header.path_exact && scenery.separation(place(corner), impact.collider) > contact_reach) continue;
      const bool is_reported = reports(impact);
      const bool demanded = impact.exposed && is_met(impact);
      if (!demanded && !(impact.exposed && is_reported)) {
        judgement.dont_care.push_back(impact.collider);
        continue;
      }
      const auto is_it = [&](const ExactContact& one) {
        return one.collider == impact.collider && one.side == side_of(impact);
      };
      const bool is_known = std::ranges::any_of(judgement.contacts, is_it);
      add_contact(impact, side_of(impact), fraction, judgement);
      if (!is_known && !demanded) judgement.ahead.emplace_back(impact.collider, side_of(impact));
    }
  }

  void add_first_impacts(const std::vector<ExactImpact>& impacts, bool starts_free, StepJudgement& judgement) const {
    const auto first = std::ranges::min_element(impacts, {}, &ExactImpact::fraction);
    if (first == impacts.end() || is_closed_before(*first)) return;
    for (const ExactImpact& impact : impacts) {
      if (impact.fraction != first->fraction || !impact.exposed) continue;
      if (!comes_to_when_grown(impact, begin) && !reports(impact)) continue;
      add_contact(impact, side_of(impact), static_cast<double>(impact.fraction), judgement, true);
    }
    if (!starts_free) return;
    const double fraction = static_cast<double>(first->fraction);
    const Vec2d relative = wanted(first->collider);
    const double approach = std::abs(relative.dot(first->normal));
    judgement.first_impact = fraction;
    if (!step.stuck && !gives_way()) judgement.first_approach = approach;
    judgement.first_impact_comparable = !step.stuck && !gives_way() &&
                                        fraction * approach > (header.path_exact ? contact_reach : box2d_skin) &&
                                        approach >= least_approach * relative.norm();
  }

  /// Whether the way to the first impact leads through an opening that counts as closed, or past a rim that is nearer
  /// than a contact may be.
  [[nodiscard]] bool is_closed_before(const ExactImpact& first) const {
    if (grown == nullptr) return false;
    const Place start = place(begin);
    const double fraction = static_cast<double>(first.fraction);
    const double along = std::abs(wanted(first.collider).dot(first.normal));
    if (!(along * fraction > 2 * contact_reach)) return false;  // it is at the start
    const double until = fraction - 2 * contact_reach / along;
    const Place there(start.position + step.requested * until, step.movers, until);
    const std::vector<ColliderIndex> touched = grown->overlapped(start);
    const std::vector<ColliderIndex> met = grown->met(start, there);
    return std::ranges::any_of(met, [&](ColliderIndex collider) {
      return collider != first.collider && !contains(touched, collider) && !is_dropped_through(collider);
    });
  }

  void add(bool starts_free, StepJudgement& judgement) const {
    std::vector<ColliderIndex> met;  // by the requested motion
    for (std::size_t i = 0; i < step.path.size(); ++i) {
      const Vec2d& position = step.path[i].position;
      const bool end = i == 0 || i + 1 == step.path.size();
      if (!header.path_exact && !end) continue;
      if (i > begin && step.movers.empty() && position == step.path[i - 1].position) continue;
      const std::vector<ExactImpact> impacts = impacts_from(i);
      if (i == begin) {
        for (const ExactImpact& impact : impacts) met.push_back(impact.collider);
        add_first_impacts(impacts, starts_free, judgement);
      }
      add_contacts_at(i, impacts, met, judgement);
    }
  }
};

}  // namespace

void add_met_contacts(const ContactScene& at, bool starts_free, StepJudgement& judgement) {
  MetContacts{at}.add(starts_free, judgement);
}

}  // namespace paperproof::compare::detail
