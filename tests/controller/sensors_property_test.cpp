/// Events of random flights through random sensors, against rational numbers and against each other.
///
/// All coordinates are multiples of 2^-10 m: separations are then exact in doubles, and the order of events has to be
/// right to the last touch and graze.
#include "controller/exact_reference.hpp"
#include "controller/random_polygons.hpp"
#include "sensors.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>  // after GoogleTest, which it does not include

#include <cstdlib>
#include <optional>
#include <string>

namespace paperproof::test {
namespace {

/// The same flights in every run, and more of them than RapidCheck's hundred; RC_PARAMS in the environment goes first.
[[maybe_unused]] const int parameters =
    setenv("RC_PARAMS", ("seed=34 max_success=" + std::to_string(sampled(2000))).c_str(), 0);

using Event = SensorEvent<double>;
using Path = std::vector<PathPoint<double>>;

constexpr double coarse = 1.0 / 4;   // the same coordinates come again: touches, grazes, shared corners
constexpr double fine = 1.0 / 1024;  // hardly ever

double rounded(double value, double lattice) { return std::round(value / lattice) * lattice; }
Vec2d rounded(const Vec2d& point, double lattice) { return {rounded(point.x(), lattice), rounded(point.y(), lattice)}; }

ColliderDef random_sensor(Random& random, double lattice) {
  const Vec2d centre = random.point(2);
  ColliderDef def;
  def.sensor = true;
  def.points = star_ring(random, 3 + random.index(9), centre, 0.3, 3);
  if (random.index(4) == 0) def.shape = ColliderDef::Shape::chain;
  for (Vec2d& point : def.points) point = rounded(point, lattice);
  return def;
}

/// One step: a path with a few corners at fractions that are exact, among sensors of which one moves.
struct Flight {
  SceneryDef def;
  Path path;
  MoverMotion<double> mover;

