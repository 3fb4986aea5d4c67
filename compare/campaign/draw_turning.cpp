#include "campaign/draw.hpp"
#include "campaign/drawing.hpp"
#include "campaign/shapes.hpp"
#include "oracle/exact.hpp"

#include <cmath>
#include <numbers>

namespace paperproof::compare {
namespace {

/// How one mover goes: evenly, or to and fro, in position and angle.
struct Course {
  Vec2d middle{0, 0};
  Vec2d reach{0, 0};  ///< To and fro by so much [m],
  double pace = 0;    ///< at so many radians of a sine per second.
  double angle = 0;   ///< At first [rad].
  double spin = 0;    ///< [rad/s]
  double swing = 0;   ///< To and fro by so much [rad], at the same pace.

  [[nodiscard]] Vec2d offset_at(double time) const { return middle + std::sin(pace * time) * reach; }
  [[nodiscard]] double angle_at(double time) const { return angle + spin * time + swing * std::sin(pace * time); }
};

/// A room, and what turns in it.
class Room {
 public:
  Room(Turning family, Random& random, SceneryDef& scenery)
      : family_(family), random_(random), colliders_(scenery.colliders) {
    add_box(-8, -1, 8, 0, no_mover);
    add_box(-9, -1, -8, 9, no_mover);
    add_box(8, -1, 9, 9, no_mover);
    if (random_.chance(0.3)) {
      const double left = random_.between(-6, 4);
      const double right = left + random_.between(0.3, 2);
      add_box(left, 0, right, random_.between(0.1, 1), no_mover);
    }
    const int movers = random_.integer(1, 6);
    for (int i = 0; i < movers; ++i) courses.push_back(add_mover(static_cast<MoverIndex>(i)));
  }

  std::vector<Course> courses;

 private:
  void add_box(double left, double bottom, double right, double top, MoverIndex mover) {
    colliders_.push_back(box(left, bottom, right, top, mover));
  }

  Course add_mover(MoverIndex mover) {
    Course course;
    course.middle = {random_.between(-5, 5), 0};
    course.middle.y() = random_.between(0.2, 4);
    course.angle = random_.angle();
    course.pace = random_.between(0.5, 4);
    half_ = random_.between(0.5, 2);
    thin_ = random_.between(0.05, 0.3);
    switch (family_) {
      case Turning::planks:
        course.spin = random_.either_sign_log_between(0.05, random_.chance(0.2) ? 30 : 4);
        add_box(-half_, -thin_, half_, thin_, mover);
        break;
      case Turning::see_saws: {
        const double about = random_.between(-0.5, 0.5) * half_;
        course.angle = random_.chance(0.5) ? 0 : random_.between(-0.5, 0.5);
        course.swing = random_.between(0.05, 1);
        add_box(-half_ + about, -thin_, half_ + about, thin_, mover);
        break;
      }
      case Turning::wheels:
        course.spin = random_.either_sign_log_between(0.05, 6);
        go_to_and_fro(2, 1, course);
        add_wheel(mover);
        break;
      case Turning::presses:
        course.reach = {random_.between(-1, 1), 0};
        course.middle.y() = random_.between(2, 4);
        course.reach.y() = -random_.between(1, 4);
        course.pace = random_.between(2, 6);
        course.angle = random_.between(-0.3, 0.3);
        course.swing = random_.between(-0.5, 0.5);
        add_box(-2 * half_, -3 * thin_, 2 * half_, 3 * thin_, mover);
        break;
      case Turning::papers:
        course.spin = random_.either_sign_log_between(0.05, random_.chance(0.2) ? 30 : 4);
        go_to_and_fro(3, 3, course);
        add_paper(mover);
        break;
      case Turning::balls:
        course.spin = random_.either_sign_log_between(0.05, random_.chance(0.2) ? 30 : 6);
        go_to_and_fro(2, 1, course);
        add_balls(mover);
        break;
    }
    return course;
  }

  void go_to_and_fro(double across, double up, Course& course) {
    course.reach = {random_.between(-across, across), 0};
    course.reach.y() = random_.between(-up, up);
  }

  void add_wheel(MoverIndex mover) {
    const double radius = half_ / 1.5;
    const int corners = random_.integer(5, 12);
    const bool notched = random_.chance(0.3);
    ColliderDef wheel{.points = {}, .mover = mover};
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      const double r = notched && k % 2 == 1 ? 0.6 * radius : radius;
      wheel.points.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    if (random_.chance(0.3)) wheel.surface_speed = random_.between(-3, 3);
    colliders_.push_back(std::move(wheel));
  }

  void add_paper(MoverIndex mover) {
    const double off = random_.between(-1, 1);
    const double thickness = random_.log_between(1e-6, 0.05);
    if (random_.chance(0.4))
      colliders_.push_back(chain({{-half_, off}, {half_, off}}, mover));
    else
      add_box(-half_, off, half_, off + thickness, mover);
  }

  void add_balls(MoverIndex mover) {
    const double off = random_.chance(0.5) ? 0 : random_.between(-1.5, 1.5);
    ColliderDef ball =
        circle({off, 0}, random_.chance(0.2) ? random_.log_between(1e-3, 0.1) : random_.between(0.1, 1.2), mover);
    if (random_.chance(0.3)) ball.surface_speed = random_.between(-3, 3);
    colliders_.push_back(ball);
    if (random_.chance(0.5)) add_box(-half_, off - thin_, half_, off + thin_, mover);
    if (random_.chance(0.5)) {
      ball.points = {{-off, random_.between(-1, 1)}};
      colliders_.push_back(ball);
    }
  }

  Turning family_;
  Random& random_;
  std::vector<ColliderDef>& colliders_;
  double half_ = 0;  ///< Of the length of the next mover [m],
  double thin_ = 0;  ///< and of its thickness.
};

}  // namespace

RandomRun draw_among_turning(Turning family, std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  run.reach = 14;
  scene.gravity = {0, -20};
  const Room room(family, random, scene.scenery);
  draw_rules(random, scene.character);
  scene.dt = random.chance(0.8) ? 1.0 / 60 : random.log_between(1e-3, 0.05);
  scene.steps = 80;
  for (const Course& course : room.courses) {
    MoverDef& mover = add_sampled_mover(scene, [&](int step) { return course.offset_at(step * scene.dt); });
    for (int step = 0; step <= scene.steps; ++step)
      mover.turns.push_back({mover.path[static_cast<std::size_t>(step)].time, course.angle_at(step * scene.dt)});
  }
  const auto hull = scene.character.shape.hull();
  const ExactScenery solids(scenery_at(scene, 0), {hull.begin(), hull.end()});
  do {
    scene.start.position.x() = random.between(-5, 5);
    scene.start.position.y() = random.between(0.7, 6);
  } while (!solids.overlapped(scene.start.position).empty());
  InputNotes notes(scene.input);
  Input input;
  for (int step = 0; step < scene.steps; ++step) {
    press_keys(random, input);
    notes.note(step, input);
    if (!random.chance(0.02)) continue;
    const Vec2d direction = towards(random.angle());
    add_launch(run, {.step = step, .velocity = random.log_between(0.1, 10) / (60 * scene.dt) * direction});
  }
  add_sensors(run, seed);
  return run;
}

}  // namespace paperproof::compare
