#include "geometry/rings.hpp"

#include <cstdio>
#include <string>

#include "geometry/exact.hpp"

namespace paperproof::geometry {
namespace {

std::string name_of(std::size_t ring) { return ring == 0 ? "the outline" : "hole " + std::to_string(ring - 1); }

/// "(1.5, 2)"
std::string text_of(const Vec2d& point) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "(%.9g, %.9g)", point.x(), point.y());
  return text.data();
}

struct Side {
  Vec2d from;
  Vec2d to;
  Box2 box;
  std::size_t ring;
  std::size_t index;
};

std::vector<Side> sides_by_left_end(std::span<const Ring> rings) {
  std::vector<Side> sides;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Vec2d& from = rings[r][i];
      const Vec2d& to = rings[r][(i + 1) % rings[r].size()];
      sides.push_back({from, to, Box2::between(from, to), r, i});
    }
  }
  std::ranges::stable_sort(sides, [](const Side& a, const Side& b) { return a.box.lower.x() < b.box.lower.x(); });
  return sides;
}

bool are_neighbours(const Side& a, const Side& b, std::span<const Ring> rings) {
  if (a.ring != b.ring) return false;
  const std::size_t size = rings[a.ring].size();
  return (a.index + 1) % size == b.index || (b.index + 1) % size == a.index;
}

enum class Meeting { none, touching, crossing };

/// How two sides with overlapping boxes meet.
Meeting meeting_of(const Side& a, const Side& b) {
  const int b_from = orientation_sign(a.from, a.to, b.from);
  const int b_to = orientation_sign(a.from, a.to, b.to);
  if (b_from * b_to > 0) return Meeting::none;
  const int a_from = orientation_sign(b.from, b.to, a.from);
  const int a_to = orientation_sign(b.from, b.to, a.to);
  if (a_from * a_to > 0) return Meeting::none;
  // Neither separates the other. On one line the overlap of the boxes is that of the sides.
  return b_from * b_to < 0 && a_from * a_to < 0 ? Meeting::crossing : Meeting::touching;
}

[[noreturn]] void refuse_meeting(const Side& a, const Side& b, Meeting meeting) {
  const std::string verb = meeting == Meeting::crossing ? " crosses " : " touches ";
  const std::string other = a.ring == b.ring ? "itself" : name_of(std::min(a.ring, b.ring));
  throw std::invalid_argument(name_of(std::max(a.ring, b.ring)) + verb + other + ": the side from " + text_of(a.from) +
                              " to " + text_of(a.to) + " meets the side from " + text_of(b.from) + " to " +
                              text_of(b.to));
}

void check_sides_apart(std::span<const Ring> rings) {
  const std::vector<Side> sides = sides_by_left_end(rings);
  std::vector<const Side*> open;  // Sides that may reach as far right as the one looked at.
  for (const Side& side : sides) {
    std::erase_if(open, [&](const Side* other) { return other->box.upper.x() < side.box.lower.x(); });
    for (const Side* other : open) {
      if (!side.box.overlaps(other->box) || are_neighbours(side, *other, rings)) continue;
      const Meeting meeting = meeting_of(*other, side);
      if (meeting != Meeting::none) refuse_meeting(*other, side, meeting);
    }
    open.push_back(&side);
  }
}

/// Counts the sides that a ray to the right crosses. `point` must not lie on the ring.
bool is_inside(const Vec2d& point, Ring ring) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d& from = ring[i];
    const Vec2d& to = ring[(i + 1) % ring.size()];
    if ((from.y() > point.y()) == (to.y() > point.y())) continue;
    const bool upwards = to.y() > from.y();
    if (upwards == (orientation_sign(from, to, point) > 0)) inside = !inside;
  }
  return inside;
}

/// The rings do not meet, so one vertex decides for its whole ring.
void check_nesting(std::span<const Ring> rings) {
  std::vector<Box2> boxes;
  for (const Ring ring : rings) boxes.push_back(Box2::around(ring));
  for (std::size_t hole = 1; hole < rings.size(); ++hole) {
    if (!is_inside(rings[hole][0], rings[0])) throw std::invalid_argument(name_of(hole) + " is not inside the outline");
    for (std::size_t other = 1; other < rings.size(); ++other) {
      if (other != hole && boxes[other].contains(boxes[hole]) && is_inside(rings[hole][0], rings[other])) {
        throw std::invalid_argument(name_of(hole) + " is inside " + name_of(other));
      }
    }
  }
}

}  // namespace

/// A convex outline turns to one side only and goes around once: it runs to the right once and to the left once.
bool is_convex(Ring ring) {
  const std::size_t size = ring.size();
  if (size < 3) return false;
  int turn = 0;
  int reversals = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Vec2d& a = ring[i];
    const Vec2d& b = ring[i + 1 < size ? i + 1 : i + 1 - size];
    const Vec2d& c = ring[i + 2 < size ? i + 2 : i + 2 - size];
    if (a == b) return false;
    const bool reversal = left_of(a, b) != left_of(b, c);
    const int sign = orientation_sign(a, b, c);
    if (sign == 0 ? reversal : sign == -turn) return false;
    if (sign != 0) turn = sign;
    if (reversal) ++reversals;
  }
  return turn != 0 && reversals == 2;
}

std::size_t leftmost(Ring ring) {
  return static_cast<std::size_t>(std::ranges::min_element(ring, left_of) - ring.begin());
}

int winding(Ring ring) {
  const std::size_t corner = leftmost(ring);
  const std::size_t size = ring.size();
  return orientation_sign(ring[(corner + size - 1) % size], ring[corner], ring[(corner + 1) % size]);
}

void check_neighbours(std::span<const Vec2d> points, bool is_closed, const std::string& name) {
  for (std::size_t i = 0; i + (is_closed ? 0 : 1) < points.size(); ++i) {
    const std::size_t next = (i + 1) % points.size();
    if (points[i] == points[next]) {
      throw std::invalid_argument(name + " has the same point twice in a row: points " + std::to_string(i) + " and " +
                                  std::to_string(next) + " (counted from 0) are both " + text_of(points[next]));
    }
  }
}

void check_ring(Ring ring, const std::string& name) {
  const std::size_t size = ring.size();
  if (size < 3) throw std::invalid_argument(name + " needs at least 3 points, it has " + std::to_string(size));
  check_neighbours(ring, true, name);
  bool has_area = false;
  const Vec2d* fold = nullptr;
  for (std::size_t i = 0; i < size; ++i) {
    const Vec2d& corner = ring[(i + 1) % size];
    const Vec2d& next = ring[(i + 2) % size];
    if (orientation_sign(ring[i], corner, next) != 0)
      has_area = true;
    else if (fold == nullptr && left_of(ring[i], corner) != left_of(corner, next))
      fold = &corner;
  }
  if (!has_area) throw std::invalid_argument(name + " has no area: all its points are on one line");
  if (fold != nullptr) throw std::invalid_argument(name + " folds back onto itself at " + text_of(*fold));
}

void check_rings(std::span<const Ring> rings) {
  check_sides_apart(rings);
  check_nesting(rings);
}

}  // namespace paperproof::geometry
