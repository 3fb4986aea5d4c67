#include "oracle/first_meeting.hpp"

#include "oracle/predicates.hpp"

#include <optional>

namespace paperproof::compare::detail {
namespace {

/// A span of time is halved at most so often.
constexpr int most_halvings = 45;
/// Spans of one stretch that are looked at before what is left is called undecided.
constexpr int most_spans = 4096;

/// So often only lines through neighbouring vertices are tried.
constexpr int halvings_of_neighbours = 12;

/// A time in which the octagon and all vertices go straight and evenly, or a leap of the octagon in no time.
struct Stretch {
  const PathPoint* leg_from;
  const PathPoint* leg_to;
  double instant_from;  ///< Of the two between which the vertices go.
  double instant_to;
  const std::vector<Vec2d>* vertices_from;
  const std::vector<Vec2d>* vertices_to;
  double begin;
  double end;

  [[nodiscard]] bool is_leap() const noexcept { return leg_from->fraction == leg_to->fraction; }
};

/// Calls `visit(stretch)` in order of time, until it returns true.
template <class Visit>
void for_stretches(std::span<const PathPoint> path, const VertexWay& way, const Visit& visit) {
  for (std::size_t leg = path.size() > 1 ? 1 : 0; leg < path.size(); ++leg) {
    const PathPoint& from = path[leg == 0 ? 0 : leg - 1];
    const PathPoint& to = path[leg];
    for (std::size_t k = 0; k + 1 < way.instants.size(); ++k) {
      const double begin = std::max(from.fraction, way.instants[k]);
      const double end = std::min(to.fraction, way.instants[k + 1]);
      const bool leap = from.fraction == to.fraction;
      if (leap ? begin > end : begin >= end) continue;
      if (visit(Stretch{&from, &to, way.instants[k], way.instants[k + 1], &way.vertices[k], &way.vertices[k + 1], begin,
                        end}))
        return;
      if (leap) break;
    }
  }
}

/// What the octagon sees, which stands still then: where the vertices are when a stretch begins and ends. All times the
/// lengths of the leg and of the time between the two instants, so that nothing is divided.
template <class Number>
struct View {
  std::vector<Point<Number>> corners;
  std::vector<Point<Number>> from;
  std::vector<Point<Number>> to;
  Number radius{};  ///< Of a disc.
};

template <class Number>
Point<Number> scaled(const Number& by, const Point<Number>& v) {
  return {by * v.x, by * v.y};
}

/// What the octagon may meet: see `first_meeting`.
struct Part {
  std::span<const std::size_t> vertices;
  double radius;
};

template <class Number>
View<Number> view_of(const Stretch& stretch, std::span<const Vec2d> octagon, const Part& part,
                     const Convert<Number>& place, const Convert<Number>& time) {
  const auto length = [&](double from, double to) { return from == to ? time(1) : time(to) - time(from); };
  const Number leg = length(stretch.leg_from->fraction, stretch.leg_to->fraction);
  const Number chord = length(stretch.instant_from, stretch.instant_to);
  // From one place to another, as far as `when` lies between their two times, times the length of that time.
  const auto between = [&](const Vec2d& a, const Vec2d& b, double begin, double when, const Number& all) {
    const Point<Number> first = convert(place, a);
    return scaled(all, first) + scaled(time(when) - time(begin), convert(place, b) - first);
  };
  const auto position = [&](bool end) {
    const PathPoint& a = *stretch.leg_from;
    const PathPoint& b = *stretch.leg_to;
    if (stretch.is_leap()) return scaled(chord, scaled(leg, convert(place, end ? b.position : a.position)));
    return scaled(chord, between(a.position, b.position, a.fraction, end ? stretch.end : stretch.begin, leg));
  };
  View<Number> view;
  for (const Vec2d& corner : octagon) view.corners.push_back(scaled(leg, scaled(chord, convert(place, corner))));
  const Point<Number> at_begin = position(false);
  const Point<Number> at_end = position(true);
  view.radius = leg * chord * place(part.radius);
  for (const std::size_t i : part.vertices) {
    const auto vertex = [&](double when) {
      return scaled(leg,
                    between((*stretch.vertices_from)[i], (*stretch.vertices_to)[i], stretch.instant_from, when, chord));
    };
    view.from.push_back(vertex(stretch.begin) - at_begin);
    view.to.push_back(vertex(stretch.end) - at_end);
  }
  return view;
}

/// The least of a product of an edge of the part with all corners, and with all vertices, at three control points of
/// its parabola: it lies within their hull (S. Bernstein 1912), and they are 0 or above only if it is. All are doubled.
template <class Number>
struct Parabola {
  Number begin;
  Number middle;
  Number end;

