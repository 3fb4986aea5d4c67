#include "techniques/discrete/body.hpp"

#include <cmath>
#include <limits>

namespace paperproof::discrete {
namespace {

/// What an outline covers of an axis.
struct Extent {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  Extent(std::span<const Vec2d> outline, const Vec2d& at, const Vec2d& axis) noexcept {
    for (const Vec2d& vertex : outline) {
      const Vec2d point = at + vertex;
      const double along = axis.dot(point);
      lower = std::min(lower, along);
      upper = std::max(upper, along);
    }
  }
};

/// Where a body goes during the frame, seen from the base of another.
struct Course {
  Vec2d start;
  Vec2d movement;

  Course(const Body& seen, const MoverMotion& from) noexcept {
    const Vec2d shift = seen.base.from - from.from;
    start = seen.position + shift;
    movement = seen.movement + ((seen.base.to - from.to) - shift);
  }
  [[nodiscard]] Vec2d end() const noexcept { return start + movement; }
};

/// The right-hand normal of the edge that ends at vertex `i`; zero for an edge whose length is lost to underflow.
Vec2d outward_normal(std::span<const Vec2d> outline, std::size_t i) noexcept {
  const Vec2d edge = outline[i] - outline[i == 0 ? outline.size() - 1 : i - 1];
  const double length = std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
  if (!(length > 0)) return Vec2d::Zero();
  return {edge.y() / length, -edge.x() / length};
}

/// Calls `look(normal)` for each normal of either outline, turned so that it points from the second to the first.
template <class Look>
void for_each_axis(const Body& first, const Body& second, const Look& look) {
  for (std::size_t i = 0; i < second.outline.size(); ++i) look(outward_normal(second.outline, i));
  for (std::size_t i = 0; i < first.outline.size(); ++i) look(Vec2d(-outward_normal(first.outline, i)));
}

double separation_along(const Vec2d& normal, const Body& first, const Vec2d& first_at, const Body& second,
                        const Vec2d& second_at) noexcept {
  return Extent(first.outline, first_at, normal).lower - Extent(second.outline, second_at, normal).upper;
}

/// The axis that decides, while all of them are looked at.
class Decision {
 public:
  Decision(const Vec2d& relative, double touch) noexcept : relative_(relative), touch_(touch) {}

  /// @param depth of the overlap along the normal, at the end.
  void look(const Vec2d& normal, double depth) noexcept {
    if (depth < least_.depth) least_ = {.normal = normal, .depth = depth};
    const double approach = -relative_.dot(normal);
    if (!(approach > 0) || depth - approach > touch_) return;  // met earlier, not along this axis
    const double time = std::clamp(1 - depth / approach, 0.0, 1.0);
    if (met_ && time <= last_.time) return;
    met_ = true;
    last_ = {.time = time, .normal = normal, .depth = depth};
  }

  [[nodiscard]] const Impact& impact() const noexcept { return met_ ? last_ : least_; }
  [[nodiscard]] bool met() const noexcept { return met_; }

 private:
  Vec2d relative_;
  double touch_;
  bool met_ = false;
  Impact last_;
  Impact least_{.depth = std::numeric_limits<double>::infinity()};
};

/// In the middle of the faces, or of the corner and the face, that meet: where both are along the tangent at the time
/// of impact.
Vec2d meeting_point(const Impact& impact, const Body& first, const Body& second, const Course& of_second,
                    double touch) noexcept {
  const Vec2d tangent(-impact.normal.y(), impact.normal.x());
  const Vec2d relative = first.movement - of_second.movement;
  const Vec2d first_at = first.expected() - relative * (1 - impact.time);
  const Vec2d second_at = of_second.end();
  const double face_of_first = Extent(first.outline, first_at, impact.normal).lower;
  const double face = Extent(second.outline, second_at, impact.normal).upper;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  const auto narrow = [&](std::span<const Vec2d> outline, const Vec2d& at, double height) {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
    for (const Vec2d& vertex : outline) {
      const Vec2d point = at + vertex;
      if (std::abs(impact.normal.dot(point) - height) > touch) continue;
      from = std::min(from, tangent.dot(point));
      to = std::max(to, tangent.dot(point));
    }
    lower = std::max(lower, from);
    upper = std::min(upper, to);
  };
  narrow(first.outline, first_at, face_of_first);
  narrow(second.outline, second_at, face);
  return impact.normal * face + tangent * (lower + (upper - lower) / 2);
}

}  // namespace

std::optional<Impact> find_impact(const Body& first, const Body& second, double touch) noexcept {
  if (second.one_way && first.drops) return std::nullopt;
  const Course of_second(second, first.base);
  const Vec2d first_at = first.expected();
  const Vec2d second_at = of_second.end();
  const Vec2d relative = first.movement - of_second.movement;
  Decision decision(relative, touch);
  Decision through(relative, touch);  // a one-way segment, along its blocking normal
  bool apart = false;
  for_each_axis(first, second, [&](const Vec2d& normal) {
    if (apart || normal.isZero(0)) return;
    const double depth = -separation_along(normal, first, first_at, second, second_at);
    apart = !(depth > 0);
    decision.look(normal, depth);
  });
  if (apart) return std::nullopt;
  if (second.one_way) {
    // Its outline has two edges, there and back; the normal on the right of the way back is on the left of the segment.
    const Vec2d blocking = outward_normal(second.outline, 0);
    through.look(blocking, -separation_along(blocking, first, first_at, second, second_at));
    if (!through.met()) return std::nullopt;
  }
  Impact impact = second.one_way ? through.impact() : decision.impact();
  impact.point = meeting_point(impact, first, second, of_second, touch);
  return impact;
}

bool began_overlapping(const Body& first, const Body& second, double touch) noexcept {
  if (second.one_way) return false;
  const Vec2d second_at = Course(second, first.base).start;
  bool apart = false;
  for_each_axis(first, second, [&](const Vec2d& normal) {
    if (normal.isZero(0)) return;
    apart = apart || !(-separation_along(normal, first, first.position, second, second_at) > touch);
  });
  return !apart;
}

}  // namespace paperproof::discrete
