#include "campaign/draw.hpp"
#include "campaign/drawing.hpp"
#include "campaign/shapes.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace paperproof::compare {
namespace {

/// Ground from left to right, piece after piece, as a level has it.
class CourseMaker {
 public:
  CourseMaker(Random& random, Scene& scene) : random_(random), scene_(scene) {
    add_ground(20, 0);
    for (int pieces = 10; pieces > 0; --pieces) add_piece();
    add_ground(30, 0);
  }

 private:
  void add_piece() {
    const double width = random_.between(0.4, 3);
    switch (random_.below(8)) {
      case 0:
        return add_ground(width, 0);
      case 1:
        return add_ground(width, width * random_.between(-1.1, 1.1));
      case 2:
        end_.y() -= random_.between(0.02, 0.6);
        return add_ground(width, 0);
      case 3:
        return add_stair(width);
      case 4:
        for (int stairs = random_.integer(2, 5); stairs > 0; --stairs) add_stair(random_.between(0.2, 0.6));
        return;
      case 5: {
        const double up = random_.between(0.05, 0.5);
        add({.shape = ColliderDef::Shape::chain,
             .points = {end_ + Vec2d(width / 3, up), end_ + Vec2d(width, up + random_.between(-0.1, 0.1))}});
        return add_ground(width, 0);
      }
      default:
        return add_lift(width);
    }
  }
  void add_stair(double width) {
    end_.y() += random_.between(0.02, scene_.character.step_height);
    add_ground(width, 0);
  }
  /// Now and then a belt. @param rise to its end [m].
  void add_ground(double width, double rise) {
    const double bottom = end_.y() + std::min(rise, 0.0) - 3;
    const Vec2d begin = end_;
    end_ += Vec2d(width, rise);
    add({.points = {{begin.x(), bottom}, {end_.x(), bottom}, end_, begin}});
  }
  /// Goes to and fro, over a floor far below.
  void add_lift(double width) {
    const auto mover = static_cast<MoverIndex>(scene_.movers.size());
    const double apart = 0.01;
    const Vec2d begin = end_;
    end_.x() += width;
    add(box(begin.x() + apart, begin.y() - 0.3, end_.x() - apart, begin.y(), mover));
    scene_.scenery.colliders.push_back(box(begin.x(), begin.y() - 4, end_.x(), begin.y() - 2.5));
    const double far = random_.between(0.2, 1.5);
    const Vec2d way = random_.chance(0.5) ? Vec2d(0, far) : Vec2d(random_.between(-0.5, 0.5) * far, 0);
    const double time = random_.between(0.7, 3);
    MoverDef lift{.id = "lift_" + std::to_string(mover), .path = {}};
    for (int turn = 0; turn < 9; ++turn) lift.path.push_back({turn * time, turn % 2 == 0 ? Vec2d(0, 0) : way});
    scene_.movers.push_back(lift);
  }
  void add(ColliderDef collider) {
    if (random_.chance(0.3)) collider.surface_speed = random_.between(-5, 5);
    scene_.scenery.colliders.push_back(std::move(collider));
  }

  Random& random_;
  Scene& scene_;
  Vec2d end_{-30, 0};
};

}  // namespace

RandomRun draw_course(std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  Scene& scene = run.scene;
  run.may_begin_inside = true;
  scene.character.step_height = random.between(0.1, 0.4);
  if (random.chance(0.7)) scene.character.snap = random.between(0.05, 0.4);
  scene.character.acceleration = random.log_between(10, 300);
  scene.dt = 1.0 / random.integer(30, 120);
  scene.steps = 300;
  scene.start.position = {-13, half_height + 1e-5};
  const CourseMaker course(random, scene);
  InputNotes notes(scene.input);
  for (int step = 0; step < scene.steps; step += random.integer(10, 60)) {
    const double move = random.chance(0.7) ? 1 : random.integer(-1, 0);
    notes.note(step, {.move = move, .jump = random.chance(0.15)});
  }
  return run;
}

}  // namespace paperproof::compare
