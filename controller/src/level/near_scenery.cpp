#include "level/near_scenery.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace paperproof::level {
namespace {

/// How much wider than needed the box is that is read [m]. Zero: each step reads another one. Large: each change costs
/// more.
constexpr double read_ahead = 1.5;

/// Surface speeds are rounded to a multiple of this [m/s]. Zero: a steady turn gives another speed in each step, by
/// rounding, and so another scenery. Large: who stands on a wheel lags behind.
constexpr double speed_unit = 0x1p-24;

/// Whether a collider is a circle that is turned. It looks the same at every angle: only its centre has a place.
bool is_turned_circle(const NearCollider& collider) noexcept {
  return collider.def->shape == ColliderDef::Shape::circle &&
         (collider.motion.from.angle != 0 || collider.motion.to.angle != 0);
}

/// The motion of a circle that is turned, as an offset of its centre.
PoseMotion motion_of_centre(const NearCollider& collider) {
  const Vec2d& centre = collider.def->points.front();
  return {{placed(centre, collider.motion.from) - centre}, {placed(centre, collider.motion.to) - centre}};
}

/// A collider as it is built into scenery: turned, not moved.
ColliderDef turned_collider(const ColliderDef& def, double angle, MoverIndex mover) {
  ColliderDef result = def;
  result.mover = mover;
  if (angle == 0) return result;
  result.points = placed(def.points, {.angle = angle});
  for (std::vector<Vec2d>& hole : result.holes) hole = placed(hole, {.angle = angle});
  return result;
}

/// Where an element with this id is, or would be, in a vector in the order of ids.
template <class Vector>
auto place_of(Vector& all, ColliderIndex id) noexcept {
  return std::lower_bound(all.begin(), all.end(), id,
                          [](const auto& each, ColliderIndex other) { return each.id < other; });
}

/// Null if there is none.
template <class Each>
const Each* find_by_id(const std::vector<Each>& all, ColliderIndex id) noexcept {
  const auto place = place_of(all, id);
  return place != all.end() && place->id == id ? &*place : nullptr;
}

}  // namespace

bool is_there(const NearCollider& collider, const ColliderFilter* filter) {
  return (filter == nullptr ? ColliderFilter{} : *filter)(collider.id, collider.def->filter);
}

void NearScenery::read(const Box2& needed, const StepContext& context, const Find& find) {
  const Vec2d spare = (box_.upper - box_.lower) - (needed.upper - needed.lower);
  if (!box_.contains(needed) || spare.maxCoeff() > 4 * read_ahead) box_ = needed.inflated(read_ahead);
  near_.clear();
  find(box_, near_);
  const auto by_id = [](const NearCollider& a, const NearCollider& b) { return a.id < b.id; };
  if (!std::is_sorted(near_.begin(), near_.end(), by_id)) std::sort(near_.begin(), near_.end(), by_id);
  const auto same_id = [](const NearCollider& a, const NearCollider& b) { return a.id == b.id; };
  near_.erase(std::unique(near_.begin(), near_.end(), same_id), near_.end());
  leave_out_refused();
  number_movers(context.dt);
  note_what_turns(needed, context.filter);
}

/// Counts the movers in the order of their numbers.
void NearScenery::number_movers(double dt) {
  moving_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i)
    if (near_[i].mover != no_mover) moving_.push_back(i);
  const auto key = [&](std::size_t i) {
    const NearCollider& collider = near_[i];
    const bool alone = is_turned_circle(collider);
    const Vec2d centre = alone ? collider.def->points.front() : Vec2d(Vec2d::Zero());
    return std::tuple(collider.mover, alone, centre.x(), centre.y(), alone ? collider.def->radius : 0.0,
                      alone ? collider.id : no_collider);
  };
  std::sort(moving_.begin(), moving_.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  movers_.clear();
  std::optional<decltype(key(0))> last;
  for (const std::size_t i : moving_) {
    NearCollider& collider = near_[i];
    const auto now = key(i);
    if (!last || now != *last) {
      NearMover mover{.motion = collider.motion};
      if (is_turned_circle(collider)) {
        const double turn = collider.motion.to.angle - collider.motion.from.angle;
        if (dt > 0) mover.surface_speed = std::round(-turn / dt * collider.def->radius / speed_unit) * speed_unit;
        mover.motion = motion_of_centre(collider);
      }
      movers_.push_back(mover);
    }
    last = now;
    collider.motion = movers_.back().motion;
    collider.mover = static_cast<MoverIndex>(movers_.size() - 1);
  }
}

/// What turns beside the needed box does not count, so that the number of parts depends on the state alone.
void NearScenery::note_what_turns(const Box2& needed, const ColliderFilter* filter) {
  any_turns_ = any_sensor_turns_ = false;
  for (const NearCollider& collider : near_) {
    if (collider.mover == no_mover || collider.motion.from.angle == collider.motion.to.angle) continue;
    any_sensor_turns_ = any_sensor_turns_ || collider.def->sensor;
    if (collider.def->sensor || !is_there(collider, filter)) continue;
    if (!swept_box(collider.def->points, collider.motion).overlaps(needed)) continue;
    movers_[collider.mover].turns = any_turns_ = true;
  }
}

/// Leaves out what was refused before.
void NearScenery::leave_out_refused() {
  unusable_.clear();
  if (refused_.empty()) return;
  std::erase_if(near_, [&](const NearCollider& collider) {
    const std::pair here(collider.id, collider.version);
    if (std::find(refused_.begin(), refused_.end(), here) == refused_.end()) return false;
    unusable_.push_back(collider.id);
    return true;
  });
  const auto is_gone = [&](const auto& refused) {
    return std::find(unusable_.begin(), unusable_.end(), refused.first) == unusable_.end();
  };
  std::erase_if(refused_, is_gone);
}

