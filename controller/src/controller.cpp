#include <paperproof/controller.hpp>
#include <paperproof/scenery.hpp>

#include <algorithm>
#include <new>

#include "inlining.hpp"
#include "intent.hpp"
#include "sensors.hpp"
#include "step/octagon_sweep.hpp"
#include "step_parts.hpp"
#include "turning/turning_step.hpp"

namespace paperproof {

using namespace intent;
using namespace step_parts;

namespace {

PAPERPROOF_INLINE bool accepts(const Scenery& scenery, const CharacterState& state, const Input& input,
                               const StepContext& context) {
  return context.dt > 0 && context.movers.size() >= scenery.mover_count() && is_unit(context.up) &&
         finite(state, input, context.gravity, context.dt, context.movers);
}

/// Whether a mover has an angle, or the state names a collider that is gone.
PAPERPROOF_INLINE bool needs_turning_step(const Scenery& scenery, const CharacterState& state,
                                          const StepContext& context) {
  const auto is_gone = [&](const Crusher& crusher) { return !scenery.has(crusher.collider); };
  return (state.ride.ground != Ride::none && !scenery.has(state.ride.ground)) || any_angle(context.movers) ||
         std::ranges::any_of(state.crushers, is_gone);
}

/// Refuses a step for which there is no memory. What the scratch holds is no longer known, so that no controller takes
/// it any more.
/// @param before how the state was.
PAPERPROOF_COLD StepStatus refuse_without_memory(const Intended& before, CharacterState& state, Scratch& scratch,
                                                 StepReport& report) {
  intended(state) = before;
  scratch.maker.reset();
  report.move.refusal = "out of memory: make another scratch";
  return report.status = report.move.status = StepStatus::refused;
}

}  // namespace

DesiredVelocity desired_velocity(const CharacterDef& character, const Vec2d& gravity, const Input& input, double dt,
                                 CharacterState& state, bool wall_ahead) noexcept {
  // Component by component: a pair that is written as two numbers and read as one vector waits for the memory.
  double x = input.move ? steered(character, state, *input.move, dt) : state.velocity.x();
  const double change = x - state.velocity.x();
  double y = state.velocity.y();
  if (change * state.velocity.x() < 0 && state.grounded && y > 0) [[unlikely]]
    y = slowed_climb(character, state, x);
  if (input.jump != state.jump_held || state.jump_pending) [[unlikely]]
    y = use_button(character, input, wall_ahead, dt, state, y);
  count_down_coyote(character, dt, state);
  x += gravity.x() * dt;
  y += gravity.y() * dt;
  if (character.max_fall_speed) y = std::max(y, -*character.max_fall_speed);
  return {{x, y}, change};
}

Controller::Controller(const Scenery& scenery, const CharacterDef& character, const SweepDef& sweep)
    : Controller(scenery, character, octagon_sweep::in_double::make_sweep(sweep, scenery, character), sweep.search) {}

Controller::Controller(const Scenery& scenery, const CharacterDef& character,
                       std::shared_ptr<const octagon_sweep::SweepInParts> sweep, PieceSearch search)
    : scenery_(&scenery), search_(search), character_(character), sweep_(std::move(sweep)) {}

Scratch Controller::make_scratch() const {
  Scratch scratch = sweep_->make_scratch();
  scratch.sensors = std::make_unique<Sensors>(*scenery_, character_.shape, search_);
  scratch.turning = std::make_unique<turning::Memory>();
  scratch.maker = sweep_;
  return scratch;
}

void Controller::reserve(const Box2& positions, Scratch& scratch) const {
  if (!is_made_by(sweep_, scratch.maker)) return;
  sweep_->reserve(positions, scratch);
  static_cast<Sensors&>(*scratch.sensors).reserve(positions);
}

/// Tries a move towards the wall, without making it. Kept out of `step`: nearly no step needs it.
PAPERPROOF_NOT_INLINE bool Controller::has_wall_ahead(const CharacterState& state, double move,
                                                      const StepContext& context, Scratch& scratch,
                                                      MoveResult& tried) const {
  const double reach = character_.wall_reach;
  const Around here = around(context, scratch);
  const Vec2d there = here.up.in_world({move < 0 ? -reach : reach, 0});
  CharacterState free = state;
  free.crushed = false;
  free.crushers.clear();
  sweep_->move({free, there, there / context.dt, context.dt, here}, scratch, tried);
  return touches(tried, move < 0 ? Side::left : Side::right);
}

PAPERPROOF_INLINE octagon_sweep::Around Controller::around(const StepContext& context, const Scratch& scratch) const {
  const turning::Memory& memory = turning::memory_of(scratch);
  const Moving moving{context.movers.first(scenery_->mover_count() + memory.apart.size()), memory.apart};
  return {moving, filter_of(context), context.up, memory.limits};
}

PAPERPROOF_INLINE octagon_sweep::StepRequest Controller::begin_step(const Input& input, const StepContext& context,
                                                                    const Around& here, bool wall_ahead,
                                                                    CharacterState& state, StepReport& report) const {
  // A carried character steers, jumps and falls relative to its ground.
  if (state.ride.ground != Ride::none) state.velocity -= state.ride.velocity;
  const UpFrame& up = here.up;
  const double dt = context.dt;
  state.velocity = up.seen(state.velocity);
  const bool rises = state.jumping;
  const auto [seen, steered] = desired_velocity(character_, up.seen(context.gravity), input, dt, state, wall_ahead);
  const Vec2d velocity = up.in_world(seen);
  report.requested = {velocity.x() * dt, velocity.y() * dt};
  report.steered = steered * dt;
  const bool jumps = state.jumping && !rises;
  return {state, report.requested, velocity, dt, here, steered, input.drop, jumps ? 0 : dt};
}

/// What the character passed without being stopped. Kept out of `step`, into which all that it calls is inlined.
PAPERPROOF_NOT_INLINE void Controller::note_passed(bool drop, const StepContext& context, Scratch& scratch,
                                                   StepReport& report) const {
  const std::span<const PathPoint> path = report.move.path;
  const Around here = around(context, scratch);
  static_cast<Sensors&>(*scratch.sensors).observe(path, here.moving, report.sensors, here.filter);
  if (drop) sweep_->find_passed(here, path, scratch, report.dropped_through);
}

PAPERPROOF_INLINE void Controller::end_step(bool drop, const StepContext& context, Scratch& scratch,
                                            CharacterState& state, StepReport& report) const {
  if (search_ == PieceSearch::none || scenery_->counts().sensors > 0 || (drop && scenery_->counts().one_way > 0))
    note_passed(drop, context, scratch, report);
  adopt(character_, context.up, report.move, state);
}

/// A step, or a move by a displacement: the compiler knows which.
PAPERPROOF_INLINE StepStatus Controller::go(CharacterState& state, const turning::Wish& wish,
                                            const StepContext& context, Scratch& scratch, StepReport& report) const {
  static constexpr Input none{};
  const Input& input = wish.input != nullptr ? *wish.input : none;
  const Intended before = intended(state);
  try {
    report.sensors.clear();
    report.dropped_through.clear();
    const auto is_finite = [&](const Vec2d& way) { return FiniteCheck().add(way).add(way / context.dt).passed(); };
    if (!is_made_by(sweep_, scratch.maker) || !accepts(*scenery_, state, input, context) ||
        !(wish.input != nullptr || is_finite(wish.displacement)))
      return report.status = StepStatus::invalid_input;
    if (!turning::memory_of(scratch).is_in_part && needs_turning_step(*scenery_, state, context)) [[unlikely]]
      return step_in_parts(state, wish, context, scratch, report);
    const bool wall_ahead = wish.input != nullptr && asks_for_wall(character_, input, state) &&
                            has_wall_ahead(state, *input.move, context, scratch, report.move);
    const Around here = around(context, scratch);
    if (wish.input != nullptr) {
      // A request with a name, read again after the move, cost 46 instructions more per step (g++ 12).
      sweep_->move(begin_step(input, context, here, wall_ahead, state, report), scratch, report.move);
    } else {
      report.requested = wish.displacement;
      report.steered = 0;
      sweep_->move({state, wish.displacement, wish.displacement / context.dt, context.dt, here}, scratch, report.move);
    }
    report.status = report.move.status;
    if (is_refused(report.status)) {
      intended(state) = before;
      return report.status;
    }
    if (wish.input == nullptr) {
      note_press(character_, state.jump_held, context.dt, state);  // as it was: time alone passes
      count_down_coyote(character_, context.dt, state);
    }
    end_step(input.drop, context, scratch, state, report);
    return report.status;
  } catch (const std::bad_alloc&) {
    return refuse_without_memory(before, state, scratch, report);
  }
}

PAPERPROOF_FLATTEN StepStatus Controller::step(CharacterState& state, const Input& input, const StepContext& context,
                                               Scratch& scratch, StepReport& report) const noexcept {
  return go(state, {&input, Vec2d::Zero()}, context, scratch, report);
}

StepStatus Controller::move(CharacterState& state, const Vec2d& displacement, const StepContext& context,
                            Scratch& scratch, StepReport& report) const noexcept {
  return go(state, {nullptr, displacement}, context, scratch, report);
}

PAPERPROOF_COLD StepStatus Controller::step_in_parts(CharacterState& state, const turning::Wish& wish,
                                                     const StepContext& context, Scratch& scratch,
                                                     StepReport& report) const {
  const CharacterState before = state;
  try {
    return turning::TurningStep(*this, context, scratch, report).step(state, wish);
  } catch (const std::bad_alloc&) {
    state = before;
    throw;
  }
}

std::span<const TurnedCollider> Controller::turned(const Scratch& scratch) noexcept {
  return scratch.turning == nullptr ? std::span<const TurnedCollider>{} : turning::memory_of(scratch).turned;
}

Box2 Controller::reach(const CharacterState& state, const StepContext& context) const noexcept {
  const double dt = context.dt;
  const double acceleration =
      character_.acceleration + character_.air_acceleration.value_or(0) + context.gravity.norm();
  const double reach = (character_.jump_speed + acceleration * dt) * dt + character_.snap + character_.step_height +
                       character_.wall_reach + 2 * most_turned;
  const Vec2d goes = state.position + (state.velocity + state.ride.velocity) * dt;
  return (Box2::between(state.position, goes) + character_.shape.box()).inflated(reach);
}

Box2 Controller::reach(const MoveResult& move) const noexcept {
  return (box_around(move.path, {}).with(move.position) + character_.shape.box()).inflated(most_turned);
}

/// Asks about a character that goes from a position.
/// @param within [m] of its way. @param ask called with what is around it, unless the question cannot be answered:
/// then the answer is an empty one.
template <class Ask>
auto Controller::answer(const Vec2d& position, const Vec2d& displacement, double within, const StepContext& context,
                        Scratch& scratch, const Ask& ask) const {
  const bool is_answered = is_made_by(sweep_, scratch.maker) && in_range(position) &&
                           in_range(Vec2d(position + displacement)) && within <= Tolerances{}.range &&
                           context.movers.size() >= scenery_->mover_count() && is_unit(context.up) &&
                           (context.movers.empty() || finite(context.movers, 1.0));
  using Answer = decltype(ask(Around{}));
  if (!is_answered) return Answer{};
  const Box2 box = Box2::between(position, position + displacement) + character_.shape.box();
  StepContext posed = context;
  std::optional<turning::TurningStep> question;
  try {
    if (any_angle(context.movers))
      posed.movers = question.emplace(*this, context, scratch, turning::memory_of(scratch).of_part)
                         .hold_angles(box.inflated(within));
    return ask(around(posed, scratch));
  } catch (const std::bad_alloc&) {
    scratch.maker.reset();
    return Answer{};
  }
}

std::optional<Contact> Controller::cast(const Vec2d& position, const Vec2d& displacement, const StepContext& context,
                                        Scratch& scratch) const noexcept {
  return answer(position, displacement, 0, context, scratch,
                [&](const Around& around) { return sweep_->cast(position, displacement, around, scratch); });
}

std::optional<std::size_t> Controller::overlaps(const Vec2d& position, const StepContext& context, Scratch& scratch,
                                                std::span<ColliderIndex> found) const noexcept {
  return answer(position, {0, 0}, 0, context, scratch, [&](const Around& around) {
    return std::optional(sweep_->overlaps(position, around, scratch, found));
  });
}

std::size_t Controller::contacts_at(const Vec2d& position, double within, const StepContext& context, Scratch& scratch,
                                    std::span<Contact> found) const noexcept {
  return answer(position, {0, 0}, std::max(within, 0.0), context, scratch,
                [&](const Around& around) { return sweep_->contacts_at(position, within, around, scratch, found); });
}

std::size_t Controller::sensors_at(const Vec2d& position, const StepContext& context, Scratch& scratch,
                                   std::span<ColliderIndex> found) const noexcept {
  return answer(position, {0, 0}, 0, context, scratch, [&](const Around& around) {
    return static_cast<Sensors&>(*scratch.sensors).around(position, around.moving, around.filter, found);
  });
}

}  // namespace paperproof
