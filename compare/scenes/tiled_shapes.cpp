#include "scenes/tiled_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/input_error.hpp"

namespace paperproof::compare {

namespace {

/// Cosine and sine of an angle in degrees: exact for multiples of 90, and the same bits on every machine (the library's
/// are not).
Vec2d turn_by(double degrees) {
  const double quarters = std::nearbyint(degrees / 90);
  const double angle = (degrees - quarters * 90) * (std::numbers::pi / 180);  // within +-45 degrees
  // Taylor series; at 45 degrees the first term left out is below 1e-20.
  double term = 1;
  Vec2d turn = Vec2d::Zero();
  for (int n = 0; n < 20; ++n) {
    turn[n % 2] += n % 4 < 2 ? term : -term;
    term *= angle / (n + 1);
  }
  const auto more = static_cast<int>(std::fmod(std::fmod(quarters, 4) + 4, 4));
  for (int quarter = 0; quarter < more; ++quarter) turn = Vec2d(-turn.y(), turn.x());
  return turn;
}

/// Clockwise on the screen, as y points down.
Vec2d turned(const Vec2d& v, const Vec2d& turn) {
  return {v.x() * turn.x() - v.y() * turn.y(), v.x() * turn.y() + v.y() * turn.x()};
}

/// How a tile is mirrored within its own rectangle; first the diagonal, then the others, as Tiled does.
class Flip {
 public:
  Flip(TileNumber number, const Vec2d& size)
      : number_(number), size_((number & flipped_diagonally) != 0 ? Vec2d{size.y(), size.x()} : size) {}
  [[nodiscard]] const Vec2d& size() const { return size_; }
  [[nodiscard]] Vec2d operator()(Vec2d p) const {
    if ((number_ & flipped_diagonally) != 0) std::swap(p.x(), p.y());
    if ((number_ & flipped_horizontally) != 0) p.x() = size_.x() - p.x();
    if ((number_ & flipped_vertically) != 0) p.y() = size_.y() - p.y();
    return p;
  }