void NearScenery::take_out_what_is_gone() {
  std::erase_if(known_, [&](const Known& each) {
    if (find(each.id) != nullptr) return false;
    scenery_.remove(each.local);
    return true;
  });
}

/// Puts a collider into the scenery, or another definition in its place.
/// @return false if it cannot be turned by its angle.
bool NearScenery::put(const NearCollider& collider, Known wanted) {
  const auto place = place_of(known_, wanted.id);
  const bool is_known = place != known_.end() && place->id == wanted.id;
  if (is_known) wanted.local = place->local;
  if (is_known && *place == wanted) return true;
  ColliderDef def = turned_collider(*collider.def, wanted.angle, wanted.mover);
  if (def.carries) def.surface_speed += wanted.surface_speed;
  try {
    if (is_known) {
      scenery_.replace(wanted.local, def);
      *place = wanted;
    } else {
      wanted.local = scenery_.add(def);
      known_.insert(place, wanted);
    }
  } catch (const InvalidScenery&) {
    try {
      const Scenery as_defined(SceneryDef{{turned_collider(*collider.def, 0, no_mover)}});
      return false;
    } catch (const InvalidScenery&) {
      unusable_.push_back(collider.id);
      refused_.emplace_back(collider.id, collider.version);
      if (!is_known) return true;
      scenery_.remove(wanted.local);
      known_.erase(place);
      return true;
    }
  }
  id_of_slot_.resize(scenery_.collider_count(), no_collider);
  id_of_slot_[Scenery::slot_of(wanted.local)] = wanted.id;
  return true;
}

/// What the scenery should have of a collider, but its id there.
NearScenery::Known NearScenery::wanted_of(const NearCollider& collider, double fraction) const {
  Known wanted{collider.id, no_collider, collider.version, collider.mover, 0, 0};
  if (collider.mover == no_mover) return wanted;
  wanted.angle = pose_at(collider.motion, fraction).angle;
  wanted.surface_speed = movers_[collider.mover].surface_speed;
  return wanted;
}

bool NearScenery::build(double fraction) {
  const auto is_as_wanted = [&](const NearCollider& collider, const Known& known) {
    Known wanted = wanted_of(collider, fraction);
    wanted.local = known.local;
    return wanted == known;
  };
  if (std::equal(near_.begin(), near_.end(), known_.begin(), known_.end(), is_as_wanted)) return true;
  take_out_what_is_gone();
  return std::all_of(near_.begin(), near_.end(), [&](const NearCollider& collider) {
    const bool is_unusable = std::find(unusable_.begin(), unusable_.end(), collider.id) != unusable_.end();
    return is_unusable || put(collider, wanted_of(collider, fraction));
  });
}

const NearCollider* NearScenery::find(ColliderIndex id) const noexcept { return find_by_id(near_, id); }

ColliderIndex NearScenery::local_of(ColliderIndex id) const noexcept {
  const Known* const found = find_by_id(known_, id);
  return found != nullptr ? found->local : no_collider;
}

StepContext NearScenery::context(StepContext context, std::span<const MoverMotion> motions) {
  motions_.assign(motions.begin(), motions.end());
  motions_.resize(scenery_.mover_count());
  context.movers = motions_;
  if (context.filter == nullptr) return context;
  filter_of_ids_ = {*context.filter, id_of_slot_};
  filter_ = *context.filter;
  filter_.user = &filter_of_ids_;
  if (filter_.is_there != nullptr)
    filter_.is_there = [](ColliderIndex collider, const void* user) {
      const auto& of_ids = *static_cast<const FilterOfIds*>(user);
      return of_ids.filter.is_there(of_ids.ids[Scenery::slot_of(collider)], of_ids.filter.user);
    };
  context.filter = &filter_;
  return context;
}

void NearScenery::to_local(CharacterState& state) const {
  if (state.ride.ground != Ride::none) {
    state.ride.ground = local_of(state.ride.ground);
    if (state.ride.ground == no_collider) state.ride = {};
  }
  const Crushers known = state.crushers;
  state.crushers.clear();
  for (Crusher crusher : known) {
    crusher.collider = local_of(crusher.collider);
    if (crusher.collider != no_collider) state.crushers.push_back(crusher);
  }
  state.crushed = state.crushed && !state.crushers.empty();
}

void NearScenery::to_ids(CharacterState& state) const {
  if (state.ride.ground != Ride::none) state.ride.ground = id_of(state.ride.ground);
  if (state.ground.state != GroundState::air) state.ground.collider = id_of(state.ground.collider);
  for (Crusher& crusher : state.crushers) crusher.collider = id_of(crusher.collider);
}

void NearScenery::to_ids(StepReport& report) const {
  MoveResult& move = report.move;
  for (Contact& contact : move.contacts) contact.collider = id_of(contact.collider);
  for (Crusher& crusher : move.crushers) crusher.collider = id_of(crusher.collider);
  if (move.ground.state != GroundState::air) move.ground.collider = id_of(move.ground.collider);
  if (move.ride.ground != Ride::none) move.ride.ground = id_of(move.ride.ground);
  for (SensorEvent& event : report.sensors) event.sensor = id_of(event.sensor);
  to_ids({move.crushed.begin(), move.crushed.size()});
  to_ids({report.dropped_through.begin(), report.dropped_through.size()});
}

void NearScenery::to_ids(std::span<ColliderIndex> colliders) const {
  for (ColliderIndex& collider : colliders) collider = id_of(collider);
}

}  // namespace paperproof::level
