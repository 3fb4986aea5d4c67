#include "figures.hpp"

#include "level.hpp"

#include <paperproof/controller.hpp>

#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>
#include <malloc.h>

#include <memory>
#include <utility>

namespace paperproof::benchmarks {
namespace {

constexpr std::int64_t pieces = 1'000'000;
constexpr int rounds = 5;

/// The bytes that the process has allocated now, untouched ones included.
double allocated() noexcept {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// Calls `make` in several rounds. @return the least time [ms], and the bytes for each piece that the result keeps.
template <class Make>
std::pair<double, double> made(const Make& make) {
  double milliseconds = std::numeric_limits<double>::infinity();
  double bytes = 0;
  for (int round = 0; round < rounds; ++round) {
    const double before = allocated();
    decltype(make()) result;
    milliseconds = std::min(milliseconds, nanoseconds_of([&] { result = make(); }) / 1e6);
    bytes = (allocated() - before) / static_cast<double>(pieces);
  }
  return {milliseconds, bytes};
}

struct Game {
  explicit Game(const Level& level) : scenery(level.scenery) {}
  Scenery scenery;
  Controller controller{scenery, CharacterDef{}};
  Scratch scratch = controller.make_scratch();
};

/// Of Box2D the tree of the fixtures included, which the first step would build.
Figures set_up() {
  const Level level = make_level(pieces);
  const auto [ours, our_bytes] = made([&] { return std::make_unique<Game>(level); });
  const auto [theirs, their_bytes] = made([&] { return make_box2d_level(level); });
  return {{"paperproof_ms", ours}, {"box2d_ms", theirs}, {"paperproof_bytes", our_bytes}, {"box2d_bytes", their_bytes}};
}

/// A step of a character that stands. Before it a tile is added, or removed again.
/// @param height of the tile above the character [m]; zero: there is none.
Figures step_after_edit(double height) {
  constexpr int steps = 10'000;
  constexpr int passes = 5;
  const Level level = make_level(pieces);
  const Vec2d at = level.start() + Vec2d(0, height);

  paperproof::Level edited(level.scenery);
  const ColliderDef tile{.points = {at, at + Vec2d(1, 0), at + Vec2d(1, 1), at + Vec2d(0, 1)}};
  const Controller controller(edited, {});
  Scratch scratch = controller.make_scratch();
  CharacterState character;
  character.position = level.start();
  StepReport report;
  ColliderIndex id = no_collider;

  const std::unique_ptr<b2World> world = make_box2d_level(level);
  b2Body& ground = *world->GetBodyList();
  add_box2d_character(*world, {}, level.start());
  b2PolygonShape shape;
  shape.SetAsBox(0.5F, 0.5F, {static_cast<float>(at.x() + 0.5), static_cast<float>(at.y() + 0.5)}, 0);
  b2Fixture* fixture = nullptr;
  for (int i = 0; i < 10; ++i) advance(*world);  // the first looks at all fixtures

  const auto step_controller = [&] {
    for (int i = 0; i < steps; ++i) {
      if (height > 0 && !edited.remove(id)) id = edited.add(tile);
      controller.step(character, {.move = 0.0}, {{0, gravity_y}, frame}, scratch, report);
    }
  };
  const auto step_box2d = [&] {
    for (int i = 0; i < steps; ++i) {
      if (fixture != nullptr) ground.DestroyFixture(fixture);
      fixture = fixture == nullptr && height > 0 ? ground.CreateFixture(&shape, 0) : nullptr;
      advance(*world);
    }
  };
  return fastest_in_turns(passes, steps, step_controller, step_box2d);
}

}  // namespace

std::vector<Measurement> level_measurements() {
  return {{"set_up", set_up},
          {"edit/none", [] { return step_after_edit(0); }},
          {"edit/far_away", [] { return step_after_edit(50); }},
          {"edit/near", [] { return step_after_edit(1.5); }}};
}

}  // namespace paperproof::benchmarks
