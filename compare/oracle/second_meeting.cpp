#include "oracle/first_meeting.hpp"

#include "oracle/predicates.hpp"

#include <numeric>
#include <stdexcept>

namespace paperproof::compare::detail {
namespace {

/// Binary places of a fraction in which a root is isolated, at most. A quadratic of coordinates and times of doubles
/// has some hundreds of bits where none is below 1e-30, and 9,000 in the worst case.
constexpr int most_bits = 1 << 16;
/// Binary places of the fraction that is told.
constexpr int told_bits = 60;

/// A goes evenly from one place to another, between two moments.
struct Leg {
  Vec2d from;
  Vec2d to;
  double begin;
  double end;
};

/// count / 2^bits.
struct Binary {
  Integer count{0};
  int bits = 0;

  [[nodiscard]] Integer at(int more) const { return count << (more - bits); }
  [[nodiscard]] double rounded() const { return ratio(count, Integer(1) << bits); }
};

int compare(const Binary& a, const Binary& b) {
  const int bits = std::max(a.bits, b.bits);
  return a.at(bits).compare(b.at(bits));
}

Binary middle(const Binary& a, const Binary& b) {
  const int bits = std::max(a.bits, b.bits);
  return {a.at(bits) + b.at(bits), bits + 1};
}

/// a t² + b t + c.
struct Quadratic {
  Integer a;
  Integer b;
  Integer c;

  [[nodiscard]] int sign_at(const Binary& t) const {
    return Integer((a * t.count + (b << t.bits)) * t.count + (c << (2 * t.bits))).sign();
  }
  [[nodiscard]] int slope_at(const Binary& t) const { return Integer(2 * a * t.count + (b << t.bits)).sign(); }
  /// Just after the time 0, and just before 1; 0 for the polynomial 0.
  [[nodiscard]] int first_sign() const { return c != 0 ? c.sign() : b != 0 ? b.sign() : a.sign(); }
  [[nodiscard]] int last_sign() const {
    const Integer value = a + b + c;
    if (value != 0) return value.sign();
    const Integer slope = 2 * a + b;
    return slope != 0 ? -slope.sign() : a.sign();
  }
};

/// A root at which the sign changes: between two binary fractions that are none, or on one.
struct Root {
  Quadratic of;
  Binary low;
  Binary high;
  int sign_before = 0;

  [[nodiscard]] bool is_exact() const { return compare(low, high) == 0; }
  [[nodiscard]] bool holds(const Binary& t) const { return compare(low, t) < 0 && compare(t, high) < 0; }

