/// A step among movers that have an angle: see `Controller`. `turning_step.cpp` divides it into shorter ones,
/// `turns.cpp` has how what is near turns and the proof of that, `turned_report.cpp` the report, and `waiting.cpp` the
/// step of a character that only waits or leaves.
#pragma once

#include "geometry/pose.hpp"
#include "step/octagon_sweep.hpp"
#include "step_parts.hpp"
#include "turning/proof.hpp"

#include <paperproof/controller.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace paperproof::turning {

/// Into so many shorter steps a step is divided at most.
inline constexpr int most_parts = 32;

/// The share of a part in which everything turns. So short that a character which waits meanwhile is not 1 um behind.
inline constexpr double turning_share = 0x1p-20;

/// Nothing nearer is proved to be apart [m]. Zero: rounding hides an overlap. Large: a character that is squeezed
/// between surfaces is crushed.
///
/// The ways of the vertices that are reported, the way of the character and its points count as exact. Of places
/// relative to the character's first each component is off by less than 1.5e-10 (vertex and corner together), and the
/// side of an edge by less than 3.4e-10 times its length. In all that is at most 6e-10 with no coordinate beyond 1e6 m,
/// and nothing farther than 1e5 m from the character's first place. Gappa proves it (tests/controller/bounds). The
/// piece itself is at most 5e-11 m beyond the line of its edge, or 3.4e-10 more by rounding: below 1e-9 in all.
inline constexpr double proved = 1e-9;

/// What a step is asked for.
struct Wish {
  const Input* input;  ///< Null: a displacement.
  Vec2d displacement;  ///< [m]
};

/// A collider that moves, and may come near the character.
struct MovingCollider {
  ColliderIndex id = no_collider;
  MoverIndex mover = no_mover;
  MoverMotion motion{};    ///< In the step. Of what goes by itself: its own, without an angle.
  bool by_itself = false;  ///< See `Moving::apart`.
};

/// A part of a step, as fractions of it.
struct Part {
  double begin;
  double end;
  /// Of the character while everything turns, in shares of this time.
  std::vector<PathPoint> way{};

  [[nodiscard]] double turned() const { return begin + (end - begin) * turning_share; }
};

/// Of one scratch. Nothing in it but `turned` outlives a step.
struct Memory final : OwnMemory {
  std::vector<PieceIndex> bodies;  ///< Of other characters, while one takes its turn. Else none.
  std::vector<PieceIndex> apart;   ///< These, then circles that go by themselves in a part. See `Moving::apart`.
  bool is_in_part = false;         ///< The controller makes a shorter step.
  octagon_sweep::Limits limits;    ///< Of that.
  std::vector<MoverMotion> motions_of_all;  ///< While one takes its turn: of movers, then of `bodies`.
  /// Of the present part, once everything has turned: of movers, then of what goes by itself.
  std::vector<MoverMotion> motions;
  std::vector<MoverMotion> motions_apart;  ///< In the step, of `apart`; of circles with the angles of their movers.
  std::vector<bool> turns;                 ///< Whether a mover turns near the character.
  std::vector<MovingCollider> moving;      ///< By id.
  std::vector<PieceIndex> pieces;
  PieceWay way;  ///< Of the piece that is looked at.
  StepReport of_part;
  std::vector<TurnedCollider> turned;
};

/// @param scratch made by a controller.
[[nodiscard]] inline Memory& memory_of(const Scratch& scratch) { return static_cast<Memory&>(*scratch.turning); }

/// One step of one character, or one question about it.
class TurningStep {
 public:
  TurningStep(const Controller& controller, const StepContext& context, Scratch& scratch, StepReport& report);
  ~TurningStep() {
    memory_.apart = memory_.bodies;
    memory_.is_in_part = false;
    memory_.limits = {};
  }
  TurningStep(const TurningStep&) = delete;
  TurningStep& operator=(const TurningStep&) = delete;

  StepStatus step(CharacterState& state, const Wish& wish);
  /// For a question: motions in which movers keep the angle with which they begin, and of the circles among them.
  /// @param around what is asked about. @return valid until the next step or question.
  [[nodiscard]] std::span<const MoverMotion> hold_angles(const Box2& around);

