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
  [[nodiscard]] Linear operator-() const { return {-from, -to}; }
  friend Linear operator-(const Linear& a, const Linear& b) { return {a.from - b.from, a.to - b.to}; }
};

using Outline = FixedVector<Linear, PieceWay::most_vertices>;

/// Character and piece during one part of the time. All places are relative to the character's first.
struct Scene {
  Outline piece;
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

/// So far a piece may be beyond the line of one of its edges [m]. Rounding turns a corner inside out that is nearly
/// flat; the line of a short edge there has a part of the piece beyond it, and separates nothing. Zero: no edge of a
/// piece that has such a corner is believed. Large: an overlap is hidden (see `proved`).
constexpr double beyond_edge = 5e-11;

bool has_separating_edge(const Outline& one, const Outline& other, double margin) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Linear edge = one[(i + 1) % one.size()] - one[i];
    const auto is_right = [&](const Linear& point) { return stays_right(edge, one[i], point, margin); };
    const auto is_left = [&](const Linear& point) { return stays_right(-edge, one[i], point, -beyond_edge); };
    if (std::ranges::all_of(other, is_right) && std::ranges::all_of(one, is_left)) return true;
  }
  return false;
}

bool some_line_separates(const Scene& scene, const Outline& piece, const Linear& character) {
  Outline corners;
  for (const Vec2d& o : scene.hull) corners.push_back({character.from + o, character.to + o});
  return has_separating_edge(piece, corners, scene.margin) || has_separating_edge(corners, piece, scene.margin);
}

bool stay_apart_between(const Scene& scene, double begin, double end, int halvings) {
  Outline piece;
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

bool circle_stays_apart(const HullWay& character, const Linear& centre, double radius, double least) {
  const Circle circle{centre.from - character.from, radius};
  const Vec2d way = (character.to - character.from) - (centre.to - centre.from);
  const auto is_apart_at = [&](const Vec2d& at) {
    return geometry::near_circle(character.hull, at, circle).separation > least;
  };
  return is_apart_at({0, 0}) && is_apart_at(way) && !geometry::approach(character.hull, {0, 0}, way, circle, least);
}

/// So many edges an outline has.
std::size_t edges_of(std::span<const Vec2d> outline) { return outline.size() > 2 ? outline.size() : 1; }

/// The point of a segment that is nearest to another point, as a share of the segment.
double nearest_share(const Vec2d& a, const Vec2d& b, const Vec2d& point) {
  const Vec2d along = b - a;
  const double square = along.squaredNorm();
  return square > 0 ? std::clamp((point - a).dot(along) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

bool stay_apart(const HullWay& character, const PieceWay& piece, double least) {
  const Vec2d origin = character.from;
  const Box2 hull = Box2::between(origin, character.to) + Box2::around(character.hull);
  Scene scene{{}, character.hull, {{0, 0}, character.to - origin}, least};
  Box2 whole = Box2::nowhere();
  for (std::size_t i = 0; i < piece.from.size(); ++i) {
    const Vec2d from = between(piece.from[i], piece.to[i], piece.begin);
    const Vec2d to = between(piece.from[i], piece.to[i], piece.end);
    scene.piece.push_back({from, to});
    whole = whole.merged(Box2::between(from, to));
  }
  if (!hull.inflated(std::abs(least)).overlaps(whole.inflated(piece.radius))) return true;
  if (piece.radius > 0) return circle_stays_apart(character, scene.piece[0], piece.radius, least);
  for (Linear& vertex : scene.piece) vertex = vertex - Linear{origin, origin};
  return stay_apart_between(scene, 0, 1, 0);
}

Approach nearest(std::span<const Vec2d> outline, std::span<const Vec2d> hull, const Vec2d& position) {
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
  for (const Vec2d& o : hull)
    for (std::size_t i = 0; i < edges_of(outline); ++i)
      offer(outline[i], outline[(i + 1) % outline.size()], position + o, 1);
  for (const Vec2d& vertex : outline)
    for (std::size_t k = 0; k < hull.size(); ++k)
      offer(position + hull[k], position + hull[(k + 1) % hull.size()], vertex, -1);
  return best;
}

std::optional<Vec2d> nearest_vertex(std::span<const Vec2d> outline, const Vec2d& point) {
  double least = std::numeric_limits<double>::infinity();
  std::optional<Vec2d> vertex;
  for (std::size_t i = 0; i < edges_of(outline); ++i) {
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