 private:
  TileNumber number_;
  Vec2d size_;
};

std::vector<Vec2d> rectangle(const Vec2d& size) { return {{0, 0}, {size.x(), 0}, size, {0, size.y()}}; }

/// A rectangle whose corners are quarters of ellipses with these radii, clockwise on the screen from the top.
std::vector<Vec2d> rounded_rectangle(const Vec2d& size, const Vec2d& radii, const std::string& where) {
  constexpr int most = 256;
  int edges = 2;  // of a quarter
  while (edges <= most && radii.maxCoeff() * (1 - turn_by(45.0 / edges).x()) > straight_within) ++edges;
  if (edges > most) refuse(where, "expected a round object with radii of at most 26,000 px; use a polygon");
  std::vector<Vec2d> points;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const bool is_right = quarter < 2;
    const bool is_low = quarter == 1 || quarter == 2;
    const Vec2d centre{is_right ? size.x() - radii.x() : radii.x(), is_low ? size.y() - radii.y() : radii.y()};
    for (int k = 0; k <= edges; ++k) {
      const Vec2d point = centre + radii.cwiseProduct(turn_by(90.0 * (quarter - 1) + 90.0 * k / edges));
      if (points.empty() || points.back() != point) points.push_back(point);
    }
  }
  if (points.back() == points.front()) points.pop_back();
  return points;
}

/// An ellipse or a capsule relative to where it is, before it is rotated.
PixelShape round_shape(const TiledObject& object) {
  PixelShape shape{.closed = true, .points = {}, .where = object.where, .drawn_as = object.shape};
  if (!(object.size.minCoeff() > 0)) return shape;
  const Vec2d half = object.size / 2;
  if (half.x() == half.y()) {
    shape.radius = half.x();
    shape.points = {half};
  } else {
    const bool is_ellipse = object.shape == TiledObject::Shape::ellipse;
    const Vec2d radii = is_ellipse ? half : Vec2d::Constant(half.minCoeff());
    shape.points = rounded_rectangle(object.size, radii, object.where);
  }
  return shape;
}

/// A circle with straight edges, as an ellipse of these radii.
void straighten(PixelShape& circle, const Vec2d& radii) {
  const Vec2d centre = circle.points.front();
  circle.points = rounded_rectangle(2 * radii, radii, circle.where);
  for (Vec2d& point : circle.points) point += centre - radii;
  circle.radius = 0;
}

/// An object's own outline, relative to where it is; empty where it has none.
PixelShape outline(const TiledObject& object) {
  PixelShape shape{.closed = true, .points = {}, .where = object.where};
  switch (object.shape) {
    case TiledObject::Shape::ellipse:
    case TiledObject::Shape::capsule:
      shape = round_shape(object);
      break;
    case TiledObject::Shape::polygon:
      shape.points = object.points;
      break;
    case TiledObject::Shape::polyline:
      shape.closed = false;
      shape.points = object.points;
      break;
    case TiledObject::Shape::rectangle:
      if (object.size.minCoeff() > 0) shape.points = rectangle(object.size);
      break;
    case TiledObject::Shape::point:
    case TiledObject::Shape::text:
    case TiledObject::Shape::tile:
      break;
  }
  const Vec2d turn = turn_by(object.rotation);
  for (Vec2d& point : shape.points) point = turned(point, turn);
  return shape;
}

/// A tile's shapes relative to its upper left corner, flipped.
std::vector<PixelShape> shapes_of_tile(const TileInfo& info, const Flip& flip, const std::string& where) {
  if (!info.has_shapes()) return {{.closed = true, .points = rectangle(flip.size()), .where = where}};
  std::vector<PixelShape> shapes;
  for (const TiledObject& object : info.tile->shapes) {
    PixelShape shape = outline(object);
    if (shape.points.empty()) continue;
    for (Vec2d& point : shape.points) point = flip(object.at + point);
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

/// Where the point that a tile object's `at` names lies in the object, as fractions of its size.
Vec2d anchor(const std::string& alignment) {
  Vec2d at{0.5, 0.5};
  if (alignment.find("left") != std::string::npos || alignment.empty() || alignment == "unspecified") at.x() = 0;
  if (alignment.find("right") != std::string::npos) at.x() = 1;
  if (alignment.find("top") != std::string::npos) at.y() = 0;
  if (alignment.find("bottom") != std::string::npos || alignment.empty() || alignment == "unspecified") at.y() = 1;
  return at;
}

std::vector<PixelShape> shapes_of_tile_object(const TiledMap& map, const TiledObject& object) {
  const TileInfo info = find_tile(map, object.tile, object.where);
  const Flip flip(object.tile, info.size());
  if (!(object.size.minCoeff() > 0) || !(flip.size().minCoeff() > 0)) return {};
  const Vec2d scale = object.size.cwiseQuotient(flip.size());
  const Vec2d corner = -anchor(info.tileset->object_alignment).cwiseProduct(object.size);
  const Vec2d turn = turn_by(object.rotation);
  std::vector<PixelShape> shapes = shapes_of_tile(info, flip, object.where);
  for (PixelShape& shape : shapes) {
    for (Vec2d& point : shape.points) point = corner + point.cwiseProduct(scale);
    if (shape.radius > 0 && scale.x() != scale.y()) straighten(shape, shape.radius * scale);
    shape.radius *= scale.x();
    for (Vec2d& point : shape.points) point = turned(point, turn);
  }
  return shapes;
}

}  // namespace

TileInfo find_tile(const TiledMap& map, TileNumber number, const std::string& where) {
  const TileNumber plain = number & tile_number_mask;
  const auto after = std::upper_bound(map.tilesets.begin(), map.tilesets.end(), plain,
                                      [](TileNumber value, const TiledTileset& set) { return value < set.first; });
  const std::string expected = fmt::format("expected a tile of one of the tilesets; {} belongs to none", plain);
  if (after == map.tilesets.begin()) refuse(where, expected);
  const TiledTileset& set = *std::prev(after);
  const auto tile = set.tiles.find(plain - set.first);
  if (tile != set.tiles.end()) return {&set, &tile->second};
  if (set.tile_count > 0 && plain - set.first >= static_cast<TileNumber>(set.tile_count)) refuse(where, expected);
  return {&set, nullptr};
}

std::vector<PixelShape> shapes_in_cell(const TiledMap& map, const TileInfo& info, TileNumber number, int column,
                                       int row, const Vec2d& offset, const std::string& where) {
  const Flip flip(number, info.size());
  // Whole tiles of the map's own size end up at (index * tile size + offset): the same bits from both neighbours.
  const Vec2d lower_left{column * map.tile_size.x(), (row + 1) * map.tile_size.y()};
  const Vec2d up{0, flip.size().y()};
  std::vector<PixelShape> shapes = shapes_of_tile(info, flip, where);
  for (PixelShape& shape : shapes) {
    for (Vec2d& point : shape.points) point = lower_left - up + point + info.tileset->tile_offset + offset;
  }
  return shapes;
}

std::vector<PixelShape> shapes_of_object(const TiledMap& map, const TiledObject& object, const Vec2d& offset) {
  std::vector<PixelShape> shapes;
  if (object.shape == TiledObject::Shape::tile) {
    shapes = shapes_of_tile_object(map, object);
  } else if (PixelShape shape = outline(object); !shape.points.empty()) {
    shapes.push_back(std::move(shape));
  }
  for (PixelShape& shape : shapes) {
    shape.where = object.where;
    for (Vec2d& point : shape.points) point = object.at + point + offset;
  }
  return shapes;
}

Vec2d upper_left(const TiledMap& map, const TiledObject& object, const Vec2d& offset) {
  if (object.shape != TiledObject::Shape::tile) return object.at + offset;
  const TileInfo info = find_tile(map, object.tile, object.where);
  return object.at + offset - anchor(info.tileset->object_alignment).cwiseProduct(object.size);
}

std::vector<PixelShape> upper_edges(PixelShape shape) {
  if (!shape.closed) return {shape};
  if (shape.radius > 0) straighten(shape, Vec2d::Constant(shape.radius));
  const std::size_t n = shape.points.size();
  double twice_area = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2d& a = shape.points[i];
    const Vec2d& b = shape.points[(i + 1) % n];
    twice_area += a.x() * b.y() - b.x() * a.y();
  }
  // Clockwise on the screen (positive with y down) an upper edge runs to the right.
  const auto faces_up = [&](std::size_t i) {
    return (shape.points[(i + 1) % n].x() - shape.points[i].x()) * twice_area > 0;
  };
  std::vector<PixelShape> runs;
  for (std::size_t i = 0; i < n; ++i) {
    if (!faces_up(i) || faces_up((i + n - 1) % n)) continue;  // only where a run begins
    PixelShape run{.closed = false, .points = {shape.points[i]}, .where = shape.where, .drawn_as = shape.drawn_as};
    for (std::size_t k = i; faces_up(k % n); ++k) run.points.push_back(shape.points[(k + 1) % n]);
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace paperproof::compare
