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

bool same_collider(const NearCollider& a, const NearCollider& b) noexcept {
  return a.id == b.id && a.version == b.version && a.mover == b.mover;
}

/// Which of two points comes first.
bool comes_first(const Vec2d& a, const Vec2d& b) noexcept { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); }

}  // namespace

bool is_there(const NearCollider& collider, const ColliderFilter* filter) {
  return (filter == nullptr ? ColliderFilter{} : *filter)(collider.id, collider.def->filter);
}

void NearScenery::read(const Box2& needed, const StepContext& context, const Find& find) {
  const Vec2d spare = (box_.upper - box_.lower) - (needed.upper - needed.lower);
  if (!box_.contains(needed) || spare.maxCoeff() > 4 * read_ahead) box_ = needed.inflated(read_ahead);
  near_.swap(near_before_);
  near_.clear();
  find(box_, near_);
  const auto by_id = [](const NearCollider& a, const NearCollider& b) { return a.id < b.id; };
  if (!std::is_sorted(near_.begin(), near_.end(), by_id)) std::sort(near_.begin(), near_.end(), by_id);
  const auto same_id = [](const NearCollider& a, const NearCollider& b) { return a.id == b.id; };
  near_.erase(std::unique(near_.begin(), near_.end(), same_id), near_.end());
  leave_out_known();
  number_movers(context.dt);
  note_what_turns(needed, context.filter);
  const bool is_same = std::equal(near_.begin(), near_.end(), near_before_.begin(), near_before_.end(), same_collider);
  if (!is_same || !scenery_) place_in_order();
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

/// The order depends on what the colliders are, not on their ids: an edited level gives the bits of one that was built
/// at once.
void NearScenery::place_in_order() {
  scenery_.reset();
  order_.resize(near_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
  const auto key = [&](std::size_t i) {
    const NearCollider& collider = near_[i];
    const Box2 extent = box_at(collider.def->points, {});
    return std::tuple(collider.mover + 1, extent.lower.x(), extent.lower.y(), extent.upper.x(), extent.upper.y(),
                      collider.def->points.size());
  };
  std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
    const auto [one, other] = std::pair(key(a), key(b));
    if (one != other) return one < other;
    const std::vector<Vec2d>& points = near_[a].def->points;
    const std::vector<Vec2d>& others = near_[b].def->points;
    if (points != others)
      return std::lexicographical_compare(points.begin(), points.end(), others.begin(), others.end(), comes_first);
    if (near_[a].def->radius != near_[b].def->radius) return near_[a].def->radius < near_[b].def->radius;
    const double speed = near_[a].def->surface_speed;
    return speed != near_[b].def->surface_speed ? speed < near_[b].def->surface_speed : a < b;
  });
}

SceneryDef NearScenery::scenery_def() const {
  SceneryDef def;
  for (const std::size_t i : order_) {
    const MoverIndex mover = near_[i].mover;
    const auto [angle, surface_speed] = mover == no_mover ? std::pair(0.0, 0.0) : built_[mover];
    def.colliders.push_back(turned_collider(*near_[i].def, angle, mover));
    if (def.colliders.back().carries) def.colliders.back().surface_speed += surface_speed;
  }
  return def;
}

/// Leaves out what was refused before.
void NearScenery::leave_out_known() {
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

/// Leaves out a collider of the scenery that is refused, and its mover, if that moves nothing else.
void NearScenery::leave_out(ColliderIndex local) {
  NearCollider& collider = near_[order_[local]];
  unusable_.push_back(collider.id);
  refused_.emplace_back(collider.id, collider.version);
  order_.erase(order_.begin() + local);
  const MoverIndex mover = std::exchange(collider.mover, no_mover);
  const auto is_its = [&](const NearCollider& other) { return other.mover == mover; };
  if (mover == no_mover || std::any_of(near_.begin(), near_.end(), is_its)) return;
  movers_.erase(movers_.begin() + mover);
  for (NearCollider& other : near_)
    if (other.mover != no_mover && other.mover > mover) --other.mover;
}

bool NearScenery::build(double fraction) {
  const auto angles_and_speeds = [&] {
    now_.clear();
    for (const NearMover& mover : movers_)
      now_.emplace_back(pose_at(mover.motion, fraction).angle, mover.surface_speed);
  };
  angles_and_speeds();
  if (scenery_ && now_ == built_) return true;
  for (scenery_.reset(); !scenery_;) {  // each round but the last leaves out a collider
    angles_and_speeds();
    built_ = now_;
    try {
      scenery_.emplace(scenery_def(), character_);
    } catch (const InvalidScenery& refused) {
      const NearCollider& collider = at(refused.collider());
      try {
        const Scenery as_defined(SceneryDef{{turned_collider(*collider.def, 0, no_mover)}});
        return false;
      } catch (const InvalidScenery&) {
        leave_out(refused.collider());
      }
    }
  }
  ids_.clear();
  for (const std::size_t i : order_) ids_.push_back(near_[i].id);
  return true;
}

ColliderIndex NearScenery::local_of(ColliderIndex id) const noexcept {
  const auto found = std::find(ids_.begin(), ids_.end(), id);
  return found == ids_.end() ? no_collider : static_cast<ColliderIndex>(found - ids_.begin());
}

StepContext NearScenery::context(StepContext context, std::span<const MoverMotion> motions) noexcept {
  context.movers = motions.first(scenery_->scenery.mover_count());
  if (context.filter == nullptr) return context;
  filter_of_ids_ = {*context.filter, ids_};
  filter_ = *context.filter;
  filter_.user = &filter_of_ids_;
  if (filter_.is_there != nullptr)
    filter_.is_there = [](ColliderIndex collider, const void* user) {
      const auto& of_ids = *static_cast<const FilterOfIds*>(user);
      return of_ids.filter.is_there(of_ids.ids[collider], of_ids.filter.user);
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
  if (state.ride.ground != Ride::none) state.ride.ground = ids_[state.ride.ground];
  if (state.ground.state != GroundState::air) state.ground.collider = ids_[state.ground.collider];
  for (Crusher& crusher : state.crushers) crusher.collider = ids_[crusher.collider];
}

void NearScenery::to_ids(StepReport& report) const {
  MoveResult& move = report.move;
  for (Contact& contact : move.contacts) contact.collider = ids_[contact.collider];
  for (Crusher& crusher : move.crushers) crusher.collider = ids_[crusher.collider];
  if (move.ground.state != GroundState::air) move.ground.collider = ids_[move.ground.collider];
  if (move.ride.ground != Ride::none) move.ride.ground = ids_[move.ride.ground];
  for (SensorEvent& event : report.sensors) event.sensor = ids_[event.sensor];
  to_ids({move.crushed.begin(), move.crushed.size()});
  to_ids({report.dropped_through.begin(), report.dropped_through.size()});
}

void NearScenery::to_ids(std::span<ColliderIndex> colliders) const {
  for (ColliderIndex& collider : colliders) collider = ids_[collider];
}

}  // namespace paperproof::level
