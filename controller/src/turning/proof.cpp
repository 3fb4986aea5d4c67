#include "turning/proof.hpp"

#include "geometry/circle.hpp"
#include "geometry/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::turning {
namespace {

using geometry::cross;

/// Halvings of the time, until the proof has failed: after 2^17 parts at most.
constexpr int most_halvings = 16;

/// A vector that changes evenly.
struct Linear {
  Vec2d from;
  Vec2d to;

  [[nodiscard]] Vec2d at(double time) const { return from + (to - from) * time; }
  [[nodiscard]] Linear between(double begin, double end) const { return {at(begin), at(end)}; }
  friend Linear operator-(const Linear& a, const Linear& b) { return {a.from - b.from, a.to - b.to}; }
};

using Vertices = FixedVector<Linear, PieceWay::most_vertices>;

/// Character and piece during one part of the time. All places are relative to the character's first.
struct Scene {
  Vertices piece;
  std::span<const Vec2d> hull;
  Linear character;
  double margin;  ///< Least distance that counts as apart [m].
};

/// Whether a point stays on the right of a line through `at` along `edge`.
bool stays_right(const Linear& edge, const Linear& at, const Linear& point, double margin) {
  const Linear way = at - point;  // cross(edge, way) is positive where the point is on the right
  const double least = margin * std::max(edge.from.norm(), edge.to.norm());
  return cross(edge.from, way.from) > least && cross(edge.to, way.to) > least &&
         (cross(edge.from, way.to) + cross(edge.to, way.from)) / 2 > least;
}

bool some_line_separates(const Scene& scene, const Vertices& piece, const Linear& character) {
  const auto corner = [&](std::size_t i) {
    const Vec2d& o = scene.hull[i % scene.hull.size()];
    return Linear{character.from + o, character.to + o};
  };
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Linear edge = piece[(i + 1) % piece.size()] - piece[i];
    bool apart = true;
    for (std::size_t k = 0; apart && k < scene.hull.size(); ++k)
      apart = stays_right(edge, piece[i], corner(k), scene.margin);
    if (apart) return true;
  }
  for (std::size_t k = 0; k < scene.hull.size(); ++k) {
    const Linear edge = corner(k + 1) - corner(k);
    if (std::all_of(piece.begin(), piece.end(),
                    [&](const Linear& vertex) { return stays_right(edge, corner(k), vertex, scene.margin); }))
      return true;
  }
  return false;
}

bool stay_apart_between(const Scene& scene, double begin, double end, int halvings) {
  Vertices piece;
  for (const Linear& vertex : scene.piece) piece.push_back(vertex.between(begin, end));
  const Linear character = scene.character.between(begin, end);
  if (some_line_separates(scene, piece, character)) return true;
  if (halvings == most_halvings) return false;
  const double middle = (begin + end) / 2;
  for (Linear& vertex : piece) vertex.from = vertex.to = vertex.at(0.5);
  const Vec2d there = character.at(0.5);
  if (!some_line_separates(scene, piece, {there, there})) return false;
  return stay_apart_between(scene, begin, middle, halvings + 1) && stay_apart_between(scene, middle, end, halvings + 1);
}

bool circle_stays_apart(const HullWay& character, const PieceWay& piece, double least) {
  const Circle circle{piece.from[0] - character.from, piece.radius};
  const Vec2d way = (character.to - character.from) - (piece.to[0] - piece.from[0]);
  const auto is_apart_at = [&](const Vec2d& at) {
    return geometry::near_circle(character.hull, at, circle).separation > least;
  };
  return is_apart_at({0, 0}) && is_apart_at(way) && !geometry::approach(character.hull, {0, 0}, way, circle, least);
}

/// The point of a segment that is nearest to another point, as a share of the segment.
double nearest_share(const Vec2d& a, const Vec2d& b, const Vec2d& point) {
  const Vec2d along = b - a;
  const double square = along.squaredNorm();
  return square > 0 ? std::clamp((point - a).dot(along) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

bool stay_apart(const HullWay& character, const PieceWay& piece, double least) {
  const Vec2d origin = character.from;
  const Box2 shape = Box2::around(character.hull);
  const Box2 hull{character.from.cwiseMin(character.to) + shape.lower,
                  character.from.cwiseMax(character.to) + shape.upper};
  const Box2 whole = Box2::around(piece.from).merged(Box2::around(piece.to)).inflated(piece.radius);
  if (!hull.inflated(std::abs(least)).overlaps(whole)) return true;
  if (piece.radius > 0) return circle_stays_apart(character, piece, least);
  Scene scene{{}, character.hull, {{0, 0}, character.to - origin}, least};
  for (std::size_t i = 0; i < piece.from.size(); ++i)
    scene.piece.push_back({piece.from[i] - origin, piece.to[i] - origin});
  return stay_apart_between(scene, 0, 1, 0);
}

Approach nearest(std::span<const Vec2d> outline, bool closed, std::span<const Vec2d> hull, const Vec2d& position) {
  Approach best{std::numeric_limits<double>::infinity(), {0, 1}};
  double least_square = best.distance;
  const auto offer = [&](const Vec2d& a, const Vec2d& b, const Vec2d& point, double side) {
    const double share = nearest_share(a, b, point);
    const Vec2d away = point - (a + (b - a) * share);
    if (!(away.squaredNorm() < least_square)) return;
    const double distance = away.norm();
    if (!(distance < best.distance)) return;
    least_square = away.squaredNorm();
    // Of an edge the normal is known, however small the distance is.
    Vec2d normal = share > 0 && share < 1 ? Vec2d(b.y() - a.y(), a.x() - b.x()) : away;
    if (normal.dot(away) < 0) normal = -normal;
    const double length = normal.norm();
    best = {distance, length > 0 ? Vec2d(normal * (side / length)) : best.normal};
  };
  const std::size_t edges = closed ? outline.size() : outline.size() - 1;
  for (const Vec2d& o : hull)
    for (std::size_t i = 0; i < edges; ++i) offer(outline[i], outline[(i + 1) % outline.size()], position + o, 1);
  for (const Vec2d& vertex : outline)
    for (std::size_t k = 0; k < hull.size(); ++k)
      offer(position + hull[k], position + hull[(k + 1) % hull.size()], vertex, -1);
  return best;
}

std::optional<Vec2d> nearest_vertex(std::span<const Vec2d> outline, bool closed, const Vec2d& point) {
  double least = std::numeric_limits<double>::infinity();
  std::optional<Vec2d> vertex;
  const std::size_t edges = closed ? outline.size() : outline.size() - 1;
  for (std::size_t i = 0; i < edges; ++i) {
    const Vec2d& a = outline[i];
    const Vec2d& b = outline[(i + 1) % outline.size()];
    const double share = nearest_share(a, b, point);
    const double distance = (a + (b - a) * share - point).norm();
    if (!(distance < least)) continue;
    least = distance;
    vertex = share == 0 ? std::optional(a) : share == 1 ? std::optional(b) : std::nullopt;
  }
  return vertex;
}

}  // namespace paperproof::turning