  void halve() {
    if (is_exact()) return;
    if (low.bits > most_bits) throw std::logic_error("two roots are too near to each other to be told apart");
    const Binary half = middle(low, high);
    const int sign = of.sign_at(half);
    if (sign == sign_before || sign == 0) low = half;
    if (sign != sign_before) high = half;
  }
};

Root root_at(int moment) { return {{}, {moment, 0}, {moment, 0}, 0}; }

/// Those between 0 and 1 at which the sign changes.
void add_roots(const Quadratic& q, std::vector<Root>& roots) {
  const int first = q.first_sign();
  const Binary begin{0, 0};
  const Binary end{1, 0};
  if (first != q.last_sign()) {
    roots.push_back({q, begin, end, first});
    return;
  }
  const bool dips = first * q.a.sign() > 0 && q.slope_at(begin) * first < 0 && q.slope_at(end) * first > 0;
  if (!dips || q.b * q.b <= 4 * q.a * q.c) return;
  Binary low = begin;
  Binary high = end;
  for (;;) {
    const Binary half = middle(low, high);
    if (q.sign_at(half) == -first) {
      roots.push_back({q, begin, half, first});
      roots.push_back({q, half, end, -first});
      return;
    }
    (q.slope_at(half) * first < 0 ? low : high) = half;
  }
}

/// Whether two roots that may be one are. The resultant of two quadratics vanishes where they share a root, and then
/// what is left when their squares cancel has it, too.
bool are_one(const Root& r, const Root& s) {
  if (r.is_exact() && s.is_exact()) return compare(r.low, s.low) == 0;
  if (r.is_exact()) return s.holds(r.low) && s.of.sign_at(r.low) == 0;
  if (s.is_exact()) return are_one(s, r);
  const Quadratic& p = r.of;
  const Quadratic& q = s.of;
  const Integer squares = p.a * q.b - q.a * p.b;
  const Integer ends = p.a * q.c - q.a * p.c;
  const Integer lines = p.b * q.c - q.b * p.c;
  const auto overlap = [&] { return compare(r.low, s.high) < 0 && compare(s.low, r.high) < 0; };
  if (squares == 0 && ends == 0 && lines == 0) return overlap();
  if (squares == 0 || ends * ends != squares * lines) return false;
  // Above zero where -ends / squares is later than a moment.
  const auto sign_from = [&](const Binary& t) {
    return Integer(squares.sign() * ((-ends << t.bits) - t.count * squares)).sign();
  };
  return sign_from(r.low) > 0 && sign_from(r.high) < 0 && sign_from(s.low) > 0 && sign_from(s.high) < 0;
}

/// Whether no moment that is no root lies between them, as far as they are isolated.
bool may_be_one(const Root& r, const Root& s) {
  const auto is_apart = [](const Root& a, const Root& b) {
    const int order = compare(a.high, b.low);
    return order < 0 || (order == 0 && !(a.is_exact() && b.is_exact()));
  };
  return !is_apart(r, s) && !is_apart(s, r);
}

/// Halves both until it is known which is earlier.
bool is_earlier(Root& r, Root& s) {
  if (may_be_one(r, s) && are_one(r, s)) return false;
  while (may_be_one(r, s)) {
    r.halve();
    s.halve();
  }
  return compare(r.high, s.low) <= 0;
}

/// A moment strictly between a root and a later one.
Binary between(Root& r, Root& s) {
  for (;;) {
    const int order = compare(r.high, s.low);
    if (order < 0) return middle(r.high, s.low);
    if (order == 0 && !r.is_exact() && !s.is_exact()) return r.high;
    r.halve();
    s.halve();
  }
}

/// Ascending, with the two ends of the time; comparing isolates them further.
std::vector<Root> in_order(std::vector<Root> roots) {
  std::vector<std::size_t> order(roots.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t i, std::size_t j) { return is_earlier(roots[i], roots[j]); });
  std::vector<Root> sorted{root_at(0)};
  for (const std::size_t i : order) sorted.push_back(std::move(roots[i]));
  sorted.push_back(root_at(1));
  return sorted;
}

/// A point that goes evenly from one place to another, as the octagon sees it.
struct Mover {
  Point<Integer> from;
  Point<Integer> to;

  [[nodiscard]] Point<Integer> way() const { return to - from; }
  [[nodiscard]] Point<Integer> at(const Binary& t) const {
    const Integer left = (Integer(1) << t.bits) - t.count;
    return {left * from.x + t.count * to.x, left * from.y + t.count * to.y};
  }
  friend Mover operator-(const Mover& a, const Mover& b) { return {a.from - b.from, a.to - b.to}; }
  friend Mover operator-(const Mover& a, const Point<Integer>& b) { return {a.from - b, a.to - b}; }
};

Quadratic cross(const Mover& u, const Mover& v) {
  return {cross(u.way(), v.way()), cross(u.from, v.way()) + cross(u.way(), v.from), cross(u.from, v.from)};
}
Quadratic cross(const Point<Integer>& u, const Mover& v) { return {0, cross(u, v.way()), cross(u, v.from)}; }
Quadratic dot(const Point<Integer>& u, const Mover& v) { return {0, dot(u, v.way()), dot(u, v.from)}; }
Quadratic dot(const Mover& u, const Mover& v) {
  return {dot(u.way(), v.way()), dot(u.from, v.way()) + dot(u.way(), v.from), dot(u.from, v.from)};
}
/// The square of one without its own square.
Quadratic squared(const Quadratic& line) { return {line.b * line.b, 2 * line.b * line.c, line.c * line.c}; }
Quadratic operator-(Quadratic q, const Integer& constant) {
  q.c -= constant;
  return q;
}

/// While both go straight and evenly. The octagon stands; all lengths are in one unit.
struct Scene {
  std::vector<Point<Integer>> corners;  ///< Counter-clockwise.
  std::vector<Mover> vertices;
  Integer radius;  ///< Of a disc.

  [[nodiscard]] Point<Integer> side(std::size_t k) const { return corners[(k + 1) % corners.size()] - corners[k]; }

  /// All polynomials whose signs tell whether the two overlap.
  [[nodiscard]] std::vector<Root> roots() const {
    std::vector<Root> all;
    if (radius > 0) {
      add_roots_of_disc(all);
      return all;
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      for (std::size_t k = 0; k < corners.size(); ++k) add_roots(cross(side(k), vertices[i] - corners[k]), all);
      for (std::size_t j = 0; j < i; ++j)
        for (const Point<Integer>& corner : corners)
          add_roots(cross(vertices[i] - vertices[j], vertices[j] - corner), all);
    }
    return all;
  }

