/// Memory of a step: sized by the scenery, so that no fixed number decides what a step does or names.
#pragma once

#include "step/half_planes.hpp"
#include "step/narrow_phase.hpp"

#include <paperproof/scenery_facts.hpp>
#include <paperproof/technique.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace paperproof::octagon_sweep {

/// A piece that stops a motion.
template <class Scalar>
struct Stop {
  PieceIndex piece;
  Scalar stop;      ///< Fraction of the motion.
  Scalar together;  ///< Stops up to this much later or earlier are at the same time.
  EntryAxes axes;
};

/// A surface that is touched: no motion may go further into it.
template <class Scalar>
struct Hold {
  PieceIndex piece;
  std::size_t axis;
  Vec2<Scalar> normal;
  MoverIndex mover;
};

/// A piece at the moment of a straight way when it is nearest.
template <class Scalar>
struct Nearest {
  PieceIndex piece;
  std::size_t axis;
  Scalar separation;  ///< [m]
  Scalar when;        ///< Fraction of the way.
};

/// What a collider is to a character during a step; several may hold.
enum Role : std::uint8_t {
  lies_on = 1,  ///< It is on the character since an earlier step, or
  crushes = 2,  ///< crushes it: it goes through the character.
  left = 4,     ///< The step began inside it, and leaves it.
  still = 8,    ///< It goes through the character, and is on it where the step ends.
  known = 16,   ///< It is or was one of these.
};
inline constexpr std::uint8_t goes_through = lies_on | crushes;

/// What a step may need besides its state.
template <class Scalar>
struct StepMemory final : OwnMemory {
  /// @param touched_at_once so many pieces that stand still can be touched in one place.
  /// @param iterations of the sweep.
  StepMemory(const ConfigurationSpace<Scalar>& space, std::size_t touched_at_once, int iterations)
      : corners(2 * MoveResult<Scalar>::max_corners + 4 * moving_pieces(space)),
        contacts(most_contacts(space, touched_at_once + moving_pieces(space), iterations)),
        crushed(count_moving_colliders(space.scenery())),
        contacts_at(corners.capacity()),
        of_mover(moving_pieces(space)) {
    const std::size_t touched = touched_at_once + of_mover.size();
    for (auto* each : {&holds, &holds_before}) each->reserve(touched);
    for (auto* each : {&ways, &velocities}) each->reserve(touched);
    roles.resize(space.scenery().collider_count());
    if (of_mover.empty()) return;
    marked.reserve(roles.size());
    crushers.reserve(crushed.capacity());
    near_the_way.reserve(space.scenery().sensor_pieces().first);
  }

  /// What the last step left.
  void clear() noexcept {
    for (const ColliderIndex collider : marked) roles[collider] = 0;
    marked.clear();
    holds.clear();
    crushers.clear();
  }
  void mark(ColliderIndex collider, Role role) noexcept {
    if (roles[collider] == 0) marked.push_back(collider);
    roles[collider] |= role | known;
  }
  void unmark(ColliderIndex collider, Role role) noexcept {
    roles[collider] = static_cast<std::uint8_t>(roles[collider] & ~role);
  }
  [[nodiscard]] bool is(ColliderIndex collider, std::uint8_t any_of) const noexcept {
    return (roles[collider] & any_of) != 0;
  }

  ReportMemory<PathPoint<Scalar>> corners;  ///< Of the path.
  ReportMemory<Contact<Scalar>> contacts;   ///< Of one step, which reports each facet once at most.
  ReportMemory<ColliderIndex> crushed;
  std::vector<std::size_t> contacts_at;    ///< How many contacts were known at each corner of the path.
  std::vector<PieceIndex> of_mover;        ///< Answers of one mover's broad phase.
  std::vector<std::uint8_t> roles;         ///< Of each collider: see `Role`.
  std::vector<ColliderIndex> marked;       ///< Those that are `known`, in the order in which they came to be.
  std::vector<Hold<Scalar>> holds;         ///< What is touched, each piece once,
  std::vector<Hold<Scalar>> holds_before;  ///< and what was when the last sweep began.
  std::vector<HalfPlane<Scalar>> ways;     ///< Those that the holds allow,
  std::vector<HalfPlane<Scalar>> velocities;
  std::vector<Nearest<Scalar>> near_the_way;  ///< Into room.
  /// What came over the character, now or before, and how far it has gone by the end of the step.
  std::vector<Crusher<Scalar>> crushers;

 private:
  [[nodiscard]] static std::size_t moving_pieces(const ConfigurationSpace<Scalar>& space) {
    const std::span<const PieceInfo> all = space.scenery().pieces();
    const auto moves = [](const PieceInfo& each) { return each.mover != no_mover; };
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), moves));
  }
  /// Each impact reports each piece once at most, and so does the end of the step, for the ground and for what it
  /// follows.
  [[nodiscard]] std::size_t most_contacts(const ConfigurationSpace<Scalar>& space, std::size_t touched,
                                          int iterations) const {
    std::size_t axes = 0;
    for (PieceIndex piece = 0; piece < space.scenery().sensor_pieces().first; ++piece) axes += space.axis_count(piece);
    const std::size_t impacts = moving_pieces(space) > 0 ? corners.capacity() : static_cast<std::size_t>(iterations);
    return std::min(axes, touched * (impacts + 3));
  }
};

/// Everything that moves during one step.
template <class Scalar>
struct Surroundings {
  const MoverPhases<Scalar>& phases;
  std::span<const MoverMotion<Scalar>> movers;
  Scalar dt;        ///< [s]
  MoverIndex near;  ///< Movers to look at: all, or none where none comes near the step.
  bool active;      ///< A mover comes near the step, or there may be a conveyor.

  void look_at_movers() noexcept {
    near = phases.size();
    active = active || near > 0;
  }

  /// How far a mover goes in the step [m].
  [[nodiscard]] Vec2<Scalar> course(MoverIndex mover) const noexcept { return movers[mover].to - movers[mover].from; }
  /// Where it is at a fraction of the step [m].
  [[nodiscard]] Vec2<Scalar> offset(MoverIndex mover, Scalar time) const noexcept { return movers[mover].at(time); }
  /// How far it still goes after a fraction of the step [m].
  [[nodiscard]] Vec2<Scalar> rest(MoverIndex mover, Scalar time) const noexcept { return course(mover) * (1 - time); }

  /// A motion for the rest of the step as the mover sees it [m]. What is nothing but rounding becomes zero: a rider at
  /// rest rests, and a sweep that looks ahead does not take noise for a direction.
  [[nodiscard]] Vec2<Scalar> relative(const Vec2<Scalar>& way, MoverIndex mover, Scalar time) const noexcept {
    constexpr Scalar noise = std::numeric_limits<Scalar>::epsilon() * 8;
    const Vec2<Scalar> whole = course(mover);
    // Each offset is rounded on its own: a mover at one speed goes an ulp more or less from step to step.
    const Vec2<Scalar> furthest = movers[mover].from.cwiseAbs().cwiseMax(movers[mover].to.cwiseAbs());
    Vec2<Scalar> result = way - rest(mover, time);
    for (Eigen::Index i = 0; i < 2; ++i)
      if (std::abs(result[i]) <= noise * std::max({std::abs(way[i]), std::abs(whole[i]), furthest[i]})) result[i] = 0;
    return result;
  }
};

}  // namespace paperproof::octagon_sweep
