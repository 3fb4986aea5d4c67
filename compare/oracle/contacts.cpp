#include "oracle/contacts.hpp"

#include "oracle/hanging.hpp"
#include "oracle/met_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

namespace paperproof::compare::detail {
namespace {

/// Cosine of the angle between two normals of one face, as far as Box2D's floats and its rounded corners know it.
constexpr double same_face = 0.9;
/// A smaller share of the speed is rounding: Box2D's floats have 24 bits.
constexpr double least_loss = 1e-5;

double degrees_between(const Vec2d& a, const Vec2d& b) {
  return std::atan2(std::abs(cross_of(a, b)), a.dot(b)) * 180 / std::numbers::pi;
}

struct ContactJudge : ContactScene {
  void judge(bool starts_free, StepJudgement& judgement) const {
    add_met_contacts(*this, starts_free, judgement);
    for (const Contact& contact : step.contacts)
      judgement.max_contact_gap = std::max(judgement.max_contact_gap, nearest(contact.collider));
    add_dont_care(judgement);
    add_ghosts(judgement);
    add_normal_error(judgement);
    measure_motion(starts_free, judgement);
    // What a crush stops is not stopped by nothing.
    if (judgement.crushed.empty()) judgement.ghost_speed_loss = ghost_speed_loss(starts_free, judgement);
  }

  /// The smallest separation over the corners of the way [m].
  [[nodiscard]] double nearest(ColliderIndex collider) const {
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < step.path.size(); ++i) {
      if (i > 0 && step.movers.empty() && step.path[i].position == step.path[i - 1].position) continue;
      gap = std::min(gap, scenery.separation(place(i), collider));
    }
    return gap;
  }

  [[nodiscard]] double ghost_speed_loss(bool starts_free, const StepJudgement& judgement) const {
    const double wanted = across(step.requested) / dt;
    const double loss = std::clamp(1 - across(step.velocity) / wanted, 0.0, 1.0);
    const bool is_rounding = !(loss * std::abs(wanted) * dt > rounding_across());
    return is_rounding || loss < least_loss || !starts_free || is_opposed(wanted, judgement) ? 0 : loss;
  }

  /// Measures how much of the wanted horizontal displacement the step lost, and whether a solid is in its way.
  void measure_motion(bool starts_free, StepJudgement& judgement) const {
    const double wanted = across(step.requested);
    judgement.motion_wanted = std::abs(wanted);
    if (std::abs(wanted) <= rounding_across() || !starts_free || !judgement.crushed.empty() || is_capped(step, header))
      return;
    const double made = across(step.path.back().position - step.path.front().position) + judgement.remainder_made;
    const double lost = std::clamp(std::abs(wanted) - std::copysign(1.0, wanted) * made, 0.0, std::abs(wanted));
    const double rounding = ulp_at(header, step.path.front().position) + least_loss * std::abs(wanted);
    if (lost > rounding && !is_opposed(wanted, judgement)) judgement.motion_lost = lost;
  }

  /// Of a motion straight along an up that is rounded this much may seem to go across [m].
  [[nodiscard]] double rounding_across() const { return 1e-12 * step.requested.norm(); }

  /// Whether a solid is in the way of the wanted horizontal motion, from any corner of the path: of the motion as
  /// requested, or at the height that it was left (ground may hold it).
  [[nodiscard]] bool is_opposed(double wanted, const StepJudgement& judgement) const {
    // Ground that rests keeps what leads across up, but between it and another surface a motion may end.
    const auto is_ground = [this](const Contact& contact) {
      return solid(contact.collider).mover == no_mover && is_walkable(contact.normal, header, up);
    };
    const bool on_ground_alone = promises && !step.contacts.empty() && std::ranges::all_of(step.contacts, is_ground);
    // A contact that exact arithmetic has, or that an exact one deflected the motion into, may take it.
    for (const Contact& contact : step.contacts) {
      const bool confirmed =
          is_exact(judgement, contact) || contains(judgement.deflected, std::pair(contact.collider, contact.side));
      if (promises && !on_ground_alone && (confirmed || comes_near(contact)) && across(contact.normal) * wanted < 0 &&
          has_face(contact))
        return true;
    }
    const double beyond = std::copysign(promises ? contact_reach : own_reach(header), wanted);
    const double rise = (step.path.back().position - step.path.front().position).dot(up);
    for (const double height : {step.requested.dot(up), rise}) {
      const Vec2d motion = right * (across(step.requested) + beyond) + up * height;
      for (std::size_t i = 0; i < step.path.size(); ++i) {
        for (const ExactImpact& impact : scenery.impacts(place(i), motion)) {
          const bool may_end_it = !on_ground_alone || !is_walkable(impact.normal, header, up);
          if (impact.exposed && across(impact.normal) * wanted < 0 && may_end_it) return true;
        }
      }
    }
    return !header.path_exact && pushed_by_skin(wanted);
  }

