/// A scenery, a controller with one character, and the buttons it is steered with; and shapes.
#pragma once

#include "campaign/random.hpp"
#include "campaign/shapes.hpp"
#include "support/refusal.hpp"
#include "support/same_bits.hpp"

#include <paperproof/techniques.hpp>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace paperproof::stepping {

using compare::box;
using compare::degree;
using compare::half_height;
using compare::half_width;
using compare::polygon;
using compare::Random;
using test::refusal_by;
using test::same_bits;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double frame = 1.0 / 60;

/// One pixel [m]. A power of two: whole pixels are exact in both scalars.
inline constexpr double px = 1.0 / 32;

inline ColliderDef chain(std::vector<Vec2d> points, std::optional<Vec2d> one_way = {}) {
  return {.shape = ColliderDef::Shape::chain, .points = std::move(points), .one_way = one_way};
}

/// Corners of a convex outline, in order of angle.
inline std::vector<Vec2d> on_an_ellipse(Random& random, const Vec2d& centre, const Vec2d& radii) {
  const int corners = 3 + random.below(6);
  const double turn = random.angle();
  std::vector<Vec2d> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 6.283185 * (i + random.between(0, 0.7)) / corners;
    outline.push_back(centre + radii.cwiseProduct(compare::towards(angle)));
  }
  return outline;
}

inline CharacterDef of_shape(const CharacterShape& shape) {
  CharacterDef character;
  character.shape = shape;
  return character;
}

struct Stepper {
  std::unique_ptr<Scenery> scenery;  ///< Stays where it is when the stepper is moved.
  TechniqueController controller;
  Scratch scratch;
  CharacterState state;
  StepReport report;
  std::vector<MoverMotion> movers;  ///< Of the next step.
  Vec2d gravity{0, -10};
  double dt = 1.0 / 60;
  const ColliderFilter* filter = nullptr;
  Vec2d up{0, 1};

  explicit Stepper(std::vector<ColliderDef> colliders, const CharacterDef& character = {},
                   const TechniqueDef& technique = {})
      : Stepper(std::make_unique<Scenery>(SceneryDef{std::move(colliders)}),
                [&](const Scenery& level) { return make_controller(level, character, technique); }) {}
  template <class Make>
  Stepper(std::unique_ptr<Scenery> level, const Make& make)
      : scenery(std::move(level)),
        controller(make(*scenery)),
        scratch(controller.make_scratch()),
        movers(scenery->mover_count()) {}
  Stepper(std::vector<ColliderDef> colliders, const CharacterDef& character, std::string_view kind)
      : Stepper(std::move(colliders), character, TechniqueDef{.name = kind}) {}

  /// For what only `octagon_sweep` does.
  [[nodiscard]] const Controller& sweep() const { return *controller.sweep(); }
  [[nodiscard]] std::vector<Vec2d> hull() const {
    const std::span<const Vec2d> hull = sweep().character().shape.hull();
    return {hull.begin(), hull.end()};
  }
  Stepper& at(double x, double y) {
    state.position = Vec2d{x, y};
    return *this;
  }
  Stepper& with_velocity(double x, double y) {
    state.velocity = Vec2d{x, y};
    return *this;
  }
  [[nodiscard]] StepContext context() const { return {gravity, dt, movers, filter, up}; }
  StepStatus step(const Input& input = {}) { return controller.step(state, input, context(), scratch, report); }
  /// The mover goes on from where it is.
  StepStatus step_with_mover_by(double x, double y, const Input& input = {}) {
    for (MoverMotion& mover : movers) mover = {mover.to, mover.to + Vec2d{x, y}};
    return step(input);
  }
  StepStatus step_with_movers_to(const Vec2d& place, const Input& input = {}) {
    for (MoverMotion& mover : movers) mover = {mover.to, place};
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
  /// The same from a start in the air.
  const MoveResult& fly_from(const Vec2d& start, const Vec2d& displacement) {
    state = {};
    state.position = start;
    return fly(displacement.x(), displacement.y());
  }
  void steps(int count, const Input& input = {}) {
    for (int i = 0; i < count; ++i) step(input);
  }
};

/// In a game: it pulls down, and ground is at height zero if nothing else is said.
inline Stepper player_in(std::vector<ColliderDef> colliders, const Vec2d& position = {0, half_height + 0.005}) {
  Stepper character(std::move(colliders));
  character.gravity = {0, -30};
  character.state.position = position;
  return character;
}

/// Every field, NaN and the sign of zero included.
inline bool same_bits(const CharacterState& a, const CharacterState& b) {
  return same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
         same_bits(a.last_free, b.last_free) && same_bits(a.technique_memory, b.technique_memory) &&
         a.has_last_free == b.has_last_free && a.grounded == b.grounded && a.jumping == b.jumping &&
         a.jump_held == b.jump_held && a.jump_pending == b.jump_pending && a.wall_left == b.wall_left &&
         a.wall_right == b.wall_right && a.stuck_steps == b.stuck_steps;
}

}  // namespace paperproof::stepping
