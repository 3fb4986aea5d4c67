/// Whether a step hangs: it could have fallen, and did not.
#pragma once

#include "oracle/crush.hpp"
#include "oracle/exact.hpp"
#include "oracle/intent.hpp"
#include "records/trace.hpp"

namespace paperproof::compare::detail {

/// What counts as near, and as an opening.
struct Reach {
  double contact = 0;  ///< What is this near may hold a character [m].
  double opening = 0;  ///< Narrower ones count as closed [m].
};
/// That of §6 of the guarantee.
inline constexpr Reach exact_reach{1e-6, 2e-7};
/// The contender's own: Box2D's skin of 20 mm, a unit of a technique that searches by units, what float still touches;
/// none of them enters an opening without that much room on both sides. Else the exact one.
[[nodiscard]] Reach reach_of(const TraceHeader& header);

/// How far what turns may come in the step, along a face's normal: at most, or as far as its nearest point does.
enum class Bounds : std::uint8_t { safe, nominal };

/// Whether a surface with this unit normal is within the climb limit, and 1e-6 rad.
[[nodiscard]] bool is_walkable(const Vec2d& normal, const TraceHeader& header, const Vec2d& up = {0, 1});

/// Asks of a step whether it hangs, and what it stands on: see `Judge` for what that means. Lives for one step.
class HangingJudge {
 public:
  /// @param up of the character in this step, a unit vector: it falls against that.
  /// @param walk what a step wants that begins as a walk, which stairs hold: see `is_stair`.
  HangingJudge(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step, const WhatTurns& turns,
               const Vec2d& up = {0, 1}, const Wanted* walk = nullptr);

  /// @param made what the step went [m].
  [[nodiscard]] bool hangs(const Vec2d& made, const Reach& reach, Bounds bounds = Bounds::safe) const;
  /// Whether a face that looks upwards is no farther away, or anything is overlapped, at a corner of the step's way.
  [[nodiscard]] bool has_support(std::size_t corner, double within) const;
  /// Whether what is no farther away where the step ends lets the unsteered motion go no way down: a wedge.
  [[nodiscard]] bool is_held_at_end(double within) const;

 private:
  /// The displacements that stay outside an obstacle, beyond one of its faces: normal · d >= bound.
  struct HalfPlane {
    Vec2d normal;
    double bound = 0;       ///< [m]
    double separation = 0;  ///< [m]
    [[nodiscard]] bool holds(const Vec2d& d) const;
    [[nodiscard]] double room(const Vec2d& aside) const;
  };
  /// One of these has to hold.
  using Obstacle = std::vector<HalfPlane>;
  struct Nearby {
    std::vector<Obstacle> obstacles;  ///< By how far they go in the whole step.
    bool holds = false;               ///< Something of it is ground, or overlaps the octagon.
    void add(const Nearby& other);
  };

  [[nodiscard]] std::vector<Nearby> near_corners(const Vec2d& fall, const Reach& reach, Bounds bounds) const;
  [[nodiscard]] double fall_leg_by_leg(const Vec2d& wanted, const std::vector<Nearby>& corners,
                                       const Reach& reach) const;
  [[nodiscard]] bool is_run_into(const Reach& reach) const;
  [[nodiscard]] bool is_run_into(const PathPoint& corner, const Vec2d& way, const Reach& reach) const;

  [[nodiscard]] std::vector<NearPart> parts_near(std::size_t corner, double within) const;
  [[nodiscard]] bool blocks(std::size_t corner, const NearPart& part, double within) const;
  [[nodiscard]] bool is_ground(std::size_t corner, const NearPart& part) const;
  [[nodiscard]] static Vec2d nearest_free(const Vec2d& wanted, const std::vector<Obstacle>& obstacles, double opening);

  const TraceHeader& header_;
  const ExactScenery& scenery_;
  const TraceStep& step_;
  const WhatTurns& turns_;
  Vec2d up_;
  const Wanted* walk_;
};

}  // namespace paperproof::compare::detail