 private:
  [[nodiscard]] const CharacterDef& character() const { return controller_.character(); }
  [[nodiscard]] std::span<const Vec2d> hull() const { return character().shape.hull(); }
  /// What the character covers from positions in a box.
  [[nodiscard]] Box2 box_at(const Box2& positions) const { return positions + character().shape.box(); }
  [[nodiscard]] bool is_there(ColliderIndex collider) const;
  [[nodiscard]] bool blocks(ColliderIndex collider) const;

  void read(const Box2& needed);
  void forget_gone(CharacterState& state) const;
  StepStatus go(CharacterState& state, const Wish& wish, double share, StepReport& report);
  StepStatus end(CharacterState& state);
  StepStatus refuse(StepStatus why, const CharacterState& state);
  StepStatus step_straight(CharacterState& state, const Wish& wish);
  StepStatus step_among_turning(CharacterState& state, const Wish& wish);
  [[nodiscard]] std::optional<StepStatus> step_in_parts(int parts, CharacterState& state, const Wish& wish);
  void begin_part(const Part& part, CharacterState& state) const;

  // turns.cpp
  [[nodiscard]] double longest_turn() const;
  [[nodiscard]] int parts_wanted() const;
  [[nodiscard]] Part turn(double begin, double end, const Vec2d& position);
  [[nodiscard]] Vec2d pivot_of(MoverIndex mover, double begin, double angle, const Vec2d& position) const;
  [[nodiscard]] bool find_way(Part& part, const MoveResult& move);
  [[nodiscard]] octagon_sweep::Limits limits_of(double push, int parts, const CharacterState& state) const;
  [[nodiscard]] double pushed_in(const Part& part, const MoveResult& move, double own) const;
  [[nodiscard]] static double way_of(const MovingCollider& collider, const Part& part, const Vec2d& place);
  [[nodiscard]] std::span<const Contact> contacts_at(const Vec2d& position, std::span<Contact> room);
  [[nodiscard]] bool is_proved(const Part& part, const MoveResult& move, bool of_all);
  [[nodiscard]] geometry::Pose turned_pose(const MovingCollider& collider, const Part& part) const;
  [[nodiscard]] bool overlaps(ColliderIndex collider, const geometry::Pose& pose, const Vec2d& position) const;
  [[nodiscard]] bool stays_clear(ColliderIndex collider, const geometry::Pose& from, const geometry::Pose& to,
                                 std::span<const PathPoint> way, double least = proved) const;
  [[nodiscard]] const MovingCollider* find_moving(ColliderIndex collider) const;
  [[nodiscard]] std::set<ColliderIndex> standing(const Box2& box) const;

  // turned_report.cpp
  void note_pushes(const Part& part);
  [[nodiscard]] bool is_turning_sensor(const MovingCollider& collider) const;
  void note_turned_sensors(const Part& part, const Vec2d& position, StepReport& report) const;
  void note_begin();
  void note_vertices(double instant, const Part* turned = nullptr);
  void append(const StepReport& added, const Part& part);

  // waiting.cpp
  void carry(Crusher& crusher, const geometry::Pose& from, const geometry::Pose& to) const;
  StepStatus go_straight_or_stay(CharacterState& state);
  StepStatus stay(CharacterState& state);
  void note_sensors(std::span<const PathPoint> way);
  void go_straight(double begin, double departure, const Vec2d& to, const CharacterState& state);
  [[nodiscard]] std::optional<Vec2d> way_out_at_end(CharacterState state);

  const Controller& controller_;
  const Scenery& scenery_;
  StepContext context_;
  std::span<const MoverMotion> bodies_;  ///< Their motions in the step.
  ColliderFilter filter_;
  Scratch& scratch_;
  Memory& memory_;
  StepReport& report_;
  Box2 needed_;
};

[[nodiscard]] bool contains(const auto& all, std::size_t one) { return std::ranges::find(all, one) != all.end(); }

[[nodiscard]] inline SensorEvent sensor_event(ColliderIndex sensor, bool enters, double fraction) {
  using Change = SensorEvent::Change;
  return {sensor, enters ? Change::enter : Change::exit, fraction};
}

}  // namespace paperproof::turning
