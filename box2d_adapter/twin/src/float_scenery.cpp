#include "float_scenery.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace paperproof::box2d {

b2Vec2 checked(const Vec2d& value, std::string_view what) {
  if (!(std::abs(value.x()) <= largest_number) || !(std::abs(value.y()) <= largest_number)) {
    throw InvalidDefinition(std::string(what) + " has a coordinate that is not finite or larger than 1e9");
  }
  return rounded(value);
}

SceneryDef rounded(const SceneryDef& scenery) {
  SceneryDef result = scenery;
  const auto round_all = [](std::vector<Vec2d>& points) {
    for (Vec2d& point : points) point = widened(rounded(point));
  };
  for (ColliderDef& collider : result.colliders) {
    round_all(collider.points);
    std::for_each(collider.holes.begin(), collider.holes.end(), round_all);
  }
  return result;
}

Ring without_repeats(std::span<const Vec2d> points, bool closed) {
  Ring ring;
  ring.reserve(points.size());
  for (const Vec2d& point : points) {
    const b2Vec2 vertex = rounded(point);
    if (ring.empty() || !(ring.back() == vertex)) ring.push_back(vertex);
  }
  while (closed && ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  return ring;
}

double twice_area(std::span<const b2Vec2> ring) noexcept {
  double sum = 0;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    const Vec2d a = widened(ring[i - 1]) - widened(ring[0]);
    const Vec2d b = widened(ring[i]) - widened(ring[0]);
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

double distance_to_segment(const Vec2d& point, const Vec2d& a, const Vec2d& b) noexcept {
  const Vec2d along = b - a;
  const Vec2d to_point = point - a;
  const double length_squared = along.squaredNorm();
  const double t = length_squared > 0 ? std::clamp(along.dot(to_point) / length_squared, 0.0, 1.0) : 0.0;
  const Vec2d offset = to_point - t * along;
  return std::sqrt(offset.squaredNorm());
}

}  // namespace paperproof::box2d
