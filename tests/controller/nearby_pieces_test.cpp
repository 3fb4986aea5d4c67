/// Sensors ask a broad phase, and remember what is near. A look at each alone, anew in each step, has to say the same,
/// to the last bit.
#include "campaign/shapes.hpp"
#include "controller/random_polygons.hpp"
#include "sensors.hpp"
#include "support/same_bits.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

namespace paperproof::test {
namespace {

using Path = std::vector<PathPoint>;
using Motions = std::vector<MoverMotion>;

constexpr double extent = 8;  ///< Of the sceneries [m].

/// On a lattice as coarse as the character: many sensors are met at the same moment, touched, grazed.
Vec2d on_lattice(const Vec2d& point) { return (point * 4).array().round().matrix() / 4; }

Vec2d random_place(Random& random) {
  const Vec2d place = random.point(extent);
  return random.index(2) == 0 ? on_lattice(place) : place;
}

/// By three movers, each of which has something.
void move_some(Random& random, SceneryDef& def) {
  for (ColliderDef& collider : def.colliders)
    if (random.index(4) == 0) collider.mover = static_cast<MoverIndex>(random.index(3));
  for (MoverIndex mover = 0; mover < 3; ++mover) {
    def.colliders.push_back(def.colliders[0]);
    def.colliders.back().mover = mover;
  }
}

Motions random_motions(Random& random) {
  Motions motions(3);
  for (MoverMotion& motion : motions) {
    motion.from = on_lattice(random.point(2));
    motion.to = random.index(3) == 0 ? motion.from : on_lattice(random.point(2));
  }
  return motions;
}

/// Goes on from `from` in most steps; rests in some, and flies through everything in others.
Path random_path(Random& random, const Vec2d& from) {
  if (random.index(6) == 0) {
    const Vec2d aside = random_place(random) / 4;
    const Vec2d along = random.index(2) == 0 ? Vec2d(1.5 * extent, 0) : Vec2d(0, -1.5 * extent);
    return {{aside - along, 0}, {aside + along, 1}};
  }
  Path path{{random.index(8) == 0 ? random_place(random) : from, 0}};
  const double reach = random.index(4) == 0 ? extent : random.between(0.01, 0.5);
  const std::size_t corners = random.index(3);
  for (std::size_t i = 0; i <= corners; ++i) {
    const Vec2d before = path.back().position;
    const Vec2d way = random.index(6) == 0 ? Vec2d(0, 0) : random.point(reach);
    path.push_back({random.index(2) == 0 ? on_lattice(before + way) : Vec2d(before + way),
                    static_cast<double>(i + 1) / static_cast<double>(corners + 1)});
  }
  return path;
}

using Seen = Sensors::Events;

Seen seen_by(Sensors& sensors, const Path& path, const Motions& motions) {
  Seen events;
  sensors.observe(path, {motions}, events);
  return events;
}

/// Each in a scenery with nothing else in it, in order of time.
std::vector<SensorEvent> seen_one_by_one(const SceneryDef& def, const Path& path, const Motions& motions) {
  std::vector<SensorEvent> all;
  for (ColliderIndex i = 0; i < def.colliders.size(); ++i) {
    SceneryDef alone{{def.colliders[i]}};
    MoverIndex& mover = alone.colliders[0].mover;
    const Motions motion = mover == no_mover ? Motions{} : Motions{motions[mover]};
    if (mover != no_mover) mover = 0;
    const Scenery scenery(alone);
    Sensors watch(scenery, CharacterShape::article());
    for (const SensorEvent& event : seen_by(watch, path, motion)) all.push_back({i, event.change, event.fraction});
  }
  std::ranges::stable_sort(all, {}, &SensorEvent::fraction);
  return all;
}

/// Coins, wide regions of several pieces, and lines; in some sceneries rows and columns of coins.
SceneryDef random_sensors(Random& random) {
  SceneryDef def;
  for (std::size_t count = 1 + random.index(40); count > 0; --count) {
    const Vec2d at = random_place(random);
    const std::size_t kind = random.index(8);
    const double size = random.index(2) == 0 ? 0.5 : random.between(0.01, 1);
    def.colliders.push_back(compare::box(at.x(), at.y(), at.x() + size, at.y() + size));
    if (kind == 0) def.colliders.back().points = star_ring(random, 3 + random.index(9), at, 0.3, 6);
    if (kind == 1) def.colliders.back().shape = ColliderDef::Shape::chain;
  }
  move_some(random, def);
  if (random.index(4) == 0)
    for (int x = -6; x < 6; ++x)
      for (int y = -2; y < 3; ++y) def.colliders.push_back(compare::box(x, y, x + 0.5, y + 0.5));
  for (ColliderDef& sensor : def.colliders) sensor.sensor = true;
  return def;
}

TEST(SensorsNearby, are_those_of_a_look_at_each_alone) {
  const int sceneries = sampled(3'000);
  // In how many steps something was seen, and so on.
  int some = 0;
  int many = 0;
  int at_once = 0;
  for (unsigned seed = 0; seed < static_cast<unsigned>(sceneries); ++seed) {
    Random random(seed);
    const SceneryDef def = random_sensors(random);
    std::optional<Scenery> scenery;
    try {
      scenery.emplace(def);
    } catch (const InvalidScenery&) {
      continue;  // a star that touches itself
    }
    Sensors watch(*scenery, CharacterShape::article());
    Vec2d at = random_place(random);
    for (int step = 0; step < 6; ++step) {
      const Path path = random_path(random, at);
      const Motions motions = random_motions(random);
      at = path.back().position;
      const Seen events = seen_by(watch, path, motions);
      const std::vector<SensorEvent> all = seen_one_by_one(def, path, motions);
      ASSERT_TRUE(all_same_bits(events, all)) << "seed " << seed << ", step " << step;
      some += !events.empty();
      many += events.size() > 32;
      for (std::size_t i = 1; i < events.size(); ++i)
        at_once += events[i].fraction == events[i - 1].fraction && events[i].sensor != events[i - 1].sensor;
    }
  }
  EXPECT_GT(some, sceneries * 6 * 3 / 10);
  EXPECT_LT(some, sceneries * 6 * 8 / 10);
  EXPECT_GT(many, sceneries / 100);
  EXPECT_GT(at_once, sceneries / 10);
}

}  // namespace
}  // namespace paperproof::test
