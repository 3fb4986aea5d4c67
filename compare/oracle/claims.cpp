#include "oracle/claims.hpp"

#include "contains.hpp"
#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/met_surfaces.hpp"
#include "oracle/stairs.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// A velocity and a place that were computed in another order differ by no more than this, relative to their size.
constexpr double rounding_of_motion = 1e-9;
/// A walk that has no more than this left of its way needs not climb [m].
constexpr double least_left = 1e-5;

}  // namespace

EndJudge::EndJudge(const TraceHeader& header, const ExactScenery& scenery, const ExactScenery& grown_scenery,
                   const TraceStep& step, const Wanted& wanted, const WhatTurns& turns, const LaterParts& later)
    : header_(header),
      scenery_(scenery),
      grown_scenery_(grown_scenery),
      step_(step),
      wanted_(later.whole(wanted)),
      turns_(turns),
      later_(later),
      up_(up_in(step, header)),
      dt_(length_of(step, header)) {}

/// The parts near where the step ends, and how they go then.
std::vector<NearPart> EndJudge::near_at_end(double within) const {
  if (!turns_.near_at_end) return near(step_.path.size() - 1, within);
  std::vector<NearPart> parts = scenery_.near_parts(end(), within);
  for (NearPart& part : turns_.near_at_end(within)) parts.push_back(std::move(part));
  return parts;
}

/// Whether an exact displacement from where the step ends meets a walkable face.
bool EndJudge::meets_ground(const Vec2d& displacement) const {
  Place beyond = end();
  beyond.position += displacement;
  std::vector<ExactImpact> impacts = scenery_.impacts_between(end(), beyond);
  if (turns_.impacts_at_end)
    for (ExactImpact& impact : turns_.impacts_at_end(displacement)) impacts.push_back(std::move(impact));
  for (const ExactImpact& impact : impacts)
    if (is_walkable(impact.normal, header_, up_) && !contains(step_.dropped_through, impact.collider)) return true;
  return false;
}

bool EndJudge::walks() const { return begins_as_walk(header_, step_, wanted_); }

bool EndJudge::stands_on_ground() const { return meets_ground(-up_ * (2 * contact_reach)); }

void EndJudge::judge_ground(const HangingJudge& hanging, bool starts_free, StepJudgement& judgement) const {
  if (!judgement.end_overlap.empty() || !judgement.crushed.empty()) return;
  const std::vector<NearPart> parts = near_at_end(guaranteed_touch + touch_rounding);
  const auto any_face = [&](const auto& is) {
    return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
      return !contains(step_.dropped_through, part.collider) &&
             std::any_of(part.faces.begin(), part.faces.end(), [&](const NearFace& face) { return is(part, face); });
    });
  };
  const auto walkable = [&](const NearPart&, const NearFace& face) {
    return face.separation >= 0 && is_walkable(face.normal, header_, up_);
  };
  if (step_.grounded) {
    // Who stands does not go on into its ground. How what turns goes then is not known.
    const auto holds = [&](const NearPart& part, const NearFace& face) {
      const bool is_known = find_way(step_.vertex_ways, part.collider) == nullptr;
      const double apart = face.normal.dot(step_.velocity * dt_ - part.moved);
      const double rounding = rounding_of_motion * (1 + step_.velocity.norm() * dt_);
      return walkable(part, face) && (!is_known || apart >= -guaranteed_touch - rounding);
    };
    const bool on_ground = any_face(holds);
    const bool on_stair = walks() && std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
                            return is_stair(header_, scenery_, step_, wanted_.carried, end(), part);
                          });
    judgement.ground_refuted = !on_ground && !on_stair && !hanging.is_held_at_end(guaranteed_touch + touch_rounding);
    judgement.hovers = judgement.hovers || (on_ground && !stands_on_ground());
    return;
  }
  const Vec2d unsteered = wanted_.displacement - wanted_.steered * right_of(up_);
  if (wanted_.jumped || step_.stuck || !starts_free) return;
  const double least = guaranteed_touch - touch_rounding;
  // At a crest several faces are touched: a motion that leaves one of them leaves the ground.
  bool touches = false;
  bool leaves = false;
  any_face([&](const NearPart& part, const NearFace& face) {
    if (!walkable(part, face) || face.separation > least || !meets_ground(-face.normal * least)) return false;
    // Where a fall ends within touch without a contact it goes on in the next step.
    const double apart = face.normal.dot(step_.velocity * dt_ - part.moved);
    const bool is_pulled = face.normal.dot(unsteered - part.moved) < -rounding_of_motion;
    touches = touches || is_pulled;
    leaves = leaves || std::abs(apart) > least;
    return false;
  });
  judgement.ground_missed = touches && !leaves && stands_on_ground();
}

