#include "setup_benchmark.hpp"

#include "scenes/scene.hpp"

#include <paperproof/controller.hpp>

#include <benchmark/benchmark.h>
#include <box2d/b2_body.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>
#include <box2d/b2_world.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace paperproof::benchmarks {
namespace {

/// A level is made of sections, side by side and one above the other, as nearly square as may be.
constexpr int section_width = 16;    ///< [m]
constexpr int section_height = 24;   ///< From one storey to the next [m].
constexpr int tile_rows = 6;         ///< Rows of tiles.
constexpr int section_pieces = 108;  ///< 96 tiles of ground, 2 on a hill, 4 slopes and 6 platforms.
constexpr int walked_steps = 2000;
constexpr double frame = 1.0 / 60;
constexpr double half_of_a_character = 20.0 / 32;

ColliderDef rectangle(double left, double bottom, double width, double height) {
  return {.points = {{left, bottom}, {left + width, bottom}, {left + width, bottom + height}, {left, bottom + height}}};
}
ColliderDef rising_slope(double left, double bottom) {
  return {.points = {{left, bottom}, {left + 1, bottom}, {left + 1, bottom + 1}}};
}
ColliderDef falling_slope(double left, double bottom) {
  return {.points = {{left, bottom}, {left + 1, bottom}, {left, bottom + 1}}};
}

/// The surface of the ground is at `y`.
void add_section(double x, double y, std::vector<ColliderDef>& colliders) {
  for (int row = 1; row <= tile_rows; ++row)
    for (int column = 0; column < section_width; ++column) colliders.push_back(rectangle(x + column, y - row, 1, 1));
  colliders.push_back(rising_slope(x + 2, y));
  colliders.push_back(rectangle(x + 3, y, 1, 1));
  colliders.push_back(rectangle(x + 4, y, 1, 1));
  colliders.push_back(falling_slope(x + 5, y));
  colliders.push_back(rising_slope(x + 10, y));
  colliders.push_back(falling_slope(x + 11, y));
  for (int i = 0; i < 6; ++i) colliders.push_back(rectangle(x + 5 * (i % 3), y + 3 + 2.5 * (i / 3) + i % 3, 3, 0.25));
}

struct Level {
  SceneryDef scenery;
  Vec2d start;  ///< Near the middle.
};

/// As many pieces as asked for, or a few more.
Level make_level(std::int64_t pieces) {
  const auto sections = static_cast<int>((pieces + section_pieces - 1) / section_pieces);
  const int storeys = std::max(1, static_cast<int>(std::sqrt(sections * section_width / section_height)));
  const int per_storey = (sections + storeys - 1) / storeys;
  Level level;
  for (int i = 0; i < sections; ++i)
    add_section(i % per_storey * section_width, i / per_storey * section_height, level.scenery.colliders);
  level.start = {per_storey / 2 * section_width + 0.25, storeys / 2 * section_height + half_of_a_character + 0.02};
  return level;
}

/// The bytes that the process has allocated now, untouched ones included.
std::size_t allocated() noexcept {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The parts of a set-up, the least of all rounds.
class Parts {
 public:
  explicit Parts(benchmark::State& state) : state_(state) {}

  /// @return what `make` made; its time and memory are noted.
  template <class Make>
  auto measured(const std::string& name, const Make& make) {
    const std::size_t before = allocated();
    const auto begin = std::chrono::steady_clock::now();
    auto made = make();
    const double seconds = seconds_since(begin);
    sum_ += seconds;
    note(name + "_ms", seconds * 1e3);
    const auto bytes = static_cast<double>(allocated() - before) / static_cast<double>(state_.range(0));
    bytes_ += bytes;
    state_.counters[name + "_bytes"] = bytes;
    return made;
  }
  void end_round() {
    note("all_ms", sum_ * 1e3);
    state_.SetIterationTime(sum_);
    state_.counters["all_bytes"] = bytes_;
    sum_ = bytes_ = 0;
  }

 private:
  void note(const std::string& name, double milliseconds) {
    const auto known = state_.counters.find(name);
    if (known == state_.counters.end())
      state_.counters[name] = milliseconds;
    else
      known->second.value = std::min(known->second.value, milliseconds);
  }

  benchmark::State& state_;
  double sum_ = 0;    ///< [s]
  double bytes_ = 0;  ///< Per piece.
};

template <class Scalar>
void set_up(benchmark::State& state) {
  const Level level = make_level(state.range(0));
  Parts parts(state);
  for ([[maybe_unused]] auto _ : state) {
    const auto scenery = parts.measured("scenery", [&] { return std::make_unique<Scenery<Scalar>>(level.scenery); });
    const auto controller =
        parts.measured("controller", [&] { return std::make_unique<Controller<Scalar>>(*scenery, CharacterDef{}); });
    const auto scratch = parts.measured("scratch", [&] { return controller->make_scratch(); });
    parts.end_round();
  }
}

/// All pieces as fixtures of one static body, and the tree that the first step would build.
void set_up_box2d(benchmark::State& state) {
  const Level level = make_level(state.range(0));
  Parts parts(state);
  for ([[maybe_unused]] auto _ : state) {
    const auto world = parts.measured("world", [&] {
      auto made = std::make_unique<b2World>(b2Vec2(0, -30));
      const b2BodyDef definition;
      b2Body* const ground = made->CreateBody(&definition);
      for (const ColliderDef& collider : level.scenery.colliders) {
        std::vector<b2Vec2> vertices;
        for (const Vec2d& p : collider.points)
          vertices.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
        b2PolygonShape shape;
        shape.Set(vertices.data(), static_cast<int32>(vertices.size()));
        ground->CreateFixture(&shape, 0);
      }
      return made;
    });
    parts.end_round();
  }
}

/// Walks and jumps, the same in every level.
template <class Scalar>
void step(benchmark::State& state) {
  const Level level = make_level(state.range(0));
  const Scenery<Scalar> scenery(level.scenery);
  const Controller<Scalar> controller(scenery, CharacterDef{});
  Scratch<Scalar> scratch = controller.make_scratch();
  const std::vector<compare::InputEvent> events = compare::random_input(1, walked_steps);
  std::vector<Input> inputs;
  for (int i = 0; i < walked_steps; ++i) inputs.push_back(compare::input_at(events, i));
  StepReport<Scalar> report;
  double least = std::numeric_limits<double>::infinity();
  Vec2d end = level.start;
  for ([[maybe_unused]] auto _ : state) {
    CharacterState<Scalar> character;
    character.position = level.start.cast<Scalar>();
    const auto begin = std::chrono::steady_clock::now();
    for (const Input& input : inputs) controller.step(character, input, {0, -30}, Scalar(frame), scratch, report);
    const double seconds = seconds_since(begin);
    state.SetIterationTime(seconds);
    least = std::min(least, seconds * 1e9 / walked_steps);
    end = character.position.template cast<double>() - level.start;
  }
  state.counters["ns_min"] = least;
  state.counters["end_x"] = end.x();
  state.counters["end_y"] = end.y();
}

void register_for_sizes(const char* name, void (*body)(benchmark::State&), int rounds) {
  benchmark::RegisterBenchmark(name, body)
      ->RangeMultiplier(10)
      ->Range(100, 1'000'000)
      ->Iterations(rounds)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_setup_benchmarks() {
  register_for_sizes("setup/octagon_sweep", set_up<double>, 3);
  register_for_sizes("setup/octagon_sweep_float", set_up<float>, 3);
  register_for_sizes("setup/box2d", set_up_box2d, 3);
  register_for_sizes("pieces/octagon_sweep", step<double>, 25);
  register_for_sizes("pieces/octagon_sweep_float", step<float>, 25);
}

}  // namespace paperproof::benchmarks
