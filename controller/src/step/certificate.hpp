/// Proof, without rounding, that a straight motion stays clear of a piece.
#pragma once

#include "step/configuration_space.hpp"

#include <paperproof/step_context.hpp>

#include <span>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Whether the octagon's open interior meets the piece: exactly, where separations do not tell. Allocates nothing.
/// @param movers motions in the whole step. @param position in the world, at a fraction of the step.
[[nodiscard]] bool overlaps_exactly(const ConfigurationSpace& space, PieceIndex piece,
                                    std::span<const MoverMotion> movers, const Vec2& position, Real time);

/// Whether one line separates octagon and piece at both ends of a straight motion, exactly. Separations are linear, so
/// the whole motion is then clear. (That no single line does so does not prove an overlap: the answer is then `false`
/// all the same.) Beside a circle also whether the motion comes no nearer from an end that is clear.
/// @param from,to positions in the world. @param begin,end when the character is there, as fractions of the step.
[[nodiscard]] bool clear_of_exactly(const ConfigurationSpace& space, PieceIndex piece,
                                    std::span<const MoverMotion> movers, const Vec2& from, Real begin, const Vec2& to,
                                    Real end);

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