/// Whether nothing that turns is within reach where the step begins.
/// @param beyond so much farther than the step goes [m].
bool EndJudge::is_alone(double beyond) const {
  const double within = beyond + contact_reach + wanted_.displacement.norm() + later_.bend() + turns_.longest_way;
  return !turns_.near || turns_.near(step_.path.front(), within).empty();
}

/// Whether the wanted motion comes within 1e-6 m of nothing.
bool EndJudge::goes_freely() const {
  const Place start(step_.path.front(), step_.movers);
  if (!is_alone() || !near(0, contact_reach).empty()) return false;
  const Place wanted(start.position + wanted_.displacement, step_.movers, 1);
  if (later_.any()) return scenery_.near(start, wanted, contact_reach + later_.bend()).empty();
  // A larger octagon is less often above a one-way surface.
  return grown_scenery_.met(start, wanted).empty() && scenery_.met(start, wanted).empty();
}

/// How far a free motion leaves the wanted one [m/s].
double EndJudge::flight_error() const {
  const Vec2d start = step_.path.front().position;
  const double size = wanted_.displacement.norm();
  const double rounding =
      rounding_of_motion * (1 + size) + 4 * ulp_at(header_, start) + 4 * ulp_at(header_, step_.path.back().position);
  const bool waits = std::any_of(step_.vertex_ways.begin(), step_.vertex_ways.end(),
                                 [](const VertexWay& way) { return way.instants.size() > 2; });
  const double waited = waits ? waited_in_part * size : 0;
  double off = 0;
  for (const PathPoint& corner : step_.path) {
    const double bend = corner.fraction < 1 ? later_.bend() : later_.steered_way(later_.steered());
    off = std::max(off, (corner.position - start - wanted_.displacement * corner.fraction).norm() - bend);
  }
  const Vec2d right = right_of(up_);
  const Vec2d slower = step_.velocity - wanted_.velocity;
  const double too_slow = (slower - right * std::clamp(slower.dot(right), later_.slower, later_.faster)).norm();
  return std::max(off <= rounding + waited ? 0 : off / dt_,
                  too_slow <= rounding_of_motion * (1 + wanted_.velocity.norm()) ? 0 : too_slow);
}

/// Whether a face may take upward speed: a ceiling, what the wanted motion goes into and that slopes or moves, ground
/// that is followed, or a wall that ends the climb of a walk.
bool EndJudge::may_take_rise(const NearPart& part, const NearFace& face) const {
  const double slope = face.normal.dot(up_);
  if (slope < 0) return true;
  const bool is_entered = face.normal.dot(wanted_.velocity * dt_ - part.moved) < part.unsure;
  const bool moves = !part.moved.isZero(0) || part.unsure > 0;
  const bool follows =
      slope > 0 && (is_entered || !wanted_.jumped) &&
      std::abs(face.normal.dot(step_.velocity)) <= guaranteed_touch / dt_ + rounding_of_motion * step_.velocity.norm();
  const bool is_level = std::abs(face.normal.dot(right_of(up_))) <= rounding_of_motion;
  const bool climbs = wanted_.from_ground && !wanted_.jumped;
  const bool ends_rise = !is_level && (climbs || header_.character.side_hit_ends_rise);
  return (moves && is_entered) || follows || ends_rise;
}

