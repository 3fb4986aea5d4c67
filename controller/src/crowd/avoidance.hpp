/// Handles the impacts of characters with each other, in order of time: one of a pair, or both, get a new path that
/// avoids the other.
#pragma once

#include "crowd/paths.hpp"

#include <cmath>
#include <utility>

namespace paperproof::crowd {

/// The velocity of what carries a character [m/s].
[[nodiscard]] inline Vec2d velocity_of(const Ride& ride) noexcept {
  return ride.ground != Ride::none ? ride.velocity : Vec2d(Vec2d::Zero());
}

/// Which of a pair moves into the other, faster than that one recedes.
struct Approaching {
  bool first = false;
  bool second = false;
};

/// @param first_rate,second_rate velocities, in any unit, relative to what carries both.
[[nodiscard]] inline Approaching approaching(const Vec2d& first_rate, const Vec2d& second_rate,
                                             const Vec2d& normal) noexcept {
  const double first_toward = -first_rate.dot(normal);
  const double second_toward = second_rate.dot(normal);
  // A character that slides along another moves towards it by rounding alone: that must not stop it.
  const double largest = std::max(first_rate.cwiseAbs().maxCoeff(), second_rate.cwiseAbs().maxCoeff());
  const double noise = std::numeric_limits<double>::epsilon() * 64 * largest;
  const bool first = first_toward > std::max(0.0, -second_toward) + noise;
  const bool second = second_toward > std::max(0.0, -first_toward) + noise;
  if (!first && !second) return {true, true};  // rounding hides which one it is
  return {first, second};
}

/// A velocity that does not go into another character faster than `limit`. On steep sides and walls of the other the
/// horizontal part ends first: a character that walks into another in the air falls on beside it. Vectors are as the
/// characters see them (see `UpFrame`).
/// @param normal from the other towards this one. @param limit how fast the other recedes along the normal [m/s].
[[nodiscard]] inline Vec2d slowed(Vec2d velocity, const Vec2d& normal, double limit, double walkable_cosine) noexcept {
  double excess = -velocity.dot(normal) - limit;
  if (!(excess > 0)) return velocity;
  const bool steep = normal.y() >= 0 && normal.y() < walkable_cosine;
  if (steep && velocity.x() * normal.x() < 0) {
    const double taken = std::min(excess / std::abs(normal.x()), std::abs(velocity.x()));
    velocity.x() += std::copysign(taken, normal.x());
    excess -= taken * std::abs(normal.x());
  }
  return velocity + normal * std::max(excess, 0.0);
}

/// Handles all impacts of one step.
class Avoidance {
 public:
  Avoidance(CrowdStep& step, Paths& paths) noexcept
      : step_(step), paths_(paths), queue_(std::span(step.memory.impacts).first(step.members.size())) {}

  /// Every impact gives a new path to a character that does not hold its position. After so many new paths it does, and
  /// two that hold their positions have no impact: so the loop ends. For each character there are 2 * `max_replans` + 2
  /// impacts at most.
  void handle_impacts() noexcept {
    avoid_those_too_near();
    const auto impact_of = [this](CharacterIndex i, CharacterIndex j) { return impact(i, j); };
    queue_.find_all(impact_of);
    while (const PairImpact* earliest = queue_.earliest()) {
      const auto [i, j, found] = *earliest;
      time_ = std::max(time_, found.stop);
      ++step_.report.impacts;
      step_.report.add_contact(i, j, found.normal, found.time, step_.up);
      if (found.instant)
        handle_instant(i, j, found);
      else
        handle(i, j, found);
      queue_.update(i, impact_of);
      queue_.update(j, impact_of);
    }
  }

 private:
  [[nodiscard]] Member& member(CharacterIndex i) const noexcept { return step_.members[i]; }

  [[nodiscard]] bool avoids(CharacterIndex i, CharacterIndex other) const noexcept {
    return contains(member(i).obstacles, other);
  }

  [[nodiscard]] Impact impact(CharacterIndex i, CharacterIndex j) const noexcept {
    constexpr Tolerances tolerances{};
    if (!member(i).box.overlaps(member(j).box)) return {};
    // A character that avoids another comes as near as the technique lets it.
    const double hit_distance = avoids(i, j) || avoids(j, i) ? tolerances.certain : tolerances.hit;
    return first_impact(step_.rules.space, member(i).plan.path, member(j).plan.path, time_, hit_distance, step_.up);
  }

  /// Those that begin the step nearer than they should be: the technique restores their gap, as that to a solid.
  void avoid_those_too_near() noexcept {
    for (CharacterIndex i = 0; i < step_.members.size(); ++i) {
      for (CharacterIndex j = 0; j < step_.members.size(); ++j) {
        if (j == i || !member(i).box.overlaps(member(j).box)) continue;
        if (step_.rules.space.separation(member(i).now.state.position, member(j).now.state.position) < Tolerances{}.hit)
          member(i).obstacles.push_back(j);
      }
      if (!member(i).obstacles.empty()) paths_.replan(i);
    }
  }

