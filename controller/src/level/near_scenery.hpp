/// What is near a character, and scenery of it.
#pragma once

#include "level/poses.hpp"

#include <paperproof/local_controller.hpp>

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace paperproof::level {

/// A mover of some of the colliders that are near. Each circle of a mover that turns is a mover of its own: its centre
/// goes straight, and its surface carries like a conveyor.
struct NearMover {
  PoseMotion motion{};
  double surface_speed = 0;  ///< What the turning of a circle adds to that of its surface [m/s].
  bool turns = false;        ///< And it may come near the character.

  [[nodiscard]] double turn() const noexcept { return turns ? motion.to.angle - motion.from.angle : 0; }
};

/// Whether a character meets a collider at all. @param filter of ids; null: it leaves out nothing.
[[nodiscard]] bool is_there(const NearCollider& collider, const ColliderFilter* filter);

/// Reads what is near, and keeps a scenery of it. It puts in what came or changed, and takes out what is gone. In the
/// scenery a collider and a mover have other numbers; outside a collider has an id.
class NearScenery {
 public:
  using Find = LocalController::Find;

  explicit NearScenery(const CharacterDef& character) : character_(character), controller_(scenery_, character) {}

  /// @param needed box. A wider one is read, so that it holds for some steps.
  /// @param context its filter knows ids: what it leaves out does not turn.
  void read(const Box2& needed, const StepContext& context, const Find& find);
  /// Brings the scenery up to what was read, with the angles at a fraction of the step.
  /// @return false if there is a collider that cannot be turned by its angle: rounding made it cross itself.
  [[nodiscard]] bool build(double fraction);

  [[nodiscard]] const CharacterDef& character() const noexcept { return character_; }
  /// See `LocalController::reach`.
  [[nodiscard]] const Box2& reach() const noexcept { return box_; }
  void set_reach(const Box2& box) noexcept { box_ = box; }
  /// What was found in it, by id. Their movers are indices of `movers()`.
  [[nodiscard]] std::span<const NearCollider> colliders() const noexcept { return near_; }
  [[nodiscard]] std::span<const NearMover> movers() const noexcept { return movers_; }
  [[nodiscard]] bool any_turns() const noexcept { return any_turns_; }
  [[nodiscard]] bool any_sensor_turns() const noexcept { return any_sensor_turns_; }
  [[nodiscard]] bool turns(const NearCollider& collider) const noexcept {
    return collider.mover != no_mover && movers_[collider.mover].turns;
  }

  // Of the scenery.
  [[nodiscard]] const Controller& controller() const noexcept { return controller_; }
  [[nodiscard]] Scratch& scratch() noexcept { return scratch_; }
  [[nodiscard]] const NearCollider& at(ColliderIndex collider) const noexcept {
    return *find(id_of_slot_[Scenery::slot_of(collider)]);
  }
  [[nodiscard]] ColliderIndex local_of(ColliderIndex id) const noexcept;
  [[nodiscard]] bool is_in_scenery(ColliderIndex id) const noexcept { return local_of(id) != no_collider; }
  /// Ids of colliders that no scenery can be made of, which are left out.
  [[nodiscard]] std::span<const ColliderIndex> unusable() const noexcept { return unusable_; }
  /// A context for steps and questions in the scenery, valid until the next one is made.
  /// @param motions one for each of `movers()`. @param context its filter knows ids.
  [[nodiscard]] StepContext context(StepContext context, std::span<const MoverMotion> motions);

  /// A collider that is gone carries and crushes no more.
  void to_local(CharacterState& state) const;
  void to_ids(CharacterState& state) const;
  void to_ids(StepReport& report) const;
  void to_ids(std::span<ColliderIndex> colliders) const;

 private:
  /// What of the scenery belongs to a collider that was found.
  struct Known {
    ColliderIndex id;
    ColliderIndex local;
    std::uint64_t version;
    MoverIndex mover;
    double angle;
    double surface_speed;
    friend bool operator==(const Known&, const Known&) = default;
  };
  /// A filter of colliders by their ids.
  struct FilterOfIds {
    ColliderFilter filter{};
    std::span<const ColliderIndex> ids{};
  };

  void number_movers(double dt);
  void note_what_turns(const Box2& needed, const ColliderFilter* filter);
  void take_out_what_is_gone();
  [[nodiscard]] Known wanted_of(const NearCollider& collider, double fraction) const;
  [[nodiscard]] bool put(const NearCollider& collider, Known wanted);
  void leave_out_refused();
  [[nodiscard]] const NearCollider* find(ColliderIndex id) const noexcept;
  [[nodiscard]] ColliderIndex id_of(ColliderIndex local) const noexcept { return id_of_slot_[Scenery::slot_of(local)]; }

  CharacterDef character_;
  Box2 box_{Vec2d::Constant(1), Vec2d::Constant(-1)};
  std::vector<NearCollider> near_;
  std::vector<NearMover> movers_;
  std::vector<std::size_t> moving_;  ///< In `near_`, by mover.
  bool any_turns_ = false;
  bool any_sensor_turns_ = false;
  std::vector<ColliderIndex> unusable_;
  std::vector<std::pair<ColliderIndex, std::uint64_t>> refused_;  ///< Of these, ids and versions.
  Scenery scenery_{SceneryDef{}};
  Controller controller_;
  Scratch scratch_ = controller_.make_scratch();
  std::vector<Known> known_;  ///< By id.
  std::vector<ColliderIndex> id_of_slot_;
  std::vector<MoverMotion> motions_;  ///< Of all movers of the scenery.
  FilterOfIds filter_of_ids_;
  ColliderFilter filter_;  ///< The same, for the scenery.
};

}  // namespace paperproof::level
