/// Sensors and one-way chains ask a broad phase. A look at all of them has to say the same, to the last bit.
#include "controller/random_polygons.hpp"
#include "geometry/overlap_time.hpp"
#include "one_way_chains.hpp"
#include "sensors.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

namespace paperproof::test {
namespace {

using Event = SensorEvent<double>;
using Stay = geometry::OverlapTime<double>;
using Path = std::vector<PathPoint<double>>;
using Motions = std::vector<MoverMotion<double>>;

constexpr MoverIndex movers = 3;
constexpr double extent = 8;  ///< Of the sceneries [m].

/// On a lattice as coarse as the character: many sensors are met at the same moment, touched, grazed.
Vec2d on_lattice(const Vec2d& point) { return (point * 4).array().round().matrix() / 4; }

Vec2d random_place(Random& random) {
  const Vec2d place = random.point(extent);
  return random.index(2) == 0 ? on_lattice(place) : place;
}

/// Coins, wide regions of several pieces, and lines.
ColliderDef random_sensor(Random& random, std::size_t colliders) {
  ColliderDef def;
  def.sensor = true;
  const Vec2d at = random_place(random);
  const std::size_t kind = random.index(8);
  const double size = random.index(2) == 0 ? 0.5 : random.uniform(0.01, 1);
  def.points = {at, at + Vec2d(size, 0), at + Vec2d(size, size), at + Vec2d(0, size)};
  if (kind == 0) def.points = star_ring(random, 3 + random.index(9), at, 0.3, 6);
  if (kind == 1) def.shape = ColliderDef::Shape::chain;
  if (random.index(4) == 0) def.mover = static_cast<MoverIndex>(random.index(std::min<std::size_t>(movers, colliders)));
  return def;
}

Motions random_motions(Random& random, std::size_t count) {
  Motions motions(count);
  for (MoverMotion<double>& motion : motions) {
    motion.from = on_lattice(random.point(2));
    motion.to = random.index(3) == 0 ? motion.from : on_lattice(random.point(2));
  }
  return motions;
}

/// Rows and columns of coins: those of a column are met at the same moment.
void add_coins(SceneryDef& def) {
  for (int i = 0; i < 60; ++i) {
    const Vec2d at(i % 12 - 6, i / 12 - 2);
    def.colliders.push_back({.points = {at, at + Vec2d(0.5, 0), at + Vec2d(0.5, 0.5), at + Vec2d(0, 0.5)}});
    def.colliders.back().sensor = true;
  }
}

/// Goes on from `from` in most steps; rests in some, and flies through everything in others.
Path random_path(Random& random, const Vec2d& from) {
  if (random.index(6) == 0) {
    const Vec2d aside = random_place(random) / 4;
    const Vec2d along = random.index(2) == 0 ? Vec2d(1.5 * extent, 0) : Vec2d(0, -1.5 * extent);
    return {{aside - along, 0}, {aside + along, 1}};
  }
  Path path{{random.index(8) == 0 ? random_place(random) : from, 0}};
  const double reach = random.index(4) == 0 ? extent : random.uniform(0.01, 0.5);
  const std::size_t corners = random.index(3);
  for (std::size_t i = 0; i <= corners; ++i) {
    const Vec2d before = path.back().position;
    const Vec2d way = random.index(6) == 0 ? Vec2d(0, 0) : random.point(reach);
    path.push_back({random.index(2) == 0 ? on_lattice(before + way) : Vec2d(before + way),
                    static_cast<double>(i + 1) / static_cast<double>(corners + 1)});
  }
  return path;
}

/// The slow, honest twin: each leg of the way against each piece of each sensor.
std::vector<Event> events_of_all(const Scenery<double>& scenery, const Path& path, const Motions& motions) {
  const CharacterShape shape = CharacterShape::article();
  std::vector<Event> events;
  for (ColliderIndex sensor = 0; sensor < scenery.collider_count(); ++sensor) {
    const MoverIndex mover = scenery.collider(sensor).mover;
    const MoverMotion<double> motion = mover == no_mover ? MoverMotion<double>{} : motions[mover];
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Vec2d from = path[i - 1].position - motion.at(path[i - 1].fraction);
      const Vec2d to = path[i].position - motion.at(path[i].fraction);
      std::vector<Stay> stays;
      for (PieceIndex piece = scenery.sensor_pieces().first; piece < scenery.sensor_pieces().end; ++piece) {
        if (scenery.pieces()[piece].collider != sensor) continue;
        const Stay stay = geometry::overlap_time<double>(shape.hull(), scenery.vertices_of(piece), from, to);
        if (stay.any()) stays.push_back(stay);
      }
      std::sort(stays.begin(), stays.end(), [](const Stay& a, const Stay& b) { return a.begin < b.begin; });
      const auto fraction = [&](double of_leg) {
        const double length = path[i].fraction - path[i - 1].fraction;
        return std::min(path[i].fraction, path[i - 1].fraction + length * of_leg);
      };
      for (std::size_t k = 0; k < stays.size();) {
        Stay stay = stays[k++];
        for (; k < stays.size() && stays[k].begin <= stay.end + 1e-12; ++k) stay.end = std::max(stay.end, stays[k].end);
        if (stay.begin != Stay::before) events.push_back({sensor, Event::Change::enter, fraction(stay.begin)});
        if (stay.end != Stay::after) events.push_back({sensor, Event::Change::exit, fraction(stay.end)});
      }
    }
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.fraction < b.fraction; });
  return events;
}