  void add_normal_error(StepJudgement& judgement) const {
    for (const Contact& contact : step.contacts) {
      std::optional<double> least;
      for (const ExactContact& exact : judgement.contacts) {
        if (exact.collider != contact.collider || exact.side != contact.side) continue;
        const double error = degrees_between(exact.normal, contact.normal);
        least = std::min(least.value_or(error), error);
      }
      // Of who promises it the normal of a contact that is excused, too: of one that no face is known of none is asked.
      const bool asks_face = least ? *least > 0 : promises;
      if (const std::optional<Vec2d> face = asks_face ? face_of(contact) : std::nullopt) {
        const double error = degrees_between(*face, contact.normal);
        least = std::min(least.value_or(error), error);
      }
      if (least) judgement.normal_error = std::max(judgement.normal_error.value_or(0), *least);
    }
  }

  /// Whether a reported contact opposes the motion and has a real face there: Box2D pushes bodies out of its skin.
  [[nodiscard]] bool pushed_by_skin(double wanted) const {
    return std::ranges::any_of(step.contacts, [&](const Contact& contact) {
      return across(contact.normal) * wanted < 0 && has_face(contact);
    });
  }

  /// The face of the solids taken together that is there to be touched along the reported normal: its own normal. There
  /// is one beside a corner of the way, or where a leg would come to if it went on. A one-way chain is there for a leg
  /// that began above it: where the leg ends, beside its tip, the octagon is not above it any more.
  [[nodiscard]] std::optional<Vec2d> find_face(const Contact& contact) const {
    const double reach = header.path_exact ? 2 * std::max(contact_reach, touch) : box2d_skin;
    std::optional<Vec2d> most_alike;
    bool is_own = false;  // of two that abut the face may be the other's, but both are there
    const auto look = [&](const ExactImpact& impact) {
      const double alike = impact.normal.dot(contact.normal);
      if (!(alike > same_face)) return;
      is_own = is_own || impact.collider == contact.collider;
      if (!impact.exposed) return;
      if (!most_alike || alike > most_alike->dot(contact.normal)) most_alike = impact.normal;
    };
    for (std::size_t i = 0; i < step.path.size(); ++i) {
      const Vec2d inwards = -contact.normal * reach;
      std::ranges::for_each(impacts_along(inwards, i), look);
      if (i == 0 || !header.path_exact || is_dropped_through(contact.collider)) continue;
      Place beyond = place(i);
      const Vec2d leg = beyond.position - place(i - 1).position;
      const double approach = -contact.normal.dot(leg);
      if (approach >= least_approach * leg.norm() && approach > 0) beyond.position += leg * (reach / approach);
      if (scenery.separation(place(i), contact.collider) > reach) continue;
      Place beside = place(i);
      beside.position += inwards;
      for (const Place& to : {beside, beyond})
        if (const auto impact = scenery.impact_between(place(i - 1), to, contact.collider)) look(*impact);
    }
    return is_own || !promises ? most_alike : std::nullopt;
  }

  /// What a straight way from a corner meets. Contacts with the same normal ask it once.
  [[nodiscard]] const std::vector<ExactImpact>& impacts_along(const Vec2d& way, std::size_t corner) const {
    const auto [found, is_new] = impacts.try_emplace({corner, way.x(), way.y()});
    if (!is_new) return found->second;
    Place end = place(corner);
    end.position += way;
    for (const ExactScenery* solids : {&scenery, grown}) {
      if (solids == nullptr) continue;
      const std::vector<ExactImpact> met = solids->impacts_between(place(corner), end);
      found->second.insert(found->second.end(), met.begin(), met.end());
    }
    return found->second;
  }

  [[nodiscard]] std::optional<Vec2d> face_of(const Contact& contact) const {
    const auto [face, is_new] = faces.try_emplace(&contact);
    if (is_new) face->second = find_face(contact);
    return face->second;
  }

