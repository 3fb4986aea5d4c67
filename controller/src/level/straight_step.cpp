#include "level/local_controller_impl.hpp"

#include <algorithm>

namespace paperproof {

using namespace level;

/// Reports that the character enters and leaves a sensor, as far as instants of the step show it.
/// @param ends the instants. @param place_at of the character, at one of them.
template <class PlaceAt>
void LocalController::Impl::note_stays(const NearCollider& sensor, double begin, std::span<const double> ends,
                                       const PlaceAt& place_at, StepReport& report) {
  const auto is_inside = [&](double when) { return overlaps(sensor, pose_at(sensor.motion, when), place_at(when)); };
  bool inside = is_inside(begin);
  for (const double end : ends) {
    if (is_inside(end) == inside) continue;
    inside = !inside;
    report.sensors.push_back(sensor_event(sensor.id, inside, end));
  }
}

/// The rest of a step, in which the character stays, then goes straight to a place, and everything that moves turns
/// evenly. What may reach the character crushes it.
/// @param begin as a fraction of the step; what is before it stands in the report.
/// @param departure when the character leaves for the place.
void LocalController::Impl::go_straight(double begin, double departure, const Vec2d& to, const CharacterState& state,
                                        const StepContext& context, StepReport& report) {
  MoveResult& move = report.move;
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
  std::vector<double> ends;
  for (int part = 1; part < most_parts; ++part) ends.push_back(begin + (1 - begin) * part / most_parts);
  if (departure > begin) ends.push_back(departure);
  ends.push_back(1);
  const auto place_at = [&](double fraction) {
    return fraction < 1 ? between(state.position, to, std::max(0.0, fraction - departure) / (1 - departure)) : to;
  };
  for (const NearCollider& collider : scenery.colliders())
    if (collider.def->sensor && scenery.is_in_scenery(collider.id) && is_there(collider, context.filter))
      note_stays(collider, begin, ends, place_at, report);
  std::stable_sort(report.sensors.begin(), report.sensors.end(),
                   [](const auto& a, const auto& b) { return a.fraction < b.fraction; });
  std::size_t next = 0;
  for (const NearCollider& collider : scenery.colliders()) {
    if (collider.mover == no_mover) continue;
    TurnedCollider& way = turned_[next++];
    const Pose from = pose_at(collider.motion, begin);
    const bool in_way = blocks(collider, context);
    bool is_reached = false;
    double last = begin;
    for (const double end : ends) {
      way.instants.push_back(end);
      way.vertices.push_back(vertices_at(*collider.def, pose_at(collider.motion, end)));
      is_reached = is_reached || (in_way && reaches(collider, {hull(), place_at(last), place_at(end)}, last, end));
      last = end;
    }
    if (!is_reached) continue;
    const auto known = std::find_if(state.crushers.begin(), state.crushers.end(),
                                    [&](const Crusher& crusher) { return crusher.collider == collider.id; });
    Crusher crusher{collider.id, state.position};
    if (known != state.crushers.end()) crusher = *known;
    carry(crusher, middle(), from, collider.motion.to);
    const bool is_named = std::find(move.crushed.begin(), move.crushed.end(), collider.id) != move.crushed.end();
    if (!is_named && !overlaps(collider, from, state.position)) move.crushed.push_back(collider.id);
    if (overlaps(collider, collider.motion.to, to)) move.crushers.push_back(crusher);
  }
}

/// Where a character that stays in place would leave what overlaps it at the end of the step.
std::optional<Vec2d> LocalController::Impl::way_out_at_end(CharacterState state, const StepContext& context) {
  if (!scenery.build(1)) return std::nullopt;
  motions.clear();
  for (const NearMover& mover : scenery.movers())
    motions.push_back({mover.motion.to.position, mover.motion.to.position});
  scenery.to_local(state);
  state.ride = {};
  for (Crusher& crusher : state.crushers) {
    const NearCollider& collider = scenery.at(crusher.collider);
    carry(crusher, middle(), collider.motion.from, collider.motion.to);
  }
  const StepStatus status =
      scenery.controller().move(state, {0, 0}, scenery.context(context, motions), scenery.scratch(), *of_part);
  if (status != StepStatus::moved) return std::nullopt;
  return of_part->move.position;
}

/// A step for a character that no division of the step brings to a free position. It goes straight to one, if it can,
/// in the course of the step or at its end; else it stays in place.
StepStatus LocalController::Impl::go_straight_or_stay(CharacterState& state, const StepContext& context,
                                                      StepReport& report) {
  const std::optional<Vec2d> out = way_out_at_end(state, context);
  MoveResult& move = report.move;
  const auto goes_out = [&](double departure) {
    report.clear();
    go_straight(0, departure, *out, state, context, report);
    return move.crushed.empty() && move.crushers.empty();
  };
  if (!out || !(goes_out(0) || goes_out(1 - turning_share))) return wait(state, context, report);
  step_parts::adopt(character(), context.up, move, state);
  return report.status = step_parts::status_of(move.status);
}

/// A step in which the character stays in place, and what reaches it crushes it.
StepStatus LocalController::Impl::wait(CharacterState& state, const StepContext& context, StepReport& report) {
  MoveResult& move = report.move;
  report.clear();
  go_straight(0, 0, state.position, state, context, report);
  const auto holds = [&](const NearCollider& collider) {
    return collider.mover == no_mover && blocks(collider, context) && overlaps(collider, {}, state.position);
  };
  const auto all = scenery.colliders();
  const bool is_held = !move.crushers.empty() || std::any_of(all.begin(), all.end(), holds);
  move.status = is_held ? MoveStatus::stuck : MoveStatus::moved;
  if (!move.crushed.empty()) move.status = MoveStatus::crushed;
  step_parts::adopt(character(), context.up, move, state);
  return report.status = step_parts::status_of(move.status);
}

}  // namespace paperproof
