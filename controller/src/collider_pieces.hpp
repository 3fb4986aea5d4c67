/// Checks a collider and cuts it into pieces.
#pragma once

#include <paperproof/scenery.hpp>

#include <vector>

namespace paperproof {

/// Where pieces are collected: what they are, their vertices, and their boxes.
struct PieceLists {
  std::vector<PieceInfo>& infos;
  std::vector<Vec2d>& vertices;
  std::vector<Box2>& boxes;
};

/// Appends the pieces of a collider. They belong to `no_collider` yet.
/// @param accepted becomes the definition as it runs; its memory is used for one collider after the other.
/// @throws std::invalid_argument for all that the constructor of `Scenery` refuses. Some pieces may be appended then.
void cut_into_pieces(const ColliderDef& def, ColliderDef& accepted, const PieceLists& lists);

}  // namespace paperproof