  void add_roots_of_disc(std::vector<Root>& all) const {
    const Integer square = radius * radius;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Mover arm = vertices.front() - corners[k];
      const Integer length = dot(side(k), side(k));
      add_roots(dot(arm, arm) - square, all);
      add_roots(dot(side(k), arm), all);
      add_roots(dot(side(k), arm) - length, all);
      add_roots(cross(side(k), arm), all);
      add_roots(squared(cross(side(k), arm)) - square * length, all);
    }
  }

  /// Whether they overlap at one moment.
  [[nodiscard]] bool overlaps_at(const Binary& t) const {
    Scene there = *this;
    const Integer scale = Integer(1) << t.bits;
    for (Point<Integer>& corner : there.corners) corner = {scale * corner.x, scale * corner.y};
    there.radius = scale * radius;
    std::vector<Point<Integer>> points;
    for (const Mover& vertex : vertices) points.push_back(vertex.at(t));
    return radius > 0 ? there.disc_overlaps(points.front()) : there.hull_overlaps(points);
  }

  [[nodiscard]] bool hull_overlaps(const std::vector<Point<Integer>>& points) const {
    Hull<Integer> octagon;
    Point<Integer> centre{0, 0};  // times the number of corners
    for (std::size_t k = 0; k < corners.size(); ++k) {
      octagon.push(corners[k], side(k));
      centre = centre + corners[k];
    }
    const auto many = static_cast<std::int64_t>(corners.size());
    const auto is_right = [&](const Point<Integer>& a, const Point<Integer>& b) {
      return cross(b - a, centre - Point<Integer>{many * a.x, many * a.y}).sign();
    };
    for (std::size_t i = 1; i < points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (segment_enters(octagon, points[j], points[i]) == Answer::yes) return true;
        const int one = is_right(points[0], points[j]);
        const int two = is_right(points[j], points[i]);
        const int three = is_right(points[i], points[0]);
        if (one != 0 && one == two && one == three) return true;
      }
    return false;
  }

  [[nodiscard]] bool disc_overlaps(const Point<Integer>& middle) const {
    bool is_inside = true;
    const Integer square = radius * radius;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Point<Integer> along = side(k);
      const Point<Integer> arm = middle - corners[k];
      const Integer length = dot(along, along);
      const Integer share = dot(along, arm);
      const Integer aside = cross(along, arm);
      const Point<Integer> from_end = arm - along;
      if (aside < 0) is_inside = false;
      const bool near = share <= 0        ? dot(arm, arm) < square
                        : share >= length ? dot(from_end, from_end) < square
                                          : aside * aside < square * length;
      if (near) return true;
    }
    return is_inside;
  }
};

/// What the octagon may meet.
struct PartWay {
  const VertexWay& way;
  std::span<const std::size_t> vertices;
  double radius;
};

/// From one moment to another, while the octagon goes one leg, and the part one chord of its way.
class StraightTime {
 public:
  StraightTime(std::span<const Vec2d> octagon, const PartWay& part, const Leg& leg, std::size_t chord, double begin,
               double end)
      : octagon_(octagon), part_(part), leg_(leg), chord_(chord), begin_(begin), end_(end) {}

  [[nodiscard]] Meeting meeting() const {
    if (are_far_apart()) return {};
    const Scene scene = exactly();
    if (begin_ == end_ && leg_.begin < leg_.end)
      return scene.overlaps_at({0, 0}) ? Meeting{Meeting::Kind::meets, begin_, begin_} : Meeting{};
    std::vector<Root> roots = in_order(scene.roots());
    for (std::size_t i = 0; i + 1 < roots.size(); ++i) {
      if (may_be_one(roots[i], roots[i + 1]) && are_one(roots[i], roots[i + 1])) continue;
      Binary then = between(roots[i], roots[i + 1]);
      if (!scene.overlaps_at(then)) continue;
      while (!roots[i].is_exact() && roots[i].low.bits < told_bits) roots[i].halve();
      for (int halvings = 0; halvings < told_bits && compare(roots[i].high, then) < 0; ++halvings)
        then = middle(roots[i].high, then);
      return {Meeting::Kind::meets, when(roots[i].low), when(then)};
    }
    return {};
  }

 private:
  [[nodiscard]] double when(const Binary& share) const { return begin_ + share.rounded() * (end_ - begin_); }

