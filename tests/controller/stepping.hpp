/// A scenery, a controller with one character, and the buttons it is steered with.
#pragma once

#include "controller/article_support.hpp"
#include "support/same_bits.hpp"

#include <paperproof/techniques.hpp>

namespace paperproof::stepping {

using article_tests::chain;
using article_tests::frame;
using article_tests::infinity;
using article_tests::nan;
using article_tests::of_shape;
using article_tests::px;
using article_tests::rectangle;
using compare::degree;
using compare::half_height;
using compare::half_width;
using compare::polygon;
using test::same_bits;

struct Stepper {
  std::unique_ptr<const Scenery> scenery;  ///< Stays where it is when the stepper is moved.
  TechniqueController controller;
  Scratch scratch;
  CharacterState state;
  StepReport report;
  std::vector<MoverMotion> movers;  ///< Of the next step.
  Vec2d gravity{0, -10};
  double dt = 1.0 / 60;

  explicit Stepper(std::vector<ColliderDef> colliders, const CharacterDef& character = {},
                   const TechniqueDef& technique = {})
      : Stepper(std::make_unique<const Scenery>(SceneryDef{std::move(colliders)}),
                [&](const Scenery& level) { return make_controller(level, character, technique); }) {}
  template <class Make>
  Stepper(std::unique_ptr<const Scenery> level, const Make& make)
      : scenery(std::move(level)),
        controller(make(*scenery)),
        scratch(controller.make_scratch()),
        movers(scenery->mover_count()) {}
  Stepper(std::vector<ColliderDef> colliders, const CharacterDef& character, std::string_view kind)
      : Stepper(std::move(colliders), character, TechniqueDef{.name = kind}) {}

  /// For what only `octagon_sweep` does.
  [[nodiscard]] const Controller& sweep() const { return *controller.sweep(); }
  Stepper& at(double x, double y) {
    state.position = Vec2d{x, y};
    return *this;
  }
  Stepper& with_velocity(double x, double y) {
    state.velocity = Vec2d{x, y};
    return *this;
  }
  StepStatus step(const Input& input = {}) {
    return controller.step(state, input, {gravity, dt, movers}, scratch, report);
  }
  /// The mover goes on from where it is.
  StepStatus step_with_mover_by(double x, double y, const Input& input = {}) {
    for (MoverMotion& mover : movers) mover = {mover.to, mover.to + Vec2d{x, y}};
    return step(input);
  }
  /// A step of a second without gravity: the displacement is this, to the last bit.
  const MoveResult& fly(double x, double y) {
    state.velocity = Vec2d{x, y};
    gravity = Vec2d::Zero();
    dt = 1;
    step();
    return report.move;
  }
  void steps(int count, const Input& input = {}) {
    for (int i = 0; i < count; ++i) step(input);
  }
};

/// Every field, NaN and the sign of zero included.
inline bool same_bits(const CharacterState& a, const CharacterState& b) {
  return same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
         same_bits(a.last_free, b.last_free) && same_bits(a.technique_memory, b.technique_memory) &&
         a.has_last_free == b.has_last_free && a.grounded == b.grounded && a.jumping == b.jumping &&
         a.jump_held == b.jump_held && a.jump_pending == b.jump_pending && a.wall_left == b.wall_left &&
         a.wall_right == b.wall_right && a.stuck_steps == b.stuck_steps;
}

}  // namespace paperproof::stepping
