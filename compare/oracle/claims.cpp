#include "oracle/claims.hpp"

#include "contains.hpp"
#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/hanging.hpp"
#include "oracle/legs.hpp"
#include "oracle/met_surfaces.hpp"
#include "oracle/stairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// A velocity and a place that were computed in another order differ by no more than this, relative to their size.
constexpr double rounding_of_motion = 1e-9;
/// A walk that has no more than this left of its way needs not climb [m].
constexpr double least_left = 1e-5;

struct EndJudge : StepView {
  const ExactScenery& grown_scenery;
  const Wanted wanted;  ///< By all parts of the step, but for what later ones steer.
  const LaterParts& later;
  bool starts_free;
  const Vec2d& stopped = step.path.back().position;

  /// The parts near where the step ends, and how they go then.
  [[nodiscard]] std::vector<NearPart> near_at_end(double within) const {
    if (!turns.near_at_end) return near(step.path.size() - 1, within);
    std::vector<NearPart> parts = scenery.near_parts(end(), within);
    std::ranges::move(turns.near_at_end(within), std::back_inserter(parts));
    return parts;
  }

  /// Whether an exact displacement from where the step ends meets a walkable face.
  [[nodiscard]] bool meets_ground(const Vec2d& displacement) const {
    Place beyond = end();
    beyond.position += displacement;
    std::vector<ExactImpact> impacts = scenery.impacts_between(end(), beyond);
    if (turns.impacts_at_end) std::ranges::move(turns.impacts_at_end(displacement), std::back_inserter(impacts));
    return std::ranges::any_of(impacts, [&](const ExactImpact& impact) {
      return is_walkable(impact.normal, header, up) && !contains(step.dropped_through, impact.collider);
    });
  }

  [[nodiscard]] bool walks() const { return begins_as_walk(header, step, wanted); }

  [[nodiscard]] bool stands_on_ground() const { return meets_ground(-up * (2 * contact_reach)); }

  void judge_ground(const StepView& whole, StepJudgement& judgement) const {
    if (!judgement.end_overlap.empty() || !judgement.crushed.empty()) return;
    const std::vector<NearPart> parts = near_at_end(guaranteed_touch + touch_rounding);
    const auto walkable = [&](const NearPart& part, const NearFace& face) {
      return !contains(step.dropped_through, part.collider) && face.separation >= 0 &&
             is_walkable(face.normal, header, up);
    };
    if (step.grounded) {
      // Who stands does not go on into its ground. How what turns goes then is not known.
      const bool on_ground = any_face(parts, [&](const NearPart& part, const NearFace& face) {
        const bool is_known = find_way(step.vertex_ways, part.collider) == nullptr;
        const double apart = face.normal.dot(step.velocity * dt - part.moved);
        const double rounding = rounding_of_motion * (1 + step.velocity.norm() * dt);
        return walkable(part, face) && (!is_known || apart >= -guaranteed_touch - rounding);
      });
      const bool on_stair = walks() && std::ranges::any_of(parts, [&](const NearPart& part) {
                              return is_stair(*this, wanted.carried, end(), part);
                            });
      judgement.ground_refuted = !on_ground && !on_stair && !is_held_at_end(whole, guaranteed_touch + touch_rounding);
      judgement.hovers = judgement.hovers || (on_ground && !stands_on_ground());
      return;
    }
    const Vec2d unsteered = wanted.displacement - wanted.steered * right;
    if (wanted.jumped || step.stuck || !starts_free) return;
    const double least = guaranteed_touch - touch_rounding;
    // At a crest several faces are touched: a motion that leaves one of them leaves the ground.
    bool touches = false;
    bool leaves = false;
    for (const NearPart& part : parts)
      for (const NearFace& face : part.faces) {
        if (!walkable(part, face) || face.separation > least || !meets_ground(-face.normal * least)) continue;
        // Where a fall ends within touch without a contact it goes on in the next step.
        const double apart = face.normal.dot(step.velocity * dt - part.moved);
        const bool is_pulled = face.normal.dot(unsteered - part.moved) < -rounding_of_motion;
        touches = touches || is_pulled;
        leaves = leaves || std::abs(apart) > least;
      }
    judgement.ground_missed = touches && !leaves && stands_on_ground();
  }

  /// Whether nothing that turns is within reach where the step begins.
  /// @param beyond so much farther than the step goes [m].
  [[nodiscard]] bool is_alone(double beyond = 0) const {
    const double within = beyond + contact_reach + wanted.displacement.norm() + later.bend() + turns.longest_way;
    return !turns.near || turns.near(step.path.front(), within).empty();
  }