/// The upward speed that is missing without anything exact that could have taken it [m/s]. What turns takes its rider
/// along by no one velocity: so much of it is not asked for.
double EndJudge::rise_lost() const {
  const double lost = (wanted_.velocity - step_.velocity).dot(up_);
  if (lost <= rounding_of_motion * (1 + wanted_.velocity.norm())) return 0;
  double unsure = 0;
  for (std::size_t corner = 0; corner < step_.path.size(); ++corner)
    for (const NearPart& part : near(corner, contact_reach)) {
      unsure = std::max(unsure, (part.unsure + std::abs(part.rim)) / dt_);
      for (const NearFace& face : part.faces)
        if (may_take_rise(part, face)) return 0;
    }
  return lost > unsure ? lost : 0;
}

void EndJudge::judge_speed(bool starts_free, StepJudgement& judgement) const {
  const bool excused =
      !starts_free || step_.stuck || step_.dropped || !judgement.crushed.empty() || !judgement.end_overlap.empty();
  if (excused) return;
  // A walker follows its ground down over a crest, as far as it is allowed to.
  const bool may_snap = header_.character.snap > 0 && wanted_.from_ground && !wanted_.jumped;
  if (!may_snap) judgement.speed_lost = goes_freely() ? flight_error() : rise_lost();
}

/// What stops a way straight down, in no time: all that is met no more than 1e-6 m later, too.
std::vector<ExactImpact> EndJudge::first_below(const ExactScenery& scenery, const Vec2d& from, double down) const {
  std::vector<ExactImpact> impacts =
      scenery.impacts_between(Place(from, step_.movers, 1), Place(from - down * up_, step_.movers, 1));
  std::erase_if(impacts, [this](const ExactImpact& impact) { return impact.normal.dot(up_) <= rounding_of_motion; });
  double first = 1;
  for (const ExactImpact& impact : impacts) first = std::min(first, static_cast<double>(impact.fraction));
  std::erase_if(impacts, [&](const ExactImpact& impact) {
    return (static_cast<double>(impact.fraction) - first) * down > contact_reach;
  });
  return impacts;
}

/// Whether it is walkable, and goes down no faster than the character may fall.
bool EndJudge::is_followed(const ExactImpact& impact) const {
  const MoverIndex mover = header_.scenery.colliders[impact.collider].mover;
  const MoverMotion motion = mover == no_mover ? MoverMotion{} : step_.movers[mover];
  const double sinks = (motion.from - motion.to).dot(up_) / dt_;
  return impact.exposed && is_walked_on(impact.normal, header_, up_) &&
         sinks <= header_.character.max_fall_speed.value_or(HUGE_VAL);
}

/// Whether a way straight down ends at ground that is followed, before it is as long as this. The octagon may be larger
/// by 1e-6 m.
bool EndJudge::meets_ground_first(const Vec2d& from, double down) const {
  const auto ends_at_ground = [&](const ExactScenery& scenery) {
    const std::vector<ExactImpact> impacts = first_below(scenery, from, down);
    return !impacts.empty() && std::all_of(impacts.begin(), impacts.end(), [&](const ExactImpact& impact) {
      return is_followed(impact) && static_cast<double>(impact.fraction) * down < down - 2 * contact_reach;
    });
  };
  return ends_at_ground(scenery_) && ends_at_ground(grown_scenery_);
}

/// Whether a way that takes no time is free for an octagon that is larger by 1e-6 m. What touches that octagon where
/// the way begins stops only the octagon itself.
bool EndJudge::is_free(const Vec2d& from, const Vec2d& to) const {
  const Place begin(from, step_.movers, 1);
  const Place end(to, step_.movers, 1);
  const std::vector<ColliderIndex> touched = grown_scenery_.overlapped(begin);
  const std::vector<ColliderIndex> met = grown_scenery_.met(begin, end);
  return scenery_.met(begin, end).empty() && std::includes(touched.begin(), touched.end(), met.begin(), met.end());
}

