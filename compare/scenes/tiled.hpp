/// Reads Tiled maps (TMX and Tiled JSON, orthogonal) as scenes.
///
/// **What is solid.** Each thing on a map is marked, or not, by the nearest of these that says something: the object or
/// tile itself, for an object showing a tile that tile, the layer, the groups around it. A mark is, in this order:
/// 1. a property: `one_way`, `oneway`, `platform` (true: one-way), `bodyType` (`static`: solid, anything else: not),
///    `solid`, `collision`, `collides` (true: solid, false: not);
/// 2. the class (`type` in older files): `platform`, `one_way` are one-way; `solid`, `collision`, `wall`, `slope`,
///    `ground`, `block`, `static` are solid;
/// 3. the name of a layer or group: `collision`, `collisions`, `solid`, `solids`, `wall`, `walls`, `platforms` make
///    what is in it solid, `one_way`, `one_way_platforms` one-way.
/// Letter case, spaces, `_` and `-` in these words do not matter. What is not marked is decoration. Where nothing at
/// all is marked, every tile that has collision shapes in its tileset is solid by these.
///
/// **What it becomes.** A solid tile is its collision shapes, or its whole square where it has none; a one-way tile is
/// its upper edges. A solid rectangle, polygon or tile object is a polygon, a solid polyline a chain that blocks from
/// both sides; a one-way polyline blocks from above, a one-way rectangle, polygon or tile object with its upper edges.
/// A solid ellipse as wide as high is a circle; another one, and a capsule (Tiled 1.12: a rectangle with half circles
/// at its ends), becomes a polygon at most 1/8 px inside of its curve, and a note counts these. An object made from a
/// template is refused where it is marked, as templates are not read; points, texts and objects without a size are left
/// out with a note. A tile object or rectangle in a layer named `moving platforms` becomes a mover: `change_x` or
/// `change_y` is its speed in pixels per 1/60 s (y up), `boundary_left`, `_right`, `_top`, `_bottom` its turning points
/// in pixels from the map's lower left corner (one that begins beyond them turns where it began); without a pair of
/// turning points it is left out with a note.
///
/// **Where the character begins.** At the first object whose name or class is `spawn`, `spawn point`, `player`,
/// `main player`, `player start`, `player spawn`, `start` or `hero`; else at the first object in a layer of such a
/// name; the sprite's top left corner is put at the object's (of a tile object, its upper left corner); but at a point
/// the sprite stands: the middle of its lower edge is there. Without any: above the first ground, looking through the
/// columns of tiles from left to right and in each from top to bottom, where there is room. The character is the
/// article's, 20 x 40 px at 32 px/m, whatever the scale of the map. It climbs kerbs up to a pixel: see
/// map_defaults.hpp.
///
/// **Scale.** A tile is 1 m high, unless a scene that refers to the map says otherwise. Vertices are (pixels) /
/// pixels_per_metre with one division, so that neighbouring tiles share bits; y is negated, so the map lies below 0.
#pragma once

#include "scenes/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace paperproof::compare {

/// Reads a map for itself: with a start, a fall limit of 25 m/s and 3,600 steps.
/// @param given the file as the user named it. @throws InputError
[[nodiscard]] Scene read_tiled(const std::string& path, const std::string& given);
[[nodiscard]] Scene read_tiled_json(const nlohmann::ordered_json& document, const std::string& path,
                                    const std::string& given);

/// Reads a map as part of a scene that has its own scale and start: only scenery, ids, movers, box and notes are
/// filled.
[[nodiscard]] Scene read_tiled_part(const std::string& path, const std::string& given, double pixels_per_metre);

}  // namespace paperproof::compare
