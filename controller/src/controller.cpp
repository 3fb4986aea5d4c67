#include <paperproof/controller.hpp>
#include <paperproof/scenery_facts.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "one_way_chains.hpp"
#include "sensors.hpp"
#include "step/octagon_sweep.hpp"
#include "step_parts.hpp"

namespace paperproof {
namespace {

using namespace step_parts;

template <class Scalar>
[[gnu::always_inline]] inline Scalar steered(const CharacterDef& character, const CharacterState<Scalar>& state,
                                             double move, Scalar dt) noexcept {
  const double acceleration =
      state.grounded ? character.acceleration : character.air_acceleration.value_or(character.acceleration);
  const Scalar target = static_cast<Scalar>(std::clamp(move, -1.0, 1.0) * character.walk_speed);
  const Scalar change = static_cast<Scalar>(acceleration) * dt;
  return state.velocity.x() + std::clamp(target - state.velocity.x(), -change, change);
}

template <class Scalar>
bool may_jump(const CharacterDef& character, const CharacterState<Scalar>& state, const Input& input,
              bool wall_ahead) noexcept {
  if (state.crushed || state.jumping || !(state.grounded || state.coyote_left > 0)) return false;
  if (!character.no_jump_toward_wall) return true;
  const double move = input.move.value_or(0);
  return !wall_ahead && !(move < 0 && state.wall_left) && !(move > 0 && state.wall_right);
}

/// Notes a press of the jump button, and ends one that has been pending for too long.
template <class Scalar>
void note_press(const CharacterDef& character, bool pressed, Scalar dt, CharacterState<Scalar>& state) noexcept {
  if (pressed && !state.jump_held) {
    state.jump_pending = true;
    if (character.jump_buffer) state.pending_left = static_cast<Scalar>(*character.jump_buffer);
  } else if (character.jump_buffer) {
    state.pending_left = std::max(state.pending_left - dt, Scalar(0));
    state.jump_pending = state.jump_pending && state.pending_left > 0;
  } else if (!pressed) {
    state.jump_pending = false;
  }
}

/// The upward speed after the button was pressed or released, or a press is pending. Kept out of most steps.
template <class Scalar>
[[gnu::cold, gnu::noinline]] Scalar use_button(const CharacterDef& character, const Input& input, bool wall_ahead,
                                               Scalar dt, CharacterState<Scalar>& state, Scalar upwards) noexcept {
  note_press(character, input.jump, dt, state);
  const bool released = state.jump_held && !input.jump;
  if (released && state.jumping && upwards > 0) upwards *= static_cast<Scalar>(character.jump_cut);
  state.jump_held = input.jump;
  if (state.jump_pending && may_jump(character, state, input, wall_ahead)) {
    upwards = static_cast<Scalar>(character.jump_speed);
    state.jumping = true;
    state.grounded = state.jump_pending = false;
    state.coyote_left = 0;
    if (!input.jump) upwards *= static_cast<Scalar>(character.jump_cut);
  }
  return upwards;
}

/// The upward speed of a walker that brakes or turns round on a slope: the climb slows with the walk. The walker would
/// leave the ground with the speed of its climb otherwise. A rise that is steeper than walkable ground is no climb, nor
/// is the speed of ground that moved and is gone.
/// @param walk speed of the walk from now on.
template <class Scalar>
[[gnu::cold, gnu::noinline]] Scalar slowed_climb(const CharacterDef& character, const CharacterState<Scalar>& state,
                                                 Scalar walk) noexcept {
  const Vec2<Scalar>& before = state.velocity;
  const Scalar cosine = character.walkable_cosine<Scalar>();
  const Scalar steepest = std::sqrt(1 - cosine * cosine) / cosine;
  const bool is_left = state.ride.ground == Ride<Scalar>::none && !state.ground.velocity.isZero(0);
  if (is_left || !(before.y() <= std::abs(before.x()) * steepest)) return before.y();
  return before.y() * std::max(walk / before.x(), Scalar(0));
}

/// Counted from the first step that begins in the air.
template <class Scalar>
void count_down_coyote(const CharacterDef& character, Scalar dt, CharacterState<Scalar>& state) noexcept {
  if (character.coyote_time > 0)
    state.coyote_left =
        state.grounded ? static_cast<Scalar>(character.coyote_time) : std::max(state.coyote_left - dt, Scalar(0));
}

/// @param wall_ahead there is a wall to jump against, whatever the last step touched.
template <class Scalar>
[[gnu::always_inline]] inline DesiredVelocity<Scalar> wanted_velocity(const CharacterDef& character,
                                                                      const Vec2<Scalar>& gravity, const Input& input,
                                                                      Scalar dt, bool wall_ahead,
                                                                      CharacterState<Scalar>& state) noexcept {
  // Component by component: a pair that is written as two numbers and read as one vector waits for the memory.
  Scalar x = input.move ? steered(character, state, *input.move, dt) : state.velocity.x();
  const Scalar change = x - state.velocity.x();
  Scalar y = state.velocity.y();
  if (change * state.velocity.x() < 0 && state.grounded && y > 0) [[unlikely]]
    y = slowed_climb(character, state, x);
  if (input.jump != state.jump_held || state.jump_pending) [[unlikely]]
    y = use_button(character, input, wall_ahead, dt, state, y);
  count_down_coyote(character, dt, state);
  x += gravity.x() * dt;
  y += gravity.y() * dt;
  if (character.max_fall_speed) y = std::max(y, static_cast<Scalar>(-*character.max_fall_speed));
  return {{x, y}, change};
}

/// Restores the members of a state that the intent changes, if the step is refused later. (A copy of the whole state
/// costs a tenth of a step.)
template <class Scalar>
class Undo {
 public:
  explicit Undo(const CharacterState<Scalar>& state) noexcept
      : velocity_(state.velocity),
        grounded_(state.grounded),
        jumping_(state.jumping),
        jump_held_(state.jump_held),
        jump_pending_(state.jump_pending),
        coyote_left_(state.coyote_left),
        pending_left_(state.pending_left) {}

