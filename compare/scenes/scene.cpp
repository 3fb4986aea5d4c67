#include "scenes/scene.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace paperproof::compare {

namespace {

/// splitmix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014). Ours and not the library's,
/// because the library's distributions give other numbers on other machines.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// In [lowest, highest].
  int between(int lowest, int highest) {
    const std::uint64_t count = static_cast<std::uint64_t>(highest - lowest) + 1;
    return lowest + static_cast<int>(next() % count);
  }

 private:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

}  // namespace

Script script_of(const Scene& scene, int steps) {
  if (scene.moves_at_random) return random_script(scene, *scene.moves_at_random, steps);
  Script script{scene.input};
  for (const OtherCharacter& other : scene.others) script.push_back(other.input);
  return script;
}

Script random_script(const Scene& scene, std::uint64_t seed, int steps) {
  Script script;
  for (std::size_t k = 0; k < character_count(scene); ++k) script.push_back(random_input(seed + k, steps));
  return script;
}

SceneryDef scenery_at(const Scene& scene, double time) {
  SceneryDef placed = scene.scenery;
  for (ColliderDef& collider : placed.colliders) {
    if (collider.mover == no_mover) continue;
    const MoverDef& mover = scene.movers[collider.mover];
    const Vec2d offset = offset_at(mover, time);
    const double angle = angle_at(mover, time);
    const Eigen::Rotation2Dd turn(angle);
    const auto place = [&](Vec2d& point) {
      if (angle != 0) point = turn * point;
      point += offset;
    };
    std::for_each(collider.points.begin(), collider.points.end(), place);
    for (std::vector<Vec2d>& hole : collider.holes) std::for_each(hole.begin(), hole.end(), place);
    if (collider.one_way && angle != 0) collider.one_way = turn * *collider.one_way;
    collider.mover = no_mover;
  }
  return placed;
}

void apply(const InputEvent& event, Input& input) {
  if (event.move) input.move = event.move;
  if (event.jump) input.jump = *event.jump;
  if (event.drop) input.drop = *event.drop;
}

Input input_at(const std::vector<InputEvent>& events, int step) {
  Input input;
  for (const InputEvent& event : events) {
    if (event.step > step) break;
    apply(event, input);
  }
  return input;
}

std::vector<InputEvent> random_input(std::uint64_t seed, int steps) {
  // As often to the left as to the right: a walk that only goes right leaves levels of small platforms at once.
  static constexpr std::array<double, 10> moves{1, 1, 1, -1, -1, -1, 0, 0, 0, 0};
  Random random(seed);
  std::vector<InputEvent> events;
  for (int step = 0; step < steps;) {
    const int held = random.between(15, 120);
    const bool jump = random.between(0, 1) == 1;
    const int press = random.between(4, std::min(30, held - 1));
    const double move = moves[static_cast<std::size_t>(random.between(0, static_cast<int>(moves.size()) - 1))];
    events.push_back({.step = step, .move = move, .jump = jump});
    if (jump && step + press < steps) events.push_back({.step = step + press, .move = std::nullopt, .jump = false});
    step += held;
  }
  return events;
}

}  // namespace paperproof::compare
