/// What is worked on during one frame of one character, or of several at once.
#pragma once

#include "techniques/discrete/solver.hpp"
#include "techniques/frame_of_reference.hpp"

#include <paperproof/tolerances.hpp>

#include <paperproof/crowd.hpp>

#include <vector>

namespace paperproof::discrete {

/// Of the pairs of a round there is room for one with each piece, and for so many more with each character: the pairs
/// that there can be grow with the square. Few: a crowd in one place drops what it should solve. Large: memory.
inline constexpr std::size_t most_pairs_each = 256;

/// One frame of one character while it is worked out, in its frame of reference.
struct Frame {
  const MoveRequest& request;
  FrameOfReference place;
  MoveResult& result;
  CrowdMember* member;  ///< Null for one that is alone.
  Body character{};
  Vec2d expected{Vec2d::Zero()};             ///< Where it was expected before the last round [m].
  FixedVector<ColliderIndex, 64> pushers{};  ///< Colliders of movers that pushed the character.
  bool left_over = true;                     ///< The last round changed something.
  bool stays = false;                        ///< It was crushed, and is where the step began.
};

struct Workplace final : OwnMemory {
  Solver solver{Tolerances{}.stop, Tolerances{}.touch};
  std::vector<Frame> frames;
  std::vector<Body> bodies;            ///< The characters, then what is near any of them.
  std::vector<PieceIndex> near;        ///< The pieces among the bodies, ascending.
  std::vector<std::uint8_t> gathered;  ///< By piece: it is among them. All zero between frames.
};

}  // namespace paperproof::discrete
