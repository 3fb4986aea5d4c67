/// Which pieces a step may have to look at.
#pragma once

#include "piece_finder.hpp"
#include "techniques/octagon_sweep/configuration_space.hpp"
#include "techniques/octagon_sweep/room.hpp"

#include <paperproof/technique.hpp>
#include <paperproof/tolerances.hpp>

#include <cmath>
#include <limits>
#include <span>

namespace paperproof::octagon_sweep {

/// The pieces that stand still around a character. Superset of what meets a box; kept between steps.
template <class Scalar>
class Neighbourhood {
 public:
  /// @param look_ahead how far ahead of a motion candidates are collected at most [m].
  Neighbourhood(const ConfigurationSpace<Scalar>& space, const BroadPhase<Scalar>& broad_phase, Scalar look_ahead,
                Candidates<Scalar>& candidates) noexcept
      : space_(space), broad_phase_(broad_phase), look_ahead_(look_ahead), candidates_(candidates) {}

  /// Every piece that the octagon can touch while its reference point is in `box`, and perhaps more; ascending.
  /// @param way where it is going [m]: what is there will be wanted next.
  [[nodiscard]] std::span<const PieceIndex> around(const Box2<Scalar>& box,
                                                   const Vec2<Scalar>& way = Vec2<Scalar>::Zero()) noexcept;

  /// The same without `way` and without what was collected before, for the caller to reorder. Nothing is kept.
  [[nodiscard]] std::span<PieceIndex> take(const Box2<Scalar>& box) noexcept {
    forget();
    const std::size_t count = around(box).size();
    forget();
    return std::span(candidates_.pieces).first(count);
  }

  /// What comes next does not depend on what was collected before, not even in how much more it is.
  void forget() noexcept { candidates_.valid = false; }

 private:
  const ConfigurationSpace<Scalar>& space_;
  const BroadPhase<Scalar>& broad_phase_;
  Scalar look_ahead_;
  Candidates<Scalar>& candidates_;
};

template <class Scalar>
std::span<const PieceIndex> Neighbourhood<Scalar>::around(const Box2<Scalar>& box, const Vec2<Scalar>& way) noexcept {
  if (!candidates_.valid || !candidates_.box.contains(box)) {
    candidates_.box = positions_ahead(box, way, look_ahead_);
    candidates_.count = broad_phase_.query(space_.touched_from(candidates_.box), candidates_.pieces);
    candidates_.valid = true;
  }
  return {candidates_.pieces.data(), candidates_.count};
}

/// What a step among movers keeps in its scratch.
template <class Scalar>
struct MoverMemory final : OwnMemory {
  explicit MoverMemory(const ConfigurationSpace<Scalar>& space)
      : of_mover(space.scenery().pieces().size()), all(of_mover.size()), room(space) {}
  std::vector<PieceIndex> of_mover;  ///< Answers of one mover's broad phase,
  std::vector<PieceIndex> all;       ///< and of all of them, with what stands still.
  RoomMemory<Scalar> room;
};

/// Everything that moves during one step.
template <class Scalar>
struct Surroundings {
  const MoverPhases<Scalar>& phases;
  std::span<const MoverMotion<Scalar>> movers;
  Scalar dt;  ///< [s]
  MoverMemory<Scalar>& memory;

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
