/// The controller: intent and gravity in, one step of motion out.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/octagon_sweep.hpp>

#include <array>
#include <memory>
#include <optional>

namespace paperproof {

/// The velocity that a character wants in one step, before any obstacle changes it.
template <class Scalar>
struct DesiredVelocity {
  Vec2<Scalar> velocity{Vec2<Scalar>::Zero()};  ///< [m/s]
  /// The part of `velocity.x()` that this step's steering added, braking included [m/s]. The rest is momentum and
  /// gravity.
  Scalar steered = 0;
};

/// The surroundings of a step. All characters of a step share them.
template <class Scalar = double>
struct StepContext {
  Vec2<Scalar> gravity{Vec2<Scalar>::Zero()};  ///< [m/s²]
  Scalar dt = 0;                               ///< Duration of the step, above zero [s].
  /// One for each mover of the scenery, within +-2e6 m.
  std::span<const MoverMotion<Scalar>> movers{};
  /// The filter of the characters. If it is null, a default filter is used. A step is as if the colliders that the
  /// filter leaves out were not in the scenery (but see `ColliderFilter` for seams): they give no contact and no event.
  /// `octagon_sweep` alone filters; with another technique a filter is invalid input.
  const ColliderFilter* filter = nullptr;
  /// Up of the characters: any unit vector, which may differ from step to step. It decides what is horizontal (a
  /// positive `Input::move` goes along (up.y, -up.x)), where a jump goes, what `max_fall_speed` limits, which surfaces
  /// are ground, walls and ceilings, how far down `snap` looks, and the sides of contacts. Gravity is a vector of the
  /// world: turn it as well. The flags of a state are those that its last step saw. The shape does not turn, and
  /// whether a motion is free does not depend on up. Invalid input: an up that is not finite, or whose length differs
  /// from 1 by more than the rounding of `Scalar`; and any other than (0, 1) with another technique than
  /// `octagon_sweep`.
  Vec2<Scalar> up{0, 1};
};

/// Computes the velocity that a character wants in this step, before any obstacle changes it, and updates the jump
/// flags. Up is (0, 1). Common to every contender, the Box2D twin included: horizontal speed approaches `move *
/// walk_speed`; on the ground a climb that is not steeper than walkable ground slows with it; a jump that is allowed
/// sets the upward speed once; then gravity, with the fall speed limited (semi-implicit Euler: the displacement of the
/// step is this velocity times dt).
/// @param state its flags `jump_held`, `jump_pending`, `jumping`, `grounded` are updated; position and velocity are
/// not.
template <class Scalar>
[[nodiscard]] DesiredVelocity<Scalar> desired_velocity(const CharacterDef& character, const Vec2<Scalar>& gravity,
                                                       const Input& input, Scalar dt,
                                                       CharacterState<Scalar>& state) noexcept;

enum class StepStatus : std::uint8_t {
  moved,
  dropped,       ///< See MoveStatus.
  stuck,         ///< See MoveStatus.
  crushed,       ///< See MoveStatus.
  out_of_range,  ///< Refused: the step would leave +-2e6 m. Position and velocity are unchanged.
  refused,       ///< Refused by the technique: see `MoveResult::refusal`. Position and velocity are unchanged.
  /// Refused: NaN, infinity, dt <= 0, a mover beyond +-2e6 m or with a speed that is not finite, a number of movers
  /// that differs from the scenery's, a filter or an up that the technique does not read (see `Abilities`), an up that
  /// is no unit vector, scratch memory that another controller made. Nothing changed at all.
  invalid_input,
};

/// Whether a step was refused: nothing moved.
[[nodiscard]] inline bool is_refused(StepStatus status) noexcept {
  switch (status) {
    case StepStatus::moved:
    case StepStatus::dropped:
    case StepStatus::stuck:
    case StepStatus::crushed:
      return false;
    case StepStatus::out_of_range:
    case StepStatus::refused:
    case StepStatus::invalid_input:
      break;
  }
  return true;
}

/// The report of one step. `move` is valid unless the status is `invalid_input`.
template <class Scalar = double>
struct StepReport {
  StepStatus status = StepStatus::moved;
  Vec2<Scalar> requested{Vec2<Scalar>::Zero()};  ///< Wanted displacement [m].
  Scalar steered = 0;  ///< The part of `requested` across up that this step's steering added [m].
  MoveResult<Scalar> move;
  /// In order of time: see `SensorEvent`. If there are more events than it holds, the latest are missing, and it
  /// `overflowed()`.
  FixedVector<SensorEvent<Scalar>, 32> sensors;
  /// One-way chains that the character passed against their normal, or missed by less than a micrometre, in a step
  /// whose input asked to drop. Each chain is listed once, in the order of the indices.
  FixedVector<ColliderIndex, 32> dropped_through;
};

namespace octagon_sweep {
template <class Scalar>
class SweepInParts;
}
template <class Scalar>
class Sensors;
template <class Scalar>
class OneWayChains;
template <class Scalar>
class Crowd;

/// Steps characters of one kind through one scenery. Const and shareable between threads.
template <class Scalar = double>
class Controller {
 public:
  /// Moves by `octagon_sweep`. `scenery` must outlive the controller.
  /// @throws InvalidCharacter, std::invalid_argument as `make_octagon_sweep`.
  Controller(const Scenery<Scalar>& scenery, const CharacterDef& character, const SweepDef& sweep = {});
  /// Moves by another technique, made for the same scenery and character.
  /// @param search of what belongs to the controller: sensors, and the one-way chains that are dropped through.
  Controller(const Scenery<Scalar>& scenery, const CharacterDef& character,
             std::unique_ptr<const Technique<Scalar>> technique, PieceSearch search = PieceSearch::tree);

