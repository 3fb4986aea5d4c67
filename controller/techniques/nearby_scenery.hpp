/// What a single collision point can ask of the pieces near a character.
#pragma once

#include <paperproof/scenery.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace paperproof {

/// The colliders that block and stand still, in order. A level that is drawn once, as squares or as a picture, consists
/// of these. Sensors block nothing, whatever their shape.
[[nodiscard]] inline std::vector<ColliderIndex> standing_solids(const SceneryDef& scenery) {
  std::vector<ColliderIndex> solids;
  for (ColliderIndex i = 0; i < scenery.colliders.size(); ++i)
    if (!scenery.colliders[i].sensor && scenery.colliders[i].mover == no_mover) solids.push_back(i);
  return solids;
}

/// Where the pieces of a rank begin. Until a scenery is edited its pieces stand in this order: the solid ones without a
/// mover (rank 0), those of mover 0, of mover 1 and so on (rank 1, 2, ...), then the sensors.
[[nodiscard]] inline PieceIndex first_of_rank(const Scenery& scenery, std::size_t rank) noexcept {
  const auto pieces = scenery.pieces();
  const auto found = std::partition_point(pieces.begin(), pieces.end(), [&](const PieceInfo& piece) {
    return !piece.sensor && (piece.mover == no_mover ? 0 : piece.mover + std::size_t{1}) < rank;
  });
  return static_cast<PieceIndex>(found - pieces.begin());
}
[[nodiscard]] inline std::span<const Box2> standing_boxes(const Scenery& scenery) noexcept {
  return scenery.boxes().first(first_of_rank(scenery, 1));
}
[[nodiscard]] inline PieceRange pieces_of_mover(const Scenery& scenery, MoverIndex mover) noexcept {
  return {first_of_rank(scenery, mover + std::size_t{1}), first_of_rank(scenery, mover + std::size_t{2})};
}
/// The solid pieces that have a mover.
[[nodiscard]] inline PieceRange moving_pieces(const Scenery& scenery) noexcept {
  return {first_of_rank(scenery, 1), first_of_rank(scenery, std::size_t{no_mover} + 1)};
}

/// Takes the one-way segments out of a list of pieces, from `first` on, for a step that drops through them.
inline void remove_one_way(const Scenery& scenery, std::size_t first, std::vector<PieceIndex>& pieces) {
  const auto begin = pieces.begin() + static_cast<std::ptrdiff_t>(first);
  const auto is_one_way = [&](PieceIndex piece) { return scenery.pieces()[piece].one_way; };
  pieces.erase(std::remove_if(begin, pieces.end(), is_one_way), pieces.end());
}

/// The part of a piece's outline that a point met.
struct PointHit {
  PieceIndex piece = 0;
  Vec2d point{Vec2d::Zero()};   ///< On the outline [m].
  Vec2d normal{Vec2d::Zero()};  ///< Unit, out of the solid; of a chain: to the side the point came from.
  double fraction = 0;          ///< Of the motion asked about, in [0, 1].
};

/// The pieces that the broad phase found, as seen by one point at a time.
///
/// A polygon has an inside: a point is in it when it is strictly inside one piece, or on an edge along which two pieces
/// abut (without the second rule a point could fall down the seam between two tiles). A corner where pieces meet counts
/// as outside. A chain has no inside: it can only be crossed, by motion. A two-sided chain is crossed by a motion that
/// begins off its line and ends on it or beyond; a one-way chain by one that begins on the side of its normal, or on
/// its line, and ends beyond. End points of a segment belong to it, so that a chain is closed at its joints.
///
/// A view: valid as long as the scenery and the list of pieces are. Const, reads only.
class NearbyScenery {
 public:
  NearbyScenery(const Scenery& scenery, std::span<const PieceIndex> pieces) noexcept
      : scenery_(&scenery), pieces_(pieces) {}

  [[nodiscard]] bool empty() const noexcept { return pieces_.empty(); }
  [[nodiscard]] std::span<const PieceIndex> pieces() const noexcept { return pieces_; }

  /// One object of several: the pieces of the collider that the first of `rest` belongs to. What abuts it still closes
  /// its seams. @param rest of `pieces()`, the object's pieces at its front (the broad phase returns them in order).
  [[nodiscard]] NearbyScenery object_at_front(std::span<const PieceIndex> rest) const noexcept;

  /// The first polygon piece that `point` is in.
  [[nodiscard]] std::optional<PieceIndex> containing(const Vec2d& point) const noexcept;

  /// The first chain piece that the straight motion of a point crosses, in order of index.
  [[nodiscard]] std::optional<PieceIndex> crossed(const Vec2d& from, const Vec2d& to) const noexcept;

  /// Where a point that moves straight by `displacement` first enters a polygon or crosses a chain, from the half
  /// planes of each convex piece (Cyrus and Beck 1978). A point that is in a polygon already has the fraction 0 and the
  /// normal of the edge through which it would leave backwards. Entering at the very end of the motion is no entry.
  [[nodiscard]] std::optional<PointHit> first_entry(const Vec2d& from, const Vec2d& displacement) const noexcept;

  /// The edge through which a point of polygon piece `piece` leaves it when pushed along `direction` (not zero).
  [[nodiscard]] PointHit way_out(PieceIndex piece, const Vec2d& point, const Vec2d& direction) const noexcept;

  /// The crossing of chain piece `piece` by a motion for which `crossed` named it.
  [[nodiscard]] PointHit crossing(PieceIndex piece, const Vec2d& from, const Vec2d& to) const noexcept;

 private:
  [[nodiscard]] bool is_seam(const Vec2d& point, const Vec2d& along) const noexcept;
  [[nodiscard]] bool is_chain(PieceIndex piece) const noexcept { return scenery_->pieces()[piece].vertex_count == 2; }
  [[nodiscard]] bool crosses(PieceIndex piece, const Vec2d& from, const Vec2d& to) const noexcept;

  const Scenery* scenery_;
  std::span<const PieceIndex> pieces_;
  std::span<const PieceIndex> around_{};  ///< Of one object: all that is near. Empty: it is everything itself.
};

}  // namespace paperproof