bool same(const Event& a, const Event& b) {
  return a.sensor == b.sensor && a.change == b.change && a.fraction == b.fraction;
}

TEST(SensorsNearby, are_those_of_a_look_at_all_of_them) {
  int steps = 0;
  int with_events = 0;
  int too_many = 0;
  int at_once = 0;
  int quiet = 0;
  constexpr int sceneries = sampled(10'000);
  for (unsigned seed = 0; seed < sceneries; ++seed) {
    Random random(seed);
    SceneryDef def;
    const std::size_t count = 1 + random.index(40);
    for (std::size_t i = 0; i < count; ++i) def.colliders.push_back(random_sensor(random, count));
    if (random.index(4) == 0) add_coins(def);
    std::optional<Scenery<double>> scenery;
    try {
      scenery.emplace(def);
    } catch (const InvalidScenery&) {
      continue;  // a star that touches itself
    }
    const Sensors<double> sensors(*scenery, CharacterShape::article());
    Candidates<double> candidates = sensors.make_candidates();
    Vec2d at = random_place(random);
    for (int step = 0; step < 6; ++step) {
      const Path path = random_path(random, at);
      const Motions motions = random_motions(random, scenery->mover_count());
      at = path.back().position;
      quiet += candidates.quiet.contains(PieceFinder<double>::positions_seen(path, {})) ? 1 : 0;
      Sensors<double>::Events events;
      sensors.observe(path, motions, candidates, events);
      const std::vector<Event> all = events_of_all(*scenery, path, motions);
      ASSERT_EQ(events.size(), std::min(all.size(), events.capacity())) << "seed " << seed << ", step " << step;
      ASSERT_EQ(events.overflowed(), all.size() > events.capacity()) << "seed " << seed << ", step " << step;
      for (std::size_t i = 0; i < events.size(); ++i)
        ASSERT_TRUE(same(events[i], all[i])) << "seed " << seed << ", step " << step << ", event " << i;
      ++steps;
      with_events += events.empty() ? 0 : 1;
      too_many += events.overflowed() ? 1 : 0;
      for (std::size_t i = 1; i < events.size(); ++i)
        at_once += events[i].fraction == events[i - 1].fraction && events[i].sensor != events[i - 1].sensor ? 1 : 0;
    }
  }
  EXPECT_GT(steps, sceneries * 5);
  EXPECT_GT(with_events, steps * 3 / 10);
  EXPECT_LT(with_events, steps * 8 / 10);
  EXPECT_GT(too_many, sceneries / 100);
  EXPECT_GT(quiet, sceneries / 10) << "known to be so from the step before";
  EXPECT_GT(at_once, sceneries / 10) << "of two sensors at the same moment";
}

/// Chains that are nowhere near each other's ends, some of them upside down.
ColliderDef random_chain(Random& random, std::size_t colliders) {
  ColliderDef def;
  def.shape = ColliderDef::Shape::chain;
  const Vec2d at = random.point(extent);
  def.points = {at, at + Vec2d(random.uniform(0.1, 3), random.uniform(-1, 1))};
  def.one_way = Vec2d(0, random.index(4) == 0 ? -1 : 1);
  if (random.index(4) == 0) def.mover = static_cast<MoverIndex>(random.index(std::min<std::size_t>(movers, colliders)));
  return def;
}

/// One scenery for each chain, with nothing else in it.
std::vector<ColliderIndex> passed_one_by_one(const SceneryDef& def, const Path& path, const Motions& motions) {
  std::vector<ColliderIndex> passed;
  for (ColliderIndex i = 0; i < def.colliders.size(); ++i) {
    SceneryDef alone{{def.colliders[i]}};
    Motions motion;
    if (alone.colliders[0].mover != no_mover) {
      motion = {motions[alone.colliders[0].mover]};
      alone.colliders[0].mover = 0;
    }
    const Scenery<double> scenery(alone);
    const OneWayChains<double> chain(scenery, CharacterShape::article());
    Candidates<double> candidates = chain.make_candidates();
    OneWayChains<double>::Passed found;
    chain.find_passed(path, motion, candidates, found);
    if (!found.empty()) passed.push_back(i);
  }
  return passed;
}

TEST(OneWayChainsNearby, that_are_passed_are_those_of_a_look_at_each_alone) {
  int several = 0;
  int too_many = 0;
  constexpr int sceneries = sampled(1'000);
  for (unsigned seed = 0; seed < sceneries; ++seed) {
    Random random(seed);
    SceneryDef def;
    const std::size_t count = 1 + random.index(random.index(10) == 0 ? 600 : 40);
    for (std::size_t i = 0; i < count; ++i) def.colliders.push_back(random_chain(random, count));
    const Scenery<double> scenery(def);
    const OneWayChains<double> chains(scenery, CharacterShape::article());
    Candidates<double> candidates = chains.make_candidates();
    Vec2d at = random_place(random);
    for (int step = 0; step < 4; ++step) {
      const Path path = random_path(random, at);
      const Motions motions = random_motions(random, scenery.mover_count());
      at = path.back().position;
      OneWayChains<double>::Passed passed;
      chains.find_passed(path, motions, candidates, passed);
      std::vector<ColliderIndex> expected = passed_one_by_one(def, path, motions);
      ASSERT_EQ(passed.overflowed(), expected.size() > passed.capacity()) << "seed " << seed << ", step " << step;
      expected.resize(std::min(expected.size(), passed.capacity()));
      ASSERT_TRUE(std::equal(passed.begin(), passed.end(), expected.begin(), expected.end()))
          << "seed " << seed << ", step " << step;
      several += passed.size() > 1 ? 1 : 0;
      too_many += passed.overflowed() ? 1 : 0;
    }
  }
  EXPECT_GT(several, sceneries / 5);
  EXPECT_GT(too_many, sceneries / 200);
}

TEST(DeepOverlap, is_found_by_the_separations_from_every_corner_of_the_box) {
  const CharacterShape shape = CharacterShape::article();
  int with_room = 0;
  constexpr int pieces = sampled(10'000);
  for (unsigned seed = 0; seed < pieces; ++seed) {
    Random random(seed);
    Points piece = star_ring(random, 3 + random.index(3), random_place(random), 0.1, 3);
    if (random.index(4) == 0) piece.resize(2);
    const Box2<double> box = geometry::deep_overlap<double>(shape.hull(), piece, 1e-3);
    if (!(box.lower.x() <= box.upper.x())) continue;
    ++with_room;
    for (const Vec2d& corner :
         {box.lower, box.upper, Vec2d(box.lower.x(), box.upper.y()), Vec2d(box.upper.x(), box.lower.y())}) {
      // A convex overlap that goes on for a millimetre in each direction.
      for (const Vec2d& aside : {Vec2d(1e-3, 0), Vec2d(-1e-3, 0), Vec2d(0, 1e-3), Vec2d(0, -1e-3)}) {
        const Stay stay = geometry::overlap_time<double>(shape.hull(), piece, corner, corner + aside * 0.999);
        EXPECT_EQ(stay.begin, Stay::before) << "seed " << seed;
        EXPECT_EQ(stay.end, Stay::after) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(with_room, pieces / 2);
}

}  // namespace
}  // namespace paperproof::test
