/// The field: movers of any engine before the same scenes, a few for each kind of trouble, and the worst that each
/// does.
#pragma once

#include "records/scene_result.hpp"
#include "studies/prepared_studies.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// Stands before the name of a group in the titles of its parts.
inline constexpr const char* field_title = "field: ";
/// The group of the walk over tiles: of hops, and of times, only its rows are looked at.
inline constexpr std::string_view field_seams = "seams";

/// A part for each scene of a group. Where nobody is named they are octagon_sweep, Box2D and all peers. Maps of
/// SuperTux are in it where Debian has installed them; in the place of one that is not here is the playground.
[[nodiscard]] std::vector<StudyPart> field_parts(GridSize size, const std::vector<std::string>& contenders);

/// What each group asks.
[[nodiscard]] std::vector<std::string> field_questions();

/// A number as tables of the field have it: two digits, or all before the point.
[[nodiscard]] std::string in_short(double number);

/// Steps that hang, without those on which the exact law does as well. Who promises never to hang has no such excuse.
[[nodiscard]] int hanging_of(const Row& row);

/// The skin of whoever ran: up to this depth it may be inside [m].
[[nodiscard]] double skin_of(const Row& row);

/// Whether its worst is unsafe: it fails, passes or ends inside something, or hangs.
[[nodiscard]] bool is_unsafe(const Row& row);

/// What hole its worst is, for the engine to be asked; nothing where it is none, or a ledge.
[[nodiscard]] std::optional<ReportEvent::Kind> hole_of(const Row& row);

}  // namespace paperproof::compare
