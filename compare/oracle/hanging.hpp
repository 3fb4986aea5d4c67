/// Whether a step hangs: it could have fallen, and did not.
#pragma once

#include "oracle/intent.hpp"
#include "oracle/step_view.hpp"

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
[[nodiscard]] bool is_walkable(const Vec2d& normal, const TraceHeader& header, const Vec2d& up);

/// Whether a step hangs: see `Judge`.
/// @param walk what a step wants that begins as a walk, which stairs hold: see `is_stair`; else null.
/// @param made what the step went [m].
[[nodiscard]] bool hangs(const StepView& at, const Wanted* walk, const Vec2d& made, const Reach& reach,
                         Bounds bounds = Bounds::safe);
/// Whether a face that looks upwards is no farther away, or anything is overlapped, at a corner of the step's way.
[[nodiscard]] bool has_support(const StepView& at, std::size_t corner, double within);
/// Whether the step ends in a wedge: the obstacles within this distance leave the unsteered motion no way down.
[[nodiscard]] bool is_held_at_end(const StepView& at, double within);

}  // namespace paperproof::compare::detail
