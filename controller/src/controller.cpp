#include <paperproof/controller.hpp>
#include <paperproof/scenery.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inlining.hpp"
#include "one_way_chains.hpp"
#include "sensors.hpp"
#include "step/octagon_sweep.hpp"
#include "step_parts.hpp"
#include "turning/turning_step.hpp"

namespace paperproof {
namespace {

using namespace step_parts;

PAPERPROOF_INLINE double steered(const CharacterDef& character, const CharacterState& state, double move,
                                 double dt) noexcept {
  const double acceleration =
      state.grounded ? character.acceleration : character.air_acceleration.value_or(character.acceleration);
  const double target = std::clamp(move, -1.0, 1.0) * character.walk_speed;
  const double change = acceleration * dt;
  return state.velocity.x() + std::clamp(target - state.velocity.x(), -change, change);
}

bool may_jump(const CharacterDef& character, const CharacterState& state, const Input& input,
              bool wall_ahead) noexcept {
  if (state.crushed || state.jumping || !(state.grounded || state.coyote_left > 0)) return false;
  if (!character.no_jump_toward_wall) return true;
  const double move = input.move.value_or(0);
  return !wall_ahead && !(move < 0 && state.wall_left) && !(move > 0 && state.wall_right);
}

/// Notes a press of the jump button, and ends one that has been pending for too long.
void note_press(const CharacterDef& character, bool pressed, double dt, CharacterState& state) noexcept {
  if (pressed && !state.jump_held) {
    state.jump_pending = true;
    if (character.jump_buffer) state.pending_left = *character.jump_buffer;
  } else if (character.jump_buffer) {
    state.pending_left = std::max(state.pending_left - dt, 0.0);
    state.jump_pending = state.jump_pending && state.pending_left > 0;
  } else if (!pressed) {
    state.jump_pending = false;
  }
}

/// The upward speed after the button was pressed or released, or a press is pending. Kept out of most steps.
PAPERPROOF_COLD double use_button(const CharacterDef& character, const Input& input, bool wall_ahead, double dt,
                                  CharacterState& state, double upwards) noexcept {
  note_press(character, input.jump, dt, state);
  const bool released = state.jump_held && !input.jump;
  if (released && state.jumping && upwards > 0) upwards *= character.jump_cut;
  state.jump_held = input.jump;
  if (state.jump_pending && may_jump(character, state, input, wall_ahead)) {
    upwards = character.jump_speed;
    state.jumping = true;
    state.grounded = state.jump_pending = false;
    state.coyote_left = 0;
    if (!input.jump) upwards *= character.jump_cut;
  }
  return upwards;
}

/// The upward speed of a walker that brakes or turns round on a slope: the climb slows with the walk. The walker would
/// leave the ground with the speed of its climb otherwise. A rise that is steeper than walkable ground is no climb, nor
/// is the speed of ground that moved and is gone.
/// @param walk speed of the walk from now on.
PAPERPROOF_COLD double slowed_climb(const CharacterDef& character, const CharacterState& state, double walk) noexcept {
  const Vec2d& before = state.velocity;
  const double cosine = character.walkable_cosine();
  const double steepest = std::sqrt(1 - cosine * cosine) / cosine;
  const bool is_left = state.ride.ground == Ride::none && !state.ground.velocity.isZero(0);
  if (is_left || !(before.y() <= std::abs(before.x()) * steepest)) return before.y();
  return before.y() * std::max(walk / before.x(), 0.0);
}

/// Counted from the first step that begins in the air.
void count_down_coyote(const CharacterDef& character, double dt, CharacterState& state) noexcept {
  if (character.coyote_time > 0)
    state.coyote_left = state.grounded ? character.coyote_time : std::max(state.coyote_left - dt, 0.0);
}

/// @param wall_ahead there is a wall to jump against, whatever the last step touched.
PAPERPROOF_INLINE DesiredVelocity wanted_velocity(const CharacterDef& character, const Vec2d& gravity,
                                                  const Input& input, double dt, bool wall_ahead,
                                                  CharacterState& state) noexcept {
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

/// Restores the members of a state that the intent changes, if the step is refused later. (A copy of the whole state
/// costs a tenth of a step.)
class Undo {
 public:
  explicit Undo(const CharacterState& state) noexcept
      : velocity_(state.velocity),
        grounded_(state.grounded),
        jumping_(state.jumping),
        jump_held_(state.jump_held),
        jump_pending_(state.jump_pending),
        coyote_left_(state.coyote_left),
        pending_left_(state.pending_left) {}

  void restore(CharacterState& state) const noexcept {
    state.velocity = velocity_;
    state.grounded = grounded_;
    state.jumping = jumping_;
    state.jump_held = jump_held_;
    state.jump_pending = jump_pending_;
    state.coyote_left = coyote_left_;
    state.pending_left = pending_left_;
  }

 private:
  Vec2d velocity_;
  bool grounded_;
  bool jumping_;
  bool jump_held_;
  bool jump_pending_;
  double coyote_left_;
  double pending_left_;
};

}  // namespace

DesiredVelocity desired_velocity(const CharacterDef& character, const Vec2d& gravity, const Input& input, double dt,
                                 CharacterState& state, bool wall_ahead) noexcept {
  return wanted_velocity(character, gravity, input, dt, wall_ahead, state);
}

Controller::Controller(const Scenery& scenery, const CharacterDef& character, const SweepDef& sweep)
    : Controller(scenery, character, octagon_sweep::in_double::make_sweep(sweep, scenery, character), sweep.search) {}

Controller::Controller(const Scenery& scenery, const CharacterDef& character,
                       std::shared_ptr<const octagon_sweep::SweepInParts> sweep, PieceSearch search)
    : scenery_(&scenery),
      asks_all_(search == PieceSearch::none),
      character_(character),
      sweep_(std::move(sweep)),
      one_way_(std::make_shared<OneWayChains>(character_.shape)) {}

Scratch Controller::make_scratch() const {
  Scratch scratch = sweep_->make_scratch();
  scratch.sensors = std::make_unique<Sensors>(*scenery_, character_.shape, sweep_->finder().search());
  scratch.turning = std::make_unique<turning::Memory>();
  scratch.maker = sweep_;
  return scratch;
}

void Controller::reserve(const Box2& positions, Scratch& scratch) const {
  if (!is_made_by(sweep_, scratch.maker)) return;
  sweep_->reserve(positions, scratch);
  static_cast<Sensors&>(*scratch.sensors).reserve(positions);
}

PAPERPROOF_INLINE Moving Controller::moving_in(const StepContext& context, const Scratch& scratch) const noexcept {
  const std::vector<PieceIndex>& circles = turning::memory_of(scratch).circles;
  return {context.movers.first(scenery_->mover_count() + circles.size()), circles};
}

PAPERPROOF_INLINE bool Controller::accepts(const CharacterState& state, const Input& input,
                                           const StepContext& context) const noexcept {
  return context.dt > 0 && context.movers.size() >= scenery_->mover_count() && is_unit(context.up) &&
         finite(state, input, context.gravity, context.dt, context.movers);
}

/// Tries a move towards the wall, without making it. Kept out of `step`: nearly no step needs it.
PAPERPROOF_NOT_INLINE bool Controller::has_wall_ahead(const CharacterState& state, double move,
                                                      const StepContext& context, Scratch& scratch,
                                                      MoveResult& tried) const noexcept {
  const double reach = character_.wall_reach;
  const Moving moving = moving_in(context, scratch);
  const Around here = around(context, moving);
  const Vec2d there = here.up.in_world({move < 0 ? -reach : reach, 0});
  CharacterState free = state;
  free.crushed = false;
  free.crushers.clear();
  sweep_->move_part(octagon_sweep::Part::whole,
                    request_of(free, there, there / context.dt, 0, false, false, context.dt, here), scratch, tried);
  return touches(tried, move < 0 ? Side::left : Side::right);
}

PAPERPROOF_INLINE octagon_sweep::Around Controller::around(const StepContext& context,
                                                           const Moving& moving) const noexcept {
  return {&moving, filter_of(context), context.up};
}

PAPERPROOF_INLINE octagon_sweep::StepRequest Controller::request_of(const CharacterState& state,
                                                                    const Vec2d& displacement, const Vec2d& velocity,
                                                                    double steered, bool drop, bool jumps, double dt,
                                                                    const Around& here) noexcept {
  return {.state = state,
          .displacement = displacement,
          .velocity = velocity,
          .steered = steered,
          .grounded = state.grounded,
          .drop = drop,
          .next_dt = jumps ? 0 : dt,
          .dt = dt,
          .around = here};
}

PAPERPROOF_INLINE octagon_sweep::StepRequest Controller::begin_step(const Input& input, const StepContext& context,
                                                                    const Around& here, bool wall_ahead,
                                                                    CharacterState& state,
                                                                    StepReport& report) const noexcept {
  // A carried character steers, jumps and falls relative to its ground.
  if (state.ride.ground != Ride::none) state.velocity -= state.ride.velocity;
  const UpFrame& up = here.up;
  const double dt = context.dt;
  state.velocity = up.seen(state.velocity);
  const bool rises = state.jumping;
  const auto [seen, steered] = wanted_velocity(character_, up.seen(context.gravity), input, dt, wall_ahead, state);
  const Vec2d velocity = up.in_world(seen);
  report.requested = {velocity.x() * dt, velocity.y() * dt};
  report.steered = steered * dt;
  return request_of(state, report.requested, velocity, steered, input.drop, state.jumping && !rises, dt, here);
}

[[nodiscard]] PAPERPROOF_INLINE bool Controller::may_pass_something(bool drop) const noexcept {
  return asks_all_ || scenery_->counts().sensors > 0 || (drop && scenery_->counts().one_way > 0);
}

/// What the character passed without being stopped. Kept out of `step`, into which all that it calls is inlined.
PAPERPROOF_NOT_INLINE void Controller::note_passed(bool drop, const StepContext& context, Scratch& scratch,
                                                   StepReport& report) const noexcept {
  const std::span<const PathPoint> path = report.move.path;
  const Moving moving = moving_in(context, scratch);
  static_cast<Sensors&>(*scratch.sensors).observe(path, moving, report.sensors, filter_of(context));
  if (drop) sweep_->find_passed(around(context, moving), path, *one_way_, scratch, report.dropped_through);
}

PAPERPROOF_INLINE void Controller::end_step(bool drop, const StepContext& context, Scratch& scratch,
                                            CharacterState& state, StepReport& report) const noexcept {
  if (may_pass_something(drop)) note_passed(drop, context, scratch, report);
  adopt(character_, context.up, report.move, state);
}

PAPERPROOF_FLATTEN StepStatus Controller::step(CharacterState& state, const Input& input, const StepContext& context,
                                               Scratch& scratch, StepReport& report) const noexcept {
  report.sensors.clear();
  report.dropped_through.clear();
  if (!is_made_by(sweep_, scratch.maker) || !accepts(state, input, context))
    return report.status = StepStatus::invalid_input;
  if (is_divided(state, context, scratch)) [[unlikely]]
    return step_in_parts(state, {&input, Vec2d::Zero()}, context, scratch, report);
  const Undo before(state);
  const bool wall_ahead =
      asks_for_wall(character_, input, state) && has_wall_ahead(state, *input.move, context, scratch, report.move);
  // A request with a name, read again after the move, cost 46 instructions more per step (g++ 12).
  const Moving moving = moving_in(context, scratch);
  const Around here = around(context, moving);
  sweep_->move_part(octagon_sweep::Part::whole, begin_step(input, context, here, wall_ahead, state, report), scratch,
                    report.move);
  report.status = status_of(report.move.status);
  if (is_refused(report.status)) {
    before.restore(state);
    return report.status;
  }
  end_step(input.drop, context, scratch, state, report);
  return report.status;
}

StepStatus Controller::move(CharacterState& state, const Vec2d& displacement, const StepContext& context,
                            Scratch& scratch, StepReport& report) const noexcept {
  report.sensors.clear();
  report.dropped_through.clear();
  const Vec2d velocity = displacement / context.dt;
  if (!is_made_by(sweep_, scratch.maker) || !accepts(state, {}, context) ||
      !FiniteCheck().add(displacement).add(velocity).passed())
    return report.status = StepStatus::invalid_input;
  if (is_divided(state, context, scratch))
    return step_in_parts(state, {nullptr, displacement}, context, scratch, report);
  report.requested = displacement;
  report.steered = 0;
  const Moving moving = moving_in(context, scratch);
  const Around here = around(context, moving);
  sweep_->move_part(octagon_sweep::Part::whole,
                    request_of(state, displacement, velocity, 0, false, false, context.dt, here), scratch, report.move);
  report.status = status_of(report.move.status);
  if (is_refused(report.status)) return report.status;
  note_press(character_, state.jump_held, context.dt, state);  // as it was: time alone passes
  count_down_coyote(character_, context.dt, state);
  end_step(false, context, scratch, state, report);
  return report.status;
}

bool Controller::is_divided(const CharacterState& state, const StepContext& context,
                            const Scratch& scratch) const noexcept {
  if (turning::memory_of(scratch).is_in_part) return false;
  const bool all_there =
      state.crushers.empty() || std::all_of(state.crushers.begin(), state.crushers.end(),
                                            [&](const Crusher& crusher) { return scenery_->has(crusher.collider); });
  return !all_there || (state.ride.ground != Ride::none && !scenery_->has(state.ride.ground)) ||
         any_angle(context.movers);
}

PAPERPROOF_COLD StepStatus Controller::step_in_parts(CharacterState& state, const turning::Wish& wish,
                                                     const StepContext& context, Scratch& scratch,
                                                     StepReport& report) const noexcept {
  return turning::TurningStep(*this, context, scratch, report).step(state, wish);
}

StepStatus Controller::wait(CharacterState& state, const StepContext& context, Scratch& scratch,
                            StepReport& report) const {
  if (!is_made_by(sweep_, scratch.maker) || !accepts(state, {}, context))
    return report.status = StepStatus::invalid_input;
  return turning::TurningStep(*this, context, scratch, report).wait(state);
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
  const Box2& extent = character_.shape.box();
  return Box2{state.position.cwiseMin(goes) + extent.lower, state.position.cwiseMax(goes) + extent.upper}.inflated(
      reach);
}

Box2 Controller::reach(const MoveResult& move) const noexcept {
  Box2 positions{move.position, move.position};
  for (const PathPoint& corner : move.path) positions = positions.merged({corner.position, corner.position});
  const Box2& extent = character_.shape.box();
  return Box2{positions.lower + extent.lower, positions.upper + extent.upper}.inflated(most_turned);
}

bool Controller::can_answer(const Vec2d& position, const Vec2d& displacement, const StepContext& context,
                            const Scratch& scratch) const noexcept {
  return is_made_by(sweep_, scratch.maker) && in_range(position) && in_range(Vec2d(position + displacement)) &&
         context.movers.size() >= scenery_->mover_count() && is_unit(context.up) &&
         (context.movers.empty() || finite(context.movers, 1.0));
}

/// Asks about a character that goes from a position.
/// @param within [m] of its way. @param ask called with what is around it.
template <class Ask>
auto Controller::answer(const Vec2d& position, const Vec2d& displacement, double within, const StepContext& context,
                        Scratch& scratch, const Ask& ask) const noexcept {
  const Box2& extent = character_.shape.box();
  const Vec2d end = position + displacement;
  const Box2 box{position.cwiseMin(end) + extent.lower, position.cwiseMax(end) + extent.upper};
  StepContext posed = context;
  std::optional<turning::TurningStep> question;
  if (any_angle(context.movers))
    posed.movers = question.emplace(*this, context, scratch, turning::memory_of(scratch).of_part)
                       .hold_angles(box.inflated(within));
  const Moving moving = moving_in(posed, scratch);
  return ask(around(posed, moving));
}

std::optional<Contact> Controller::cast(const Vec2d& position, const Vec2d& displacement, const StepContext& context,
                                        Scratch& scratch) const noexcept {
  if (!can_answer(position, displacement, context, scratch)) return std::nullopt;
  return answer(position, displacement, 0, context, scratch,
                [&](const Around& around) { return sweep_->cast(position, displacement, around, scratch); });
}

std::optional<std::size_t> Controller::overlaps(const Vec2d& position, const StepContext& context, Scratch& scratch,
                                                std::span<ColliderIndex> found) const noexcept {
  if (!can_answer(position, {0, 0}, context, scratch)) return std::nullopt;
  return answer(position, {0, 0}, 0, context, scratch,
                [&](const Around& around) { return sweep_->overlaps(position, around, scratch, found); });
}

std::size_t Controller::contacts_at(const Vec2d& position, double within, const StepContext& context, Scratch& scratch,
                                    std::span<Contact> found) const noexcept {
  if (!can_answer(position, {0, 0}, context, scratch) || !(within <= Tolerances{}.range)) return 0;
  return answer(position, {0, 0}, std::max(within, 0.0), context, scratch,
                [&](const Around& around) { return sweep_->contacts_at(position, within, around, scratch, found); });
}

std::size_t Controller::sensors_at(const Vec2d& position, const StepContext& context, Scratch& scratch,
                                   std::span<ColliderIndex> found) const noexcept {
  if (!can_answer(position, {0, 0}, context, scratch)) return 0;
  return answer(position, {0, 0}, 0, context, scratch, [&](const Around& around) {
    return static_cast<Sensors&>(*scratch.sensors).around(position, *around.moving, around.filter, found);
  });
}

bool Controller::begin_together(const CharacterState& before, const Input& input, const StepContext& context,
                                const Around& here, CharacterState& state, std::optional<StepRequest>& request,
                                StepReport& report) const noexcept {
  if (!accepts(before, input, context) || any_angle(context.movers)) return false;
  state = before;
  if (state.ride.ground != Ride::none && !scenery_->has(state.ride.ground)) state.ride = {};
  request.emplace(begin_step(input, context, here, false, state, report));
  return true;
}

void Controller::end_together(const Input& input, const StepContext& context, Scratch& scratch, CharacterState& state,
                              StepReport& report) const noexcept {
  report.status = status_of(report.move.status);
  end_step(input.drop, context, scratch, state, report);
}

}  // namespace paperproof
