#include "techniques/grid/squares.hpp"

#include "techniques/raster/rasterise.hpp"

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

}  // namespace

Squares::Squares(const SceneryDef& scenery, double side, double tolerance) : side_(side) {
  const Reader reader(side, tolerance);
  std::optional<std::pair<Square, Square>> box;
  for (const ColliderIndex collider : standing_solids(scenery)) {
    const ColliderDef& def = scenery.colliders[collider];
    if (def.shape == ColliderDef::Shape::chain) reader.refuse("a chain", collider);
    if (def.one_way) reader.refuse("a one-way polygon", collider);
    for (const Square& corner : reader.corners_of(def.points, collider)) {
      if (!box) box = {corner, corner};
      box->first = {std::min(box->first.column, corner.column), std::min(box->first.row, corner.row)};
      box->second = {std::max(box->second.column, corner.column), std::max(box->second.row, corner.row)};
    }
    for (const std::vector<Vec2d>& hole : def.holes) (void)reader.corners_of(hole, collider);
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
  raster::for_each_span(scenery, 1 / side, [&](ColliderIndex collider, const raster::Span& span) {
    for (Square at{span.first, span.row}; at.column < span.end; ++at.column)
      if (ColliderIndex& here = colliders_[index_of(at)]; here == nothing) here = collider;
  });
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
