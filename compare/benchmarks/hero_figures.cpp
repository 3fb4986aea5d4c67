#include "figures.hpp"

#include "level.hpp"

#include "box2d_adapter/src/float_geometry.hpp"

#include <paperproof/box2d/hero.hpp>

#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>

#include <limits>
#include <stdexcept>

namespace paperproof::benchmarks {
namespace {

constexpr int frames = 1800;  // whole ways to and fro
constexpr std::int64_t tiles = 10'000;
constexpr double to_flat_ground = 7.5;  ///< From the left end of a section [m].
constexpr int frames_one_way = 15;
constexpr int most_in_air = 10;  // until it has landed

/// The ground that a hero goes on: one box, or unit tiles that are fixtures of one body.
std::unique_ptr<b2World> make_world(bool of_tiles, const Level& level, const Vec2d& start) {
  auto world = of_tiles ? make_box2d_level(level) : std::make_unique<b2World>(b2Vec2(0, 0));
  world->SetGravity({0, static_cast<float>(gravity_y)});
  if (of_tiles) return world;
  b2BodyDef still;
  b2PolygonShape floor;
  floor.SetAsBox(1000, 1, box2d::rounded(Vec2d(start - Vec2d(0, 1.7))), 0);
  world->CreateBody(&still)->CreateFixture(&floor, 0);
  return world;
}

/// What a hero costs a game that steps its world anyway: its own step, and how much dearer its body makes the step of
/// the world. Beside it a body of the same shape that is nothing but Box2D's, and goes the same way.
Figures hero(bool of_tiles, bool walks) {
  constexpr int passes = 20;
  const Level level = make_level(tiles);
  const Vec2d start = level.start() + Vec2d(to_flat_ground, 0);
  const std::unique_ptr<b2World> empty = make_world(of_tiles, level, start);
  const std::unique_ptr<b2World> with_hero = make_world(of_tiles, level, start);
  const std::unique_ptr<b2World> with_body = make_world(of_tiles, level, start);
  box2d::Hero hero(*with_hero, {.position = start});
  b2Body& body = add_box2d_character(*with_body, {}, start);

  std::vector<Input> inputs(frames, Input{.move = 0.0});
  if (walks)  // to and fro
    for (int i = 0; i < frames; ++i)
      inputs[static_cast<std::size_t>(i)].move = i / frames_one_way % 2 == 0 ? 1.0 : -1.0;

  // Each pass is the same way again: of each frame the fastest counts.
  struct Frame {
    double world = std::numeric_limits<double>::infinity();
    double step = world;
    double world_of_hero = world;
    double world_of_body = world;
  };
  std::vector<Frame> fastest(frames);
  const auto keep = [](double& least, const auto& run) { least = std::min(least, nanoseconds_of(run)); };
  int in_air = 0;
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t i = 0; i < frames; ++i) {
      Frame& now = fastest[i];
      keep(now.world, [&] { advance(*empty); });
      keep(now.world_of_hero, [&] { advance(*with_hero); });
      keep(now.step, [&] { hero.step(inputs[i], static_cast<float>(frame)); });
      body.SetLinearVelocity({static_cast<float>(hero.velocity().x()), body.GetLinearVelocity().y});
      keep(now.world_of_body, [&] { advance(*with_body); });
      in_air += static_cast<int>(!hero.grounded());
    }
  if (in_air > most_in_air) throw std::runtime_error("hero: it left its ground");
  Figures mean;
  for (const Frame& one : fastest) {
    mean["step"] += one.step / frames;
    mean["its_body"] += (one.world_of_hero - one.world) / frames;
    mean["plain_body"] += (one.world_of_body - one.world) / frames;
  }
  return mean;
}

}  // namespace

std::vector<Measurement> hero_measurements() {
  return {{"hero/box/stands", [] { return hero(false, false); }},
          {"hero/box/walks", [] { return hero(false, true); }},
          {"hero/tiles/stands", [] { return hero(true, false); }},
          {"hero/tiles/walks", [] { return hero(true, true); }}};
}

}  // namespace paperproof::benchmarks
