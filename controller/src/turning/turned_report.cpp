#include "turning/turning_step.hpp"

#include <algorithm>
#include <array>

namespace paperproof::turning {

using geometry::Pose;
using geometry::pose_at;

/// Reports what pushed the character when it turned, as contacts at the beginning of a part.
void TurningStep::note_pushes(const Part& part) {
  MoveResult& move = memory_.of_part.move;
  if (move.path.size() < 2 || move.path[1].fraction > 0) return;
  std::array<Contact, MoveResult::max_contacts> room;
  std::ptrdiff_t pushes = 0;
  for (const Contact& touched : contacts_at(part.way.back().position, room)) {
    const MovingCollider* collider = find_moving(touched.collider);
    const auto is_known = [&](const Contact& contact) { return contact.collider == touched.collider; };
    if (collider == nullptr || collider->by_itself || !memory_.turns[collider->mover]) continue;
    if (std::ranges::any_of(move.contacts, is_known)) continue;
    // They come first: nothing else is met before any time has passed.
    move.contacts.insert(move.contacts.begin() + pushes++, touched);
  }
}

bool TurningStep::is_turning_sensor(const MovingCollider& collider) const {
  return scenery_.collider(collider.id).sensor && collider.motion.turn() != 0 && is_there(collider.id);
}

/// Reports the sensors that came over the character, or left it, as they turned at the beginning of a part. The sweep
/// sees how they go on.
/// @param position where the part begins. @param report of the part.
void TurningStep::note_turned_sensors(const Part& part, const Vec2d& position, StepReport& report) const {
  std::ptrdiff_t turned = 0;
  for (const MovingCollider& collider : memory_.moving) {
    if (!is_turning_sensor(collider)) continue;
    const bool before = overlaps(collider.id, pose_at(collider.motion, part.begin), position);
    const bool after = overlaps(collider.id, turned_pose(collider, part), position);
    if (before != after) report.sensors.insert(report.sensors.begin() + turned++, sensor_event(collider.id, after, 0));
  }
}

/// Where everything that moves is when the step begins.
void TurningStep::note_begin() {
  memory_.turned.clear();
  if (!scratch_.notes_turned) return;
  for (const MovingCollider& collider : memory_.moving) memory_.turned.push_back({collider.id, {}, {}});
  note_vertices(0);
}

/// @param turned if the instant is the one at which everything has turned in this part.
void TurningStep::note_vertices(double instant, const Part* turned) {
  for (std::size_t i = 0; i < memory_.turned.size(); ++i) {
    const MovingCollider& collider = memory_.moving[i];
    const Pose pose = turned != nullptr ? turned_pose(collider, *turned) : pose_at(collider.motion, instant);
    const ColliderDef def = scenery_.as_run(collider.id);
    memory_.turned[i].instants.push_back(instant);
    std::vector<Vec2d>& vertices = memory_.turned[i].vertices.emplace_back();
    geometry::place(def.points, pose, vertices);
    for (const std::vector<Vec2d>& hole : def.holes) geometry::place(hole, pose, vertices);
  }
}

/// Adds a part to the report of the step. The status of a step is the worst of its parts; but a step is stuck only if
/// it ends so.
void TurningStep::append(const StepReport& added, const Part& part) {
  const MoveResult& from = added.move;
  MoveResult& to = report_.move;
  const auto when = [&](double fraction) {
    return fraction < 1 ? part.turned() + (part.end - part.turned()) * fraction : part.end;
  };
  for (const PathPoint& corner : part.way) {
    const double fraction = part.begin + (part.turned() - part.begin) * corner.fraction;
    if (corner.fraction > 0 || to.path.empty())
      to.path.push_back({corner.position, corner.fraction < 1 ? fraction : part.turned()});
  }
  for (const PathPoint& corner : from.path)
    if (corner.fraction > 0) to.path.push_back({corner.position, when(corner.fraction)});
  for (Contact contact : from.contacts) {
    contact.fraction = when(contact.fraction);
    const auto is_it = [&](const Contact& other) {
      return other.collider == contact.collider && other.normal == contact.normal;
    };
    if (std::ranges::none_of(to.contacts, is_it)) to.contacts.push_back(contact);
  }
  for (const ColliderIndex collider : from.crushed)
    if (!contains(to.crushed, collider)) to.crushed.push_back(collider);
  for (SensorEvent event : added.sensors) {
    event.fraction = when(event.fraction);
    report_.sensors.push_back(event);
  }
  for (const ColliderIndex collider : added.dropped_through)
    if (!contains(report_.dropped_through, collider)) report_.dropped_through.push_back(collider);
  if (part.begin == 0) {
    report_.requested = added.requested / part.end;
    report_.steered = added.steered / part.end;
  }
  const bool was_freed = to.status == StepStatus::stuck && from.status != StepStatus::crushed;
  to.status = was_freed ? from.status : std::max(to.status, from.status);  // the later in the enum, the worse
  report_.status = to.status;
  to.position = from.position;
  to.velocity = from.velocity;
  to.technique_memory = from.technique_memory;
  to.grounded = from.grounded;
  to.ground = from.ground;
  to.ride = from.ride;
  to.crushers = from.crushers;
}

}  // namespace paperproof::turning
