#include <paperproof/character.hpp>

#include <cmath>
#include <numbers>

#include "geometry/exact.hpp"
#include "geometry/vectors.hpp"

namespace paperproof {
namespace {

using Points = FixedVector<Vec2d, CharacterShape::max_points>;

std::string point_name(std::size_t index) { return "point " + std::to_string(index) + " of the character"; }

bool lower_then_left(const Vec2d& a, const Vec2d& b) { return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x(); }

void check_count(std::size_t count) {
  if (count < 3 || count > CharacterShape::max_points) {
    throw InvalidCharacter("a character has 3 to 8 points, this one has " + std::to_string(count));
  }
}

Points checked_points(std::span<const Vec2d> points) {
  check_count(points.size());
  Points checked;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!geometry::in_range(points[i]))
      throw InvalidCharacter(point_name(i) + " is not a finite length of at most 2e6 m");
    checked.push_back({geometry::without_traces(points[i].x()), geometry::without_traces(points[i].y())});
    for (std::size_t other = 0; other < i; ++other) {
      if (checked[other] == checked[i])
        throw InvalidCharacter(point_name(i) + " repeats point " + std::to_string(other));
    }
  }
  return checked;
}

/// Sorted by angle around the lowest point: if the points are the corners of a convex polygon, this is its outline.
Points outline_of(const Points& points) {
  Points hull = points;
  std::ranges::sort(hull, lower_then_left);
  const Vec2d lowest = hull[0];
  std::sort(hull.begin() + 1, hull.end(),
            [&](const Vec2d& a, const Vec2d& b) { return geometry::orientation_sign(lowest, a, b) > 0; });
  return hull;
}

/// A point inside the hull, or on a side of it, causes a turn that is not to the left: at this point or at its
/// neighbour.
void check_all_corners(const Points& hull) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2d& next = hull[(i + 1) % hull.size()];
    if (geometry::orientation_sign(hull[i], next, hull[(i + 2) % hull.size()]) <= 0) {
      throw InvalidCharacter("the points of a character must all be corners of their convex hull");
    }
  }
}

void require(bool holds, const char* name, const char* what) {
  if (!holds) throw InvalidCharacter(std::string(name) + " must be " + what);
}

void require_not_negative(double value, const char* name) {
  require(std::isfinite(value) && value >= 0, name, "a finite number, zero or more");
}

}  // namespace

CharacterShape CharacterShape::article(double pixels_per_metre) {
  const std::array<Vec2d, 8> points_px{Vec2d(5, 0),  Vec2d(15, 0), Vec2d(5, 40),  Vec2d(15, 40),
                                       Vec2d(0, 10), Vec2d(0, 30), Vec2d(20, 10), Vec2d(20, 30)};
  return from_pixels(points_px, pixels_per_metre);
}

CharacterShape CharacterShape::from_pixels(std::span<const Vec2d> points_px, double pixels_per_metre) {
  require(std::isfinite(pixels_per_metre) && pixels_per_metre > 0, "pixels_per_metre", "a finite number above zero");
  check_count(points_px.size());
  const Box2 sprite = Box2::around(points_px);
  const Vec2d centre = 0.5 * sprite.lower + 0.5 * sprite.upper;
  Points points;
  for (const Vec2d& at : points_px) {
    points.push_back({(at.x() - centre.x()) / pixels_per_metre, (centre.y() - at.y()) / pixels_per_metre});
  }
  return CharacterShape(std::span<const Vec2d>(points.begin(), points.end()));
}

CharacterShape::CharacterShape(std::span<const Vec2d> points)
    : points_(checked_points(points)), hull_(outline_of(points_)), box_(Box2::around(this->points())) {
  check_all_corners(hull_);
}

void CharacterDef::validate() const {
  require_not_negative(walk_speed, "walk_speed");
  require_not_negative(acceleration, "acceleration");
  if (air_acceleration) require_not_negative(*air_acceleration, "air_acceleration");
  require_not_negative(jump_speed, "jump_speed");
  require_not_negative(coyote_time, "coyote_time");
  if (jump_buffer) require_not_negative(*jump_buffer, "jump_buffer");
  require(jump_cut >= 0 && jump_cut <= 1, "jump_cut", "from 0 to 1");
  if (max_fall_speed) require_not_negative(*max_fall_speed, "max_fall_speed");
  require(max_climb_degrees >= 0 && max_climb_degrees <= 89, "max_climb_degrees", "from 0 to 89");
  require_not_negative(snap, "snap");
  require_not_negative(step_height, "step_height");
  require_not_negative(wall_reach, "wall_reach");
}

double CharacterDef::walkable_cosine(double climb) const noexcept {
  return std::cos(max_climb_degrees * std::numbers::pi / 180 + climb);
}

}  // namespace paperproof
