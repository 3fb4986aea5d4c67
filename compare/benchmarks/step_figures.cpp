#include "figures.hpp"

#include "level.hpp"

#include "box2d_adapter/src/float_geometry.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/together.hpp>

#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>

#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

namespace paperproof::benchmarks {
namespace {

constexpr int walked_steps = 2000;
constexpr std::size_t many = 10'000;
constexpr std::size_t those_that_meet = 1'000;
constexpr int frames_to_land = 20;
constexpr std::int64_t pieces_of_many = 10'000;
constexpr std::int64_t pieces_of_large = 1'000'000;

/// One character, and with Box2D alone a body that is given the velocities that the controller wanted.
Figures one_character(const Level& level) {
  constexpr int passes = 50;
  const std::vector<Input> inputs = random_walk(1, walked_steps);
  const Scenery scenery(level.scenery);
  const Controller controller(scenery, CharacterDef{});
  Scratch scratch = controller.make_scratch();
  StepReport report;
  const auto walk = [&](const auto& look) {
    CharacterState character;
    character.position = level.start();
    for (const Input& input : inputs) {
      controller.step(character, input, {{0, gravity_y}, frame}, scratch, report);
      look();
    }
  };
  std::vector<b2Vec2> velocities;
  walk([&] { velocities.push_back(box2d::rounded(report.requested / frame)); });

  const std::unique_ptr<b2World> world = make_box2d_level(level);
  b2Body& body = add_box2d_character(*world, CharacterDef{}, level.start());
  const auto run_box2d = [&] {
    body.SetEnabled(false);  // drops its contacts
    body.SetTransform(box2d::rounded(level.start()), 0);
    body.SetEnabled(true);
    for (const b2Vec2& velocity : velocities) {
      body.SetLinearVelocity(velocity);
      advance(*world);
    }
  };
  const auto run = [&] { walk([] {}); };
  return fastest_in_turns(passes, walked_steps, run, run_box2d);
}

/// Where so many characters begin, above the ground of the sections and below their platforms.
/// @param spaced side by side, so that none overlaps another; else anywhere.
std::vector<Vec2d> places(const Level& level, std::size_t count, bool spaced) {
  std::mt19937_64 random(1);
  std::vector<Vec2d> found;
  for (std::size_t i = 0; i < count; ++i) {
    const auto sections = static_cast<std::size_t>(level.sections);
    const std::size_t section = spaced ? i % sections : random() % sections;
    const double along = spaced ? 1.25 * static_cast<double>(i / sections) : static_cast<double>(random() % 15);
    found.push_back(level.start(static_cast<int>(section)) + Vec2d(along, 1));
  }
  return found;
}

/// Characters that all walk and jump, each in its own rhythm, and as many bodies, which are given their velocities.
class Characters {
 public:
  /// @param meet whether the bodies collide with each other.
  Characters(const Level& level, const std::vector<Vec2d>& starts, bool meet)
      : scenery(level.scenery), states(starts.size()), world_(make_box2d_level(level)), velocities_(starts.size()) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      states[i].position = starts[i];
      bodies_.push_back(&add_box2d_character(*world_, CharacterDef{}, starts[i]));
      if (meet) bodies_.back()->GetFixtureList()->SetFilterData({});
    }
  }
  /// What each wants in the next frame.
  void press() {
    for (std::size_t i = 0; i < states.size(); ++i) {
      inputs[i] = walk_[(7 * i + frame_) % walk_.size()];
      velocities_[i] = box2d::rounded(Vec2d(states[i].velocity + Vec2d(0, gravity_y * frame)));
    }
    ++frame_;
  }
  void step_bodies() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i]->SetLinearVelocity(velocities_[i]);
    advance(*world_);
  }

  Scenery scenery;
  std::vector<CharacterState> states;
  std::vector<Input> inputs = std::vector<Input>(states.size());

 private:
  std::vector<Input> walk_ = random_walk(1, walked_steps);
  std::size_t frame_ = 0;
  std::unique_ptr<b2World> world_;
  std::vector<b2Body*> bodies_;
  std::vector<b2Vec2> velocities_;
};

/// @param step of all characters. @return for each of them.
template <class Step>
Figures fastest_frames(Characters& characters, const Step& step) {
  constexpr int passes = 40;
  const auto turn = [&] {
    characters.press();
    return fastest_in_turns(1, static_cast<double>(characters.states.size()), step, [&] { characters.step_bodies(); });
  };
  for (int i = 0; i < frames_to_land; ++i) turn();
  Figures least = turn();
  for (int pass = 1; pass < passes; ++pass)
    for (const auto& [name, value] : turn()) least[name] = std::min(least[name], value);
  return least;
}