  /// One step: the input and gravity become a velocity, and the character moves by it. `state` is read and written;
  /// nothing else carries over. Never allocates, never throws.
  /// @param scratch made by this controller; any other is invalid input.
  StepStatus step(CharacterState<Scalar>& state, const Input& input, const StepContext<Scalar>& context,
                  Scratch<Scalar>& scratch, StepReport<Scalar>& report) const noexcept;

  /// One step of a game that owns its velocities: the character moves by a displacement, as far as obstacles let it,
  /// and slides along them. No input, jump or gravity is added; gravity is checked, but not used.
  ///
  /// To stay on the ground, and to ride, the character must press on it: give the displacement a part against up, or
  /// the character a `snap`. With `snap`, clear `state.grounded` to leave the ground by less than the climb limit.
  /// Ground that carries the character adds its motion. `state.velocity` is not read; it becomes what obstacles leave
  /// of displacement / dt, the motion of the ground included. A jump that is pending stays so; time passes for it.
  /// @param displacement in the step [m]; relative to what carries the character.
  StepStatus move(CharacterState<Scalar>& state, const Vec2<Scalar>& displacement, const StepContext<Scalar>& context,
                  Scratch<Scalar>& scratch, StepReport<Scalar>& report) const noexcept;

  // Questions about the surroundings of a character of this kind. They move nothing and allocate nothing. They read
  // only the movers, the filter and up of the context. No question is answered by a controller that does not move by
  // `octagon_sweep`, with a scratch of another controller, with another number of movers than the scenery's, or about
  // numbers that are out of range.

  /// The first contact of a straight displacement, if there is one: where the character would touch, with the exact
  /// normal and the time of impact as a fraction of the displacement. Movers move at the same time, as in a step; for
  /// movers that stand, each motion must end where it begins. What the character overlaps at the start counts, with
  /// fraction 0, if the displacement leads deeper.
  /// @param position,displacement [m]
  [[nodiscard]] std::optional<Contact<Scalar>> cast(const Vec2<Scalar>& position, const Vec2<Scalar>& displacement,
                                                    const StepContext<Scalar>& context,
                                                    Scratch<Scalar>& scratch) const noexcept;

  /// How many solid colliders the character would overlap at a position, exactly. If it is 0, the character fits there.
  /// Movers are where their motions begin. One-way chains do not count.
  /// @param found as many of the colliders as it has room for. @return nothing if the question cannot be answered.
  [[nodiscard]] std::optional<std::size_t> overlaps(const Vec2<Scalar>& position, const StepContext<Scalar>& context,
                                                    Scratch<Scalar>& scratch,
                                                    std::span<ColliderIndex> found = {}) const noexcept;

  /// The surfaces that the character would have beside it at a position, nearest first; overlaps are nearest of all and
  /// have a negative separation. The separation is that along the best axis: from corner to corner the distance is up
  /// to 1.42 times as large. Each convex piece gives one contact at most. Movers are where their motions begin. A
  /// one-way chain counts if the character is above it.
  /// @param within the largest separation [m]; below zero: only overlaps that are deeper.
  /// @param found at most as many as it has room for. @return how many were written.
  [[nodiscard]] std::size_t contacts_at(const Vec2<Scalar>& position, Scalar within, const StepContext<Scalar>& context,
                                        Scratch<Scalar>& scratch, std::span<Contact<Scalar>> found) const noexcept;

  /// The nearest of `contacts_at`.
  [[nodiscard]] std::optional<Contact<Scalar>> nearest(const Vec2<Scalar>& position, Scalar within,
                                                       const StepContext<Scalar>& context,
                                                       Scratch<Scalar>& scratch) const noexcept {
    std::array<Contact<Scalar>, 1> found;
    if (contacts_at(position, within, context, scratch, found) == 0) return std::nullopt;
    return found[0];
  }