  friend Parabola operator+(const Parabola& a, const Parabola& b) {
    return {a.begin + b.begin, a.middle + b.middle, a.end + b.end};
  }
  friend Parabola least(const Parabola& a, const Parabola& b) {
    return {detail::least(a.begin, b.begin), detail::least(a.middle, b.middle), detail::least(a.end, b.end)};
  }
};

/// Of edge × v, while both go from the first to the second.
template <class Number>
Parabola<Number> product(const std::array<Point<Number>, 2>& edge, const std::array<Point<Number>, 2>& v) {
  const Number begin = cross(edge[0], v[0]);
  const Number end = cross(edge[1], v[1]);
  return {begin + begin, cross(edge[0], v[1]) + cross(edge[1], v[0]), end + end};
}

Answer is_not_negative(Sign sign) { return is_not(is(sign, Sign::negative)); }

template <class Number>
Answer is_zero(const Point<Number>& v) {
  return both(is(sign_of(v.x), Sign::zero), is(sign_of(v.y), Sign::zero));
}

/// The sharpest that can be said: a parabola that dips between two ends stays at 0 or above if its vertex does.
template <class Number>
Answer is_never_negative(const Parabola<Number>& p) {
  const Answer ends = both(is_not_negative(sign_of(p.begin)), is_not_negative(sign_of(p.end)));
  if (ends == Answer::no) return Answer::no;
  const Number vertex = p.begin * p.end - p.middle * p.middle;
  return both(ends, either(is_not_negative(sign_of(p.middle)), is_not_negative(sign_of(vertex))));
}

/// A span of a stretch: both ends as the octagon sees them. One moment, where both are the same.
template <class Number>
struct Span {
  std::vector<Point<Number>> corners;
  std::vector<Point<Number>> from;
  std::vector<Point<Number>> to;
  Number radius;
  bool is_disc;

  /// From first / 2^halvings of a stretch on, `length` of these parts long; all times 2^halvings.
  Span(const View<Number>& view, bool of_disc, std::int64_t first, std::int64_t length, int halvings)
      : is_disc(of_disc) {
    const Convert<Number> whole{0};
    const std::int64_t all = std::int64_t{1} << halvings;
    radius = whole(static_cast<double>(all)) * view.radius;
    const auto at = [&](std::size_t i, std::int64_t when) {
      return scaled(whole(static_cast<double>(all - when)), view.from[i]) +
             scaled(whole(static_cast<double>(when)), view.to[i]);
    };
    for (const Point<Number>& corner : view.corners) corners.push_back(scaled(whole(static_cast<double>(all)), corner));
    for (std::size_t i = 0; i < view.from.size(); ++i) {
      from.push_back(at(i, first));
      to.push_back(at(i, first + length));
    }
  }

  /// Whether an edge of the octagon separates the two: what is a line at one end and at the other is one in between.
  [[nodiscard]] Answer separated_by_side(std::size_t k) const {
    const Point<Number> side = corners[(k + 1) % corners.size()] - corners[k];
    Number nearest = -cross(side, from[0] - corners[k]);
    for (const auto* ends : {&from, &to})
      for (const Point<Number>& vertex : *ends) nearest = least(nearest, -cross(side, vertex - corners[k]));
    return is_not_negative(sign_of(nearest));
  }

