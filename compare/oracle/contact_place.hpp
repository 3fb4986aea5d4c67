/// Where a reported contact says that it is.
#pragma once

#include "oracle/met_surfaces.hpp"

#include <string>

namespace paperproof::compare {

/// What is wrong with a place, and which clause that breaks.
struct PlaceFault {
  Clause clause = Clause::contact_invented;
  std::string words;
};

/// A contact is where it says at some corner of the way: its point lies on the outline of the collider, as that stands
/// then, and on the face of the character that looks against the normal, moved out by the separation. How far the face
/// is from the point along the normal is the separation.
/// @param contact with what does not turn, of a step that begins and ends inside nothing.
/// @return none where it is right.
[[nodiscard]] std::optional<PlaceFault> place_fault(const TraceHeader& header, const TraceStep& step,
                                                    const Contact& contact);

}  // namespace paperproof::compare