  [[nodiscard]] Scratch<Scalar> make_scratch() const { return completed(technique_->make_scratch()); }
  [[nodiscard]] const CharacterDef& character() const noexcept { return character_; }
  [[nodiscard]] const Technique<Scalar>& technique() const noexcept { return *technique_; }

 private:
  [[nodiscard]] bool accepts(const CharacterState<Scalar>& state, const Input& input,
                             const StepContext<Scalar>& context) const noexcept;
  [[nodiscard]] bool accepts_turned(const CharacterState<Scalar>& state, const Input& input,
                                    StepContext<Scalar> context) const noexcept;
  /// Whether a wall is within `wall_reach` of the character, on the side that `move` (not zero) points to.
  /// @param tried is overwritten.
  [[nodiscard]] bool has_wall_ahead(const CharacterState<Scalar>& state, double move,
                                    const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                    MoveResult<Scalar>& tried) const noexcept;
  /// Whether a step or a question may have this up.
  [[nodiscard]] bool accepts(const Vec2<Scalar>& up) const noexcept {
    return is_upright(up) || (is_unit(up) && technique_->abilities().up);
  }
  /// Without up, which is (0, 1) if nothing else is said.
  /// @param crushers of the state as it was; must outlive the request, as `context`.
  [[nodiscard]] MoveRequest<Scalar> request_of(const CharacterState<Scalar>& state, const Crushers<Scalar>& crushers,
                                               const Vec2<Scalar>& displacement, const Vec2<Scalar>& velocity,
                                               Scalar steered, bool drop, bool jumps,
                                               const StepContext<Scalar>& context) const noexcept;
  /// Begins an accepted step: turns the intent into a request.
  [[nodiscard]] MoveRequest<Scalar> begin_step(const Crushers<Scalar>& crushers, const Input& input,
                                               const StepContext<Scalar>& context, bool wall_ahead,
                                               CharacterState<Scalar>& state,
                                               StepReport<Scalar>& report) const noexcept;
  [[nodiscard]] MoveRequest<Scalar> begin_turned_step(const Crushers<Scalar>& crushers, const Input& input,
                                                      const StepContext<Scalar>& context, bool wall_ahead,
                                                      CharacterState<Scalar>& state,
                                                      StepReport<Scalar>& report) const noexcept;
  /// Ends the step, after the move has filled `report.move`.
  void end_step(bool drop, const StepContext<Scalar>& context, Scratch<Scalar>& scratch, CharacterState<Scalar>& state,
                StepReport<Scalar>& report) const noexcept;
  /// Null: all colliders are there.
  [[nodiscard]] const ColliderFilter* filter_of(const StepContext<Scalar>& context) const noexcept {
    static constexpr ColliderFilter usual{};
    return context.filter == nullptr && has_filters_ ? &usual : context.filter;
  }
  /// A technique's scratch, with room for the rest of a step added, and marked with its maker.
  [[nodiscard]] Scratch<Scalar> completed(Scratch<Scalar> scratch) const;

  /// A crowd begins the steps of all its characters, moves them all at once, and then ends their steps.
  /// @param before must outlive the request. @return false if the input is not accepted.
  friend class Crowd<Scalar>;
  bool begin_together(const CharacterState<Scalar>& before, const Input& input, const StepContext<Scalar>& context,
                      CharacterState<Scalar>& state, MoveRequest<Scalar>& request,
                      StepReport<Scalar>& report) const noexcept;
  void end_together(const Input& input, const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                    CharacterState<Scalar>& state, StepReport<Scalar>& report) const noexcept;

  /// Whether a question about a position can be answered.
  [[nodiscard]] bool can_answer(const Vec2<Scalar>& position, const Vec2<Scalar>& displacement,
                                const StepContext<Scalar>& context, const Scratch<Scalar>& scratch) const noexcept;
  [[nodiscard]] MoveRequest<Scalar> question(const Vec2<Scalar>& position, const Vec2<Scalar>& displacement,
                                             const StepContext<Scalar>& context) const noexcept {
    return {.position = position,
            .displacement = displacement,
            .movers = context.movers,
            .filter = filter_of(context),
            .up = context.up};
  }

  const Scenery<Scalar>* scenery_;
  bool has_filters_;  ///< Some collider is not there for every character, or all are asked anyway.
  CharacterDef character_;
  std::shared_ptr<const Technique<Scalar>> technique_;   ///< Has no other owner: scratch memory refers to it.
  const octagon_sweep::SweepInParts<Scalar>* sweep_;     ///< The same, if it is `octagon_sweep`; else null.
  std::shared_ptr<const Sensors<Scalar>> sensors_;       ///< Null where the scenery has none,
  std::shared_ptr<const OneWayChains<Scalar>> one_way_;  ///< and is not asked all the same.
};

extern template class Controller<float>;
extern template class Controller<double>;

}  // namespace paperproof
