/// A scenery with several characters in it, and the buttons they are steered with.
#pragma once

#include "campaign/shapes.hpp"
#include "controller/states.hpp"

#include <paperproof/techniques.hpp>

#include <memory>
#include <vector>

namespace paperproof::stepping {

/// Where a character that was stopped ends [m].
inline constexpr double least_gap = 1e-7;
inline constexpr double most_gap = 1e-6;
/// Where a character that stands stays [m].
inline constexpr double rest_gap = 5e-7;

[[nodiscard]] inline bool gap_of_a_contact(double gap) { return gap > least_gap - 1e-9 && gap < most_gap; }

struct Together {
  std::unique_ptr<const Scenery> scenery;
  TechniqueCrowd crowd;
  CrowdScratch scratch;
  CrowdReport report;
  std::vector<CharacterState> states;
  std::vector<Input> inputs;
  std::vector<MoverMotion> movers;  ///< Of the next step.
  Vec2d gravity{0, 0};
  double dt = 1;

  explicit Together(std::vector<Vec2d> positions, std::vector<ColliderDef> colliders = {},
                    const CharacterDef& character = {}, const TechniqueDef& technique = {})
      : scenery(std::make_unique<const Scenery>(SceneryDef{std::move(colliders)})),
        crowd(make_crowd(*scenery, character, technique)),
        scratch(crowd.make_scratch(positions.size())),
        report(positions.size()),
        states(positions.size()),
        inputs(positions.size()),
        movers(scenery->mover_count()) {
    for (std::size_t i = 0; i < positions.size(); ++i) states[i].position = positions[i];
  }
  StepStatus step() { return crowd.step(states, inputs, {gravity, dt, movers}, scratch, report); }
  /// The movers go on from where they are, each by its way.
  StepStatus step_with_movers_by(const std::vector<Vec2d>& ways) {
    for (std::size_t k = 0; k < movers.size(); ++k) movers[k] = {movers[k].to, movers[k].to + ways[k]};
    return step();
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  /// From right side to left side [m].
  [[nodiscard]] double gap(std::size_t left, std::size_t right) const {
    return states[right].position.x() - states[left].position.x() - 2 * half_width;
  }
};

[[nodiscard]] inline ColliderDef floor_at_zero() { return rectangle(-20, -1, 20, 0); }

/// In a game: it pulls down, and a step is a frame.
[[nodiscard]] inline Together under_gravity(std::vector<Vec2d> positions, std::vector<ColliderDef> colliders,
                                            const CharacterDef& character = {}, const TechniqueDef& technique = {}) {
  Together all(std::move(positions), std::move(colliders), character, technique);
  all.gravity = {0, -30};
  all.dt = 1.0 / 60;
  return all;
}

/// Standing side by side, at height zero.
[[nodiscard]] inline Together standing(const std::vector<double>& at,
                                       std::vector<ColliderDef> colliders = {floor_at_zero()}) {
  std::vector<Vec2d> positions;
  for (const double x : at) positions.push_back({x, half_height + rest_gap});
  return under_gravity(std::move(positions), std::move(colliders));
}

}  // namespace paperproof::stepping
