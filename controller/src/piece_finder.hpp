/// Pieces that a character's way may touch.
#pragma once

#include "broad_phase/tree.hpp"

#include <paperproof/report.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/scratch.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace paperproof {

/// Candidates are collected at most this far ahead of a motion, in multiples of the character's larger extent. Zero:
/// every step asks the tree. Large: a fast step tests pieces that it never meets.
inline constexpr double look_ahead_share = 2;

/// The positions for which candidates are collected when a character in `box` goes by `way` in a step [m].
/// @param most how far ahead at most [m].
[[nodiscard]] inline Box2 positions_ahead(const Box2& box, const Vec2d& way, double most) noexcept {
  // Number of further steps like the present one. None: every step asks the tree. Many: every step tests pieces
  // that it never meets.
  constexpr int steps_ahead = 8;
  // The box also grows by this fraction of `most` on every side: for small turns.
  constexpr int sides = 32;
  const Vec2d limit = Vec2d::Constant(most);
  const Vec2d ahead = (way * double(steps_ahead)).cwiseMin(limit).cwiseMax(-limit);
  return box.merged({box.lower + ahead, box.upper + ahead}).inflated(most / sides);
}

/// Finds the pieces near a path, among given pieces of a scenery. It has one tree for the standing pieces, whose
/// answer is kept for the next steps, and one for each mover. Immutable; shareable between threads; a search never
/// allocates.
class PieceFinder {
 public:
  /// @param pieces ascending.
  PieceFinder(const Scenery& scenery, const CharacterShape& shape, std::span<const PieceIndex> pieces,
              PieceSearch search);

  [[nodiscard]] Candidates make_candidates() const;

  /// Calls `look(pieces, motion)` for the standing pieces and for each mover. `pieces` (ascending) are all those that
  /// the character may touch on the path, and perhaps more. If the character stays in one place, pieces that it touches
  /// throughout may be missing.
  /// @param path straight between its corners. @param movers one for each mover of the scenery.
  /// @param candidates made by this finder, or by one of the same pieces and shape.
  template <class Look>
  void along(std::span<const PathPoint> path, std::span<const MoverMotion> movers, Candidates& candidates,
             const Look& look) const noexcept {
    if (const std::span<const PieceIndex> near = near_standing(path, candidates); !near.empty())
      look(near, MoverMotion{});
    along_movers(path, movers, candidates, look);
  }
  /// For each mover alone.
  template <class Look>
  void along_movers(std::span<const PathPoint> path, std::span<const MoverMotion> movers, Candidates& candidates,
                    const Look& look) const noexcept {
    const std::span<PieceIndex> room = std::span(candidates.pieces).subspan(standing_.pieces.size());
    for (const Group& group : moving_) {
      const MoverMotion& motion = movers[group.mover];
      const std::span<const PieceIndex> near = group.query(touched_from(positions_seen(path, motion)), room);
      if (!near.empty()) look(near, motion);
    }
  }
  /// The standing pieces; none if the whole path is inside `candidates.quiet`.
  [[nodiscard]] std::span<const PieceIndex> near_standing(std::span<const PathPoint> path,
                                                          Candidates& candidates) const noexcept;
  /// Box around all corners of a path, relative to a mover.
  [[nodiscard]] static Box2 positions_seen(std::span<const PathPoint> path, const MoverMotion& motion) noexcept;

 private:
  /// The standing pieces, or the pieces of one mover.
  struct Group {
    MoverIndex mover = no_mover;
    std::vector<PieceIndex> pieces;
    std::vector<Box2> boxes;                ///< Of the pieces, at offset zero,
    std::optional<broad_phase::Tree> tree;  ///< and the tree over them.

    [[nodiscard]] std::span<const PieceIndex> query(const Box2& box, std::span<PieceIndex> found) const noexcept;
  };

  [[nodiscard]] Box2 touched_from(const Box2& positions) const noexcept {
    return {positions.lower + reach_.lower, positions.upper + reach_.upper};
  }

  Box2 reach_;         ///< Around the character at the origin, and a little more [m].
  double look_ahead_;  ///< [m]
  bool asks_all_;      ///< Also on a way that is known to be quiet.
  Group standing_;
  std::vector<Group> moving_;  ///< One for each mover that has such pieces.
};

}  // namespace paperproof
