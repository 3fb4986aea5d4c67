#include "edit_benchmark.hpp"

#include "level.hpp"

#include <paperproof/controller.hpp>

#include <benchmark/benchmark.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>

#include <memory>

namespace paperproof::benchmarks {
namespace {

constexpr std::int64_t pieces = 1'000'000;

/// A tile in the air, so many metres above the character, which stands near the middle.
ColliderDef tile_above(const Level& level, double height) {
  const Vec2d at = level.start() + Vec2d(0, height);
  return {.points = {at, at + Vec2d(1, 0), at + Vec2d(1, 1), at + Vec2d(0, 1)}};
}

/// The whole level, added collider by collider.
void build(benchmark::State& state) {
  const Level level = make_level(pieces);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(paperproof::Level(level.scenery).size());
}

/// One tile is added and removed.
void edit(benchmark::State& state) {
  const Level level = make_level(pieces);
  paperproof::Level edited(level.scenery);
  const ColliderDef tile = tile_above(level, 5);
  for ([[maybe_unused]] auto _ : state) edited.remove(edited.add(tile));
}

/// A step of a character that stands, and before it an edit.
/// @param height of the edited tile above the character [m]; zero: none is edited.
void step(benchmark::State& state, double height) {
  const Level level = make_level(pieces);
  paperproof::Level edited(level.scenery);
  const ColliderDef tile = tile_above(level, height);
  const Controller controller(edited, {});
  Scratch scratch = controller.make_scratch();
  CharacterState character;
  character.position = level.start();
  StepReport report;
  ColliderIndex id = no_collider;
  for ([[maybe_unused]] auto _ : state) {
    if (height > 0 && !edited.remove(id)) id = edited.add(tile);
    controller.step(character, {.move = 0.0}, {{0, gravity_y}, frame}, scratch, report);
  }
}

/// The same in Box2D.
void step_box2d(benchmark::State& state, double height) {
  const Level level = make_level(pieces);
  const std::unique_ptr<b2World> world = make_box2d_level(level);
  b2Body& ground = *world->GetBodyList();
  add_box2d_character(*world, {}, level.start());
  const Vec2d at = level.start() + Vec2d(0.5, height + 0.5);
  b2PolygonShape shape;
  shape.SetAsBox(0.5F, 0.5F, {static_cast<float>(at.x()), static_cast<float>(at.y())}, 0);
  b2Fixture* tile = nullptr;
  for (int i = 0; i < 10; ++i) world->Step(static_cast<float>(frame), 8, 3);  // the first looks at all fixtures
  for ([[maybe_unused]] auto _ : state) {
    if (tile != nullptr) ground.DestroyFixture(tile);
    tile = tile == nullptr && height > 0 ? ground.CreateFixture(&shape, 0) : nullptr;
    world->Step(static_cast<float>(frame), 8, 3);
  }
}

}  // namespace

void register_edit_benchmarks() {
  benchmark::RegisterBenchmark("edit/build", build)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("edit/add_and_remove", edit);
  benchmark::RegisterBenchmark("edit/step", step, 0.0);
  benchmark::RegisterBenchmark("edit/step_and_edit_far_away", step, 50.0);
  benchmark::RegisterBenchmark("edit/step_and_edit_near", step, 1.5);
  benchmark::RegisterBenchmark("edit/box2d_step", step_box2d, 0.0);
  benchmark::RegisterBenchmark("edit/box2d_step_and_edit_far_away", step_box2d, 50.0);
}

}  // namespace paperproof::benchmarks
