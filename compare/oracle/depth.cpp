#include "oracle/depth.hpp"

#include "oracle/doubled.hpp"

namespace paperproof::compare::detail {
namespace {

template <class Height>
auto least_of(std::span<const Vec2d> points, const Height& height) {
  auto lowest = height(points[0]);
  for (const Vec2d& point : points.subspan(1)) lowest = least(lowest, height(point));
  return lowest;
}

/// The exact product of the separation and the length of the edge: for its left normal n, n·x = edge × x.
template <class Number>
Number scaled_separation(const Convert<Number>& number, const AxisEdge& axis, std::span<const Vec2d> vertices,
                         std::span<const Vec2d> octagon, const FramePlace& place) {
  const Point<Number> from = place.in(number);
  const Point<Number> edge = convert(number, axis.end) - convert(number, axis.start);
  // The vertex that is farthest to the left is the one that is nearest to the octagon.
  return least_of(octagon, [&](const Vec2d& corner) { return cross(edge, convert(number, corner)); }) +
         least_of(vertices, [&](const Vec2d& vertex) { return -cross(edge, convert(number, vertex) - from); });
}

double length_of(const AxisEdge& axis) {
  const Vec2d edge = axis.end - axis.start;
  const double scale = edge.cwiseAbs().maxCoeff();
  const Vec2d unit = edge / scale;
  return scale * std::sqrt(unit.x() * unit.x() + unit.y() * unit.y());
}

double exact_separation(const AxisEdge& axis, const ConvexPart& part, std::span<const Vec2d> octagon,
                        const FramePlace& place) {
  constexpr double good_enough = 1e-13;  // relative; the length that it is divided by has a few ulp of its own
  const Doubled quick = scaled_separation(Convert<Doubled>{}, axis, part.points, octagon, place);
  if (quick.radius <= good_enough * std::abs(quick.value)) return quick.value / length_of(axis);
  const int unit = std::min({common_unit(part, octagon, place), lowest_bit(axis.start), lowest_bit(axis.end)});
  const Integer exact = scaled_separation(Convert<Integer>{unit}, axis, part.points, octagon, place);
  return to_double(exact, 2 * unit) / length_of(axis);
}

double estimate_of(const AxisEdge& axis, const ConvexPart& part, std::span<const Vec2d> octagon,
                   const Vec2d& position) {
  const Vec2d edge = (axis.end - axis.start) / length_of(axis);
  const auto along = [&](const Vec2d& v) { return edge.x() * v.y() - edge.y() * v.x(); };
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (const Vec2d& corner : octagon) nearest = std::min(nearest, along(corner));
  for (const Vec2d& vertex : part.points) farthest = std::max(farthest, along(Vec2d(vertex - position)));
  return nearest - farthest;
}

}  // namespace

std::vector<AxisEdge> axis_edges(const ConvexPart& part, std::span<const Vec2d> octagon) {
  std::vector<AxisEdge> axes;
  axes.reserve(part.points.size() + octagon.size());
  const std::size_t n = part.points.size();
  // The outward normal of a counter-clockwise edge is the left one of the edge reversed.
  for (std::size_t i = 0; i < n; ++i) axes.push_back({part.points[(i + 1) % n], part.points[i]});
  for (std::size_t k = 0; k < octagon.size(); ++k) axes.push_back({octagon[k], octagon[(k + 1) % octagon.size()]});
  return axes;
}

int common_unit(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& place) {
  return std::min({place.unit(), lowest_bit_of(octagon), lowest_bit_of(part.points)});
}

std::vector<Integer> scaled_separations(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& place,
                                        int unit) {
  std::vector<Integer> separations;
  for (const AxisEdge& axis : axis_edges(part, octagon)) {
    separations.push_back(scaled_separation(Convert<Integer>{unit}, axis, part.points, octagon, place));
  }
  return separations;
}

namespace {

/// The axes of a place with separations as far as doubles know them.
struct Estimates {
  std::vector<AxisEdge> axes;
  std::vector<double> separations;
  double best = -std::numeric_limits<double>::infinity();
  double window = 0;  ///< More than an estimate can be off: among movers the place itself is rounded [m].
};

Estimates estimate(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& place) {
  const Vec2d position = place.rounded();
  Estimates estimates{.axes = axis_edges(part, octagon), .separations = {}};
  estimates.separations.reserve(estimates.axes.size());
  double size = 0;
  for (const AxisEdge& axis : estimates.axes) {
    estimates.separations.push_back(estimate_of(axis, part, octagon, position));
    estimates.best = std::max(estimates.best, estimates.separations.back());
  }
  for (const Vec2d& vertex : part.points) size = std::max(size, (vertex - position).cwiseAbs().maxCoeff());
  for (const Vec2d& corner : octagon) size = std::max(size, corner.cwiseAbs().maxCoeff());
  estimates.window = size * 0x1p-46 + (place.moved() ? place.size() * 0x1p-48 : 0);
  return estimates;
}

Vec2d normal_of(const AxisEdge& axis) {
  const Vec2d edge = (axis.end - axis.start) / length_of(axis);
  return {-edge.y(), edge.x()};
}

/// The first of the largest.
Axis best_of(const Estimates& estimates, const ConvexPart& part, std::span<const Vec2d> octagon,
             const FramePlace& place) {
  Axis result{-std::numeric_limits<double>::infinity(), Vec2d::Zero()};
  for (std::size_t i = 0; i < estimates.axes.size(); ++i) {
    if (estimates.separations[i] < estimates.best - estimates.window) continue;
    const double separation = exact_separation(estimates.axes[i], part, octagon, place);
    if (separation > result.separation) result = {separation, normal_of(estimates.axes[i])};
  }
  return result;
}

using Long = Eigen::Matrix<long double, 2, 1>;

/// Exact, but for one rounding.
Long centre_seen_from(const FramePlace& place, const ConvexPart& disc) {
  const Convert<Integer> number{std::min(place.unit(), lowest_bit(disc.points.front()))};
  const Point<Integer> seen = convert(number, disc.points.front()) - place.in(number);
  const auto rounded = [&](const Integer& x) { return std::ldexp(static_cast<long double>(x), number.unit); };
  return {rounded(seen.x), rounded(seen.y)};
}

/// The octagon is nearest to the centre at a point of an edge; from inside the way out leads through the nearest line.
Axis axis_of_disc(const ConvexPart& disc, std::span<const Vec2d> octagon, const FramePlace& place) {
  const Long centre = centre_seen_from(place, disc);
  long double nearest = std::numeric_limits<long double>::infinity();
  long double shallowest = -nearest;  // of the lines, from inside
  Long away = Long::Zero();
  Long out = Long::Zero();
  for (std::size_t k = 0; k < octagon.size(); ++k) {
    const Long corner = octagon[k].cast<long double>();
    const Long edge = octagon[(k + 1) % octagon.size()].cast<long double>() - corner;
    const Long arm = centre - corner;
    const Long normal = Long(edge.y(), -edge.x()) / edge.norm();
    const long double height = normal.dot(arm);
    if (height > shallowest) {
      shallowest = height;
      out = -normal;
    }
    const long double share = edge.dot(arm) / edge.squaredNorm();
    const bool beside = share > 0 && share < 1 && height > 0;
    const Long gap = share <= 0 ? arm : Long(arm - edge);
    const long double distance = beside ? height : gap.norm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    away = beside ? Long(-normal) : distance > 0 ? Long(-gap / distance) : Long(-normal);
  }
  const long double radius = disc.radius;
  if (shallowest < 0) return {static_cast<double>(shallowest - radius), out.cast<double>()};
  return {static_cast<double>(nearest - radius), away.cast<double>()};
}

}  // namespace

Axis best_axis(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& place) {
  if (part.radius > 0) return axis_of_disc(part, octagon, place);
  return best_of(estimate(part, octagon, place), part, octagon, place);
}

std::vector<Axis> separating_axes(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& place,
                                  double within) {
  if (part.radius > 0) {
    const Axis axis = axis_of_disc(part, octagon, place);
    return axis.separation > within ? std::vector<Axis>{} : std::vector<Axis>{axis};
  }
  const Estimates estimates = estimate(part, octagon, place);
  if (estimates.best > within + estimates.window) return {};
  std::vector<Axis> apart;
  for (std::size_t i = 0; i < estimates.axes.size(); ++i) {
    if (estimates.separations[i] < -estimates.window) continue;
    const double separation = exact_separation(estimates.axes[i], part, octagon, place);
    if (separation >= 0) apart.push_back({separation, normal_of(estimates.axes[i])});
  }
  if (apart.empty()) apart.push_back(best_of(estimates, part, octagon, place));
  std::ranges::stable_sort(apart, [](const Axis& a, const Axis& b) { return a.separation > b.separation; });
  if (apart.front().separation > within) return {};
  return apart;
}

}  // namespace paperproof::compare::detail