  /// Whether the wanted motion comes within 1e-6 m of nothing.
  [[nodiscard]] bool goes_freely() const {
    const Place start = place(0);
    if (!is_alone() || !near(0, contact_reach).empty()) return false;
    const Place there(start.position + wanted.displacement, step.movers, 1);
    if (later.any()) return scenery.near(start, there, contact_reach + later.bend()).empty();
    // A larger octagon is less often above a one-way surface.
    return grown_scenery.met(start, there).empty() && scenery.met(start, there).empty();
  }

  /// How far a free motion leaves the wanted one [m/s].
  [[nodiscard]] double flight_error() const {
    const Vec2d start = step.path.front().position;
    const double size = wanted.displacement.norm();
    const double rounding = rounding_of_motion * (1 + size) + 4 * ulp_at(header, start) + 4 * ulp_at(header, stopped);
    const bool waits =
        std::ranges::any_of(step.vertex_ways, [](const VertexWay& way) { return way.instants.size() > 2; });
    const double waited = waits ? waited_in_part * size : 0;
    double off = 0;
    for (const PathPoint& corner : step.path) {
      const double bend = corner.fraction < 1 ? later.bend() : later.steered_way(later.steered());
      off = std::max(off, (corner.position - start - wanted.displacement * corner.fraction).norm() - bend);
    }
    const Vec2d slower = step.velocity - wanted.velocity;
    const double too_slow = (slower - right * std::clamp(slower.dot(right), later.slower, later.faster)).norm();
    return std::max(off <= rounding + waited ? 0 : off / dt,
                    too_slow <= rounding_of_motion * (1 + wanted.velocity.norm()) ? 0 : too_slow);
  }

  /// Whether a face may take upward speed: a ceiling, what the wanted motion goes into and that slopes or moves, ground
  /// that is followed, or a wall that ends the climb of a walk.
  [[nodiscard]] bool may_take_rise(const NearPart& part, const NearFace& face) const {
    const double slope = face.normal.dot(up);
    if (slope < 0) return true;
    const bool is_entered = face.normal.dot(wanted.velocity * dt - part.moved) < part.unsure;
    const bool moves = !part.moved.isZero(0) || part.unsure > 0;
    const bool follows =
        slope > 0 && (is_entered || !wanted.jumped) &&
        std::abs(face.normal.dot(step.velocity)) <= guaranteed_touch / dt + rounding_of_motion * step.velocity.norm();
    const bool is_level = std::abs(face.normal.dot(right)) <= rounding_of_motion;
    const bool climbs = wanted.from_ground && !wanted.jumped;
    const bool ends_rise = !is_level && (climbs || header.character.side_hit_ends_rise);
    return (moves && is_entered) || follows || ends_rise;
  }

  /// The upward speed that is missing without anything exact that could have taken it [m/s]. What turns takes its rider
  /// along by no one velocity: so much of it is not asked for.
  [[nodiscard]] double rise_lost() const {
    const double lost = (wanted.velocity - step.velocity).dot(up);
    if (lost <= rounding_of_motion * (1 + wanted.velocity.norm())) return 0;
    double unsure = 0;
    for (std::size_t corner = 0; corner < step.path.size(); ++corner)
      for (const NearPart& part : near(corner, contact_reach)) {
        unsure = std::max(unsure, (part.unsure + std::abs(part.rim)) / dt);
        for (const NearFace& face : part.faces)
          if (may_take_rise(part, face)) return 0;
      }
    return lost > unsure ? lost : 0;
  }

  /// Whether the end of the step tells of no motion: it began or ends in something, gave up, or was crushed.
  [[nodiscard]] bool is_excused(const StepJudgement& judgement) const {
    return !starts_free || step.stuck || step.dropped || !judgement.crushed.empty() || !judgement.end_overlap.empty();
  }

  void judge_speed(StepJudgement& judgement) const {
    if (is_excused(judgement)) return;
    // A walker follows its ground down over a crest, as far as it is allowed to.
    const bool may_snap = header.character.snap > 0 && wanted.from_ground && !wanted.jumped;
    if (!may_snap) judgement.speed_lost = goes_freely() ? flight_error() : rise_lost();
  }

  /// What stops a way straight down, in no time: all that is met no more than 1e-6 m later, too.
  [[nodiscard]] std::vector<ExactImpact> first_below(const ExactScenery& solids, const Vec2d& from, double down) const {
    std::vector<ExactImpact> impacts =
        solids.impacts_between(Place(from, step.movers, 1), Place(from - down * up, step.movers, 1));
    std::erase_if(impacts, [&](const ExactImpact& impact) { return impact.normal.dot(up) <= rounding_of_motion; });
    double first = 1;
    for (const ExactImpact& impact : impacts) first = std::min(first, static_cast<double>(impact.fraction));
    std::erase_if(impacts, [&](const ExactImpact& impact) {
      return (static_cast<double>(impact.fraction) - first) * down > contact_reach;
    });
    return impacts;
  }

