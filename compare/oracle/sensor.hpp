/// When the octagon is in a sensor, exactly.
#pragma once

#include "oracle/convex_parts.hpp"
#include "oracle/exact.hpp"
#include "oracle/world.hpp"

#include <span>
#include <vector>

namespace paperproof::compare::detail {

/// What happens to one sensor on a way, appended in order of time. In each convex part of it the octagon is while every
/// edge normal of the two finds them overlapping (separating axes), and along a leg each of those is linear in time.
/// @param places the corners of the way in the sensor's frame.
void add_sensor_events(const World& world, ColliderIndex sensor, std::span<const ConvexPart> parts,
                       std::span<const FramePlace> places, std::vector<ExactSensorEvent>& events);

}  // namespace paperproof::compare::detail