  [[nodiscard]] bool has_face(const Contact& contact) const { return face_of(contact).has_value(); }

  /// Whether a climb leads on at a corner: its way up ends there, and took no time.
  [[nodiscard]] bool climbs_to(std::size_t corner) const {
    if (!(header.character.step_height > 0) || corner == 0) return false;
    const Vec2d way = step.path[corner].position - step.path[corner - 1].position;
    return step.path[corner].fraction == step.path[corner - 1].fraction && way.dot(up) > 0 &&
           std::abs(across(way)) <= ulp_at(header, step.path[corner].position);
  }

  /// Whether the way that was travelled leads against the reported normal, and stops there: what an earlier contact
  /// left of the motion was stopped, or ground was followed. A climb may end along the top of its stair.
  [[nodiscard]] bool ran_into(const Contact& contact) const {
    for (std::size_t i = 1; i < step.path.size(); ++i) {
      const Vec2d leg = step.path[i].position - step.path[i - 1].position;
      const double most = climbs_to(i - 1) ? ulp_at(header, step.path[i].position) : 0;
      if (contact.normal.dot(leg) < most && scenery.separation(place(i), contact.collider) <= contact_reach)
        return true;
    }
    return false;
  }

  void add_ghosts(StepJudgement& judgement) const {
    for (const Contact& contact : step.contacts) {
      if (contains(judgement.dont_care, contact.collider) && !is_exact(judgement, contact) && !has_face(contact))
        judgement.ghosts.emplace_back(contact.collider, contact.side);
    }
  }

  /// Whether what another contact leaves of the requested motion, or what a mover adds to it by pushing, leads into a
  /// collider that is touched: the contender's law of response says which part that is, and geometry does not. (An
  /// example is the corner of a wall and a slope. A motion down along the slope runs into the wall. What the wall
  /// leaves of it falls onto the slope.)
  [[nodiscard]] bool met_after_another(const Contact& contact, std::span<const ExactContact> others) const {
    const Vec2d own = step.requested - wanted(contact.collider);
    // A steep face takes steering out of the motion, and an impact the momentum across up.
    const std::array<Vec2d, 4> left_over{step.requested, unsteered(), up * step.requested.dot(up),
                                         right * step.requested.dot(right)};
    // A mover that pushes adds its motion. So does ground that carries.
    const auto leads_in = [&](const Vec2d& d, const ExactContact& one) {
      const Vec2d pushed = step.requested - wanted(one.collider);
      if (is_walkable(one.normal, header, up) && contact.normal.dot(pushed - own) < 0) return true;
      // Where an impact ends the motion, the character moves on with the face, along the normal of that face.
      if (contact.normal.dot(one.normal * pushed.dot(one.normal) - own) < 0) return true;
      const Vec2d along = d - one.normal * std::min(0.0, (d - pushed).dot(one.normal)) - own;
      return std::min({contact.normal.dot(along), contact.normal.dot(right) * (d - own).dot(right),
                       contact.normal.dot(up) * (d - own).dot(up)}) < 0;
    };
    const bool deflected = std::ranges::any_of(others, [&](const ExactContact& one) {
      return std::ranges::any_of(left_over, [&](const Vec2d& d) { return leads_in(d, one); });
    });
    return deflected && nearest(contact.collider) <= contact_reach;
  }

  /// Whether the requested motion leads against the reported normal, and the collider is held already or comes within
  /// the contender's hit distance on the way.
  [[nodiscard]] bool comes_near(const Contact& contact) const {
    const auto [known, is_new] = comes.try_emplace(&contact);
    if (is_new) known->second = is_near_the_way(contact);
    return known->second;
  }

  [[nodiscard]] bool is_near_the_way(const Contact& contact) const {
    if (contact.normal.dot(wanted(contact.collider)) >= 0) return false;
    const auto is_it = [&contact](const ExactImpact& impact) { return impact.collider == contact.collider; };
    for (std::size_t i = 0; i < step.path.size(); ++i) {
      const double gap = scenery.separation(place(i), contact.collider);
      if (gap >= 0 && gap <= touch) return true;
      Place nearer = place(i);
      nearer.position -= contact.normal * hit;
      if (std::ranges::any_of(scenery.impacts(nearer, step.requested), is_it)) return true;
    }
    return false;
  }

