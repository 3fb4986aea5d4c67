#include "campaign/draw.hpp"
#include "campaign/drawing.hpp"
#include "campaign/shapes.hpp"
#include "campaign/wanderers.hpp"
#include "scenes/step_times.hpp"

#include <paperproof/scenery.hpp>

#include <cmath>
#include <string>

namespace paperproof::compare {
namespace {

/// All keys.
void press_and_drop(Random& random, Input& input) {
  press_keys(random, input);
  input.drop = random.chance(input.drop ? 0.8 : 0.1);
}

/// Any up, or one along or across a side of the scenery: there walls are exactly upright and ground is exactly level,
/// but for rounding.
Vec2d any_up(const Scenery& scenery, Random& random) {
  const Vec2d up = towards(random.angle());
  if (!random.chance(0.4)) return up;
  const int last = static_cast<int>(scenery.pieces().size()) - 1;
  const auto vertices = scenery.vertices_of(static_cast<PieceIndex>(random.integer(0, last)));
  const Vec2d along = (vertices[1] - vertices[0]).normalized();
  return random.chance(0.5) ? Vec2d{-along.y(), along.x()} : along;
}

/// Goes at one speed through points, and back.
struct Shuttle {
  std::vector<Vec2d> points;
  double speed = 0;  ///< [m/s]

  [[nodiscard]] Vec2d at(double time) const {
    double length = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
    double along = std::fmod(time * speed, 2 * length);
    if (along > length) along = 2 * length - along;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double leg = (points[i + 1] - points[i]).norm();
      if (along <= leg && leg > 0) return points[i] + (points[i + 1] - points[i]) * (along / leg);
      along -= leg;
    }
    return points.back();
  }
};

}  // namespace

RandomRun draw_still(Terrain terrain, std::uint64_t seed, bool up_turns) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  run.reach = 12;
  run.centre = random.chance(0.7) ? Vec2d{0, 0} : Vec2d{far(random), far(random)};
  scene.scenery = random_terrain(terrain, random, run.centre);
  draw_rules(random, scene.character);
  scene.start.position = run.centre + Vec2d{random.between(-4, 4), random.between(-3, 5)};
  if (terrain == Terrain::shafts)
    scene.start.position = run.centre + Vec2d{random.chance(0.5) ? 0 : random.between(-1, 1), 3};
  if (terrain == Terrain::lattice) scene.start.position = round_to_pixels(scene.start.position);
  run.may_begin_inside = random.chance(0.1);
  const double gravity = random.chance(0.9) ? 30 : random.log_between(1, 1e6);
  scene.gravity = {0, -gravity};
  std::optional<Scenery> sides;
  if (up_turns) sides.emplace(scene.scenery);
  Vec2d up{0, 1};
  if (up_turns) up = any_up(*sides, random);
  scene.dt = random.chance(0.7) ? 1.0 / 60 : random.log_between(1e-4, 1);
  scene.steps = 40;
  InputNotes notes(scene.input);
  Input input;
  for (int step = 0; step < scene.steps; ++step) {
    press_and_drop(random, input);
    notes.note(step, input);
    if (random.chance(0.2)) {
      const double speed = random.log_between(1e-3, random.chance(0.3) ? 1e6 : 20) / scene.dt;
      Vec2d velocity = towards(any_direction(random)) * speed;
      if (random.chance(0.2)) velocity.x() = 0;
      add_launch(run, {.step = step, .velocity = velocity});
    }
    if (up_turns && random.chance(0.1)) up = any_up(*sides, random);
    if (up_turns) run.ups.push_back(up);
  }
  add_sensors(run, seed);
  return run;
}

