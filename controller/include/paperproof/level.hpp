/// A level that changes between steps: colliders come, go and turn.
#pragma once

#include <paperproof/controller.hpp>
#include <paperproof/local_controller.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace paperproof {

/// A scenery that is edited between steps: tiles that break, doors, bridges. To add, replace or remove a collider takes
/// about a microsecond, however large the level is.
using Level = Scenery;

/// The surroundings of a step in a level: see `StepContext`.
struct LevelContext {
  Vec2d gravity{Vec2d::Zero()};          ///< [m/s²]
  double dt = 0;                         ///< [s]
  std::span<const PoseMotion> movers{};  ///< At least `Level::mover_count()`.
  const ColliderFilter* filter = nullptr;
  Vec2d up{0, 1};
};

/// Steps one character through a level. Reports and state name colliders by their ids in the level. A state may be
/// copied, saved and restored; a controller keeps nothing that changes a result.
///
/// Where no mover has an angle, a `Controller` makes the step, and `Controller::reserve` says when it allocates.
/// Otherwise a `LocalController` makes it.
///
/// Not thread-safe: each thread brings its own.
class LevelController {
 public:
  /// @param level must outlive the controller. @throws InvalidCharacter
  LevelController(const Level& level, const CharacterDef& character)
      : level_(&level), straight_(level, character), scratch_(straight_.make_scratch()), local_(character) {}

  /// One step: see `Controller::step`. `invalid_input` also if there are fewer movers than `Level::mover_count()`, or
  /// a pose is not finite or beyond 1e6.
  StepStatus step(CharacterState& state, const Input& input, const LevelContext& context, StepReport& report);
  /// One step of a game that owns its velocities: see `Controller::move`.
  StepStatus move(CharacterState& state, const Vec2d& displacement, const LevelContext& context, StepReport& report);
  /// How many solid colliders a character of this kind would overlap, where the movers' motions begin.
  [[nodiscard]] std::optional<std::size_t> overlaps(const Vec2d& position, const LevelContext& context);
  /// What moved near the character in the last step, as the step saw it; empty where nothing near it turned.
  [[nodiscard]] std::span<const TurnedCollider> turned() const noexcept {
    return went_straight_ ? std::span<const TurnedCollider>{} : local_.turned();
  }
  [[nodiscard]] const CharacterDef& character() const noexcept { return local_.character(); }

 private:
  /// A definition, kept while its collider has the same version.
  struct Known {
    std::uint64_t version = 0;
    ColliderDef def{};
  };

  [[nodiscard]] bool accepts(const LevelContext& context) const noexcept;
  [[nodiscard]] LocalController::Find finder(const LevelContext& context);
  [[nodiscard]] StepContext context_without_movers(const LevelContext& context) const noexcept;
  [[nodiscard]] StepContext straight_context(const LevelContext& context);
  /// Whether no mover has an angle.
  [[nodiscard]] static bool goes_straight(const LevelContext& context) noexcept;
  void find(MoverIndex mover, const PoseMotion& motion, const Box2& box, std::vector<NearCollider>& found);

  const Level* level_;
  Controller straight_;
  Scratch scratch_;
  bool went_straight_ = true;  ///< In the last step.
  std::vector<MoverMotion> motions_;
  LocalController local_;
  std::unordered_map<ColliderIndex, Known> known_;
  std::vector<PieceIndex> pieces_;
  std::vector<NearCollider> standing_;  ///< In `read_`, after `last_edit_`.
  Box2 read_{Vec2d::Constant(1), Vec2d::Constant(-1)};
  std::uint64_t last_edit_ = 0;
};

}  // namespace paperproof