  /// The other contacts that there are: exact ones, and those that a motion comes within the hit distance of.
  [[nodiscard]] std::vector<ExactContact> contacts_besides(const Contact& contact,
                                                           const StepJudgement& judgement) const {
    std::vector<ExactContact> others = judgement.contacts;
    for (const Contact& other : step.contacts)
      if (&other != &contact && comes_near(other) && has_face(other))
        others.push_back({.collider = other.collider, .side = other.side, .normal = other.normal});
    return others;
  }

  /// Whether the collider is held, and the motion along the ground goes against it or away from it by no more than a
  /// slanted up, which is rounded, makes of a motion straight down.
  [[nodiscard]] bool is_led_into_by_rounding(const Contact& contact, std::span<const ExactContact> others) const {
    const bool is_slanted = up.x() != 0 && up.y() != 0;
    return is_slanted && std::abs(across(step.requested)) <= rounding_across() && nearest(contact.collider) <= touch &&
           std::ranges::any_of(others, [&](const ExactContact& one) { return is_walkable(one.normal, header, up); });
  }

  void add_dont_care(StepJudgement& judgement) const {
    if (!header.path_exact) {
      const Place start = place(0);
      const Place end = place(step.path.size() - 1);
      for (const ColliderIndex collider : scenery.near(start, end, box2d_skin)) {
        const double gap = std::min(scenery.separation(start, collider), scenery.separation(end, collider));
        if (gap <= box2d_skin) judgement.dont_care.push_back(collider);
      }
    }
    for (const Contact& contact : step.contacts) {
      if (!header.path_exact || is_exact(judgement, contact)) continue;
      // Nothing but another contact turns a motion aside; ground is followed.
      const std::vector<ExactContact> others = contacts_besides(contact, judgement);
      const bool turned_aside = !others.empty() || is_walkable(contact.normal, header, up);
      const bool deflected = met_after_another(contact, others) || (turned_aside && ran_into(contact));
      if (deflected && has_face(contact)) judgement.deflected.emplace_back(contact.collider, contact.side);
      const bool near = comes_near(contact) || (!deflected && is_led_into_by_rounding(contact, others));
      if (promises && near && has_face(contact)) judgement.contact_band.emplace_back(contact.collider, contact.side);
      if (deflected || near) judgement.dont_care.push_back(contact.collider);
    }
    std::ranges::sort(judgement.dont_care);
    judgement.dont_care.erase(std::unique(judgement.dont_care.begin(), judgement.dont_care.end()),
                              judgement.dont_care.end());
    // A collider that is met on one side may be held, or deflect the motion, on another: a valley.
    const auto is_met_as_reported = [&](ColliderIndex collider) {
      const auto is_it = [&](const auto& one) { return one.collider == collider; };
      return std::ranges::any_of(judgement.contacts, is_it) &&
             std::ranges::all_of(step.contacts,
                                 [&](const Contact& one) { return !is_it(one) || is_exact(judgement, one); });
    };
    std::erase_if(judgement.dont_care, is_met_as_reported);
  }

  /// By contact: see `face_of`.
  mutable std::map<const Contact*, std::optional<Vec2d>> faces{};
  /// By contact: see `comes_near`.
  mutable std::map<const Contact*, bool> comes{};
  /// By corner and way: see `impacts_along`.
  mutable std::map<std::tuple<std::size_t, double, double>, std::vector<ExactImpact>> impacts{};
};

}  // namespace

Side side_along(const Vec2d& normal, const Vec2d& up) {
  constexpr double rounding = 1e-12;
  const auto clean = [](double component) { return std::abs(component) <= rounding ? 0 : component; };
  return side_of_normal(clean(cross_of(normal, up)), clean(normal.dot(up)));
}

bool is_exact(const StepJudgement& judgement, const Contact& reported) {
  return std::ranges::any_of(judgement.contacts, [&](const ExactContact& one) {
    return one.collider == reported.collider && one.side == reported.side;
  });
}

void judge_contacts(const StepView& at, const ExactScenery* grown, bool starts_free, StepJudgement& judgement) {
  ContactJudge{{at, grown}}.judge(starts_free, judgement);
}

void measure_motion(const StepView& at, bool starts_free, StepJudgement& judgement) {
  ContactJudge{{at, nullptr}}.measure_motion(starts_free, judgement);
}

}  // namespace paperproof::compare::detail
