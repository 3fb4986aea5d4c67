/// The controller: intent and gravity in, one step of motion out.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/report.hpp>
#include <paperproof/step_context.hpp>
#include <paperproof/tolerances.hpp>

#include <array>
#include <memory>
#include <optional>

namespace paperproof {

/// The velocity that a character wants in one step, before any obstacle changes it.
struct DesiredVelocity {
  Vec2d velocity{Vec2d::Zero()};  ///< [m/s]
  /// The part of `velocity.x()` that this step's steering added, braking included [m/s]. The rest is momentum and
  /// gravity.
  double steered = 0;
};

/// Computes the velocity that a character wants in this step, before any obstacle changes it, and updates the jump
/// flags. Up is (0, 1). Common to every contender, the Box2D twin included: horizontal speed approaches `move *
/// walk_speed`; on the ground a climb that is not steeper than walkable ground slows with it; a jump that is allowed
/// sets the upward speed once; then gravity, with the fall speed limited (semi-implicit Euler: the displacement of the
/// step is this velocity times dt).
/// @param state its flags `jump_held`, `jump_pending`, `jumping`, `grounded` are updated; position and velocity are
/// not.
/// @param wall_ahead a wall is within `CharacterDef::wall_reach` on the side of the move: see `no_jump_toward_wall`.
[[nodiscard]] DesiredVelocity desired_velocity(const CharacterDef& character, const Vec2d& gravity, const Input& input,
                                               double dt, CharacterState& state, bool wall_ahead = false) noexcept;

namespace octagon_sweep {
class SweepInParts;
struct Around;
struct StepRequest;
}  // namespace octagon_sweep
namespace turning {
class TurningStep;
struct Wish;
}  // namespace turning

/// How a collider went in a step: between two instants each vertex goes evenly on a straight line.
struct TurnedCollider {
  ColliderIndex collider = no_collider;
  std::vector<double> instants;  ///< Fractions of the step, ascending from 0 to 1.
  /// At each instant: the points of its definition, then those of its holes [m]; of a circle its centre.
  std::vector<std::vector<Vec2d>> vertices;
};

/// Steps characters of one kind through one scenery, by `octagon_sweep`. Const and shareable between threads.
///
/// **What turns.** A step among movers that turn consists of 1, 2, 4, ... or 32 shorter steps, so many that nothing
/// near the character is turned by more than `most_turned` at once. Each begins with a millionth of its time in which
/// each mover turns by its angle about a pivot, every vertex on a straight line, while everything else stands. The
/// pivot is the corner of the character that will be nearest to the mover, or a corner of the mover beneath it. If it
/// comes to overlap the character, the character goes straight to the nearest free position meanwhile. Then all movers
/// go straight to their places. So a plank turns under the character's foot. `turned` gives every vertex at all times.
///
/// A circle does not turn in this sense: its centre goes straight, and its surface carries like a conveyor.
///
/// That the character's way is clear of what turns is proved for each step. Where no number of parts has a proof, the
/// character goes straight to a free position, or stays in place, and what reaches it crushes it. Among movers that
/// turn, gravity acts in each of the shorter steps; `StepReport::requested` is that of the first of them, scaled to the
/// whole step. One-way colliders that turn are not proved.
class Controller {
 public:
  /// How far a point near the character goes at most where a mover turns at once [m]. Zero: many short steps. Large:
  /// the far side of a plank is ahead of its near side.
  static constexpr double most_turned = 0.05;

  /// `scenery` must outlive the controller.
  /// @throws InvalidCharacter for an impossible character, std::invalid_argument for iterations out of range.
  Controller(const Scenery& scenery, const CharacterDef& character, const SweepDef& sweep = {});

  /// One step: the input and gravity become a velocity, and the character moves by it. `state` is read and written;
  /// nothing else carries over. Allocates as `reserve` says, never throws. Without memory the step is `refused`, and
  /// the scratch must be made anew.
  /// @param scratch made by this controller; any other is invalid input.
  StepStatus step(CharacterState& state, const Input& input, const StepContext& context, Scratch& scratch,
                  StepReport& report) const noexcept;

  /// One step of a game that owns its velocities: the character moves by a displacement, as far as obstacles let it,
  /// and slides along them. No input, jump or gravity is added; gravity is checked, but not used.
  ///
  /// To stay on the ground, and to ride, the character must press on it: give the displacement a part against up, or
  /// the character a `snap`. With `snap`, clear `state.grounded` to leave the ground by less than the climb limit.
  /// Ground that carries the character adds its motion. `state.velocity` is not read; it becomes what obstacles leave
  /// of displacement / dt, the motion of the ground included. A jump that is pending stays so; time passes for it.
  /// @param displacement in the step [m]; relative to what carries the character.
  StepStatus move(CharacterState& state, const Vec2d& displacement, const StepContext& context, Scratch& scratch,
                  StepReport& report) const noexcept;

  /// How what moves near the character went in the last step; empty where nothing near it has an angle. Only where
  /// `Scratch::notes_turned` is set.
  [[nodiscard]] static std::span<const TurnedCollider> turned(const Scratch& scratch) noexcept;

  /// What a step can touch: only a way out of solids may lead farther.
  [[nodiscard]] Box2 reach(const CharacterState& state, const StepContext& context) const noexcept;
  /// What the character may have touched in a move. A game that loads only what is near compares this with what it has
  /// loaded: where it is larger, the game loads more, and makes the step again.
  [[nodiscard]] Box2 reach(const MoveResult& move) const noexcept;

