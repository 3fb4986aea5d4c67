/// Moves a crowd by `octagon_sweep`.
#pragma once

#include "crowd/member.hpp"

namespace paperproof::crowd {

/// Moves all characters that have a request in `step.memory`. Never throws.
/// @param step its members are overwritten; of each member of the report `step.move`, `met`, `started_overlapping` and
///   `stayed` are filled in, and of the report its `impacts`. `memory.states` become those after the move, but for what
///   the controller makes of it.
/// @param before the states when the step began.
/// @return false where the step of one would leave the range: then no move is valid.
[[nodiscard]] bool sweep_together(CrowdStep step, std::span<const CharacterState> before) noexcept;

}  // namespace paperproof::crowd
