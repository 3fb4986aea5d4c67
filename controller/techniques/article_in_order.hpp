/// Speculative contacts where something moves: in order of time of impact.
#pragma once

#include "techniques/article_record.hpp"

namespace paperproof::article {

/// Goes from one time of impact to the next, each time with the rest of the movement, until the end of the frame: of
/// all pairs that face their movement relative to what is near, the one that hits first. From then on that component
/// goes as what it met does. Hits go into the record, and the corners of the way.
/// @return where the frame ends; every pair that hit is free there of what it hit, unless that crushes it.
[[nodiscard]] Vec2d meet_in_order_of_time(const Parts& parts, ImpactSearch search, std::span<const PieceGroup> groups,
                                          const MoveRequest& request, FrameRecord& record) noexcept;

}  // namespace paperproof::article
