/// A level with several characters in it that take turns, and the buttons they are steered with.
#pragma once

#include "campaign/shapes.hpp"
#include "controller/states.hpp"

#include <paperproof/together.hpp>

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

namespace paperproof::stepping {

/// Where a character that was stopped ends [m].
inline constexpr double least_gap = 1e-7;
inline constexpr double most_gap = 1e-6;
/// Where a character that stands stays [m].
inline constexpr double rest_gap = 5e-7;

struct Together {
  std::unique_ptr<Level> level;
  std::vector<ColliderIndex> bodies;
  std::unique_ptr<const Controller> controller;
  Scratch scratch;
  TogetherScratch turns;
  std::vector<CharacterState> states;
  std::vector<Input> inputs;
  std::vector<StepReport> reports;
  std::vector<std::size_t> turn;    ///< Of each in the last step.
  std::vector<std::size_t> order;   ///< In which they are handed over.
  std::vector<MoverMotion> movers;  ///< Of the next step.
  Vec2d gravity{0, 0};
  Vec2d up{0, 1};
  double dt = 1;

  explicit Together(const std::vector<Vec2d>& positions, const std::vector<ColliderDef>& colliders = {},
                    const CharacterDef& character = {})
      : level(std::make_unique<Level>(SceneryDef{colliders})),
        states(positions.size()),
        inputs(positions.size()),
        reports(positions.size()),
        turn(positions.size()),
        order(positions.size()),
        companions_(positions.size()) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      bodies.push_back(level->add(body_of(character)));
      states[i].position = positions[i];
    }
    controller = std::make_unique<const Controller>(*level, character);
    scratch = controller->make_scratch();
    movers.resize(level->mover_count());
    std::iota(order.begin(), order.end(), std::size_t{0});
  }

  [[nodiscard]] StepContext context() const { return {gravity, dt, movers, nullptr, up}; }
  void step() {
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t i = order[k];
      companions_[k] = {&*controller, &states[i], inputs[i], bodies[i], &scratch, &reports[i]};
    }
    step_together(companions_, context(), turns);
    for (std::size_t k = 0; k < order.size(); ++k) turn[order[k]] = companions_[k].turn;
  }
  /// The one mover turns on to this angle, at its place.
  void step_with_mover_turned_to(double angle) {
    movers[0] = {{0, 0}, {0, 0}, movers[0].to_angle, angle};
    step();
  }
  [[nodiscard]] bool is_body(ColliderIndex collider) const {
    return std::find(bodies.begin(), bodies.end(), collider) != bodies.end();
  }
  /// Contacts of the last step with others.
  [[nodiscard]] std::vector<Contact> met(std::size_t i) const {
    std::vector<Contact> all;
    for (const Contact& contact : reports[i].move.contacts)
      if (is_body(contact.collider)) all.push_back(contact);
    return all;
  }
  /// From right side to left side [m].
  [[nodiscard]] double gap(std::size_t left, std::size_t right) const {
    return states[right].position.x() - states[left].position.x() - 2 * half_width;
  }

 private:
  std::vector<Companion> companions_;
};

[[nodiscard]] inline ColliderDef floor_at_zero() { return box(-20, -1, 20, 0); }

/// In a game: it pulls down, and a step is a frame.
[[nodiscard]] inline Together under_gravity(const std::vector<Vec2d>& positions,
                                            const std::vector<ColliderDef>& colliders,
                                            const CharacterDef& character = {}) {
  Together all(positions, colliders, character);
  all.gravity = {0, -30};
  all.dt = 1.0 / 60;
  return all;
}

/// Standing side by side, at height zero.
[[nodiscard]] inline Together standing(const std::vector<double>& at,
                                       const std::vector<ColliderDef>& colliders = {floor_at_zero()}) {
  std::vector<Vec2d> positions;
  for (const double x : at) positions.emplace_back(x, half_height + rest_gap);
  return under_gravity(positions, colliders);
}

}  // namespace paperproof::stepping
