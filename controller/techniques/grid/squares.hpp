/// The level as a two-dimensional array of squares.
#pragma once

#include <paperproof/scenery.hpp>

#include <optional>
#include <vector>

namespace paperproof::grid {

/// A square by column and row: it reaches from `column * side` to `(column + 1) * side`, rows alike, upwards.
struct Square {
  std::int64_t column = 0;
  std::int64_t row = 0;

  friend bool operator==(const Square&, const Square&) = default;
};

/// Which squares are solid, and with what. Immutable after construction; may be shared between threads.
class Squares {
 public:
  /// The squares that are filled by the polygons of a scenery, sensors and what moves left out.
  /// @param side of a square [m], positive.
  /// @param tolerance how far a vertex may lie from a corner of the squares [m].
  /// @throws NotExpressible where a collider is not made of whole squares, or where the array would have more than
  ///   `most_squares`.
  Squares(const SceneryDef& scenery, double side, double tolerance);

  /// 64 MB. Less: large levels are refused. More: a stray tile far out takes all memory.
  static constexpr std::int64_t most_squares = std::int64_t{1} << 24;

  [[nodiscard]] double side() const noexcept { return side_; }
  [[nodiscard]] std::size_t memory_bytes() const noexcept { return colliders_.size() * sizeof(ColliderIndex); }
  /// What fills a square; the first of several colliders. Nothing outside of the array.
  [[nodiscard]] std::optional<ColliderIndex> collider_at(const Square& square) const noexcept;

 private:
  static constexpr ColliderIndex nothing = 0xffffffffU;

  [[nodiscard]] std::size_t index_of(const Square& square) const noexcept {
    return static_cast<std::size_t>((square.row - origin_.row) * columns_ + square.column - origin_.column);
  }

  double side_;
  Square origin_;  ///< The lower left one.
  std::int64_t columns_ = 0;
  std::int64_t rows_ = 0;
  std::vector<ColliderIndex> colliders_;  ///< Row by row.
};

}  // namespace paperproof::grid