  /// Whether the line from one vertex to another does, with the octagon on its right.
  [[nodiscard]] Answer separated_by_edge(std::size_t a, std::size_t b) const {
    const std::array<Point<Number>, 2> edge{from[b] - from[a], to[b] - to[a]};
    const Answer vanishes = both(is_zero(edge[0]), is_zero(edge[1]));
    if (vanishes == Answer::yes) return Answer::no;
    const auto of_vertex = [&](std::size_t j) { return product(edge, {from[j], to[j]}); };
    const auto of_corner = [&](std::size_t k) { return product(edge, {-corners[k], -corners[k]}); };
    Parabola<Number> vertex = of_vertex(0);
    Parabola<Number> corner = of_corner(0);
    for (std::size_t j = 1; j < from.size(); ++j) vertex = least(vertex, of_vertex(j));
    for (std::size_t k = 1; k < corners.size(); ++k) corner = least(corner, of_corner(k));
    const Parabola<Number> all = vertex + corner;
    Answer separated = both(is_not_negative(sign_of(all.begin)), is_not_negative(sign_of(all.end)));
    if (separated == Answer::no) return separated;
    if (const Answer flat = is_not_negative(sign_of(all.middle)); flat == Answer::no) {
      for (std::size_t j = 0; j < from.size() && separated != Answer::no; ++j)
        for (std::size_t k = 0; k < corners.size() && separated != Answer::no; ++k)
          separated = both(separated, is_never_negative(of_vertex(j) + of_corner(k)));
    } else {
      separated = both(separated, flat);
    }
    return separated == Answer::yes && vanishes == Answer::unknown ? Answer::unknown : separated;
  }

  /// Whether one line does. @param any_edge tries lines through any two vertices, too: rounded vertices of an edge
  ///   that is cut by others may leave the hull between two that are no neighbours.
  [[nodiscard]] Answer separated(bool any_edge) const {
    if (is_disc) return disc_is_apart();
    Answer found = Answer::no;
    for (std::size_t a = 0; a < from.size() && found != Answer::yes; ++a)
      found = either(found, separated_by_edge(a, (a + 1) % from.size()));
    for (std::size_t k = 0; k < corners.size() && found != Answer::yes; ++k)
      found = either(found, separated_by_side(k));
    for (std::size_t a = 0; any_edge && a < from.size(); ++a)
      for (std::size_t b = 0; b < from.size() && found != Answer::yes; ++b)
        if (a != b && b != (a + 1) % from.size()) found = either(found, separated_by_edge(a, b));
    return found;
  }

  /// The disc stands, and the octagon goes.
  [[nodiscard]] Answer disc_is_apart() const {
    Octagon<Number> octagon;
    for (const Point<Number>& corner : corners) octagon.corners[octagon.size++] = corner;
    Hull<Number> hull;
    if (!sweep_hull(octagon, from[0] - to[0], hull)) return Answer::unknown;
    return is_not(disc_enters(hull, from[0], radius));
  }
};

/// The questions about one stretch.
class StretchSearch {
 public:
  StretchSearch(const Stretch& stretch, std::span<const Vec2d> octagon, const Part& part)
      : stretch_(stretch),
        octagon_(octagon),
        part_(part),
        quick_(view_of<Approximate>(stretch, octagon, part, {}, {})) {}

