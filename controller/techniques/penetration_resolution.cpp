/// The article's penetration resolution: where the character arrives, pair by pair, the movement is adjusted by one
/// unit until the pair is free; iterated. In-between positions are never looked at: paper is passed, and a chain, which
/// has no inside, is never met. On the floor it hops: it falls until it is inside, is pushed out by whole units, and
/// falls again. This is the article's jitter, "between two adjacent positions", though the cycle has more than two
/// positions and less than a unit between the outermost: at 60 steps per second 17 positions within 28 mm under 10
/// m/s², 9 within 27 mm under 30, with a unit of 31 mm (scenes `stuck_points` and `long_rest`). A contact is only known
/// at the end of the frame: its fraction is 1.
///
/// Where the article leaves it open, this is how it is read here. "Adjusted by one pixel" is by a unit, against the
/// side of the pair; past the start of the frame where needed, by as much as the character is long. What is not free
/// then is larger than the character: the component is zero. "The object currently being tested" is one collider, in
/// the order of the scenery, and its four pairs in the order top, bottom, left, right (the knob `objects`).
#include "techniques/article_technique.hpp"
#include "techniques/registry.hpp"

namespace paperproof {

namespace {

using PenetrationResolution = article::SearchingTechnique<nullptr, true>;

}  // namespace

TechniqueEntry penetration_resolution_entry() {
  return article::entry_of_search<PenetrationResolution>("penetration_resolution");
}

}  // namespace paperproof
