#include "techniques/grid/squares.hpp"

#include "techniques/nearby_scenery.hpp"

#include <paperproof/techniques.hpp>

#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace paperproof::grid {
namespace {

std::string text_of(double metres) {
  std::string text = std::to_string(metres);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " m";
}

/// Polygons are read corner by corner as columns and rows.
class Reader {
 public:
  Reader(double side, double tolerance) : side_(side), tolerance_(tolerance) {}

  [[nodiscard]] std::vector<Square> corners_of(std::span<const Vec2d> ring, ColliderIndex collider) const {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2d edge = ring[(i + 1) % ring.size()] - ring[i];
      if (edge.cwiseAbs().minCoeff() > tolerance_) refuse("a slope", collider);
    }
    std::vector<Square> corners;
    for (const Vec2d& vertex : ring) corners.push_back({line_at(vertex.x(), collider), line_at(vertex.y(), collider)});
    return corners;
  }

  [[noreturn]] void refuse(const std::string& what, ColliderIndex collider) const {
    throw NotExpressible("the grid cannot express " + what + ": collider " + std::to_string(collider) +
                         " is not made of whole squares of " + text_of(side_));
  }

 private:
  [[nodiscard]] std::int64_t line_at(double coordinate, ColliderIndex collider) const {
    const double line = std::round(coordinate / side_);
    if (!(std::abs(coordinate - line * side_) <= tolerance_)) refuse("an edge between two squares", collider);
    return static_cast<std::int64_t>(line);
  }

  double side_;
  double tolerance_;
};

/// Where a row is crossed by an upright edge: the column on the edge's right.
struct Crossing {
  std::int64_t row = 0;
  std::int64_t column = 0;
  friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

void add_crossings(std::span<const Square> corners, std::vector<Crossing>& crossings) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Square& from = corners[i];
    const Square& to = corners[(i + 1) % corners.size()];
    const auto [low, high] = std::minmax(from.row, to.row);
    for (std::int64_t row = low; row < high; ++row) crossings.push_back({row, from.column});
  }
}

using Rings = std::vector<std::vector<Square>>;

Rings rings_of(const ColliderDef& def, ColliderIndex collider, const Reader& reader) {
  if (def.shape == ColliderDef::Shape::chain) reader.refuse("a chain", collider);
  if (def.one_way) reader.refuse("a one-way polygon", collider);
  Rings rings{reader.corners_of(def.points, collider)};
  for (const std::vector<Vec2d>& hole : def.holes) rings.push_back(reader.corners_of(hole, collider));
  return rings;
}

}  // namespace

Squares::Squares(const SceneryDef& scenery, double side, double tolerance) : side_(side) {
  const Reader reader(side, tolerance);
  const std::vector<ColliderIndex> solids = standing_solids(scenery);
  std::vector<Rings> all;
  std::optional<std::pair<Square, Square>> box;
  for (const ColliderIndex collider : solids) {
    all.push_back(rings_of(scenery.colliders[collider], collider, reader));
    for (const Square& corner : all.back().front()) {
      if (!box) box = {corner, corner};
      box->first = {std::min(box->first.column, corner.column), std::min(box->first.row, corner.row)};
      box->second = {std::max(box->second.column, corner.column), std::max(box->second.row, corner.row)};
    }
  }
  if (!box) return;
  origin_ = box->first;
  columns_ = box->second.column - origin_.column;
  rows_ = box->second.row - origin_.row;
  if (columns_ > most_squares || rows_ > most_squares || columns_ * rows_ > most_squares) {
    throw NotExpressible("the grid cannot express a level of " + std::to_string(columns_) + " x " +
                         std::to_string(rows_) + " squares of " + text_of(side) + ": the most are " +
                         std::to_string(most_squares));
  }
  colliders_.assign(static_cast<std::size_t>(columns_ * rows_), nothing);
  for (std::size_t solid = 0; solid < solids.size(); ++solid) {
    std::vector<Crossing> crossings;
    for (const std::vector<Square>& ring : all[solid]) add_crossings(ring, crossings);
    std::sort(crossings.begin(), crossings.end());
    // Every ring is closed: in each row crossings come in pairs, into the solid and out of it.
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      for (Square at{crossings[i].column, crossings[i].row}; at.column < crossings[i + 1].column; ++at.column) {
        ColliderIndex& here = colliders_[index_of(at)];
        if (here == nothing) here = solids[solid];
      }
    }
  }
}

std::optional<ColliderIndex> Squares::collider_at(const Square& square) const noexcept {
  const bool in_columns = square.column >= origin_.column && square.column - origin_.column < columns_;
  const bool in_rows = square.row >= origin_.row && square.row - origin_.row < rows_;
  if (!in_columns || !in_rows) return std::nullopt;
  const ColliderIndex collider = colliders_[index_of(square)];
  if (collider == nothing) return std::nullopt;
  return collider;
}

}  // namespace paperproof::grid
