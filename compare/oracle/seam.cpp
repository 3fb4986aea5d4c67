#include "oracle/seam.hpp"

#include <algorithm>

namespace paperproof::compare::detail {
Seams::Seams(const World& world, const Group& own, const WayIn& way_in, const Integer& numerator,
             const Integer& denominator, const Box2& near)
    : world_(world) {
  const Way own_way = way_in(own);
  const double fraction = ratio(numerator, denominator);
  for (const Group& group : world.groups()) {
    if (group.sensor) continue;
    if (&group == &own) {
      neighbours_.push_back({.group = &group, .shift = {}});
      continue;
    }
    const Way way = way_in(group);
    const Vec2d shift = way.from.rounded() - own_way.from.rounded() +
                        fraction * (way.rounded_displacement() - own_way.rounded_displacement());
    const double rounding = (own_way.size() + way.size()) * 0x1p-48;
    if (!group.box.overlaps((near + shift).inflated(rounding))) continue;
    const Convert<Integer> number{std::min(own_way.unit(), way.unit())};
    const Point<Integer> start = way.from.in(number)-own_way.from.in(number);
    const Point<Integer> change = way.displacement(number) - own_way.displacement(number);
    neighbours_.push_back(
        {.group = &group,
         .same_frame = false,
         .unit = number.unit,
         .over = denominator,
         .shift = {start.x * denominator + change.x * numerator, start.y * denominator + change.y * numerator},
         .rounded_shift = shift,
         .rounding = rounding});
  }
}

Sign Seams::side(const Neighbour& neighbour, const Vec2d& start, const Vec2d& end, const Vec2d& from, const Vec2d& to) {
  if (neighbour.same_frame) return detail::side(start, end, from, to);
  const int unit = std::min({lowest_bit(start), lowest_bit(end), lowest_bit(from), lowest_bit(to), neighbour.unit});
  const Convert<Integer> number{unit};
  const Point<Integer> way = convert(number, to) - convert(number, from);
  const int finer = neighbour.unit - unit;
  const Point<Integer> seen{way.x * neighbour.over - (neighbour.shift.x << finer),
                            way.y * neighbour.over - (neighbour.shift.y << finer)};
  return sign_of(cross(convert(number, end) - convert(number, start), seen));
}

bool Seams::cover(const Edge& edge, const Vec2d& first, const Vec2d& last) const {
  const Vec2d along = (edge.b - edge.a) / (edge.b - edge.a).cwiseAbs().maxCoeff();
  const auto place = [&](const Vec2d& p) { return (p - edge.a).dot(along); };
  std::vector<std::pair<double, double>> covers;
  for (const Neighbour& neighbour : neighbours_) {
    const Vec2d& shift = neighbour.rounded_shift;
    const Box2 box = (Box2::between(first, last) + shift).inflated(neighbour.rounding);
    for (const std::uint32_t i : neighbour.group->edge_tree.meeting(box)) {
      const Edge& other = world_.edges()[i];
      if (other.collider == edge.collider || world_.solids()[other.collider].kind != Kind::polygon) continue;
      // Who lies on the same side, as a copy does, has the same outline there.
      if ((other.b - other.a).dot(along) > 0) continue;
      if (side(neighbour, edge.a, edge.b, edge.a, other.a) != Sign::zero) continue;
      if (side(neighbour, edge.a, edge.b, edge.a, other.b) != Sign::zero) continue;
      const double a = place(other.a - shift);
      const double b = place(other.b - shift);
      covers.emplace_back(std::min(a, b) - 2 * neighbour.rounding, std::max(a, b) + 2 * neighbour.rounding);
    }
  }
  std::ranges::sort(covers);
  double reached = std::min(place(first), place(last));
  const double end = std::max(place(first), place(last));
  bool begun = false;
  for (const auto& [from, to] : covers) {
    if (from > reached) break;
    begun = begun || to >= reached;
    reached = std::max(reached, to);
  }
  return begun && reached >= end;
}

bool Seams::pass(const Vec2d& vertex, std::uint32_t own, const Vec2d& start, const Vec2d& end) const {
  return std::ranges::any_of(neighbours_, [&](const Neighbour& neighbour) {
    const Vec2d there = vertex + neighbour.rounded_shift;
    const std::vector<std::uint32_t> edges =
        neighbour.group->edge_tree.meeting(Box2{there, there}.inflated(neighbour.rounding));
    return std::ranges::any_of(edges, [&](std::uint32_t i) {
      const Edge& other = world_.edges()[i];
      if (i == own) return false;
      // What may be let through passes no vertex but of its own surface, which is let through with it.
      const bool one_way = world_.solids()[other.collider].kind == Kind::one_way;
      if (one_way && other.surface != world_.edges()[own].surface) return false;
      if (side(neighbour, other.a, other.b, vertex, other.a) != Sign::zero) return false;
      return side(neighbour, start, end, vertex, other.a) == Sign::positive ||
             side(neighbour, start, end, vertex, other.b) == Sign::positive;
    });
  });
}

}  // namespace paperproof::compare::detail
