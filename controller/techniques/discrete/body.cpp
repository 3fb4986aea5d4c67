#include "techniques/discrete/body.hpp"

#include <cmath>
#include <limits>

namespace paperproof::discrete {
namespace {

/// What an outline covers of an axis.
template <class Scalar>
struct Extent {
  Scalar lower = std::numeric_limits<Scalar>::infinity();
  Scalar upper = -std::numeric_limits<Scalar>::infinity();

  Extent(std::span<const Vec2<Scalar>> outline, const Vec2<Scalar>& at, const Vec2<Scalar>& axis) noexcept {
    for (const Vec2<Scalar>& vertex : outline) {
      const Vec2<Scalar> point = at + vertex;
      const Scalar along = axis.dot(point);
      lower = std::min(lower, along);
      upper = std::max(upper, along);
    }
  }
};

/// Where a body goes during the frame, seen from the base of another.
template <class Scalar>
struct Course {
  Vec2<Scalar> start;
  Vec2<Scalar> movement;

  Course(const Body<Scalar>& seen, const MoverMotion<Scalar>& from) noexcept {
    const Vec2<Scalar> shift = seen.base.from - from.from;
    start = seen.position + shift;
    movement = seen.movement + ((seen.base.to - from.to) - shift);
  }
  [[nodiscard]] Vec2<Scalar> end() const noexcept { return start + movement; }
};

/// The right-hand normal of the edge that ends at vertex `i`; zero for an edge whose length is lost to underflow.
template <class Scalar>
Vec2<Scalar> outward_normal(std::span<const Vec2<Scalar>> outline, std::size_t i) noexcept {
  const Vec2<Scalar> edge = outline[i] - outline[i == 0 ? outline.size() - 1 : i - 1];
  const Scalar length = std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
  if (!(length > 0)) return Vec2<Scalar>::Zero();
  return {edge.y() / length, -edge.x() / length};
}

/// Calls `look(normal)` for each normal of either outline, turned so that it points from the second to the first.
template <class Scalar, class Look>
void for_each_axis(const Body<Scalar>& first, const Body<Scalar>& second, const Look& look) {
  for (std::size_t i = 0; i < second.outline.size(); ++i) look(outward_normal<Scalar>(second.outline, i));
  for (std::size_t i = 0; i < first.outline.size(); ++i) look(Vec2<Scalar>(-outward_normal<Scalar>(first.outline, i)));
}

template <class Scalar>
Scalar separation_along(const Vec2<Scalar>& normal, const Body<Scalar>& first, const Vec2<Scalar>& first_at,
                        const Body<Scalar>& second, const Vec2<Scalar>& second_at) noexcept {
  return Extent<Scalar>(first.outline, first_at, normal).lower -
         Extent<Scalar>(second.outline, second_at, normal).upper;
}

/// The axis that decides, while all of them are looked at.
template <class Scalar>
class Decision {
 public:
  Decision(const Vec2<Scalar>& relative, Scalar touch) noexcept : relative_(relative), touch_(touch) {}

  /// @param depth of the overlap along the normal, at the end.
  void look(const Vec2<Scalar>& normal, Scalar depth) noexcept {
    if (depth < least_.depth) least_ = {.normal = normal, .depth = depth};
    const Scalar approach = -relative_.dot(normal);
    if (!(approach > 0) || depth - approach > touch_) return;  // met earlier, not along this axis
    const Scalar time = std::clamp(1 - depth / approach, Scalar(0), Scalar(1));
    if (met_ && time <= last_.time) return;
    met_ = true;
    last_ = {.time = time, .normal = normal, .depth = depth};
  }

  [[nodiscard]] const Impact<Scalar>& impact() const noexcept { return met_ ? last_ : least_; }
  [[nodiscard]] bool met() const noexcept { return met_; }

