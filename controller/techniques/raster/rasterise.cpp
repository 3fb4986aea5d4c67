#include "techniques/raster/rasterise.hpp"

#include <paperproof/techniques.hpp>

#include <algorithm>

namespace paperproof::raster {
namespace {

/// The first whole number i with i + 1/2 at or beyond a coordinate: the first pixel whose middle is.
std::int64_t first_middle(double coordinate) noexcept { return ceil_to_pixel(coordinate - 0.5); }

/// An edge of an outline, from its lower end up [px].
class Edge {
 public:
  Edge(const Vec2d& a, const Vec2d& b) noexcept : low_(a.y() <= b.y() ? a : b), high_(a.y() <= b.y() ? b : a) {}

  /// The rows whose middle line it crosses: half open, and none where it is level.
  [[nodiscard]] std::int64_t first_row() const noexcept { return first_middle(low_.y()); }
  [[nodiscard]] std::int64_t end_row() const noexcept { return first_middle(high_.y()); }
  [[nodiscard]] bool crosses(std::int64_t row) const noexcept {
    const double middle = static_cast<double>(row) + 0.5;
    return low_.y() <= middle && middle < high_.y();
  }
  /// For rows that it crosses.
  [[nodiscard]] double slope() const noexcept { return (high_.x() - low_.x()) / (high_.y() - low_.y()); }
  /// The first pixel of a row that is to the right of the edge.
  [[nodiscard]] std::int64_t first_right(std::int64_t row, double slope) const noexcept {
    return first_middle(low_.x() + (static_cast<double>(row) + 0.5 - low_.y()) * slope);
  }

 private:
  Vec2d low_;
  Vec2d high_;
};

/// A segment of a chain as a line one pixel wide [px].
class Line {
 public:
  Line(const Vec2d& a, const Vec2d& b) noexcept : ends_{a, b} {
    const Vec2d along = (b - a).cwiseAbs();
    major_ = along.x() >= along.y() ? 0 : 1;
    if (ends_[1][major_] < ends_[0][major_]) std::swap(ends_[0], ends_[1]);
  }

  [[nodiscard]] std::int64_t first() const noexcept { return floor_to_pixel(ends_[0][major_]); }
  [[nodiscard]] std::int64_t last() const noexcept { return floor_to_pixel(ends_[1][major_]); }
  /// The pixel of a column (or row) from `first` to `last`.
  [[nodiscard]] Pixel at(std::int64_t i) const noexcept {
    const Eigen::Index minor = 1 - major_;
    const double length = ends_[1][major_] - ends_[0][major_];
    const double middle = std::clamp(static_cast<double>(i) + 0.5, ends_[0][major_], ends_[1][major_]);
    const double share = length > 0 ? (middle - ends_[0][major_]) / length : 0;
    const std::int64_t across = floor_to_pixel(ends_[0][minor] + share * (ends_[1][minor] - ends_[0][minor]));
    return major_ == 0 ? Pixel{i, across} : Pixel{across, i};
  }
  /// Without the pixels of the ends two segments could meet at a joint and leave a gap.
  [[nodiscard]] Pixel end(std::size_t i) const noexcept {
    return {floor_to_pixel(ends_[i].x()), floor_to_pixel(ends_[i].y())};
  }
  [[nodiscard]] bool covers(const Pixel& pixel) const noexcept {
    if (pixel == end(0) || pixel == end(1)) return true;
    const std::int64_t i = major_ == 0 ? pixel.x : pixel.y;
    return i >= first() && i <= last() && at(i) == pixel;
  }

 private:
  std::array<Vec2d, 2> ends_;
  Eigen::Index major_ = 0;
};

/// Where an outline enters or leaves a row.
struct Crossing {
  std::int64_t row;
  std::int64_t pixel;

  friend bool operator<(const Crossing& a, const Crossing& b) noexcept {
    return a.row != b.row ? a.row < b.row : a.pixel < b.pixel;
  }
};

void add_crossings(std::span<const Vec2d> ring, double pixels_per_metre, std::vector<Crossing>& crossings) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Edge edge(ring[i] * pixels_per_metre, ring[(i + 1) % ring.size()] * pixels_per_metre);
    const std::int64_t end = edge.end_row();
    std::int64_t row = edge.first_row();
    if (row >= end) continue;
    for (const double slope = edge.slope(); row < end; ++row) crossings.push_back({row, edge.first_right(row, slope)});
  }
}

void add_polygon(const ColliderDef& polygon, double pixels_per_metre, std::vector<Span>& spans) {
  std::vector<Crossing> crossings;
  add_crossings(polygon.points, pixels_per_metre, crossings);
  for (const std::vector<Vec2d>& hole : polygon.holes) add_crossings(hole, pixels_per_metre, crossings);
  std::sort(crossings.begin(), crossings.end());
  // A closed outline crosses a row an even number of times.
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i].pixel < crossings[i + 1].pixel) {
      spans.push_back({crossings[i].row, crossings[i].pixel, crossings[i + 1].pixel});
    }
  }
}

void add_chain(const ColliderDef& chain, double pixels_per_metre, std::vector<Span>& spans) {
  const auto add = [&spans](const Pixel& pixel) { spans.push_back({pixel.y, pixel.x, pixel.x + 1}); };
  for (std::size_t i = 1; i < chain.points.size(); ++i) {
    const Line line(chain.points[i - 1] * pixels_per_metre, chain.points[i] * pixels_per_metre);
    add(line.end(0));
    for (std::int64_t at = line.first(); at <= line.last(); ++at) add(line.at(at));
    add(line.end(1));
  }
}

}  // namespace

void spans_of(const ColliderDef& collider, double pixels_per_metre, std::vector<Span>& spans) {
  spans.clear();
  if (collider.one_way)
    throw NotExpressible("a picture cannot express a one-way chain: a pixel is solid from all sides");
  if (collider.shape == ColliderDef::Shape::polygon) return add_polygon(collider, pixels_per_metre, spans);
  add_chain(collider, pixels_per_metre, spans);
}

PixelBox pixels_around(const SceneryDef& scenery, double pixels_per_metre) {
  const std::vector<ColliderIndex> solids = standing_solids(scenery);
  if (solids.empty()) return {};
  const Vec2d& any = scenery.colliders[solids.front()].points.front();
  Box2 box{any, any};
  for (const ColliderIndex solid : solids) {
    for (const Vec2d& point : scenery.colliders[solid].points) box = box.with(point);
  }
  const Pixel lower{floor_to_pixel(box.lower.x() * pixels_per_metre), floor_to_pixel(box.lower.y() * pixels_per_metre)};
  const Pixel upper{floor_to_pixel(box.upper.x() * pixels_per_metre), floor_to_pixel(box.upper.y() * pixels_per_metre)};
  return {lower, upper.x - lower.x + 1, upper.y - lower.y + 1};
}

bool covers(std::span<const Vec2d> outline, double pixels_per_metre, const Pixel& pixel) noexcept {
  const auto vertex = [&](std::size_t i) -> Vec2d { return outline[i % outline.size()] * pixels_per_metre; };
  if (outline.size() == 2) return Line(vertex(0), vertex(1)).covers(pixel);
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge edge(vertex(i), vertex(i + 1));
    if (edge.crosses(pixel.y) && edge.first_right(pixel.y, edge.slope()) <= pixel.x) inside = !inside;
  }
  return inside;
}

}  // namespace paperproof::raster
