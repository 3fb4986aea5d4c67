#include "shapes.hpp"

#include "float_geometry.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_polygon_shape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

namespace paperproof::box2d {
namespace {

Vec2d right_of(const Vec2d& way) { return {way.y(), -way.x()}; }

}  // namespace

bool is_one_sided(const b2Shape& shape) {
  return shape.GetType() == b2Shape::e_chain ||
         (shape.GetType() == b2Shape::e_edge && static_cast<const b2EdgeShape&>(shape).m_oneSided);
}

std::optional<Vec2d> front_of(std::span<const Vec2d> chain) {
  const Vec2d front = right_of(chain.back() - chain.front()).normalized();
  const auto turns_away = [&](const Vec2d& from, const Vec2d& to) { return !(right_of(to - from).dot(front) > 0); };
  const bool any = std::adjacent_find(chain.begin(), chain.end(), turns_away) != chain.end();
  return any ? std::nullopt : std::optional(front);
}

bool is_in_front(std::span<const Vec2d> polygon, std::span<const Vec2d> chain, const Vec2d& front) {
  const Vec2d along = -right_of(front);  // the chain has its front on the right, and so goes this way
  const auto place = [&](const Vec2d& point) { return point.dot(along); };
  const auto height = [&](const Vec2d& point) { return point.dot(front); };
  const double least = place(std::ranges::min(polygon, {}, place));
  const double most = place(std::ranges::max(polygon, {}, place));
  const auto is_right_of = [](const Vec2d& from, const Vec2d& to, const Vec2d& point) {
    return right_of(to - from).dot(point - to) >= 0;
  };
  if (most < place(chain.front()) || least > place(chain.back())) {
    const Vec2d middle =
        std::accumulate(polygon.begin(), polygon.end(), Vec2d(0, 0)) / static_cast<double>(polygon.size());
    const std::size_t to = most < place(chain.front()) ? 1 : chain.size() - 1;
    return is_right_of(chain[to - 1], chain[to], middle);
  }
  const auto vertex_from = [&](double there) {
    return std::ranges::partition_point(chain, [&](const Vec2d& vertex) { return place(vertex) < there; });
  };
  const auto is_above = [&](const Vec2d& corner) {
    const auto next = vertex_from(place(corner));
    if (next == chain.end() || (next == chain.begin() && place(*next) > place(corner))) return true;
    const auto to = next == chain.begin() ? next + 1 : next;
    return is_right_of(*(to - 1), *to, corner);
  };
  const auto is_below = [&](const Vec2d& vertex) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2d& a = polygon[i];
      const Vec2d& b = polygon[(i + 1) % polygon.size()];
      const double from = std::min(place(a), place(b));
      const double to = std::max(place(a), place(b));
      if (place(vertex) < from || place(vertex) > to || from == to) continue;
      const double share = (place(vertex) - place(a)) / (place(b) - place(a));
      if (height(a) + share * (height(b) - height(a)) < height(vertex)) return false;
    }
    return true;
  };
  if (!std::all_of(polygon.begin(), polygon.end(), is_above)) return false;
  for (auto vertex = vertex_from(least); vertex != chain.end() && place(*vertex) <= most; ++vertex)
    if (!is_below(*vertex)) return false;
  return true;
}

b2PolygonShape character_polygon(std::span<const Vec2d> hull) {
  const std::size_t count = hull.size();
  if (count < 3 || count > b2_maxPolygonVertices) throw InvalidDefinition("Box2D takes characters of 3 to 8 corners");
  std::vector<b2Vec2> corners;
  for (const Vec2d& corner : hull) {
    corners.push_back(rounded(corner));
    if (!corners.back().IsValid())
      throw InvalidDefinition("a corner of the character is not finite in single precision");
  }
  double twice_area = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!(b2Distance(corners[i], corners[j]) > 0.505F * b2_linearSlop))
        throw InvalidDefinition("the character has corners nearer than 2.5 mm, which Box2D would weld");
    }
    const b2Vec2 along = corners[(i + 1) % count] - corners[i];
    const b2Vec2 onward = corners[(i + 2) % count] - corners[(i + 1) % count];
    if (!(b2Cross(along, onward) > 0))
      throw InvalidDefinition("the character is not strictly convex in single precision");
    twice_area += static_cast<double>(b2Cross(corners[i] - corners[0], along));
  }
  // Box2D asserts an area above 1.2e-7 m²; ten times that leaves room for its rounding.
  if (!(twice_area > 2e-6)) throw InvalidDefinition("the character is smaller than 1e-6 m²");

  b2PolygonShape shape;
  shape.Set(corners.data(), static_cast<int32>(count));
  if (static_cast<std::size_t>(shape.m_count) != count)
    throw InvalidDefinition("Box2D would drop a corner of the character");
  return shape;
}

ColliderDef polygon_around(const ColliderDef& circle) {
  constexpr int corners = 32;
  constexpr double half_angle = std::numbers::pi / corners;
  const double reach = circle.radius / std::cos(half_angle);
  ColliderDef polygon = circle;
  polygon.shape = ColliderDef::Shape::polygon;
  polygon.radius = 0;
  polygon.points.clear();
  for (int i = 0; i < corners; ++i) {
    const double angle = half_angle * (2 * i + 1);
    polygon.points.emplace_back(circle.points.front() + reach * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

std::span<const b2Vec2> points_of(const b2Shape& shape, std::array<b2Vec2, 2>& room) {
  switch (shape.GetType()) {
    case b2Shape::e_circle:
      room[0] = static_cast<const b2CircleShape&>(shape).m_p;
      return std::span(room).first(1);
    case b2Shape::e_edge: {
      const auto& edge = static_cast<const b2EdgeShape&>(shape);
      room = {edge.m_vertex1, edge.m_vertex2};
      return room;
    }
    case b2Shape::e_polygon: {
      const auto& polygon = static_cast<const b2PolygonShape&>(shape);
      return {polygon.m_vertices, static_cast<std::size_t>(polygon.m_count)};
    }
    case b2Shape::e_chain: {
      const auto& chain = static_cast<const b2ChainShape&>(shape);
      return {chain.m_vertices, static_cast<std::size_t>(chain.m_count)};
    }
    case b2Shape::e_typeCount:
      break;
  }
  throw InvalidDefinition("a fixture has a shape that Box2D 2.4 does not have");
}

ColliderDef collider_of(const b2Shape& shape, const b2Transform& transform) {
  ColliderDef def{.shape = ColliderDef::Shape::chain, .points = {}};
  std::array<b2Vec2, 2> room;
  for (const b2Vec2& point : points_of(shape, room)) def.points.push_back(widened(b2Mul(transform, point)));
  if (shape.GetType() == b2Shape::e_polygon) def.shape = ColliderDef::Shape::polygon;
  if (shape.GetType() != b2Shape::e_circle) return def;
  def.shape = ColliderDef::Shape::circle;
  def.radius = static_cast<double>(shape.m_radius);
  return def;
}

}  // namespace paperproof::box2d