/// Whether a face at rest is touched that is too steep to walk on, and stops a way ahead. Surely too steep: it is not
/// walkable by 1e-6 rad.
bool EndJudge::touches_riser(const Vec2d& ahead) const {
  const std::vector<NearPart> parts = near_at_end(contact_reach);
  return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
    return part.moved.isZero(0) && std::any_of(part.faces.begin(), part.faces.end(), [&](const NearFace& face) {
             return face.normal.dot(ahead) < 0 && face.normal.dot(up_) >= -rounding_of_motion &&
                    !is_walkable(face.normal, header_, up_);
           });
  });
}

/// How far a way straight up is free, at most as far as the character climbs [m].
double EndJudge::headroom() const {
  const double highest = header_.character.step_height;
  const Vec2d& stopped = step_.path.back().position;
  double free = highest;
  for (const ExactImpact& impact : scenery_.impacts_between(end(), Place(stopped + highest * up_, step_.movers, 1)))
    free = std::min(free, static_cast<double>(impact.fraction) * highest - 2 * contact_reach);
  return free;
}

/// Whether a way straight up by so much, on, and down ends on ground that is higher.
bool EndJudge::could_climb(double rise, const Vec2d& ahead) const {
  const Vec2d& stopped = step_.path.back().position;
  const Vec2d above = stopped + rise * up_;
  if (!is_free(stopped, above) || !is_free(above, above + ahead)) return false;
  if (meets_ground_first(above + ahead, rise)) return true;
  const std::vector<ExactImpact> impacts = first_below(scenery_, above + ahead, rise);
  double down = rise;
  for (const ExactImpact& impact : impacts) down = std::min(down, static_cast<double>(impact.fraction) * rise);
  const Place landing(above + ahead - (down - contact_reach / 2) * up_, step_.movers, 1);  // not in it by rounding
  const std::vector<NearPart> parts = scenery_.near_parts(landing, contact_reach);
  return down < rise - 2 * contact_reach && std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
           return is_stair(header_, scenery_, step_, wanted_.carried, landing, part);
         });
}

void EndJudge::judge_walk(bool starts_free, StepJudgement& judgement) const {
  const CharacterDef& character = header_.character;
  const bool excused = !starts_free || step_.stuck || step_.dropped || step_.input.drop || !judgement.crushed.empty() ||
                       !judgement.end_overlap.empty();
  if (excused || !wanted_.from_ground || wanted_.jumped || later_.any()) return;
  const Vec2d& stopped = step_.path.back().position;
  const Vec2d right = right_of(up_);
  const Vec2d ahead = (wanted_.displacement - (stopped - step_.path.front().position)).dot(right) * right;
  const bool may_leave = character.snap > 0 && !step_.grounded && walks();
  const bool may_miss = character.step_height > 0 && header_.characters == 1 && walks() && ahead.norm() > least_left &&
                        ahead.dot(wanted_.velocity) > 0;
  if (!(may_leave || may_miss) || !is_alone(character.snap + character.step_height)) return;
  judgement.ground_left = may_leave && meets_ground_first(stopped, character.snap);
  if (!may_miss || !touches_riser(ahead) || stairs_climbed(header_, scenery_, step_, turns_, wanted_) > 0) return;
  const double most = headroom();
  const std::array shares{1.0, 0.5, 0.25, 0.125};
  judgement.kerb_missed = std::any_of(shares.begin(), shares.end(), [&](double share) {
    const double rise = std::min(share * character.step_height, most);
    return rise > 0 && could_climb(rise, ahead);
  });
}

}  // namespace paperproof::compare::detail