RandomRun draw_among_movers(Terrain terrain, std::uint64_t seed, bool up_turns) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  run.reach = 14;
  run.may_begin_inside = true;
  run.centre = random.chance(0.8) ? Vec2d{0, 0} : Vec2d{far(random), far(random)};
  if (random.chance(0.8)) scene.scenery = random_terrain(terrain, random, run.centre);
  const int movers = random.chance(0.1) ? 64 : random.integer(1, 8);
  for (int i = 0; i < movers; ++i) add_mover(scene.scenery.colliders, static_cast<MoverIndex>(i), random, run.centre);
  if (terrain == Terrain::circles) round_movers(scene.scenery.colliders, random);
  draw_rules(random, scene.character);
  scene.start.position = run.centre + Vec2d{random.between(-4, 4), random.between(-3, 5)};
  scene.dt = random.chance(0.7) ? 1.0 / 60 : random.log_between(1e-3, 0.1);
  scene.steps = 60;
  const StepTimes times(scene);
  std::vector<Wanderer> wanderers(static_cast<std::size_t>(movers));
  for (int i = 0; i < movers; ++i) scene.movers.push_back({.id = std::to_string(i), .path = {{0, Vec2d::Zero()}}});
  InputNotes notes(scene.input);
  Input input;
  Vec2d up{0, 1};
  for (int step = 0; step < scene.steps; ++step) {
    press_and_drop(random, input);
    notes.note(step, input);
    if (random.chance(0.05)) {
      const double speed = random.log_between(1e-3, random.chance(0.2) ? 1e6 : 10) / scene.dt;
      add_launch(run, {.step = step, .velocity = towards(random.angle()) * speed});
    }
    for (std::size_t i = 0; i < wanderers.size(); ++i) {
      std::vector<MoverDef::Waypoint>& path = scene.movers[i].path;
      path.push_back({times.end(step), next_offset(wanderers[i], path.back().at, random)});
    }
    if (up_turns && (step == 0 || random.chance(0.1))) up = towards(random.angle());
    if (up_turns) run.ups.push_back(up);
  }
  add_sensors(run, seed);
  return run;
}

namespace {

/// The walls of a chamber, and presses that begin beside it and go to some places in it.
class Chamber {
 public:
  Chamber(Random& random, RandomRun& run, bool rims) : random_(random), scene_(run.scene), rims_(rims) {
    height_ = random_.between(1.4, 3);
    width_ = random_.between(0.8, 2.5);
    std::vector<ColliderDef>& walls = scene_.scenery.colliders;
    walls = {box(-6, -1, 6, 0), box(-6, height_, 6, height_ + 1), box(-6, 0, -width_, height_),
             box(width_, 0, 6, height_)};
    if (random_.chance(0.4)) walls.erase(walls.begin() + random_.integer(1, 3));
    const int count = random_.integer(2, 4);
    for (int i = 0; i < count; ++i) shuttles.push_back(press(static_cast<MoverIndex>(i)));
  }

  std::vector<Shuttle> shuttles;

 private:
  Shuttle press(MoverIndex mover) {
    constexpr std::array speeds{1, 3, 10, 30};
    const double width = random_.between(0.1, 1);
    const double height = random_.between(0.05, 0.6);
    const double across = random_.between(-width_, width_);
    const double up = random_.between(0, height_);
    const bool sideways = random_.chance(0.5);
    const double away = random_.between(0, 1);
    Vec2d at(across, random_.chance(0.5) ? height_ + away : -height - away);
    if (sideways) at = {random_.chance(0.5) ? width_ + away : -width_ - width - away, up};
    ColliderDef def = box(at.x(), at.y(), at.x() + width, at.y() + height, mover);
    if (random_.chance(0.3)) def.points = {at, {at.x() + width, at.y()}, {at.x() + width / 2, at.y() + height}};
    scene_.scenery.colliders.push_back(def);
    if (rims_) add_rims(at, width, mover);
    Shuttle shuttle{{Vec2d{0, 0}}, static_cast<double>(speeds[static_cast<std::size_t>(random_.integer(0, 3))])};
    for (int points = random_.integer(1, 4); points > 0; --points) {
      Vec2d to;
      to.x() = random_.between(-width_, width_) - width / 2 - at.x();
      to.y() = random_.between(0, height_) - height / 2 - at.y();
      if (random_.chance(0.5)) to[sideways ? 1 : 0] = shuttle.points.back()[sideways ? 1 : 0];
      shuttle.points.push_back(to);
    }
    return shuttle;
  }