  void handle(CharacterIndex i, CharacterIndex j, const Impact& impact) noexcept {
    // Relative to what carries both alike, they move as on ground that stands.
    const Vec2d first_ride = velocity_of(member(i).plan.ride);
    const Vec2d ride = first_ride == velocity_of(member(j).plan.ride) ? first_ride : Vec2d(Vec2d::Zero());
    const Vec2d& normal = impact.normal;
    const Vec2d first_rate = impact.first_rate - ride * step_.dt;
    const Vec2d second_rate = impact.second_rate - ride * step_.dt;
    const Approaching toward = approaching(first_rate, second_rate, normal);
    if (!toward.second || member(j).holds_position) return avoid_or_push(i, j);
    if (!toward.first || member(i).holds_position) return avoid_or_push(j, i);
    paths_.advance_to(i, time_);
    paths_.advance_to(j, time_);
    const double away = ride.dot(normal);
    slow_down(i, normal, std::max(0.0, -second_rate.dot(normal)) / step_.dt - away);
    slow_down(j, Vec2d(-normal), std::max(0.0, first_rate.dot(normal)) / step_.dt + away);
    const auto [upper, lower] = is_above(i, j) ? std::pair(i, j) : std::pair(j, i);
    // The upper one stands still as an obstacle first. Otherwise the ground would deflect the motion of the lower one
    // into it and push it. A lower one that a mover pushes does push it on.
    stand_still(upper, velocity_of(member(lower).plan.ride));
    if (avoid(lower, upper).any()) stop_avoiding(lower, upper);
    avoid_or_push(upper, lower);
  }

  /// Nothing can be avoided on a leg that takes no time. A leg that follows the ground down is left out instead. For
  /// one that leads out of an overlap, or to the right gap, another is looked for once; after that the character holds
  /// its position.
  void handle_instant(CharacterIndex i, CharacterIndex j, const Impact& impact) noexcept {
    const auto [mover, other] = impact.first_rate == Vec2d::Zero() ? std::pair(j, i) : std::pair(i, j);
    if (time_ > member(mover).now.time && !member(mover).ground_taken) {
      member(mover).ground_taken = true;
      paths_.replan(mover);
    } else if (!avoids(mover, other) && may_replan(mover)) {
      avoid(mover, other);
    } else {
      paths_.advance_to(mover, time_);
      paths_.hold_position(mover);
    }
  }

  /// First `i` avoids `other`. If `i` is pushed and has no room, `other` avoids `i`. If neither has room, `i` is
  /// crushed between them: `other` becomes its only obstacle, so that whatever pushed `i` must avoid `i`.
  void avoid_or_push(CharacterIndex i, CharacterIndex other) noexcept {
    if (!may_replan(i)) return;
    const Crush first = avoid(i, other);
    if (!first.any()) return;
    if (!member(other).holds_position) {
      stop_avoiding(i, other);
      const Crush second = avoid(other, i);
      if (!second.any()) return;
      stop_avoiding(other, i);
      if (first.by_character && !second.by_character) {
        avoid(other, i);
        return;
      }
    }
    if (!first.by_character && !avoid(i, other).by_character) return;
    member(i).obstacles.clear();
    if (avoid(i, other).by_character) paths_.hold_position(i);
  }

  /// A new path from the impact on, with one more obstacle.
  Crush avoid(CharacterIndex i, CharacterIndex other) noexcept {
    paths_.advance_to(i, time_);
    if (avoids(i, other) || member(i).obstacles.push_back(other)) return paths_.replan(i);
    paths_.hold_position(i);
    return {};
  }

  void stop_avoiding(CharacterIndex i, CharacterIndex other) noexcept {
    if (member(i).holds_position) return;
    const Obstacles obstacles = member(i).obstacles;
    member(i).obstacles.clear();
    for (const CharacterIndex each : obstacles)
      if (each != other) member(i).obstacles.push_back(each);
    paths_.replan(i);
  }

  /// Counts the new paths of a character. After many it gives up its own motion.
  /// @return false after twice as many: then it holds its position.
  [[nodiscard]] bool may_replan(CharacterIndex i) noexcept {
    paths_.advance_to(i, time_);
    Member& replanned = member(i);
    if (++replanned.replans == step_.rules.max_replans) {
      replanned.dropped = true;
      replanned.now.own_velocity =
          replanned.now.state.grounded ? Vec2d(step_.gravity * step_.dt) : Vec2d(Vec2d::Zero());
    }
    if (replanned.replans < 2 * step_.rules.max_replans) return true;
    paths_.hold_position(i);
    return false;
  }

  /// Plans to stand still, relative to what moves with velocity `ride` [m/s], until there is another plan.
  void stand_still(CharacterIndex i, const Vec2d& ride) noexcept {
    const Moment& now = member(i).now;
    auto& path = member(i).plan.path;
    path.clear();
    path.push_back({now.state.position, now.time});
    path.push_back({now.state.position + ride * (step_.dt * (1 - now.time)), 1});
  }

  /// When the step began. Of two at one height the left one is the upper one, in whichever order they are given.
  [[nodiscard]] bool is_above(CharacterIndex i, CharacterIndex j) const noexcept {
    const Vec2d a = step_.up.seen(member(i).start.state.position);
    const Vec2d b = step_.up.seen(member(j).start.state.position);
    return a.y() > b.y() || (a.y() == b.y() && a.x() <= b.x());
  }

  /// Slows a character to `limit` against the normal, in the world [m/s].
  void slow_down(CharacterIndex i, const Vec2d& normal, double limit) noexcept {
    Moment& now = member(i).now;
    const Vec2d ride = velocity_of(now.state.ride);
    const Vec2d velocity = step_.up.seen(now.own_velocity + ride);
    now.own_velocity =
        step_.up.in_world(slowed(velocity, step_.up.seen(normal), limit, step_.rules.walkable_cosine)) - ride;
  }

  CrowdStep& step_;
  Paths& paths_;
  ImpactQueue queue_;
  double time_ = 0;  ///< Of the impact that is handled.
};

}  // namespace paperproof::crowd