/// Many that do not see each other, one after the other.
Figures many_characters(std::size_t scratches_made) {
  const Level level = make_level(pieces_of_many);
  Characters characters(level, places(level, many, false), false);
  const Controller controller(characters.scenery, CharacterDef{});
  std::vector<Scratch> scratches;
  for (std::size_t i = 0; i < scratches_made; ++i) scratches.push_back(controller.make_scratch());
  StepReport report;
  return fastest_frames(characters, [&] {
    for (std::size_t i = 0; i < many; ++i)
      controller.step(characters.states[i], characters.inputs[i], {{0, gravity_y}, frame},
                      scratches[i % scratches.size()], report);
  });
}

/// Those that block, carry and push each other: each with the others, and each alone.
Figures characters_that_meet(bool together) {
  const Level level = make_level(pieces_of_many);
  Characters characters(level, places(level, those_that_meet, true), together);
  std::vector<ColliderIndex> own(those_that_meet, no_collider);
  if (together)
    for (ColliderIndex& body : own) body = characters.scenery.add(body_of(CharacterDef{}));
  const Controller controller(characters.scenery, CharacterDef{});
  Scratch scratch = controller.make_scratch();
  TogetherScratch together_scratch;
  std::vector<StepReport> reports(those_that_meet);
  std::vector<Companion> companions(those_that_meet);
  const StepContext context{{0, gravity_y}, frame};
  return fastest_frames(characters, [&] {
    for (std::size_t i = 0; i < those_that_meet; ++i) {
      if (together)
        companions[i] = {&controller, &characters.states[i], characters.inputs[i], own[i], &scratch, &reports[i]};
      else
        controller.step(characters.states[i], characters.inputs[i], context, scratch, reports[i]);
    }
    if (together) step_together(companions, context, together_scratch);
  });
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
Figures plank(double aside) {
  const bool is_on_it = aside == 0;
  const Level level = make_level(pieces_of_many);
  const Vec2d middle = level.start() + Vec2d(where_nothing_is_above, plank_above_ground);
  const Vec2d start =
      is_on_it ? Vec2d(middle + Vec2d(0, 0.8)) : Vec2d(level.start() + Vec2d(where_nothing_is_above + aside, 0));
  Scenery scenery(level.scenery);
  const ColliderDef def{.points = {{-half_of_plank, -half_thickness},
                                   {half_of_plank, -half_thickness},
                                   {half_of_plank, half_thickness},
                                   {-half_of_plank, half_thickness}},
                        .mover = 0};
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
      advance(*world);
    }
  };
  constexpr int passes = 20;
  const Figures figures = fastest_in_turns(passes, walked_steps, run, run_box2d);
  if (!character.grounded || (character.position.y() > middle.y()) != is_on_it)
    throw std::runtime_error("plank: the character stands elsewhere");
  return figures;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median of many starts, each somewhere in a level that no cache holds.
/// @param depth of the character's feet below the ground [m]. @param expected what becomes of such a start.
Figures start_inside(double depth, StepStatus expected) {
  constexpr int starts = 200;
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
  for (int start = 0; start < starts; ++start) {
    const int section = static_cast<int>(random() % static_cast<std::uint64_t>(level.sections));
    CharacterState character;
    character.position = level.start(section) + Vec2d(0.75, -depth - 0.02);
    body.SetTransform(box2d::rounded(character.position), 0);
    body.SetLinearVelocity({0, static_cast<float>(gravity_y * frame)});
    paperproof.push_back(nanoseconds_of([&] {
      controller.step(character, {}, {{0, gravity_y}, frame}, scratch, report);
    }));
    if (report.status != expected) throw std::runtime_error("start_inside: the start ends otherwise");
    box2d.push_back(nanoseconds_of([&] { advance(*world); }));
  }
  return {{"paperproof", median(paperproof)}, {"box2d", median(box2d)}};
}

}  // namespace

std::vector<Measurement> step_measurements() {
  std::vector<Measurement> all;
  for (std::int64_t pieces = 100; pieces <= pieces_of_large; pieces *= 10)
    all.push_back({"pieces/" + std::to_string(pieces), [=] { return one_character(make_level(pieces)); }});
  all.push_back({"sensors", [] { return one_character(make_level_with_sensors(pieces_of_many, 10'000)); }});
  all.push_back({"characters/own_scratch", [] { return many_characters(many); }});
  all.push_back({"characters/shared_scratch", [] { return many_characters(1); }});
  all.push_back({"those_that_meet/alone", [] { return characters_that_meet(false); }});
  all.push_back({"those_that_meet/together", [] { return characters_that_meet(true); }});
  all.push_back({"plank/on", [] { return plank(0); }});
  all.push_back({"plank/beside", [] { return plank(2.2); }});
  all.push_back({"start_inside/surface", [] { return start_inside(0.1, StepStatus::moved); }});
  all.push_back({"start_inside/deep", [] { return start_inside(3, StepStatus::stuck); }});
  return all;
}

}  // namespace paperproof::benchmarks
