#include "oracle/impact.hpp"

#include <algorithm>

namespace paperproof::compare::detail {
namespace {

/// A corner of one body meets an edge of the other.
struct Event {
  std::uint32_t edge = 0;      ///< Of the world.
  std::uint8_t part = 0;       ///< The octagon's corner, or its edge.
  bool on_world_edge = false;  ///< The octagon's corner meets the world's edge; else one of its ends meets ours.
  bool at_b = false;           ///< Which end.
};

/// When an event happens: numerator / denominator, the denominator positive. `along` is the place on the edge that is
/// met, from 0 at its start to `denominator` at its end.
template <class Number>
struct Timing {
  Number numerator{};
  Number denominator{};
  Number along{};
  Answer happens = Answer::unknown;
};

/// The point `q`, moving by `way`, against the edge from `start` along `edge`.
template <class Number>
Timing<Number> meeting(const Point<Number>& start, const Point<Number>& edge, const Point<Number>& q,
                       const Point<Number>& way) {
  Timing<Number> timing;
  const Point<Number> gap = start - q;
  timing.numerator = cross(edge, gap);
  timing.denominator = cross(edge, way);
  timing.along = -cross(gap, way);
  const Sign sign = sign_of(timing.denominator);
  if (sign == Sign::zero) timing.happens = Answer::no;
  if (sign == Sign::zero || sign == Sign::unknown) return timing;
  if (sign == Sign::negative) {
    timing.numerator = -timing.numerator;
    timing.denominator = -timing.denominator;
    timing.along = -timing.along;
  }
  const Sign after_start = sign_of(timing.along);
  const Sign before_end = sign_of(timing.denominator - timing.along);
  if (after_start == Sign::negative || before_end == Sign::negative) {
    timing.happens = Answer::no;
  } else if (after_start != Sign::unknown && before_end != Sign::unknown) {
    timing.happens = Answer::yes;
  }
  return timing;
}

template <class Number>
Timing<Number> timing_of(const World& world, const Frame<Number>& frame, const Event& event) {
  const Edge& edge = world.edges()[event.edge];
  const Point<Number> a = frame.at(edge.a);
  const Point<Number> b = frame.at(edge.b);
  if (event.on_world_edge) return meeting(a, b - a, frame.octagon.corners[event.part], frame.way);
  return meeting(frame.octagon.corners[event.part], frame.octagon.edge(event.part), event.at_b ? b : a, -frame.way);
}

struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

Bounds bounds_of(const Timing<Approximate>& timing) noexcept {
  const double denominator = std::abs(timing.denominator.value) - timing.denominator.radius;
  if (!(denominator > 0)) return {};
  const double value = timing.numerator.value / timing.denominator.value;
  const double error = (timing.numerator.radius + std::abs(value) * timing.denominator.radius) / denominator;
  const double radius = error * (1 + 0x1p-40) + std::abs(value) * 0x1p-50 + std::numeric_limits<double>::min();
  if (!(radius < std::numeric_limits<double>::infinity())) return {};
  return {value - radius, value + radius};
}

/// Only edges that look ahead, and their corners, can touch first.
std::vector<Event> leading_events(const World& world, const Frame<Approximate>& frame,
                                  std::span<const std::uint32_t> edges) {
  const std::size_t size = frame.octagon.size;
  std::array<bool, max_points> ahead{};
  for (std::size_t k = 0; k < size; ++k) {
    const Sign sign = sign_of(cross(frame.way, frame.octagon.edge(k)));
    ahead[k] = sign == Sign::positive || sign == Sign::unknown;
  }
  std::vector<Event> events;
  events.reserve(edges.size() * 3 * world.points().size());
  for (const std::uint32_t edge : edges) {
    for (std::uint8_t k = 0; k < size; ++k) {
      if (ahead[k] || ahead[(k + size - 1) % size]) events.push_back({edge, k, true, false});
      if (!ahead[k]) continue;
      events.push_back({edge, k, false, false});
      events.push_back({edge, k, false, true});
    }
  }
  return events;
}

/// The events that may be the earliest, as far as doubles can tell.
std::vector<Event> candidates(const World& world, const Way& way, std::span<const std::uint32_t> edges) {
  const Frame<Approximate> frame = make_frame<Approximate>(world, way, 0);
  std::vector<std::pair<Event, double>> possible;
  double latest = std::numeric_limits<double>::infinity();
  for (const Event& event : leading_events(world, frame, edges)) {
    const Timing<Approximate> timing = timing_of(world, frame, event);
    if (timing.happens == Answer::no) continue;
    const Bounds bounds = bounds_of(timing);
    if (timing.happens == Answer::yes) latest = std::min(latest, bounds.high);
    possible.emplace_back(event, bounds.low);
  }
  std::vector<Event> events;
  for (const auto& [event, low] : possible) {
    if (!(low > latest)) events.push_back(event);
  }
  return events;
}

/// One of the earliest events, in exact numbers.
struct Touch {
  Event event;
  Timing<Integer> timing;
  Point<Integer> edge;   ///< The direction of the edge that is met, turned so that the contact normal is on its left.
  bool opposes = false;  ///< The normal is against the motion.
};

Touch make_touch(const World& world, const Frame<Integer>& frame, const Event& event, const Timing<Integer>& timing) {
  Touch touch{event, timing, {}, false};
  if (event.on_world_edge) {
    const Edge& edge = world.edges()[event.edge];
    touch.edge = frame.at(edge.b) - frame.at(edge.a);
    if (sign_of(cross(touch.edge, frame.way)) == Sign::positive) touch.edge = -touch.edge;
  } else {
    touch.edge = frame.octagon.edge(event.part);
  }
  touch.opposes = sign_of(cross(touch.edge, frame.way)) == Sign::negative;
  return touch;
}

std::vector<Touch> earliest(const World& world, const Frame<Integer>& frame, const std::vector<Event>& events) {
  std::vector<Touch> first;
  for (const Event& event : events) {
    const Timing<Integer> timing = timing_of(world, frame, event);
    if (timing.happens != Answer::yes) continue;
    if (!first.empty()) {
      const Timing<Integer>& best = first.front().timing;
      const Sign order = sign_of(timing.numerator * best.denominator - best.numerator * timing.denominator);
      if (order == Sign::positive) continue;
      if (order == Sign::negative) first.clear();
    }
    first.push_back(make_touch(world, frame, event, timing));
  }
  return first;
}

/// The lowest height of the octagon over the touch's edge, where it touches: times the denominator.
Integer lowest_of_octagon(const Frame<Integer>& frame, const Touch& touch) {
  Integer lowest = cross(touch.edge, frame.octagon.corners[0]);
  for (std::size_t k = 1; k < frame.octagon.size; ++k) {
    lowest = least(lowest, cross(touch.edge, frame.octagon.corners[k]));
  }
  return lowest * touch.timing.denominator + cross(touch.edge, frame.way) * touch.timing.numerator;
}

/// Whether the touch's normal separates the octagon, where it touches, from everything that is touched.
bool stands(const World& world, const Frame<Integer>& frame, const Touch& touch, const std::vector<Touch>& touches) {
  const Integer lowest = lowest_of_octagon(frame, touch);
  return std::ranges::all_of(touches, [&](const Touch& other) {
    const Edge& edge = world.edges()[other.event.edge];
    const auto is_below = [&](const Vec2d& vertex) {
      return cross(touch.edge, frame.at(vertex)) * touch.timing.denominator <= lowest;
    };
    return is_below(edge.a) && is_below(edge.b);
  });
}

Vec2d left_normal(const World& world, const Touch& touch) {
  const Edge& edge = world.edges()[touch.event.edge];
  const std::size_t next = (touch.event.part + 1U) % world.points().size();
  Vec2d along = touch.event.on_world_edge ? Vec2d(edge.b - edge.a)
                                          : Vec2d(world.points()[next] - world.points()[touch.event.part]);
  along /= along.cwiseAbs().maxCoeff();
  along /= std::sqrt(along.x() * along.x() + along.y() * along.y());
  // The exact direction may be the reverse of the world's edge.
  const Integer& leading = abs(touch.edge.x) > abs(touch.edge.y) ? touch.edge.x : touch.edge.y;
  const double rounded = abs(touch.edge.x) > abs(touch.edge.y) ? along.x() : along.y();
  if ((leading > 0) != (rounded > 0)) along = -along;
  return {-along.y(), along.x()};
}

/// The touch whose normal stands: against the motion, separating from every edge that is touched, most opposed.
const Touch& choose(const World& world, const Frame<Integer>& frame, const std::vector<Touch>& touches,
                    const Vec2d& displacement) {
  const auto parallel = [&](const Touch& touch) {
    return touch.opposes && sign_of(cross(touch.edge, touches.front().edge)) == Sign::zero;
  };
  if (std::ranges::all_of(touches, parallel)) return touches.front();

  const Touch* best = nullptr;
  std::pair<bool, double> best_rank;
  for (const Touch& touch : touches) {
    if (!touch.opposes) continue;
    const std::pair<bool, double> rank{stands(world, frame, touch, touches),
                                       -left_normal(world, touch).dot(displacement)};
    if (best == nullptr || rank > best_rank) {
      best = &touch;
      best_rank = rank;
    }
  }
  return best != nullptr ? *best : touches.front();
}

Vec2d place_of(const World& world, const Touch& touch) {
  const Edge& edge = world.edges()[touch.event.edge];
  if (!touch.event.on_world_edge) return touch.event.at_b ? edge.b : edge.a;
  if (touch.timing.along == touch.timing.denominator) return edge.b;
  return edge.a + ratio(touch.timing.along, touch.timing.denominator) * (edge.b - edge.a);
}

/// What touches, along the contact: the first and the last place.
struct Range {
  Vec2d first;
  Vec2d last;
};

Range range_of(const World& world, const std::vector<Touch>& touches, const Touch& chosen, const Vec2d& normal) {
  const Vec2d tangent(normal.y(), -normal.x());
  Range range{place_of(world, chosen), place_of(world, chosen)};
  for (const Touch& touch : touches) {
    if (sign_of(cross(touch.edge, chosen.edge)) != Sign::zero) continue;
    const Vec2d place = place_of(world, touch);
    if ((place - range.first).dot(tangent) < 0) range.first = place;
    if ((place - range.last).dot(tangent) > 0) range.last = place;
  }
  return range;
}

/// A polygon's edge that is met from the inside is one that the octagon comes out of.
bool from_inside(const World& world, const Touch& touch, const Vec2d& normal) {
  const Edge& edge = world.edges()[touch.event.edge];
  const Vec2d along = edge.b - edge.a;
  return world.solids()[edge.collider].kind == Kind::polygon && normal.y() * along.x() - normal.x() * along.y() > 0;
}

bool is_exposed(const World& world, const std::vector<Touch>& touches, const Touch& chosen, const Range& range,
                const Vec2d& normal, const WayIn& way_in) {
  const Group& group = world.group_of(world.edges()[chosen.event.edge].collider);
  const Vec2d place = place_of(world, chosen);
  const Box2 near = Box2::between(range.first, range.last).with(place);
  const auto seams = [&] {
    return Seams(world, group, way_in, chosen.timing.numerator, chosen.timing.denominator, near);
  };
  for (const Touch& touch : touches) {
    if (!touch.event.on_world_edge || sign_of(cross(touch.edge, chosen.edge)) != Sign::zero) continue;
    const Edge& edge = world.edges()[touch.event.edge];
    if (from_inside(world, touch, normal)) return false;
    if (world.solids()[edge.collider].kind != Kind::polygon) return true;
    return !seams().cover(edge, range.first, range.last);
  }
  const Vec2d& start = world.points()[chosen.event.part];
  const Vec2d& end = world.points()[(chosen.event.part + 1U) % world.points().size()];
  return !seams().pass(place, chosen.event.edge, start, end);
}

}  // namespace

ExactImpact find_impact(const World& world, const WayIn& way_in, ColliderIndex collider,
                        std::span<const std::uint32_t> edges) {
  const Way way = way_in(world.group_of(collider));
  const Frame<Integer> frame = make_frame<Integer>(world, way, world.unit_of(way, collider));
  const std::vector<Touch> touches = earliest(world, frame, candidates(world, way, edges));
  const Touch& chosen = choose(world, frame, touches, way.rounded_displacement());
  const Vec2d normal = left_normal(world, chosen);
  const Range range = range_of(world, touches, chosen, normal);
  const Vec2d offset = way.offset_after(ratio(chosen.timing.numerator, chosen.timing.denominator));
  return ExactImpact{.collider = collider,
                     .fraction = ExactFraction(Ratio{chosen.timing.numerator, chosen.timing.denominator}),
                     .normal = normal,
                     .point = (range.first + range.last) / 2 + offset,
                     .exposed = is_exposed(world, touches, chosen, range, normal, way_in)};
}

}  // namespace paperproof::compare::detail
