/// What the parts of `RunJudge` share.
#pragma once

#include "oracle/hanging.hpp"

#include <paperproof/types.hpp>

#include <fmt/format.h>

#include <string>

namespace paperproof::compare::run_judge {

/// The largest gap that is allowed at a contact, and how far a time of impact may be off along the normal [m].
inline constexpr double guaranteed_gap = 1e-6;
/// Positions and offsets beyond are refused [m].
inline constexpr double range = 2e6;
/// What moves farther away than this does not reach a character at rest in the step [m].
inline constexpr double beside = 0.01;
/// Cosine of the angle between two normals of one face that is round.
inline constexpr double same_face = 0.9;
/// Relative: two computations of a velocity.
inline constexpr double same_speed = 1e-9;

[[nodiscard]] inline bool moves(const MoverMotion& motion) { return motion.from != motion.to; }
[[nodiscard]] inline std::string metres(double length) { return fmt::format("{:.3g} m", length); }
[[nodiscard]] inline std::string no_ground(const TraceHeader& header) {
  return "says it is grounded with nothing under it within " + metres(detail::reach_of(header).contact);
}

}  // namespace paperproof::compare::run_judge