  explicit Flight(unsigned seed) {
    Random random(seed);
    const double lattice = random.index(2) == 0 ? coarse : fine;
    def.colliders = {random_sensor(random, lattice), random_sensor(random, lattice)};
    def.colliders[1].mover = 0;
    // Divisible by 32 once more, for the corners and splits.
    mover = {rounded(random.point(2), lattice * 32), rounded(random.point(2), lattice * 32)};
    const int corners = static_cast<int>(random.index(4));
    path.push_back({rounded(random.point(4), lattice), 0});
    for (int i = 1; i <= corners; ++i) path.push_back({rounded(random.point(4), lattice), i * 0.125});
    const Vec2d along = rounded(random.point(6), lattice * 16);
    path.push_back({random.index(3) == 0 ? Vec2d(along.x(), path.back().position.y()) : along, 1});
  }
};

std::vector<Event> events_of(const Sensors<double>& sensors, const Path& path, const MoverMotion<double>& mover) {
  Sensors<double>::Events events;
  Candidates<double> candidates = sensors.make_candidates();
  sensors.observe(path, std::span(&mover, 1), candidates, events);
  return {events.begin(), events.end()};
}

struct ExactStay {
  std::optional<Rational> begin;  ///< Absent: from before.
  std::optional<Rational> end;    ///< Absent: until later.
};

/// By the rational separations along all edge normals of both outlines.
std::optional<ExactStay> exact_stay(std::span<const Vec2d> hull, std::span<const Vec2d> piece, const ExactPoint& from,
                                    const ExactPoint& to) {
  ExactStay stay;
  const auto narrow = [&](const Vec2d& a, const Vec2d& b, int sign) {
    const Rational nx = (Rational(b.y()) - Rational(a.y())) * sign;
    const Rational ny = (Rational(a.x()) - Rational(b.x())) * sign;
    std::optional<Rational> lowest;
    std::optional<Rational> highest;
    for (const Vec2d& point : hull) {
      const Rational value = nx * Rational(point.x()) + ny * Rational(point.y());
      if (!lowest || value < *lowest) lowest = value;
    }
    for (const Vec2d& point : piece) {
      const Rational value = nx * Rational(point.x()) + ny * Rational(point.y());
      if (!highest || value > *highest) highest = value;
    }
    const Rational first = nx * from.x + ny * from.y + *lowest - *highest;
    const Rational last = nx * to.x + ny * to.y + *lowest - *highest;
    if (first >= 0 && last >= 0) return false;
    if (first < 0 && last < 0) return true;
    const Rational crossing = first / (first - last);
    if (first >= 0 && (!stay.begin || crossing > *stay.begin)) stay.begin = crossing;
    if (last >= 0 && (!stay.end || crossing < *stay.end)) stay.end = crossing;
    return true;
  };
  for (std::size_t i = 0; i < piece.size(); ++i)
    if (!narrow(piece[i], piece[(i + 1) % piece.size()], 1)) return std::nullopt;
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (!narrow(hull[i], hull[(i + 1) % hull.size()], -1)) return std::nullopt;
  if (stay.begin && stay.end && *stay.begin >= *stay.end) return std::nullopt;
  return stay;
}

struct ExactEvent {
  Event::Change change;
  Rational fraction;
};

ExactPoint seen(const PathPoint<double>& corner, const MoverMotion<double>& motion) {
  ExactPoint point(corner.position);
  const Rational fraction(corner.fraction);
  point.x -= Rational(motion.from.x()) + fraction * (Rational(motion.to.x()) - Rational(motion.from.x()));
  point.y -= Rational(motion.from.y()) + fraction * (Rational(motion.to.y()) - Rational(motion.from.y()));
  return point;
}

/// All stays in the pieces of a sensor during one segment, sorted and joined.
std::vector<ExactStay> exact_stays(const Scenery<double>& scenery, ColliderIndex sensor, const ExactPoint& from,
                                   const ExactPoint& to) {
  const CharacterShape shape = CharacterShape::article();
  std::vector<ExactStay> stays;
  for (PieceIndex piece = scenery.sensor_pieces().first; piece < scenery.sensor_pieces().end; ++piece) {
    if (scenery.pieces()[piece].collider != sensor) continue;
    if (const auto stay = exact_stay(shape.hull(), scenery.vertices_of(piece), from, to)) stays.push_back(*stay);
  }
  const auto begin_of = [](const ExactStay& stay) { return stay.begin.value_or(-1); };
  std::sort(stays.begin(), stays.end(),
            [&](const ExactStay& a, const ExactStay& b) { return begin_of(a) < begin_of(b); });
  std::vector<ExactStay> joined;
  for (const ExactStay& stay : stays) {
    // Two that meet in one instant are one: see `Sensors::observe`.
    if (joined.empty() || (joined.back().end && begin_of(stay) > *joined.back().end + Rational(1e-12)))
      joined.push_back(stay);
    else if (joined.back().end && (!stay.end || *stay.end > *joined.back().end))
      joined.back().end = stay.end;
  }
  return joined;
}

std::vector<ExactEvent> exact_events(const Scenery<double>& scenery, ColliderIndex sensor, const Path& path,
                                     const MoverMotion<double>& motion) {
  std::vector<ExactEvent> events;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Rational begin(path[i - 1].fraction);
    const Rational length = Rational(path[i].fraction) - begin;
    for (const ExactStay& stay : exact_stays(scenery, sensor, seen(path[i - 1], motion), seen(path[i], motion))) {
      if (stay.begin) events.push_back({Event::Change::enter, begin + length * *stay.begin});
      if (stay.end) events.push_back({Event::Change::exit, begin + length * *stay.end});
    }
  }
  return events;
}

std::vector<Event> only(const std::vector<Event>& events, ColliderIndex sensor) {
  std::vector<Event> result;
  for (const Event& event : events)
    if (event.sensor == sensor) result.push_back(event);
  return result;
}

RC_GTEST_PROP(SensorEvents, are_those_of_rational_arithmetic, (unsigned seed)) {
  const Flight flight(seed);
  std::optional<Scenery<double>> scenery;
  try {
    scenery.emplace(flight.def);
  } catch (const InvalidScenery&) {
    RC_DISCARD("rounding made the polygon touch itself");
  }
  const Sensors<double> sensors(*scenery, CharacterShape::article());
  const std::vector<Event> events = events_of(sensors, flight.path, flight.mover);
  for (std::size_t i = 1; i < events.size(); ++i) RC_ASSERT(events[i - 1].fraction <= events[i].fraction);
  bool any = false;
  for (const ColliderIndex sensor : {0U, 1U}) {
    const MoverMotion<double> motion = sensor == 0 ? MoverMotion<double>{} : flight.mover;
    const std::vector<ExactEvent> expected = exact_events(*scenery, sensor, flight.path, motion);
    const std::vector<Event> found = only(events, sensor);
    RC_ASSERT(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      RC_ASSERT(found[i].change == expected[i].change);
      if (i > 0) RC_ASSERT(found[i].change != found[i - 1].change);
      RC_ASSERT(std::abs(found[i].fraction - static_cast<double>(expected[i].fraction)) <= 1e-12);
    }
    any = any || !found.empty();
  }
  RC_CLASSIFY(any, "with an event");
}

/// The same flight in two steps: everything up to `split` of its last segment, and the rest.
struct Halves {
  Path first;
  Path second;
  MoverMotion<double> first_mover;
  MoverMotion<double> second_mover;
  double split = 0;  ///< Fraction of the whole flight.

