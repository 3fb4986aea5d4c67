/// What a `LocalController` is made of: `local_controller.cpp` has its steps, `turns.cpp` how what is near turns and
/// the proof of that, `turned_report.cpp` the report, and `straight_step.cpp` the step of a character that only waits
/// or leaves.
#pragma once

#include "level/near_scenery.hpp"
#include "level/turn.hpp"
#include "step_parts.hpp"

#include <paperproof/local_controller.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace paperproof {
namespace level {

/// Into so many shorter steps a step is divided at most.
inline constexpr int most_parts = 32;

/// The share of a part in which everything turns. So short that a character which waits meanwhile is not 1 um behind.
inline constexpr double turning_share = 0x1p-20;

/// A part of a step, as fractions of it, and how what is near moves in it once everything has turned.
struct StepPart {
  double begin;
  double end;
  std::span<const MoverMotion> motions;
  /// Of the character while everything turns, in shares of this time.
  std::vector<PathPoint> way{};

  [[nodiscard]] double turned() const noexcept { return begin + (end - begin) * turning_share; }
};

/// A collider, and where it is nearest to the character.
struct NearestOutline {
  Approach approach;
  std::vector<Vec2d> outline;
  bool closed;
};

/// All points of a collider in a pose: see `TurnedCollider`.
inline std::vector<Vec2d> vertices_at(const ColliderDef& def, const Pose& pose) {
  std::vector<Vec2d> vertices;
  const auto add = [&](const std::vector<Vec2d>& points) {
    for (const Vec2d& point : points) vertices.push_back(placed(point, pose));
  };
  add(def.points);
  for (const std::vector<Vec2d>& hole : def.holes) add(hole);
  return vertices;
}

inline Vec2d between(const Vec2d& from, const Vec2d& to, double share) { return from + (to - from) * share; }

/// The place from which the character came goes along with what crushed it.
/// @param middle of the character's shape, relative to its position.
inline void carry(Crusher& crusher, const Vec2d& middle, const Pose& from, const Pose& to) {
  const Vec2d came_from = crusher.last_free + crusher.displacement + middle;
  const Vec2d there = to.position + rotated(Vec2d(came_from - from.position), to.angle - from.angle);
  crusher.displacement = there - middle - crusher.last_free;
}

inline SensorEvent sensor_event(ColliderIndex sensor, bool enters, double fraction) {
  using Change = SensorEvent::Change;
  return {sensor, enters ? Change::enter : Change::exit, fraction};
}

}  // namespace level

struct LocalController::Impl {
  explicit Impl(const CharacterDef& def) : scenery(def) { def.validate(); }

  [[nodiscard]] const CharacterDef& character() const noexcept { return scenery.character(); }
  [[nodiscard]] std::span<const Vec2d> hull() const noexcept { return character().shape.hull(); }
  [[nodiscard]] Vec2d middle() const noexcept { return character().shape.box().middle(); }

  [[nodiscard]] Box2 box_needed(const CharacterState& state, const StepContext& context) const;
  [[nodiscard]] Box2 box_along(const MoveResult& move) const;
  StepStatus refuse(const CharacterState& state, StepReport& report);
  StepStatus stay(MoveStatus why, const CharacterState& state, StepReport& report);

  template <class Go>
  StepStatus advance(CharacterState& state, const StepContext& context, const Find& find, StepReport& report,
                     const Go& go);
  template <class Go>
  StepStatus step_straight(CharacterState& state, const StepContext& context, StepReport& report, const Go& go);
  template <class Go>
  StepStatus step_among_turning(CharacterState& state, const StepContext& context, StepReport& report, const Go& go);
  template <class Go>
  [[nodiscard]] std::optional<StepStatus> step_in_parts(int parts, CharacterState& state, const StepContext& context,
                                                        StepReport& report, const Go& go);

  // Among what turns.
  [[nodiscard]] int parts_for(const CharacterState& state, const StepContext& context) const;
  [[nodiscard]] level::StepPart turn(double begin, double end, const Vec2d& position, const ColliderFilter* filter);
  [[nodiscard]] level::NearestOutline nearest_of(MoverIndex mover, double fraction, const Vec2d& position,
                                                 const ColliderFilter* filter) const;
  [[nodiscard]] Vec2d pivot_of(MoverIndex mover, double begin, double angle, const Vec2d& position,
                               const ColliderFilter* filter) const;
  [[nodiscard]] bool find_way(level::StepPart& part, const MoveResult& move, const StepContext& context);
  void limit_speed(const level::StepPart& part, double wanted, double dt, MoveResult& move,
                   CharacterState& state) const;
  [[nodiscard]] Vec2d out_of_corner(const Vec2d& position, const StepContext& context, const level::StepPart& part);
  [[nodiscard]] bool is_proved(const level::StepPart& part, const MoveResult& move, const StepContext& context,
                               bool of_all);
  [[nodiscard]] bool blocks(const NearCollider& collider, const StepContext& context) const;
  [[nodiscard]] Pose turned_pose(const NearCollider& collider, const level::StepPart& part) const;
  void note_pushes(const level::StepPart& part, const StepContext& context);
  void note_turned_sensors(const level::StepPart& part, const Vec2d& position, const ColliderFilter* filter,
                           StepReport& report);
  void note_begin();
  void note_vertices(const level::StepPart& part);
  void append(const StepReport& added, const level::StepPart& part, StepReport& report) const;
  StepStatus go_straight_or_stay(CharacterState& state, const StepContext& context, StepReport& report);
  StepStatus wait(CharacterState& state, const StepContext& context, StepReport& report);
  template <class PlaceAt>
  void note_stays(const NearCollider& sensor, double begin, std::span<const double> ends, const PlaceAt& place_at,
                  StepReport& report);
  void go_straight(double begin, double departure, const Vec2d& to, const CharacterState& state,
                   const StepContext& context, StepReport& report);
  [[nodiscard]] std::optional<Vec2d> way_out_at_end(CharacterState state, const StepContext& context);
  [[nodiscard]] bool overlaps(const NearCollider& collider, const Pose& pose, const Vec2d& position);
  [[nodiscard]] bool reaches(const NearCollider& collider, const level::HullWay& way, double begin, double end);
  [[nodiscard]] const std::vector<level::ConvexPiece>& pieces(const NearCollider& collider);

  struct KnownPieces {
    ColliderIndex id;
    std::uint64_t version;
    std::vector<level::ConvexPiece> pieces;
  };

  level::NearScenery scenery;
  std::vector<MoverMotion> motions;
  std::vector<TurnedCollider> turned_;
  std::unique_ptr<StepReport> of_part = std::make_unique<StepReport>();
  std::vector<KnownPieces> known_pieces;
};

}  // namespace paperproof