  // Questions about the surroundings of a character of this kind. They move nothing. They read
  // only the movers, the filter and up of the context. Movers have the angles with which they begin. No question is
  // answered with a scratch of another controller, with fewer movers than the scenery's, or about numbers that are out
  // of range.

  /// The first contact of a straight displacement, if there is one: where the character would touch, with the exact
  /// normal and the time of impact as a fraction of the displacement. Movers move at the same time, as in a step; for
  /// movers that stand, each motion must end where it begins. What the character overlaps at the start counts, with
  /// fraction 0, if the displacement leads deeper. A displacement that ends before a surface by less than the gap at
  /// which motions stop (`Tolerances::stop` along the normal) touches it, at fraction 1.
  /// @param position,displacement [m]
  [[nodiscard]] std::optional<Contact> cast(const Vec2d& position, const Vec2d& displacement,
                                            const StepContext& context, Scratch& scratch) const noexcept;

  /// How many solid colliders the character would overlap at a position, exactly. If it is 0, the character fits there.
  /// Movers are where their motions begin. One-way chains do not count.
  /// @param found as many of the colliders as it has room for. @return nothing if the question cannot be answered.
  [[nodiscard]] std::optional<std::size_t> overlaps(const Vec2d& position, const StepContext& context, Scratch& scratch,
                                                    std::span<ColliderIndex> found = {}) const noexcept;

  /// The surfaces that the character would have beside it at a position, nearest first; overlaps are nearest of all and
  /// have a negative separation. The separation is that along the best axis: from corner to corner the distance is up
  /// to 1.42 times as large. Each convex piece gives one contact at most. Movers are where their motions begin. A
  /// one-way chain counts if the character is above it.
  /// @param within the largest separation [m]; below zero: only overlaps that are deeper.
  /// @param found at most as many as it has room for. @return how many were written.
  [[nodiscard]] std::size_t contacts_at(const Vec2d& position, double within, const StepContext& context,
                                        Scratch& scratch, std::span<Contact> found) const noexcept;

  /// The nearest of `contacts_at`.
  [[nodiscard]] std::optional<Contact> nearest(const Vec2d& position, double within, const StepContext& context,
                                               Scratch& scratch) const noexcept {
    std::array<Contact, 1> found;
    if (contacts_at(position, within, context, scratch, found) == 0) return std::nullopt;
    return found[0];
  }

  /// The sensors that the character would be in at a position, as the events of steps say it. Movers are where their
  /// motions begin.
  /// @param found as many of them as it has room for. @return how many they are.
  [[nodiscard]] std::size_t sensors_at(const Vec2d& position, const StepContext& context, Scratch& scratch,
                                       std::span<ColliderIndex> found) const noexcept;

  [[nodiscard]] Scratch make_scratch() const;
  /// Makes a scratch ready for positions in a box: then steps and questions there allocate nothing. Else they allocate
  /// where a piece of the scenery comes near for the first time.
  void reserve(const Box2& positions, Scratch& scratch) const;
  [[nodiscard]] const CharacterDef& character() const noexcept { return character_; }
  [[nodiscard]] const Scenery& scenery() const noexcept { return *scenery_; }

 private:
  using Around = octagon_sweep::Around;
  using StepRequest = octagon_sweep::StepRequest;

  friend class turning::TurningStep;
  StepStatus go(CharacterState& state, const turning::Wish& wish, const StepContext& context, Scratch& scratch,
                StepReport& report) const;
  StepStatus step_in_parts(CharacterState& state, const turning::Wish& wish, const StepContext& context,
                           Scratch& scratch, StepReport& report) const;
  friend Controller make_controller_in_float(const Scenery& scenery, const CharacterDef& character,
                                             const SweepDef& sweep);
  /// @param sweep made for the same character, and for the scenery or one that begins with the same colliders.
  Controller(const Scenery& scenery, const CharacterDef& character,
             std::shared_ptr<const octagon_sweep::SweepInParts> sweep, PieceSearch search);
  /// Whether a wall is within `wall_reach` of the character, on the side that `move` (not zero) points to.
  /// @param tried is overwritten.
  [[nodiscard]] bool has_wall_ahead(const CharacterState& state, double move, const StepContext& context,
                                    Scratch& scratch, MoveResult& tried) const;
  [[nodiscard]] Around around(const StepContext& context, const Scratch& scratch) const;
  /// Begins an accepted step: turns the intent into a request.
  /// @param state must outlive the request, as `here`.
  [[nodiscard]] StepRequest begin_step(const Input& input, const StepContext& context, const Around& here,
                                       bool wall_ahead, CharacterState& state, StepReport& report) const;
  void note_passed(bool drop, const StepContext& context, Scratch& scratch, StepReport& report) const;
  /// Ends the step, after the move has filled `report.move`.
  void end_step(bool drop, const StepContext& context, Scratch& scratch, CharacterState& state,
                StepReport& report) const;
  /// Null: all colliders are there.
  [[nodiscard]] const ColliderFilter* filter_of(const StepContext& context) const {
    static constexpr ColliderFilter usual{};
    const bool asks = search_ == PieceSearch::none || scenery_->counts().filtered > 0;
    return context.filter == nullptr && asks ? &usual : context.filter;
  }
  template <class Ask>
  [[nodiscard]] auto answer(const Vec2d& position, const Vec2d& displacement, double within, const StepContext& context,
                            Scratch& scratch, const Ask& ask) const;

  const Scenery* scenery_;
  PieceSearch search_;
  CharacterDef character_;
  /// Scratch memory refers to it.
  std::shared_ptr<const octagon_sweep::SweepInParts> sweep_;
};

}  // namespace paperproof