  Halves(const Flight& flight, double part) : first(flight.path) {
    const PathPoint<double> last = flight.path.back();
    const PathPoint<double> before = flight.path[flight.path.size() - 2];
    split = before.fraction + (1 - before.fraction) * part;
    const Vec2d middle = before.position + (last.position - before.position) * part;
    const Vec2d offset = flight.mover.from + (flight.mover.to - flight.mover.from) * split;
    first.back() = {middle, 1};
    for (std::size_t i = 0; i + 1 < first.size(); ++i) first[i].fraction /= split;
    second = {{middle, 0}, {last.position, 1}};
    first_mover = {flight.mover.from, offset};
    second_mover = {offset, flight.mover.to};
  }
};

RC_GTEST_PROP(SensorEvents, are_the_same_when_a_motion_is_split_into_steps, (unsigned seed)) {
  Flight flight(seed);
  flight.path.erase(flight.path.begin() + 1, flight.path.end() - 1);  // its fractions would be rounded
  std::optional<Scenery<double>> scenery;
  try {
    scenery.emplace(flight.def);
  } catch (const InvalidScenery&) {
    RC_DISCARD("rounding made the polygon touch itself");
  }
  const Sensors<double> sensors(*scenery, CharacterShape::article());
  const std::vector<Event> whole = events_of(sensors, flight.path, flight.mover);
  const double part = *rc::gen::inRange(1, 16) / 16.0;
  const Halves halves(flight, part);
  std::vector<Event> joined;
  for (Event event : events_of(sensors, halves.first, halves.first_mover)) {
    event.fraction *= halves.split;
    joined.push_back(event);
  }
  for (Event event : events_of(sensors, halves.second, halves.second_mover)) {
    event.fraction = halves.split + event.fraction * (1 - halves.split);
    joined.push_back(event);
  }
  for (const ColliderIndex sensor : {0U, 1U}) {
    const std::vector<Event> expected = only(whole, sensor);
    const std::vector<Event> found = only(joined, sensor);
    RC_ASSERT(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      RC_ASSERT(found[i].change == expected[i].change);
      RC_ASSERT(std::abs(found[i].fraction - expected[i].fraction) <= 1e-12);
    }
  }
  RC_CLASSIFY(!whole.empty(), "with an event");
}

}  // namespace
}  // namespace paperproof::test
