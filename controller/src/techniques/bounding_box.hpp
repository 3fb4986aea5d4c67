/// The article's bounding boxes: every piece and the character are replaced by the smallest box that holds them, and
/// only boxes meet boxes. Right on flat ground; on a slope the character walks into its box as into a wall, and stands
/// in the air above the rest of it.
///
/// The boxes are compared where the movement would end, one component at a time (vertical first, as the article's pairs
/// are): what the component has entered stops it at the face that it came from. Nothing between start and end is looked
/// at, so paper is passed. A box that the character was in already pushes it out along the axis of least overlap, both
/// repeated up to the knob `iterations`; the other knobs have no meaning here.
///
/// Enemies are boxes, too: what moves is where it will be at the end of the frame, and pushes out whom it came over. It
/// carries nobody. A conveyor is refused.
///
/// A chain is the boxes of its segments, which have no thickness where a segment is level or upright. A one-way
/// segment stops only what comes from the side that its blocking normal mostly points to. A contact is only known at
/// the end of the frame: its fraction is 1. Where it ended outside of all boxes, it did so exactly, whatever the
/// rounding.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique, and has no conveyor.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_bounding_box(const TechniqueDef& def,
                                                                   const Scenery<Scalar>& scenery,
                                                                   const CharacterDef& character);

}  // namespace paperproof
