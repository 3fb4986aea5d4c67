/// What a character wants that another engine moves: the same as ours would in its place.
#pragma once

#include "oracle/exact.hpp"
#include "runs/contender.hpp"

#include <memory>
#include <optional>

namespace paperproof::compare {

/// A character as the harness follows it, while the engine has the body.
struct EngineCharacter {
  CharacterState state;
  Vec2d ground_normal{Vec2d::UnitY()};  ///< Of what the ride is on.
  double steered = 0;                   ///< See `DesiredVelocity`, of the present step [m/s].
};

/// What an engine says that a character stands on.
struct EngineGround {
  ColliderIndex collider = 0;
  Vec2d normal{Vec2d::UnitY()};
};

/// How a step of the engine ended.
struct EngineStep {
  Vec2d velocity{Vec2d::Zero()};  ///< [m/s]
  bool grounded = false;
  std::optional<EngineGround> ground{};
};

/// A new story of it begins there.
[[nodiscard]] EngineCharacter character_at(const Pose& pose);
/// @param position where the engine has its body.
[[nodiscard]] Pose pose_of(const EngineCharacter& character, const Vec2d& position);

/// Empties what a step of an engine writes anew.
void clear(TraceStep& record);

/// The common law of intent, for engines that know velocities and no riders. Not thread-safe.
class EngineIntent {
 public:
  /// @param header with the character and the scenery as run; must outlive this.
  explicit EngineIntent(const TraceHeader& header) : header_(header) {}

  /// The velocity that is wanted in this step [m/s]. On ground that carries it is relative to that, as it is for the
  /// controller. Notes what was steered. @param at where the character is.
  [[nodiscard]] Vec2d wanted(EngineCharacter& who, const Vec2d& at, const Input& player, const StepInput& input);
  /// @param input of the step that ended. @param contacts in it.
  void take_over(const EngineStep& step, const StepInput& input, std::span<const Contact> contacts,
                 EngineCharacter& who) const;

 private:
  [[nodiscard]] Vec2d velocity_of_ground(ColliderIndex ground, const Vec2d& normal, const StepInput& input) const;

  const TraceHeader& header_;
  std::unique_ptr<ExactScenery> solids_;  ///< Made where a wall may forbid a jump.
};

}  // namespace paperproof::compare
