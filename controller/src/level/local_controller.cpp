#include "level/local_controller_impl.hpp"

#include <algorithm>

namespace paperproof {

using namespace level;

namespace {

/// Of what can be looked for. Written so that NaN is not.
bool is_in_range(const Box2& box) noexcept {
  constexpr double range = 1e8;
  return box.lower.x() > -range && box.lower.y() > -range && box.upper.x() < range && box.upper.y() < range;
}

}  // namespace

/// Everything that the step can reach, but a way out of solids.
Box2 LocalController::Impl::box_needed(const CharacterState& state, const StepContext& context) const {
  const double dt = context.dt;
  const double acceleration =
      character().acceleration + character().air_acceleration.value_or(0) + context.gravity.norm();
  const double reach = (character().jump_speed + acceleration * dt) * dt + character().snap + character().step_height +
                       character().wall_reach + 2 * most_turned;
  const Vec2d goes = state.position + (state.velocity + state.ride.velocity) * dt;
  const Box2 way{state.position.cwiseMin(goes), state.position.cwiseMax(goes)};
  const Box2& extent = character().shape.box();
  return Box2{way.lower + extent.lower, way.upper + extent.upper}.inflated(reach);
}

/// The box that everything which decides a move is in. A way out of solids may lead farther than was looked.
Box2 LocalController::Impl::box_along(const MoveResult& move) const {
  const Box2& extent = character().shape.box();
  Box2 way{move.path[0].position, move.path[0].position};
  for (const PathPoint& corner : move.path) way = way.merged({corner.position, corner.position});
  return Box2{way.lower + extent.lower, way.upper + extent.upper}.inflated(most_turned);
}

template <class Go>
StepStatus LocalController::Impl::advance(CharacterState& state, const StepContext& context, const Find& find,
                                          StepReport& report, const Go& go) {
  const CharacterState before = state;
  Box2 needed = box_needed(state, context);
  if (!(context.dt > 0 && is_in_range(needed))) return report.status = StepStatus::invalid_input;
  for (;;) {  // 27 times at most: `needed` doubles, from 4 * most_turned or more, until it has the whole range
    turned_.clear();
    state = before;  // `find` may ask the game, which may ask for the character
    scenery.read(needed, context, find);
    const StepStatus status = scenery.any_turns() ? step_among_turning(state, context, report, go)
                                                  : step_straight(state, context, report, go);
    if (is_refused(status)) {
      state = before;
      return status;
    }
    const Box2 way = box_along(report.move);
    if (needed.contains(way)) return status;
    needed = needed.merged(way.inflated((needed.upper - needed.lower).maxCoeff()));
  }
}

/// Where nothing near turns.
template <class Go>
StepStatus LocalController::Impl::step_straight(CharacterState& state, const StepContext& context, StepReport& report,
                                                const Go& go) {
  if (!scenery.build(1)) return refuse(state, report);
  motions.clear();
  for (const NearMover& mover : scenery.movers())
    motions.push_back({mover.motion.from.position, mover.motion.to.position});
  const Vec2d from = state.position;
  scenery.to_local(state);
  const StepStatus status =
      go(scenery.controller(), state, scenery.context(context, motions), 1.0, scenery.scratch(), report);
  if (status == StepStatus::invalid_input) return status;
  scenery.to_ids(report);
  if (is_refused(status)) return status;
  scenery.to_ids(state);
  note_turned_sensors({0, 1, motions}, from, context.filter, report);
  return status;
}

/// A collider cannot be turned as it should.
StepStatus LocalController::Impl::refuse(const CharacterState& state, StepReport& report) {
  report.move.refusal =
      "a collider near the character crosses itself when it is turned: two of its corners are so near "
      "to each other that rounding swaps them";
  return stay(MoveStatus::refused, state, report);
}

/// Reports a step that is refused.
StepStatus LocalController::Impl::stay(MoveStatus why, const CharacterState& state, StepReport& report) {
  const auto words = report.move.refusal;
  turned_.clear();
  report.clear();
  report.move.refusal = words;
  report.move.status = why;
  report.move.position = state.position;
  report.move.velocity = state.velocity;
  report.move.ride = state.ride;
  report.move.path.push_back({state.position, 0});
  report.move.path.push_back({state.position, 1});
  return report.status = step_parts::status_of(why);
}

template <class Go>
StepStatus LocalController::Impl::step_among_turning(CharacterState& state, const StepContext& context,
                                                     StepReport& report, const Go& go) {
  const CharacterState before = state;
  const int usual = parts_for(state, context);
  std::optional<int> crushing;  // so many parts can be proved, but crush the character
  const auto try_parts = [&](int parts) -> std::optional<StepStatus> {
    state = before;
    const std::optional<StepStatus> status = step_in_parts(parts, state, context, report, go);
    const bool is_inside = before.crushed || before.stuck_steps > 0;  // other divisions would not free it
    if (!status || report.move.crushed.empty() || is_inside) return status;
    if (!crushing) crushing = parts;
    return std::nullopt;
  };
  for (int parts = usual; parts <= most_parts; parts *= 2)
    if (const std::optional<StepStatus> status = try_parts(parts)) return *status;
  for (int parts = usual / 2; parts > 0; parts /= 2)
    if (const std::optional<StepStatus> status = try_parts(parts)) return *status;
  state = before;
  const StepStatus status = go_straight_or_stay(state, context, report);
  if (!crushing || status == StepStatus::moved) return status;
  state = before;
  return *step_in_parts(*crushing, state, context, report, go);
}

/// @return nothing if the step cannot be proved; it is not complete then.
template <class Go>
std::optional<StepStatus> LocalController::Impl::step_in_parts(int parts, CharacterState& state,
                                                               const StepContext& context, StepReport& report,
                                                               const Go& go) {
  report.clear();
  const CharacterState before = state;
  StepContext shorter = context;
  shorter.dt = context.dt / parts;
  for (int i = 0; i < parts; ++i) {
    if (!scenery.build(double(i + 1) / parts)) return refuse(before, report);
    if (i == 0) note_begin();
    StepPart part = turn(double(i) / parts, double(i + 1) / parts, state.position, context.filter);
    scenery.to_local(state);
    if (state.ride.ground != Ride::none) {
      const MoverIndex mover = scenery.at(state.ride.ground).mover;
      if (mover != no_mover && scenery.movers()[mover].turn() != 0)
        state.ride.place = state.position - part.motions[mover].from;
    }
    for (Crusher& crusher : state.crushers) {
      const NearCollider& collider = scenery.at(crusher.collider);
      if (collider.mover != no_mover)
        carry(crusher, middle(), pose_at(collider.motion, part.begin), turned_pose(collider, part));
    }
    const Vec2d from = state.position;
    const Vec2d carried = state.ride.velocity;
    const StepStatus status = go(scenery.controller(), state, scenery.context(shorter, part.motions), 1.0 / parts,
                                 scenery.scratch(), *of_part);
    if (status == StepStatus::invalid_input) return report.status = status;
    if (is_refused(status)) return stay(of_part->move.status, before, report);
    if (!find_way(part, of_part->move, context)) return std::nullopt;
    note_pushes(part, shorter);
    limit_speed(part, (of_part->requested / shorter.dt + carried).norm(), shorter.dt, of_part->move, state);
    scenery.to_ids(*of_part);
    scenery.to_ids(state);
    note_turned_sensors(part, from, context.filter, *of_part);
    note_vertices(part);
    append(*of_part, part, report);
    if (report.move.crushed.empty() || i + 1 == parts) continue;
    // It stays where it was crushed until the next step.
    go_straight(part.end, part.end, state.position, state, context, report);
    step_parts::adopt(character(), context.up, report.move, state);
    break;
  }
  return report.status;
}

LocalController::LocalController(const CharacterDef& character) : impl_(std::make_unique<Impl>(character)) {}
LocalController::~LocalController() = default;
LocalController::LocalController(LocalController&&) noexcept = default;
LocalController& LocalController::operator=(LocalController&&) noexcept = default;

StepStatus LocalController::step(CharacterState& state, const Input& input, const StepContext& context,
                                 const Find& find, StepReport& report) {
  return impl_->advance(
      state, context, find, report,
      [&](const Controller& controller, CharacterState& of, const auto& here, double /*share*/, Scratch& scratch,
          StepReport& result) { return controller.step(of, input, here, scratch, result); });
}

StepStatus LocalController::move(CharacterState& state, const Vec2d& displacement, const StepContext& context,
                                 const Find& find, StepReport& report) {
  return impl_->advance(
      state, context, find, report,
      [&](const Controller& controller, CharacterState& of, const auto& here, double share, Scratch& scratch,
          StepReport& result) { return controller.move(of, displacement * share, here, scratch, result); });
}

StepStatus LocalController::wait(CharacterState& state, const StepContext& context, const Find& find,
                                 StepReport& report) {
  Impl& impl = *impl_;
  const Box2& extent = impl.character().shape.box();
  const Box2 here{state.position + extent.lower, state.position + extent.upper};
  if (!(context.dt > 0 && is_in_range(here))) return report.status = StepStatus::invalid_input;
  impl.turned_.clear();
  impl.scenery.read(here, context, find);
  return impl.scenery.build(1) ? impl.wait(state, context, report) : impl.refuse(state, report);
}

std::optional<std::size_t> LocalController::overlaps(const Vec2d& position, const StepContext& context,
                                                     const Find& find, bool at_end, std::span<ColliderIndex> found) {
  Impl& impl = *impl_;
  const Box2& extent = impl.character().shape.box();
  if (!is_in_range({position, position})) return std::nullopt;
  impl.turned_.clear();
  impl.scenery.read({position + extent.lower, position + extent.upper}, context, find);
  if (!impl.scenery.build(at_end ? 1 : 0)) return std::nullopt;
  impl.motions.clear();
  for (const NearMover& mover : impl.scenery.movers()) {
    const Vec2d there = (at_end ? mover.motion.to : mover.motion.from).position;
    impl.motions.push_back({there, there});
  }
  const std::optional<std::size_t> count = impl.scenery.controller().overlaps(
      position, impl.scenery.context(context, impl.motions), impl.scenery.scratch(), found);
  impl.scenery.to_ids(found.first(std::min(count.value_or(0), found.size())));
  return count;
}

std::span<const TurnedCollider> LocalController::turned() const noexcept { return impl_->turned_; }
const Box2& LocalController::reach() const noexcept { return impl_->scenery.reach(); }
void LocalController::set_reach(const Box2& box) noexcept { impl_->scenery.set_reach(box); }
std::span<const ColliderIndex> LocalController::unusable() const noexcept { return impl_->scenery.unusable(); }
const CharacterDef& LocalController::character() const noexcept { return impl_->character(); }

}  // namespace paperproof