 private:
  Vec2<Scalar> relative_;
  Scalar touch_;
  bool met_ = false;
  Impact<Scalar> last_;
  Impact<Scalar> least_{.depth = std::numeric_limits<Scalar>::infinity()};
};

/// In the middle of the faces, or of the corner and the face, that meet: where both are along the tangent at the time
/// of impact.
template <class Scalar>
Vec2<Scalar> meeting_point(const Impact<Scalar>& impact, const Body<Scalar>& first, const Body<Scalar>& second,
                           const Course<Scalar>& of_second, Scalar touch) noexcept {
  const Vec2<Scalar> tangent(-impact.normal.y(), impact.normal.x());
  const Vec2<Scalar> relative = first.movement - of_second.movement;
  const Vec2<Scalar> first_at = first.expected() - relative * (1 - impact.time);
  const Vec2<Scalar> second_at = of_second.end();
  const Scalar face_of_first = Extent<Scalar>(first.outline, first_at, impact.normal).lower;
  const Scalar face = Extent<Scalar>(second.outline, second_at, impact.normal).upper;
  Scalar lower = -std::numeric_limits<Scalar>::infinity();
  Scalar upper = std::numeric_limits<Scalar>::infinity();
  const auto narrow = [&](std::span<const Vec2<Scalar>> outline, const Vec2<Scalar>& at, Scalar height) {
    Scalar from = std::numeric_limits<Scalar>::infinity();
    Scalar to = -std::numeric_limits<Scalar>::infinity();
    for (const Vec2<Scalar>& vertex : outline) {
      const Vec2<Scalar> point = at + vertex;
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

template <class Scalar>
std::optional<Impact<Scalar>> find_impact(const Body<Scalar>& first, const Body<Scalar>& second,
                                          Scalar touch) noexcept {
  if (second.one_way && first.drops) return std::nullopt;
  const Course<Scalar> of_second(second, first.base);
  const Vec2<Scalar> first_at = first.expected();
  const Vec2<Scalar> second_at = of_second.end();
  const Vec2<Scalar> relative = first.movement - of_second.movement;
  Decision<Scalar> decision(relative, touch);
  Decision<Scalar> through(relative, touch);  // a one-way segment, along its blocking normal
  bool apart = false;
  for_each_axis(first, second, [&](const Vec2<Scalar>& normal) {
    if (apart || normal.isZero(0)) return;
    const Scalar depth = -separation_along(normal, first, first_at, second, second_at);
    apart = !(depth > 0);
    decision.look(normal, depth);
  });
  if (apart) return std::nullopt;
  if (second.one_way) {
    // Its outline has two edges, there and back; the normal on the right of the way back is on the left of the segment.
    const Vec2<Scalar> blocking = outward_normal<Scalar>(second.outline, 0);
    through.look(blocking, -separation_along(blocking, first, first_at, second, second_at));
    if (!through.met()) return std::nullopt;
  }
  Impact<Scalar> impact = second.one_way ? through.impact() : decision.impact();
  impact.point = meeting_point(impact, first, second, of_second, touch);
  return impact;
}

template <class Scalar>
bool began_overlapping(const Body<Scalar>& first, const Body<Scalar>& second, Scalar touch) noexcept {
  if (second.one_way) return false;
  const Vec2<Scalar> second_at = Course<Scalar>(second, first.base).start;
  bool apart = false;
  for_each_axis(first, second, [&](const Vec2<Scalar>& normal) {
    if (normal.isZero(0)) return;
    apart = apart || !(-separation_along(normal, first, first.position, second, second_at) > touch);
  });
  return !apart;
}

#define PAPERPROOF_INSTANTIATE(Scalar)                                                                           \
  template std::optional<Impact<Scalar>> find_impact(const Body<Scalar>&, const Body<Scalar>&, Scalar) noexcept; \
  template bool began_overlapping(const Body<Scalar>&, const Body<Scalar>&, Scalar) noexcept
PAPERPROOF_INSTANTIATE(float);
PAPERPROOF_INSTANTIATE(double);
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::discrete