  /// Whether a way straight down ends at ground, before it is as long as this. The octagon may be larger by 1e-6 m.
  /// Ground is walkable, and goes down no faster than the character may fall.
  [[nodiscard]] bool meets_ground_first(const Vec2d& from, double down) const {
    const auto is_followed = [&](const ExactImpact& impact) {
      const double sinks = -moved(impact.collider).dot(up) / dt;
      return impact.exposed && is_walked_on(impact.normal, header, up) &&
             sinks <= header.character.max_fall_speed.value_or(HUGE_VAL) &&
             static_cast<double>(impact.fraction) * down < down - 2 * contact_reach;
    };
    return std::ranges::all_of(std::array{&scenery, &grown_scenery}, [&](const ExactScenery* solids) {
      const std::vector<ExactImpact> impacts = first_below(*solids, from, down);
      return !impacts.empty() && std::ranges::all_of(impacts, is_followed);
    });
  }

  /// Whether a way that takes no time is free for an octagon that is larger by 1e-6 m. What touches that octagon where
  /// the way begins stops only the octagon itself.
  [[nodiscard]] bool is_free(const Vec2d& from, const Vec2d& to) const {
    const Place begin(from, step.movers, 1);
    const Place there(to, step.movers, 1);
    return scenery.met(begin, there).empty() && grown_scenery.meets_only(begin, there, grown_scenery.overlapped(begin));
  }

  /// Whether a face at rest is touched that is too steep to walk on, and stops a way ahead. Surely too steep: it is not
  /// walkable by 1e-6 rad.
  [[nodiscard]] bool touches_riser(const Vec2d& ahead) const {
    return any_face(near_at_end(contact_reach), [&](const NearPart& part, const NearFace& face) {
      return part.moved.isZero(0) && face.normal.dot(ahead) < 0 && face.normal.dot(up) >= -rounding_of_motion &&
             !is_walkable(face.normal, header, up);
    });
  }

  /// How far a way straight up is free, at most as far as the character climbs [m].
  [[nodiscard]] double headroom() const {
    const double highest = header.character.step_height;
    double free = highest;
    for (const ExactImpact& impact : scenery.impacts_between(end(), Place(stopped + highest * up, step.movers, 1)))
      free = std::min(free, static_cast<double>(impact.fraction) * highest - 2 * contact_reach);
    return free;
  }

  /// Whether a way straight up by so much, on, and down ends on ground that is higher.
  [[nodiscard]] bool could_climb(double rise, const Vec2d& ahead) const {
    const Vec2d above = stopped + rise * up;
    if (!is_free(stopped, above) || !is_free(above, above + ahead)) return false;
    if (meets_ground_first(above + ahead, rise)) return true;
    double down = rise;
    for (const ExactImpact& impact : first_below(scenery, above + ahead, rise))
      down = std::min(down, static_cast<double>(impact.fraction) * rise);
    const Place landing(above + ahead - (down - contact_reach / 2) * up, step.movers, 1);  // not in it by rounding
    const std::vector<NearPart> parts = scenery.near_parts(landing, contact_reach);
    return down < rise - 2 * contact_reach && std::ranges::any_of(parts, [&](const NearPart& part) {
             return is_stair(*this, wanted.carried, landing, part);
           });
  }

  void judge_walk(StepJudgement& judgement) const {
    const CharacterDef& character = header.character;
    const bool excused = is_excused(judgement) || step.input.drop;
    if (excused || !wanted.from_ground || wanted.jumped || later.any()) return;
    const Vec2d ahead = (wanted.displacement - (stopped - step.path.front().position)).dot(right) * right;
    const bool may_leave = character.snap > 0 && !step.grounded && walks();
    const bool may_miss = character.step_height > 0 && header.characters == 1 && walks() && ahead.norm() > least_left &&
                          ahead.dot(wanted.velocity) > 0;
    if (!(may_leave || may_miss) || !is_alone(character.snap + character.step_height)) return;
    judgement.ground_left = may_leave && meets_ground_first(stopped, character.snap);
    if (!may_miss || !touches_riser(ahead) || stairs_climbed(*this, wanted) > 0) return;
    const double most = headroom();
    judgement.kerb_missed = std::ranges::any_of(std::array{1.0, 0.5, 0.25, 0.125}, [&](double share) {
      const double rise = std::min(share * character.step_height, most);
      return rise > 0 && could_climb(rise, ahead);
    });
  }
};

}  // namespace

void judge_end(const StepView& at, const StepView& whole, const ExactScenery& grown_scenery, const Wanted& wanted,
               const LaterParts& later, bool starts_free, StepJudgement& judgement) {
  const EndJudge end{at, grown_scenery, later.whole(wanted), later, starts_free};
  end.judge_ground(whole, judgement);
  end.judge_speed(judgement);
  end.judge_walk(judgement);
}

}  // namespace paperproof::compare::detail
