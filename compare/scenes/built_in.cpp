#include "scenes/built_in.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace paperproof::compare {

const std::vector<BuiltInScene>& built_in_scenes() {
  static const std::vector<BuiltInScene> all = [] {
    std::vector<BuiltInScene> scenes;
    for (auto theme :
         {paper_scenes(), angle_scenes(), ground_scenes(), article_scenes(), claim_scenes(), limit_scenes(),
          one_way_scenes(), moving_scenes(), body_scenes(), crowd_scenes(), extreme_scenes(), play_scenes()}) {
      scenes.insert(scenes.end(), std::make_move_iterator(theme.begin()), std::make_move_iterator(theme.end()));
    }
    return scenes;
  }();
  return all;
}

Scene flight(double x, double y, double velocity_x, double velocity_y, int steps, double gravity) {
  Scene scene;
  scene.gravity = {0, 0 - gravity};
  scene.steps = steps;
  scene.start.position = {x, y};
  scene.start.velocity = {velocity_x, velocity_y};
  return scene;
}

Scene walk(double x, double y, double move, int steps, double gravity) {
  Scene scene = flight(x, y, 0, 0, steps, gravity);
  scene.input = {steer(0, move)};
  return scene;
}

namespace {

ColliderDef& add(Scene& scene, std::string id, ColliderDef collider) {
  scene.ids.push_back(std::move(id));
  return scene.scenery.colliders.emplace_back(std::move(collider));
}

}  // namespace

ColliderDef& add_polygon(Scene& scene, std::string id, std::vector<Vec2d> points) {
  return add(scene, std::move(id), {.points = std::move(points)});
}

ColliderDef& add_box(Scene& scene, std::string id, double left, double bottom, double right, double top) {
  return add_polygon(scene, std::move(id), {{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

ColliderDef& add_chain(Scene& scene, std::string id, std::vector<Vec2d> points) {
  return add(scene, std::move(id), {.shape = ColliderDef::Shape::chain, .points = std::move(points)});
}

ColliderDef& add_circle(Scene& scene, std::string id, const Vec2d& centre, double radius) {
  return add(scene, std::move(id), {.shape = ColliderDef::Shape::circle, .points = {centre}, .radius = radius});
}

ColliderDef& add_ledge(Scene& scene, std::string id, std::vector<Vec2d> points) {
  ColliderDef& ledge = add_chain(scene, std::move(id), std::move(points));
  ledge.one_way = Vec2d(0, 1);
  return ledge;
}

void move_last(Scene& scene, std::vector<MoverDef::Waypoint> path, MoverDef::Loop loop) {
  scene.scenery.colliders.back().mover = static_cast<MoverIndex>(scene.movers.size());
  scene.movers.push_back({.id = scene.ids.back(), .path = std::move(path), .loop = loop});
}

void let_box2d_move_last(Scene& scene, const Body& body) {
  move_last(scene, {{}});
  scene.movers.back().body = body;
}

double fallen(const Scene& scene, int steps) {
  return -scene.gravity.y() * scene.dt * scene.dt * steps * (steps + 1) / 2;
}

double risen(const Scene& scene, int steps) {
  return scene.character.jump_speed * scene.dt * steps - fallen(scene, steps);
}

double steps_to_fall(const Scene& scene, double way, double speed) {
  for (int step = 0;; ++step) {
    speed -= scene.gravity.y() * scene.dt;
    if (speed * scene.dt >= way) return step + way / (speed * scene.dt);
    way -= speed * scene.dt;
  }
}

double walked(const Scene& scene, int steps) {
  double way = 0;
  for (int step = 1; step <= steps; ++step)
    way += std::min(scene.character.walk_speed, step * scene.character.acceleration * scene.dt) * scene.dt;
  return way;
}

double steps_to_walk(const Scene& scene, double way) {
  int steps = 0;
  while (walked(scene, steps + 1) < way) ++steps;
  const double left = way - walked(scene, steps);
  return steps + left / (walked(scene, steps + 1) - walked(scene, steps));
}

double ulp(double x) { return std::nextafter(std::abs(x), HUGE_VAL) - std::abs(x); }

void ends_at(Scene& scene, double x, double y) {
  scene.answers.push_back(x_is(x));
  scene.answers.push_back(y_is(y));
}

void carried_by(Scene& scene, const std::string& mover, int steps, double rounding) {
  scene.answers.push_back(is(Answer::Of::drift, 0).to(mover).after(steps).within(rounding));
  scene.answers.push_back(count(Answer::Of::in_the_air, 0).after(steps));
}

void rests_after(Scene& scene, int steps) {
  scene.answers.push_back(between(Answer::Of::settled, 0, steps));
  scene.answers.push_back(is(Answer::Of::speed, 0, {1, 0}));
  scene.answers.push_back(is(Answer::Of::speed, 0, {0, 1}));
}

void hold_jump(Scene& scene, int from, int to) {
  scene.input.push_back(press(from));
  scene.input.push_back(release(to));
}

void hold_drop(Scene& scene, int from, int to) {
  scene.input.push_back({.step = from, .move = std::nullopt, .jump = std::nullopt, .drop = true});
  scene.input.push_back({.step = to, .move = std::nullopt, .jump = std::nullopt, .drop = false});
}

}  // namespace paperproof::compare