  void restore(CharacterState<Scalar>& state) const noexcept {
    state.velocity = velocity_;
    state.grounded = grounded_;
    state.jumping = jumping_;
    state.jump_held = jump_held_;
    state.jump_pending = jump_pending_;
    state.coyote_left = coyote_left_;
    state.pending_left = pending_left_;
  }

 private:
  Vec2<Scalar> velocity_;
  bool grounded_;
  bool jumping_;
  bool jump_held_;
  bool jump_pending_;
  Scalar coyote_left_;
  Scalar pending_left_;
};

}  // namespace

template <class Scalar>
DesiredVelocity<Scalar> desired_velocity(const CharacterDef& character, const Vec2<Scalar>& gravity, const Input& input,
                                         Scalar dt, CharacterState<Scalar>& state, bool wall_ahead) noexcept {
  return wanted_velocity(character, gravity, input, dt, wall_ahead, state);
}

template <class Scalar>
Controller<Scalar>::Controller(const Scenery<Scalar>& scenery, const CharacterDef& character, const SweepDef& sweep)
    : Controller(scenery, character, octagon_sweep::make_sweep_in_parts(sweep, scenery, character), sweep.search) {}

template <class Scalar>
Controller<Scalar>::Controller(const Scenery<Scalar>& scenery, const CharacterDef& character,
                               std::shared_ptr<const octagon_sweep::SweepInParts<Scalar>> sweep, PieceSearch search)
    : scenery_(&scenery),
      has_filters_(search == PieceSearch::none || has_filters(scenery)),
      character_(character),
      sweep_(std::move(sweep)) {
  const bool asks_all = search == PieceSearch::none;
  if (asks_all || scenery.sensor_pieces().size() > 0)
    sensors_ = std::make_shared<Sensors<Scalar>>(scenery, character_.shape, search);
  if (asks_all || has_one_way_chains(scenery))
    one_way_ = std::make_shared<OneWayChains<Scalar>>(scenery, character_.shape, search);
}

template <class Scalar>
Scratch<Scalar> Controller<Scalar>::make_scratch() const {
  Scratch<Scalar> scratch = sweep_->make_scratch();
  if (sensors_) scratch.sensors = sensors_->make_candidates();
  if (one_way_) scratch.one_way = one_way_->make_candidates();
  scratch.maker = sweep_;
  return scratch;
}

template <class Scalar>
[[gnu::always_inline]] inline bool Controller<Scalar>::accepts(const CharacterState<Scalar>& state, const Input& input,
                                                               const StepContext<Scalar>& context) const noexcept {
  if (!is_upright(context.up)) [[unlikely]]
    return accepts_turned(state, input, context);
  return context.dt > 0 && context.movers.size() == scenery_->mover_count() &&
         finite(state, input, context.gravity, context.dt, context.movers);
}

/// With an up that is not (0, 1).
template <class Scalar>
[[gnu::cold, gnu::noinline]] bool Controller<Scalar>::accepts_turned(const CharacterState<Scalar>& state,
                                                                     const Input& input,
                                                                     StepContext<Scalar> context) const noexcept {
  if (!accepts(context.up)) return false;
  context.up = {0, 1};
  return accepts(state, input, context);
}

/// Tries a move towards the wall, without making it. Kept out of `step`: nearly no step needs it.
template <class Scalar>
[[gnu::noinline]] bool Controller<Scalar>::has_wall_ahead(const CharacterState<Scalar>& state, double move,
                                                          const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                                          MoveResult<Scalar>& tried) const noexcept {
  const Scalar reach = static_cast<Scalar>(character_.wall_reach);
  const UpFrame<Scalar> up = context.up;
  const Vec2<Scalar> there = up.in_world({move < 0 ? -reach : reach, 0});
  StepRequest request = request_of(state, state.crushers, there, there / context.dt, 0, false, false, context);
  request.up = up;
  request.crushed = false;
  request.crushers = {};
  sweep_->move_part(octagon_sweep::Part::whole, request, scratch, tried);
  return touches(tried, move < 0 ? Side::left : Side::right);
}

template <class Scalar>
[[gnu::always_inline]] inline octagon_sweep::StepRequest<Scalar> Controller<Scalar>::request_of(
    const CharacterState<Scalar>& state, const Crushers<Scalar>& crushers, const Vec2<Scalar>& displacement,
    const Vec2<Scalar>& velocity, Scalar steered, bool drop, bool jumps,
    const StepContext<Scalar>& context) const noexcept {
  return {.position = state.position,
          .displacement = {displacement.x(), displacement.y()},
          .velocity = {velocity.x(), velocity.y()},
          .steered = steered,
          .last_free = state.last_free,
          .has_last_free = state.has_last_free,
          .grounded = state.grounded,
          .crushed = state.crushed,
          .drop = drop,
          .leaves_ground_above = jumps ? Scalar(0) : Tolerances<Scalar>{}.touch / context.dt,
          .crushers = {crushers.begin(), crushers.end()},
          .movers = context.movers,
          .filter = filter_of(context),
          .dt = context.dt,
          .ride = state.ride};
}

template <class Scalar>
[[gnu::always_inline]] inline octagon_sweep::StepRequest<Scalar> Controller<Scalar>::begin_step(
    const Crushers<Scalar>& crushers, const Input& input, const StepContext<Scalar>& context, bool wall_ahead,
    CharacterState<Scalar>& state, StepReport<Scalar>& report) const noexcept {
  // A carried character steers, jumps and falls relative to its ground.
  if (state.ride.ground != Ride<Scalar>::none) state.velocity -= state.ride.velocity;
  const Scalar dt = context.dt;
  const bool rises = state.jumping;
  const auto [velocity, steered] = wanted_velocity(character_, context.gravity, input, dt, wall_ahead, state);
  report.requested = {velocity.x() * dt, velocity.y() * dt};
  report.steered = steered * dt;
  return request_of(state, crushers, {velocity.x() * dt, velocity.y() * dt}, velocity, steered, input.drop,
                    state.jumping && !rises, context);
}

/// The same for a character that is not upright. Kept out of most steps.
template <class Scalar>
[[gnu::cold, gnu::noinline]] octagon_sweep::StepRequest<Scalar> Controller<Scalar>::begin_turned_step(
    const Crushers<Scalar>& crushers, const Input& input, const StepContext<Scalar>& context, bool wall_ahead,
    CharacterState<Scalar>& state, StepReport<Scalar>& report) const noexcept {
  if (state.ride.ground != Ride<Scalar>::none) state.velocity -= state.ride.velocity;
  const UpFrame<Scalar> up = context.up;
  const Scalar dt = context.dt;
  state.velocity = up.seen(state.velocity);
  const bool rises = state.jumping;
  const auto [seen, steered] = wanted_velocity(character_, up.seen(context.gravity), input, dt, wall_ahead, state);
  const Vec2<Scalar> velocity = up.in_world(seen);
  report.requested = velocity * dt;
  report.steered = steered * dt;
  StepRequest request =
      request_of(state, crushers, report.requested, velocity, steered, input.drop, state.jumping && !rises, context);
  request.up = up;
  return request;
}

template <class Scalar>
[[gnu::always_inline]] inline void Controller<Scalar>::end_step(bool drop, const StepContext<Scalar>& context,
                                                                Scratch<Scalar>& scratch, CharacterState<Scalar>& state,
                                                                StepReport<Scalar>& report) const noexcept {
  const std::span<const PathPoint<Scalar>> path = report.move.path;
  if (sensors_) sensors_->observe(path, context.movers, scratch.sensors, report.sensors, filter_of(context));
  if (drop && one_way_)
    one_way_->find_passed(path, context.movers, scratch.one_way, report.dropped_through, filter_of(context));
  adopt(character_, context.up, report.move, state);
}

template <class Scalar>
[[gnu::flatten]] StepStatus Controller<Scalar>::step(CharacterState<Scalar>& state, const Input& input,
                                                     const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                                     StepReport<Scalar>& report) const noexcept {
  report.sensors.clear();
  report.dropped_through.clear();
  if (!is_made_by(sweep_, scratch.maker) || !accepts(state, input, context))
    return report.status = StepStatus::invalid_input;
  using enum octagon_sweep::Part;
  const Undo<Scalar> before(state);
  const bool wall_ahead =
      asks_for_wall(character_, input, state) && has_wall_ahead(state, *input.move, context, scratch, report.move);
  // A request with a name, read again after the move, cost 46 instructions more per step (g++ 12).
  if (is_upright(context.up)) [[likely]]
    sweep_->move_part(whole, begin_step(state.crushers, input, context, wall_ahead, state, report), scratch,
                      report.move);
  else
    sweep_->move_part(whole, begin_turned_step(state.crushers, input, context, wall_ahead, state, report), scratch,
                      report.move);
  report.status = status_of(report.move.status);
  if (is_refused(report.status)) {
    before.restore(state);
    return report.status;
  }
  end_step(input.drop, context, scratch, state, report);
  return report.status;
}

template <class Scalar>
StepStatus Controller<Scalar>::move(CharacterState<Scalar>& state, const Vec2<Scalar>& displacement,
                                    const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                    StepReport<Scalar>& report) const noexcept {
  report.sensors.clear();
  report.dropped_through.clear();
  const Vec2<Scalar> velocity = displacement / context.dt;
  if (!is_made_by(sweep_, scratch.maker) || !accepts(state, {}, context) ||
      !FiniteCheck<Scalar>().add(displacement).add(velocity).passed())
    return report.status = StepStatus::invalid_input;
  report.requested = displacement;
  report.steered = 0;
  StepRequest request = request_of(state, state.crushers, displacement, velocity, 0, false, false, context);
  request.up = context.up;
  sweep_->move_part(octagon_sweep::Part::whole, request, scratch, report.move);
  report.status = status_of(report.move.status);
  if (is_refused(report.status)) return report.status;
  note_press(character_, state.jump_held, context.dt, state);  // as it was: time alone passes
  count_down_coyote(character_, context.dt, state);
  end_step(false, context, scratch, state, report);
  return report.status;
}

template <class Scalar>
bool Controller<Scalar>::can_answer(const Vec2<Scalar>& position, const Vec2<Scalar>& displacement,
                                    const StepContext<Scalar>& context, const Scratch<Scalar>& scratch) const noexcept {
  return is_made_by(sweep_, scratch.maker) && in_range(position) && in_range(Vec2<Scalar>(position + displacement)) &&
         context.movers.size() == scenery_->mover_count() && accepts(context.up) &&
         (context.movers.empty() || finite(context.movers, Scalar(1)));
}

template <class Scalar>
octagon_sweep::StepRequest<Scalar> Controller<Scalar>::question(const Vec2<Scalar>& position,
                                                                const Vec2<Scalar>& displacement,
                                                                const StepContext<Scalar>& context) const noexcept {
  return {.position = position,
          .displacement = displacement,
          .movers = context.movers,
          .filter = filter_of(context),
          .up = context.up};
}

template <class Scalar>
std::optional<Contact<Scalar>> Controller<Scalar>::cast(const Vec2<Scalar>& position, const Vec2<Scalar>& displacement,
                                                        const StepContext<Scalar>& context,
                                                        Scratch<Scalar>& scratch) const noexcept {
  if (!can_answer(position, displacement, context, scratch)) return std::nullopt;
  return sweep_->cast(question(position, displacement, context), scratch);
}

template <class Scalar>
std::optional<std::size_t> Controller<Scalar>::overlaps(const Vec2<Scalar>& position,
                                                        const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                                        std::span<ColliderIndex> found) const noexcept {
  const Vec2<Scalar> nowhere{0, 0};
  if (!can_answer(position, nowhere, context, scratch)) return std::nullopt;
  return sweep_->overlaps(question(position, nowhere, context), scratch, found);
}

template <class Scalar>
std::size_t Controller<Scalar>::contacts_at(const Vec2<Scalar>& position, Scalar within,
                                            const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                            std::span<Contact<Scalar>> found) const noexcept {
  const Vec2<Scalar> nowhere{0, 0};
  if (!can_answer(position, nowhere, context, scratch) || !(within <= Tolerances<Scalar>{}.range)) return 0;
  return sweep_->contacts_at(question(position, nowhere, context), within, scratch, found);
}

template <class Scalar>
bool Controller<Scalar>::begin_together(const CharacterState<Scalar>& before, const Input& input,
                                        const StepContext<Scalar>& context, CharacterState<Scalar>& state,
                                        StepRequest& request, StepReport<Scalar>& report) const noexcept {
  if (!accepts(before, input, context)) return false;
  state = before;
  request = is_upright(context.up) ? begin_step(before.crushers, input, context, false, state, report)
                                   : begin_turned_step(before.crushers, input, context, false, state, report);
  return true;
}

template <class Scalar>
void Controller<Scalar>::end_together(const Input& input, const StepContext<Scalar>& context, Scratch<Scalar>& scratch,
                                      CharacterState<Scalar>& state, StepReport<Scalar>& report) const noexcept {
  report.status = status_of(report.move.status);
  end_step(input.drop, context, scratch, state, report);
}

template DesiredVelocity<float> desired_velocity(const CharacterDef&, const Vec2<float>&, const Input&, float,
                                                 CharacterState<float>&, bool) noexcept;
template DesiredVelocity<double> desired_velocity(const CharacterDef&, const Vec2<double>&, const Input&, double,
                                                  CharacterState<double>&, bool) noexcept;
template class Controller<float>;
template class Controller<double>;

}  // namespace paperproof
