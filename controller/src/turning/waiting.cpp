#include "sensors.hpp"
#include "turning/turning_step.hpp"

#include <algorithm>
#include <array>

namespace paperproof::turning {

using geometry::Pose;
using geometry::pose_at;

/// The place from which the character came goes along with what crushed it.
void TurningStep::carry(Crusher& crusher, const Pose& from, const Pose& to) const {
  const Vec2d middle = character().shape.box().middle();
  const Vec2d came_from = crusher.last_free + crusher.displacement + middle;
  const Vec2d there = to.position + geometry::Turn(to.angle - from.angle)(Vec2d(came_from - from.position));
  crusher.displacement = there - middle - crusher.last_free;
}

/// Reports the sensors that the character enters and leaves on a way: those that turn as far as its corners show it.
void TurningStep::note_sensors(std::span<const PathPoint> way) {
  std::vector<MoverMotion> motions(context_.movers.begin(), context_.movers.end());
  for (const MoverMotion& motion : memory_.motions_apart) motions.push_back({motion.from, motion.to});
  std::vector<SensorEvent> events;
  static_cast<Sensors&>(*scratch_.sensors).observe(way, {motions, memory_.apart}, events, &filter_);
  for (const MovingCollider& collider : memory_.moving) {
    if (!is_turning_sensor(collider)) continue;
    std::erase_if(events, [&](const SensorEvent& event) { return event.sensor == collider.id; });
    const auto is_inside = [&](const PathPoint& at) {
      return overlaps(collider.id, pose_at(collider.motion, at.fraction), at.position);
    };
    bool inside = is_inside(way[0]);
    for (const PathPoint& corner : way.subspan(1))
      if (is_inside(corner) != inside) {
        inside = !inside;
        events.push_back(sensor_event(collider.id, inside, corner.fraction));
      }
  }
  report_.sensors.insert(report_.sensors.end(), events.begin(), events.end());
}

/// The rest of a step, in which the character stays, then goes straight to a place, and everything that moves turns
/// evenly. What may reach the character crushes it.
/// @param begin as a fraction of the step; what is before it stands in the report.
/// @param departure when the character leaves for the place.
void TurningStep::go_straight(double begin, double departure, const Vec2d& to, const CharacterState& state) {
  MoveResult& move = report_.move;
  move.position = to;
  move.velocity.setZero();
  move.grounded = false;
  move.ground = {};
  move.ride = {};
  move.crushers.clear();
  if (move.path.empty()) move.path.push_back({state.position, 0});
  if (departure > begin) move.path.push_back({state.position, departure});
  move.path.push_back({to, 1});
  if (begin == 0) note_begin();
  std::vector<PathPoint> way{{state.position, begin}};
  const auto go_on = [&](double end) {
    way.push_back({between(state.position, to, std::max(0.0, end - departure) / (1 - departure)), end});
  };
  for (int part = 1; part < most_parts; ++part) go_on(begin + (1 - begin) * part / most_parts);
  if (departure > begin) go_on(departure);
  go_on(1);
  note_sensors(way);
  std::ranges::stable_sort(report_.sensors, {}, &SensorEvent::fraction);
  for (std::size_t i = 1; i < way.size(); ++i) note_vertices(way[i].fraction);
  for (const MovingCollider& collider : memory_.moving) {
    if (!blocks(collider.id)) continue;
    const Pose from = pose_at(collider.motion, begin);
    const Pose at_end = pose_at(collider.motion, 1);
    bool is_reached = false;
    for (std::size_t i = 1; i < way.size() && !is_reached; ++i) {
      const std::array<PathPoint, 2> leg{{{way[i - 1].position, 0}, {way[i].position, 1}}};
      is_reached = !stays_clear(collider.id, pose_at(collider.motion, way[i - 1].fraction),
                                pose_at(collider.motion, way[i].fraction), leg);
    }
    if (!is_reached) continue;
    const auto known = std::ranges::find(state.crushers, collider.id, &Crusher::collider);
    Crusher crusher{collider.id, state.position};
    if (known != state.crushers.end()) crusher = *known;
    carry(crusher, from, at_end);
    if (!contains(move.crushed, collider.id) && !overlaps(collider.id, from, state.position))
      move.crushed.push_back(collider.id);
    if (overlaps(collider.id, at_end, to)) move.crushers.push_back(crusher);
  }
}

/// Where a character that stays in place would leave what overlaps it at the end of the step.
std::optional<Vec2d> TurningStep::way_out_at_end(CharacterState state) {
  (void)turn(0, 1, state.position);
  for (MoverMotion& motion : memory_.motions) {
    motion.from = motion.to;
    motion.from_angle = motion.to_angle;
  }
  state.ride = {};
  for (Crusher& crusher : state.crushers)
    if (const MovingCollider* collider = find_moving(crusher.collider))
      carry(crusher, pose_at(collider->motion, 0), pose_at(collider->motion, 1));
  double way = 0;
  for (const MovingCollider& collider : memory_.moving)
    if (blocks(collider.id) && overlaps(collider.id, pose_at(collider.motion, 1), state.position))
      way = std::max(way, way_of(collider, {0, 1}, state.position + character().shape.box().middle()));
  memory_.limits = limits_of(Tolerances{}.push + way, 1, state);
  memory_.limits.push += longest_turn();
  const StepStatus status = go(state, {nullptr, {0, 0}}, 1, memory_.of_part);
  if (status != StepStatus::moved) return std::nullopt;
  return memory_.of_part.move.position;
}

/// A step for a character that no division of the step brings to a free position. It goes straight to one, if it can,
/// in the course of the step or at its end; else it stays in place.
StepStatus TurningStep::go_straight_or_stay(CharacterState& state) {
  const std::optional<Vec2d> out = way_out_at_end(state);
  MoveResult& move = report_.move;
  const auto goes_out = [&](double departure) {
    report_.clear();
    go_straight(0, departure, *out, state);
    return move.crushed.empty() && move.crushers.empty();
  };
  if (!out || !(goes_out(0) || goes_out(1 - turning_share))) return stay(state);
  return end(state);
}

/// A step in which the character stays in place, and what reaches it crushes it.
StepStatus TurningStep::stay(CharacterState& state) {
  MoveResult& move = report_.move;
  report_.clear();
  go_straight(0, 0, state.position, state);
  const std::set<ColliderIndex> around = standing(box_at({state.position, state.position}));
  const bool is_held = !move.crushers.empty() || std::ranges::any_of(around, [&](ColliderIndex collider) {
    return blocks(collider) && overlaps(collider, {}, state.position);
  });
  move.status = is_held ? StepStatus::stuck : StepStatus::moved;
  if (!move.crushed.empty()) move.status = StepStatus::crushed;
  return end(state);
}

}  // namespace paperproof::turning