  [[nodiscard]] Meeting find(Asked asked) const {
    if (are_far_apart()) return {};
    if (stretch_.begin == stretch_.end && !stretch_.is_leap())
      return separated(0, 0, 0, true) ? Meeting{} : Meeting{Meeting::Kind::meets, stretch_.begin, stretch_.end};
    std::optional<Meeting> found;
    std::optional<double> unsure;
    if (part_.radius > 0 && asked == Asked::whether)
      return separated(0, 1, 0, true) ? Meeting{} : Meeting{Meeting::Kind::meets, stretch_.begin, stretch_.end};
    std::vector<Halves> open{{0, 0}};
    for (int spans = 0; !open.empty(); ++spans) {
      const Halves part = open.back();
      open.pop_back();
      if (separated(part.first, 1, part.halvings, part.halvings >= halvings_of_neighbours)) continue;
      if (part.halvings == most_halvings || spans == most_spans) {
        const double begin = when(part.first, part.halvings);
        unsure = std::min(unsure.value_or(begin), begin);
        if (spans == most_spans) break;
        continue;
      }
      const Halves early{2 * part.first, part.halvings + 1};
      const Halves late{early.first + 1, early.halvings};
      if (separated(late.first, 0, late.halvings, true)) {
        open.push_back(late);
        open.push_back(early);
        continue;
      }
      found = {Meeting::Kind::meets, 0, when(late.first, late.halvings)};
      if (asked == Asked::whether) break;
      open.assign(1, early);
    }
    if (found) found->low = std::min(unsure.value_or(found->high), found->high);
    if (!found && unsure) found = {Meeting::Kind::undecided, *unsure, stretch_.end};
    return found.value_or(Meeting{});
  }

 private:
  struct Halves {
    std::int64_t first;
    int halvings;
  };

  [[nodiscard]] double when(std::int64_t first, int halvings) const {
    return stretch_.begin + std::ldexp(static_cast<double>(first), -halvings) * (stretch_.end - stretch_.begin);
  }

  /// Boxes around all places of both, with more between them than rounding.
  [[nodiscard]] bool are_far_apart() const {
    const Box2 octagon = Box2::between(stretch_.leg_from->position, stretch_.leg_to->position) + Box2::around(octagon_);
    Box2 part = Box2::nowhere();
    for (const std::size_t i : part_.vertices)
      part = part.with((*stretch_.vertices_from)[i]).with((*stretch_.vertices_to)[i]);
    const double size = std::max(octagon.lower.cwiseAbs().maxCoeff(), octagon.upper.cwiseAbs().maxCoeff());
    return !part.overlaps(octagon.inflated(part_.radius + size * 0x1p-50 + std::numeric_limits<double>::min()));
  }

  [[nodiscard]] bool separated(std::int64_t first, std::int64_t length, int halvings, bool any_edge) const {
    const Answer quick = Span<Approximate>(quick_, part_.radius > 0, first, length, halvings).separated(any_edge);
    if (quick != Answer::unknown) return quick == Answer::yes;
    if (!exact_) exact_ = exactly();
    return Span<Integer>(*exact_, part_.radius > 0, first, length, halvings).separated(true) == Answer::yes;
  }

  [[nodiscard]] View<Integer> exactly() const {
    int place = std::min({lowest_bit(stretch_.leg_from->position), lowest_bit(stretch_.leg_to->position),
                          lowest_bit(part_.radius), lowest_bit_of(octagon_)});
    for (const std::size_t i : part_.vertices)
      place = std::min({place, lowest_bit((*stretch_.vertices_from)[i]), lowest_bit((*stretch_.vertices_to)[i])});
    int time = 0;  // the bit of 1
    for (const double t : {stretch_.leg_from->fraction, stretch_.leg_to->fraction, stretch_.instant_from,
                           stretch_.instant_to, stretch_.begin, stretch_.end})
      time = std::min(time, lowest_bit(t));
    return view_of<Integer>(stretch_, octagon_, part_, {place}, {time});
  }

  const Stretch& stretch_;
  std::span<const Vec2d> octagon_;
  const Part& part_;
  View<Approximate> quick_;
  mutable std::optional<View<Integer>> exact_;
};

}  // namespace

Meeting first_meeting(std::span<const Vec2d> octagon, std::span<const PathPoint> path, const VertexWay& way,
                      std::span<const std::size_t> part, Asked asked, double radius) {
  const Part whole{part, radius};
  Meeting first;
  for_stretches(path, way, [&](const Stretch& stretch) {
    const Meeting found = StretchSearch(stretch, octagon, whole).find(asked);
    if (found.kind == Meeting::Kind::apart) return false;
    const double low = first.kind == Meeting::Kind::apart ? found.low : first.low;
    first = {found.kind, low, found.high};
    return first.kind == Meeting::Kind::meets;
  });
  return first;
}

}  // namespace paperproof::compare::detail
