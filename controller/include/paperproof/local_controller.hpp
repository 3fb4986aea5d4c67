/// A controller that reads what is near its character anew in each step.
#pragma once

#include <paperproof/controller.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace paperproof {

/// Where a mover is: a point v of its colliders is at position + R(angle) v.
struct Pose {
  Vec2d position{Vec2d::Zero()};  ///< [m]
  double angle = 0;               ///< Counter-clockwise [rad].
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// The place of a mover when a step begins, and when it ends.
struct PoseMotion {
  Pose from{};  ///< `to` of the step before, bit for bit.
  Pose to{};
};

/// A collider that may be in a character's way during a step.
struct NearCollider {
  ColliderIndex id = no_collider;  ///< Reports and state name it so.
  std::uint64_t version = 0;       ///< Another one for another definition.
  const ColliderDef* def = nullptr;
  /// What moves it: any number. Colliders of one mover have the same motion. `no_mover`: it stands.
  MoverIndex mover = no_mover;
  PoseMotion motion{};
};

/// How a collider went in a step: between two instants each vertex goes evenly on a straight line.
struct TurnedCollider {
  ColliderIndex collider = no_collider;
  std::vector<double> instants;  ///< Fractions of the step, ascending from 0 to 1.
  /// At each instant: the points of its definition, then those of its holes [m]; of a circle its centre.
  std::vector<std::vector<Vec2d>> vertices;
};

/// Steps one character through whatever a function finds near it: `LevelController` and `box2d::Hero` are made of it.
///
/// While the colliders that are found stay the same, a step costs no more than one of a `Controller`, and allocates
/// nothing. Otherwise it makes anew what came, changed or turned.
///
/// **What turns.** A step among movers that turn consists of 1, 2, 4, ... or 32 shorter steps, so many that nothing
/// near the character is turned by more than `most_turned` at once. Each begins with a millionth of its time in which
/// each mover turns by its angle about a pivot, every vertex on a straight line, while everything else stands. The
/// pivot is the corner of the character that will be nearest to the mover, or a corner of the mover beneath it. If it
/// comes to overlap the character, the character goes straight to the nearest free position meanwhile. Then all movers
/// go straight to their places. So what is near the character turns under its foot, and `turned()` gives every vertex
/// at all times.
///
/// A circle does not turn in this sense: its centre goes straight, and its surface carries like a conveyor.
///
/// That the character's way is clear of what turns is proved for each step. Where no number of parts has a proof, the
/// character goes straight to a free position, or stays in place, and what reaches it crushes it. Among movers that
/// turn, gravity acts in each of the shorter steps; the report says what was requested as if the first of them were the
/// whole. One-way colliders that turn are not proved.
///
/// Not thread-safe.
class LocalController {
 public:
  /// Finds all colliders that come into a box during the step, in any order, each once or more often.
  using Find = std::function<void(const Box2& box, std::vector<NearCollider>& found)>;

  /// How far a point near the character goes at most where a mover turns at once [m]. Zero: many short steps. Large:
  /// the far side of a plank is ahead of its near side.
  static constexpr double most_turned = 0.05;

  /// @throws InvalidCharacter
  explicit LocalController(const CharacterDef& character);
  ~LocalController();
  LocalController(LocalController&&) noexcept;
  LocalController& operator=(LocalController&&) noexcept;

  /// One step: see `Controller::step`.
  /// @param context without movers. @param find is called at least once, and not after the call returns.
  StepStatus step(CharacterState& state, const Input& input, const StepContext& context, const Find& find,
                  StepReport& report);
  /// See `Controller::move`.
  StepStatus move(CharacterState& state, const Vec2d& displacement, const StepContext& context, const Find& find,
                  StepReport& report);
  /// A step in which the character stays where it is, and what reaches it crushes it. Its velocity is zero then.
  /// @return `crushed` if something reached the character, else `stuck` if something overlaps it at the end, else
  /// `moved`.
  StepStatus wait(CharacterState& state, const StepContext& context, const Find& find, StepReport& report);
  /// See `Controller::overlaps`. @param at_end movers are where their motions end; else where they begin.
  [[nodiscard]] std::optional<std::size_t> overlaps(const Vec2d& position, const StepContext& context, const Find& find,
                                                    bool at_end = false, std::span<ColliderIndex> found = {});

  /// What moved near the character in the last step; empty where nothing near it turned. Valid until the next call.
  [[nodiscard]] std::span<const TurnedCollider> turned() const noexcept;
  /// The box in which colliders were looked for last: while a step needs no more, the next one looks there again. Where
  /// a `Find` misses what only passes through the box, it decides what is found: a roll-back puts it back.
  [[nodiscard]] const Box2& reach() const noexcept;
  void set_reach(const Box2& box) noexcept;
  /// Colliders near the character that no scenery can be made of: see `InvalidScenery`. Valid until the next call.
  [[nodiscard]] std::span<const ColliderIndex> unusable() const noexcept;
  [[nodiscard]] const CharacterDef& character() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace paperproof
