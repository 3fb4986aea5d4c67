#include "level/local_controller_impl.hpp"

#include <algorithm>
#include <array>

namespace paperproof {

using namespace level;

namespace {

/// How bad a status is: that of a step is the worst of its parts; but a step is stuck only if it ends so.
int rank(MoveStatus status) noexcept {
  constexpr std::array order{MoveStatus::moved, MoveStatus::dropped, MoveStatus::stuck, MoveStatus::crushed};
  return static_cast<int>(std::find(order.begin(), order.end(), status) - order.begin());
}

}  // namespace

/// Reports what pushed the character when it turned, as contacts at the beginning of a part.
void LocalController::Impl::note_pushes(const StepPart& part, const StepContext& context) {
  MoveResult& move = of_part->move;
  if (move.path.size() < 2 || move.path[1].fraction > 0) return;
  std::size_t last = 1;
  while (last + 1 < move.path.size() && move.path[last + 1].fraction == 0) ++last;
  std::array<Contact, MoveResult::max_contacts> touched;
  const std::size_t count = scenery.controller().contacts_at(
      move.path[last].position, Tolerances{}.touch, scenery.context(context, part.motions), scenery.scratch(), touched);
  std::ptrdiff_t pushes = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const NearCollider& collider = scenery.at(touched[i].collider);
    const auto is_known = [&](const Contact& contact) { return contact.collider == touched[i].collider; };
    if (!scenery.turns(collider)) continue;
    if (std::any_of(move.contacts.begin(), move.contacts.end(), is_known)) continue;
    // They come first: nothing else is met before any time has passed.
    move.contacts.insert(move.contacts.begin() + pushes++, touched[i]);
  }
}

/// Reports the sensors that came over the character, or left it, as they turned at the beginning of a part. The sweep
/// sees how they go on.
/// @param position where the part begins. @param report of the part, by ids.
void LocalController::Impl::note_turned_sensors(const StepPart& part, const Vec2d& position,
                                                const ColliderFilter* filter, StepReport& report) {
  if (!scenery.any_sensor_turns()) return;
  const auto later = report.sensors;
  report.sensors.clear();
  for (const NearCollider& collider : scenery.colliders()) {
    const bool turns = collider.mover != no_mover && collider.motion.from.angle != collider.motion.to.angle;
    if (!collider.def->sensor || !turns || !scenery.is_in_scenery(collider.id) || !is_there(collider, filter)) continue;
    const bool before = overlaps(collider, pose_at(collider.motion, part.begin), position);
    const bool after = overlaps(collider, turned_pose(collider, part), position);
    if (before != after) report.sensors.push_back(sensor_event(collider.id, after, 0));
  }
  for (const SensorEvent& event : later) report.sensors.push_back(event);
}

/// Where everything that moves is when the step begins.
void LocalController::Impl::note_begin() {
  turned_.clear();
  for (const NearCollider& collider : scenery.colliders())
    if (collider.mover != no_mover)
      turned_.push_back({collider.id, {0}, {vertices_at(*collider.def, collider.motion.from)}});
}

void LocalController::Impl::note_vertices(const StepPart& part) {
  std::size_t next = 0;
  for (const NearCollider& collider : scenery.colliders()) {
    if (collider.mover == no_mover) continue;
    TurnedCollider& way = turned_[next++];
    way.instants.insert(way.instants.end(), {part.turned(), part.end});
    way.vertices.push_back(vertices_at(*collider.def, turned_pose(collider, part)));
    way.vertices.push_back(vertices_at(*collider.def, pose_at(collider.motion, part.end)));
  }
}

/// Adds a part to the report of the step. @param added names colliders by ids.
void LocalController::Impl::append(const StepReport& added, const StepPart& part, StepReport& report) const {
  const MoveResult& from = added.move;
  MoveResult& to = report.move;
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
    if (std::none_of(to.contacts.begin(), to.contacts.end(), is_it)) to.contacts.push_back(contact);
  }
  for (const ColliderIndex collider : from.crushed)
    if (std::find(to.crushed.begin(), to.crushed.end(), collider) == to.crushed.end()) to.crushed.push_back(collider);
  for (SensorEvent event : added.sensors) {
    event.fraction = when(event.fraction);
    report.sensors.push_back(event);
  }
  for (const ColliderIndex collider : added.dropped_through)
    if (std::find(report.dropped_through.begin(), report.dropped_through.end(), collider) ==
        report.dropped_through.end())
      report.dropped_through.push_back(collider);
  if (part.begin == 0) {
    report.requested = added.requested / part.end;
    report.steered = added.steered / part.end;
  }
  const bool was_freed = to.status == MoveStatus::stuck && from.status != MoveStatus::crushed;
  if (was_freed || rank(from.status) > rank(to.status)) to.status = from.status;
  report.status = step_parts::status_of(to.status);
  to.position = from.position;
  to.velocity = from.velocity;
  to.technique_memory = from.technique_memory;
  to.grounded = from.grounded;
  to.ground = from.ground;
  to.ride = from.ride;
  to.crushers = from.crushers;
}

}  // namespace paperproof