  /// Boxes around all places of both, with more between them than rounding.
  [[nodiscard]] bool are_far_apart() const {
    const Box2 body = Box2::between(leg_.from, leg_.to) + Box2::around(octagon_);
    const double rounding = std::max(body.lower.cwiseAbs().maxCoeff(), body.upper.cwiseAbs().maxCoeff()) * 0x1p-48;
    Box2 around = Box2::nowhere();
    for (const std::size_t k : {chord_, chord_ + 1})
      for (const std::size_t i : part_.vertices) around = around.with(part_.way.vertices[k][i]);
    return !around.overlaps(body.inflated(part_.radius + rounding + std::numeric_limits<double>::min()));
  }

  /// All lengths times the time of the leg and that of the chord, so that nothing is divided.
  [[nodiscard]] Scene exactly() const {
    const VertexWay& way = part_.way;
    const std::array<double, 2> chord{way.instants[chord_], way.instants[chord_ + 1]};
    int places =
        std::min({lowest_bit(leg_.from), lowest_bit(leg_.to), lowest_bit(part_.radius), lowest_bit_of(octagon_)});
    for (const std::size_t k : {chord_, chord_ + 1})
      for (const std::size_t i : part_.vertices) places = std::min(places, lowest_bit(way.vertices[k][i]));
    int times = 0;
    for (const double t : {leg_.begin, leg_.end, chord[0], chord[1], begin_, end_})
      times = std::min(times, lowest_bit(t));
    const Convert<Integer> place{places};
    const Convert<Integer> time{times};
    const Integer one = time(1);
    const bool leaps = leg_.begin == leg_.end;
    const Integer leg_time = leaps ? one : Integer(time(leg_.end) - time(leg_.begin));
    const Integer chord_time = time(chord[1]) - time(chord[0]);
    const auto weighted = [&](const Vec2d& a, const Integer& of_a, const Vec2d& b, const Integer& of_b) {
      const Point<Integer> first = convert(place, a);
      const Point<Integer> second = convert(place, b);
      return Point<Integer>{of_a * first.x + of_b * second.x, of_a * first.y + of_b * second.y};
    };
    const auto position = [&](double t, bool at_end) {
      Integer gone = time(t) - time(leg_.begin);
      if (leaps) gone = at_end ? one : Integer(0);
      return weighted(leg_.from, chord_time * (leg_time - gone), leg_.to, chord_time * gone);
    };
    const auto vertex = [&](std::size_t i, double t) {
      const Integer gone = time(t) - time(chord[0]);
      return weighted(way.vertices[chord_][i], leg_time * (chord_time - gone), way.vertices[chord_ + 1][i],
                      leg_time * gone);
    };
    Scene scene;
    for (const Vec2d& corner : octagon_) scene.corners.push_back(weighted(corner, leg_time * chord_time, corner, 0));
    for (const std::size_t i : part_.vertices)
      scene.vertices.push_back({vertex(i, begin_) - position(begin_, false), vertex(i, end_) - position(end_, true)});
    scene.radius = leg_time * chord_time * place(part_.radius);
    return scene;
  }

  std::span<const Vec2d> octagon_;
  const PartWay& part_;
  const Leg& leg_;
  std::size_t chord_;
  double begin_;
  double end_;
};

}  // namespace

Meeting second_meeting(std::span<const Vec2d> octagon, std::span<const PathPoint> path, const VertexWay& way,
                       std::span<const std::size_t> part, double radius) {
  const PartWay whole{way, part, radius};
  const std::size_t chords = way.instants.size() - 1;
  const auto chord_at = [&](double t) {
    std::size_t k = 0;
    while (k + 1 < chords && way.instants[k + 1] < t) ++k;
    return k;
  };
  if (path.size() == 1) {
    const double t = path[0].fraction;
    const Leg standing{path[0].position, path[0].position, t, t + 1};
    return StraightTime(octagon, whole, standing, chord_at(t), t, t).meeting();
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Leg leg{path[i - 1].position, path[i].position, path[i - 1].fraction, path[i].fraction};
    double begin = leg.begin;
    for (std::size_t chord = chord_at(begin); chord < chords; ++chord) {
      const double end = std::min(leg.end, way.instants[chord + 1]);
      if (begin < end || leg.begin == leg.end) {
        const Meeting found = StraightTime(octagon, whole, leg, chord, begin, end).meeting();
        if (found.kind != Meeting::Kind::apart) return found;
      }
      begin = end;
      if (end == leg.end) break;
    }
  }
  return {};
}

}  // namespace paperproof::compare::detail