  /// Walls on both sides of a press, flush with it: it becomes a bucket.
  void add_rims(const Vec2d& at, double width, MoverIndex mover) {
    constexpr double thick = 0.1;
    const double height = random_.between(0.2, 1.2);
    for (const double left : {at.x() - thick, at.x() + width})
      scene_.scenery.colliders.push_back(box(left, at.y(), left + thick, at.y() + height, mover));
  }

  Random& random_;
  Scene& scene_;
  bool rims_;
  double height_ = 0;
  double width_ = 0;
};

}  // namespace

RandomRun draw_among_presses(bool rims, std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  run.reach = 9;
  run.may_begin_inside = true;
  const Chamber chamber(random, run, rims);
  scene.start.position = {random.between(-0.3, 0.3), half_height + 1e-5};
  constexpr std::array steps_a_second{60, 60, 30, 20};
  constexpr std::array pulls{0, -10, -30};
  scene.dt = 1.0 / steps_a_second[static_cast<std::size_t>(random.integer(0, 3))];
  scene.gravity = {0, static_cast<double>(pulls[static_cast<std::size_t>(random.integer(0, 2))])};
  scene.steps = 120;
  InputNotes notes(scene.input);
  for (int step = 0; step < scene.steps; step += 11)
    notes.note(step, {.move = random.integer(-1, 1), .jump = random.chance(0.3)});
  for (const Shuttle& shuttle : chamber.shuttles)
    add_sampled_mover(scene, [&](int step) { return shuttle.at(step * scene.dt); });
  return run;
}

RandomRun draw_play(PlayLevel level, int rate, std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  run.may_begin_inside = true;
  scene.scenery = play_level(level, random);
  scene.character.shape = play_shape(random.integer(0, 2));
  if (random.chance(0.5)) scene.character.snap = 0.3;
  scene.start.position = {random.between(-25, 25), 12};
  scene.dt = 1.0 / rate;
  scene.steps = 10 * rate;
  InputNotes notes(scene.input);
  for (int step = 0; step < scene.steps;) {
    const int held = static_cast<int>(random.between(0.2, 2.5) * rate);
    Input input;
    input.move = random.integer(-1, 1);
    input.jump = random.chance(0.25);
    notes.note(step, input);
    step += 1 + held;
  }
  return run;
}

RandomRun draw_slanted(PlayLevel level, std::uint64_t seed) {
  RandomRun run = draw_play(level, 60, seed);
  Random random(~seed);
  run.scene.gravity = 30 * towards(random.between(-150, -30) * degree);
  run.scene.steps = 480;
  if (random.chance(0.5)) run.scene.input.clear();
  return run;
}

RandomRun draw_stairs(PlayLevel level, std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  run.may_begin_inside = true;
  scene.scenery = play_level(level, random);
  const double x = random.between(-25, 25);
  const double y = random.between(-12, -9);
  const double width = random.between(0.3, 4);
  scene.scenery.colliders.push_back(box(x, y, x + width, y + random.between(0.05, 0.5), 0));
  scene.character.shape = play_shape(random.integer(0, 2));
  scene.character.step_height = random.between(0.1, 0.6);
  scene.character.snap = random.between(0.01, 0.6);
  scene.dt = 1.0 / random.integer(30, 120);
  scene.start.position = {random.between(-25, 25), random.between(-8, 8)};
  const Vec2d speed{random.between(-2, 2), random.between(-1, 1)};
  scene.steps = 200;
  const StepTimes times(scene);
  scene.movers = {{.id = "lift", .path = {{0, Vec2d::Zero()}}}};
  InputNotes notes(scene.input);
  for (int step = 0; step < scene.steps; ++step) {
    if (step % 25 == 0) {
      Input input;
      input.move = random.chance(0.5) ? 1.0 : random.between(-1, 1);
      input.jump = random.chance(0.1);
      notes.note(step, input);
    }
    const Vec2d by = (step / 50 % 2 == 0 ? speed : Vec2d(-speed)) * scene.dt;
    std::vector<MoverDef::Waypoint>& path = scene.movers[0].path;
    path.push_back({times.end(step), path.back().at + by});
  }
  return run;
}

}  // namespace paperproof::compare
