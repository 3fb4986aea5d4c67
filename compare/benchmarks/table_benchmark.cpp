#include "table_benchmark.hpp"

#include "level.hpp"

#include "box2d_adapter/src/float_geometry.hpp"

#include <paperproof/controller.hpp>

#include <benchmark/benchmark.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace paperproof::benchmarks {
namespace {

constexpr int walked_steps = 2000;
constexpr std::size_t many = 10'000;
constexpr int frames_to_land = 20;
constexpr std::int64_t pieces_of_many = 10'000;
constexpr std::int64_t pieces_of_large = 1'000'000;
/// As `paperproof compare` and Box2D's manual have them.
constexpr int velocity_iterations = 8;
constexpr int position_iterations = 3;

template <class Run>
double nanoseconds_of(const Run& run) {
  const auto begin = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

/// The fastest pass.
struct Least {
  double nanoseconds = std::numeric_limits<double>::infinity();
  void note(double other) { nanoseconds = std::min(nanoseconds, other); }
};

void report(benchmark::State& state, const Least& paperproof, const Least& box2d, double steps) {
  state.counters["paperproof"] = paperproof.nanoseconds / steps;
  state.counters["box2d"] = box2d.nanoseconds / steps;
  state.counters["ratio"] = box2d.nanoseconds / paperproof.nanoseconds;
}

/// One character with the controller alone.
class Walk {
 public:
  Walk(const Level& level, const std::vector<Input>& inputs)
      : inputs_(inputs), start_(level.start()), scenery_(level.scenery) {}

  /// @param look called after each step with its report.
  template <class Look>
  void run(const Look& look) {
    CharacterState character;
    character.position = start_;
    for (const Input& input : inputs_) {
      controller_.step(character, input, {{0, gravity_y}, frame}, scratch_, report_);
      look(report_);
    }
  }
  void run() {
    run([](const StepReport&) {});
  }

 private:
  const std::vector<Input>& inputs_;
  Vec2d start_;
  Scenery scenery_;
  Controller controller_{scenery_, CharacterDef{}};
  Scratch scratch_ = controller_.make_scratch();
  StepReport report_;
};

/// One character with Box2D alone, given the velocities that the controller wanted.
class Box2dWalk {
 public:
  Box2dWalk(const Level& level, Walk& walk)
      : start_(box2d::rounded(level.start())),
        world_(make_box2d_level(level)),
        body_(add_box2d_character(*world_, CharacterDef{}, level.start())) {
    walk.run([&](const StepReport& step) { velocities_.push_back(box2d::rounded(step.requested / frame)); });
  }
  void run() {
    body_.SetEnabled(false);  // drops its contacts
    body_.SetTransform(start_, 0);
    body_.SetEnabled(true);
    for (const b2Vec2& velocity : velocities_) {
      body_.SetLinearVelocity(velocity);
      world_->Step(static_cast<float>(frame), velocity_iterations, position_iterations);
    }
  }

 private:
  b2Vec2 start_;
  std::unique_ptr<b2World> world_;
  b2Body& body_;
  std::vector<b2Vec2> velocities_;
};

void one_character(benchmark::State& state, const Level& level) {
  const std::vector<Input> inputs = random_walk(1, walked_steps);
  Walk walk(level, inputs);
  Box2dWalk box2d_walk(level, walk);
  Least paperproof;
  Least box2d;
  for ([[maybe_unused]] auto _ : state) {
    paperproof.note(nanoseconds_of([&] { walk.run(); }));
    box2d.note(nanoseconds_of([&] { box2d_walk.run(); }));
  }
  report(state, paperproof, box2d, walked_steps);
}

/// Above the ground of a section, wherever its hills are, and below its platforms.
Vec2d place_above_ground(const Level& level, std::mt19937_64& random) {
  const Vec2d start = level.start(static_cast<int>(random() % static_cast<std::uint64_t>(level.sections)));
  return start + Vec2d(static_cast<double>(random() % 15), 1);
}

/// Many characters that do not see each other.
class Characters {
 public:
  Characters(const Level& level, std::size_t scratches) : scenery_(level.scenery) {
    std::mt19937_64 random(1);
    for (CharacterState& state : states) state.position = place_above_ground(level, random);
    for (std::size_t i = 0; i < scratches; ++i) scratches_.push_back(controller_.make_scratch());
  }
  /// What all of them want in the next frame.
  void press() {
    for (std::size_t i = 0; i < many; ++i) inputs_[i] = walk_[(7 * i + frame_) % walk_.size()];
    ++frame_;
  }
  /// One after the other.
  void step() {
    for (std::size_t i = 0; i < many; ++i)
      controller_.step(states[i], inputs_[i], {{0, gravity_y}, frame}, scratches_[i % scratches_.size()], report_);
  }

  std::vector<CharacterState> states = std::vector<CharacterState>(many);

 private:
  Scenery scenery_;
  Controller controller_{scenery_, CharacterDef{}};
  std::vector<Scratch> scratches_;
  StepReport report_;
  std::vector<Input> walk_ = random_walk(1, walked_steps);
  std::vector<Input> inputs_ = std::vector<Input>(many);
  std::size_t frame_ = 0;
};

/// As many bodies, which go where the characters do.
class Box2dCharacters {
 public:
  Box2dCharacters(const Level& level, const Characters& characters) : world_(make_box2d_level(level)) {
    for (const CharacterState& state : characters.states)
      bodies_.push_back(&add_box2d_character(*world_, CharacterDef{}, state.position));
  }
  void follow(const Characters& characters) {
    for (std::size_t i = 0; i < many; ++i)
      velocities_[i] = box2d::rounded(Vec2d(characters.states[i].velocity + Vec2d(0, gravity_y * frame)));
  }
  void step() {
    for (std::size_t i = 0; i < many; ++i) bodies_[i]->SetLinearVelocity(velocities_[i]);
    world_->Step(static_cast<float>(frame), velocity_iterations, position_iterations);
  }

 private:
  std::unique_ptr<b2World> world_;
  std::vector<b2Body*> bodies_;
  std::vector<b2Vec2> velocities_ = std::vector<b2Vec2>(many);
};

void many_characters(benchmark::State& state, std::size_t scratches) {
  const Level level = make_level(pieces_of_many);
  Characters characters(level, scratches);
  Box2dCharacters bodies(level, characters);
  Least paperproof;
  Least box2d;
  const auto turn = [&] {
    characters.press();
    bodies.follow(characters);
    paperproof.note(nanoseconds_of([&] { characters.step(); }));
    box2d.note(nanoseconds_of([&] { bodies.step(); }));
  };
  for (int i = 0; i < frames_to_land; ++i) turn();
  paperproof = box2d = {};
  for ([[maybe_unused]] auto _ : state) turn();
  report(state, paperproof, box2d, many);
}

/// A plank of 3 m that turns, 1 m above the ground.
constexpr double half_of_plank = 1.5;
constexpr double half_thickness = 0.1;
constexpr double plank_above_ground = 1;
constexpr double where_nothing_is_above = 14.35;
/// How far and how fast it rocks under a character.
constexpr double rocks_by = 0.1;      // [rad]
constexpr double rocks_faster = 0.5;  // [rad/s]
/// How fast it turns round beside a character.
constexpr double turns_by = 2;  // [rad/s]

/// Where the plank is when a step begins [rad].
double angle_at(int step, bool rocks) {
  const double time = step * frame;
  return rocks ? rocks_by * std::sin(rocks_faster / rocks_by * time) : turns_by * time;
}

/// A character that stands while the plank turns.
/// @param aside of the middle of the plank [m]; zero: it stands on the plank, which rocks.
void plank(benchmark::State& state, double aside) {
  const bool is_on_it = aside == 0;
  const Level level = make_level(pieces_of_many);
  const Vec2d middle = level.start() + Vec2d(where_nothing_is_above, plank_above_ground);
  const Vec2d start =
      is_on_it ? Vec2d(middle + Vec2d(0, 0.8)) : Vec2d(level.start() + Vec2d(where_nothing_is_above + aside, 0));
  Scenery scenery(level.scenery);
  ColliderDef def{.points = {{-half_of_plank, -half_thickness},
                             {half_of_plank, -half_thickness},
                             {half_of_plank, half_thickness},
                             {-half_of_plank, half_thickness}}};
  def.mover = 0;
  scenery.add(def);
  const Controller controller(scenery, CharacterDef{});
  Scratch scratch = controller.make_scratch();
  StepReport report_of_step;
  CharacterState character;
  const auto run = [&] {
    character = {};
    character.position = start;
    for (int step = 0; step < walked_steps; ++step) {
      const MoverMotion motion{middle, middle, angle_at(step, is_on_it), angle_at(step + 1, is_on_it)};
      controller.step(character, {.move = 0.0}, {{0, gravity_y}, frame, {&motion, 1}}, scratch, report_of_step);
    }
  };

  const std::unique_ptr<b2World> world = make_box2d_level(level);
  b2BodyDef kinematic;
  kinematic.type = b2_kinematicBody;
  kinematic.position = box2d::rounded(middle);
  b2Body& body_of_plank = *world->CreateBody(&kinematic);
  b2PolygonShape shape;
  shape.SetAsBox(static_cast<float>(half_of_plank), static_cast<float>(half_thickness));
  body_of_plank.CreateFixture(&shape, 0);
  b2Body& body = add_box2d_character(*world, CharacterDef{}, start);
  const auto run_box2d = [&] {
    body.SetTransform(box2d::rounded(start), 0);
    body_of_plank.SetTransform(box2d::rounded(middle), 0);
    body.SetLinearVelocity({0, 0});
    body.SetAwake(true);
    for (int step = 0; step < walked_steps; ++step) {
      const double turn = angle_at(step + 1, is_on_it) - angle_at(step, is_on_it);
      body_of_plank.SetAngularVelocity(static_cast<float>(turn / frame));
      body.SetLinearVelocity({0, body.GetLinearVelocity().y + static_cast<float>(gravity_y * frame)});
      world->Step(static_cast<float>(frame), velocity_iterations, position_iterations);
    }
  };
  Least paperproof;
  Least box2d;
  for ([[maybe_unused]] auto _ : state) {
    paperproof.note(nanoseconds_of(run));
    if (!character.grounded || (character.position.y() > middle.y()) != is_on_it)
      return state.SkipWithError("the character stands elsewhere");
    box2d.note(nanoseconds_of(run_box2d));
  }
  report(state, paperproof, box2d, walked_steps);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// @param depth of the character's feet below the ground [m]. @param expected what becomes of such a start.
void start_inside(benchmark::State& state, double depth, StepStatus expected) {
  const Level level = make_level(pieces_of_large);
  const Scenery scenery(level.scenery);
  const Controller controller(scenery, CharacterDef{});
  Scratch scratch = controller.make_scratch();
  StepReport report;
  const std::unique_ptr<b2World> world = make_box2d_level(level);
  b2Body& body = add_box2d_character(*world, CharacterDef{}, level.start());
  std::mt19937_64 random(1);
  std::vector<double> paperproof;
  std::vector<double> box2d;
  for ([[maybe_unused]] auto _ : state) {
    const int section = static_cast<int>(random() % static_cast<std::uint64_t>(level.sections));
    CharacterState character;
    character.position = level.start(section) + Vec2d(0.75, -depth - 0.02);
    body.SetTransform(box2d::rounded(character.position), 0);
    body.SetLinearVelocity({0, static_cast<float>(gravity_y * frame)});
    paperproof.push_back(nanoseconds_of([&] {
      controller.step(character, {}, {{0, gravity_y}, frame}, scratch, report);
    }));
    if (report.status != expected) return state.SkipWithError("the start ends otherwise");
    box2d.push_back(
        nanoseconds_of([&] { world->Step(static_cast<float>(frame), velocity_iterations, position_iterations); }));
  }
  state.counters["paperproof"] = median(paperproof);
  state.counters["paperproof_most"] = *std::max_element(paperproof.begin(), paperproof.end());
  state.counters["box2d"] = median(box2d);
  state.counters["ratio"] = median(box2d) / median(paperproof);
}

template <class Body>
void add(const std::string& name, int passes, const Body& body) {
  benchmark::RegisterBenchmark(("table/" + name).c_str(), body)->Iterations(passes)->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_table_benchmarks() {
  for (std::int64_t pieces = 100; pieces <= pieces_of_large; pieces *= 10)
    add("pieces/" + std::to_string(pieces), 50,
        [=](benchmark::State& state) { one_character(state, make_level(pieces)); });
  add("sensors/10000", 50,
      [](benchmark::State& state) { one_character(state, make_level_with_sensors(pieces_of_many, 10'000)); });
  add("characters/own_scratch", 40, [](benchmark::State& state) { many_characters(state, many); });
  add("characters/shared_scratch", 40, [](benchmark::State& state) { many_characters(state, 1); });
  add("plank/on", 20, [](benchmark::State& state) { plank(state, 0); });
  add("plank/beside", 20, [](benchmark::State& state) { plank(state, 2.2); });
  add("start_inside/surface", 200, [](benchmark::State& state) { start_inside(state, 0.1, StepStatus::moved); });
  add("start_inside/deep", 200, [](benchmark::State& state) { start_inside(state, 3, StepStatus::stuck); });
}

}  // namespace paperproof::benchmarks
