#include "oracle/intent.hpp"

#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/met_surfaces.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace paperproof::compare {
namespace {

/// Ground of exactly the climb limit is walkable, whatever its normal was rounded to [rad].
constexpr double climb_margin = 1e-8;
/// Relative: a few operations in the number type of the contender.
constexpr double share_of_double = 1e-12;
constexpr double share_of_float = 1e-5;

Vec2d way_of(const MoverMotion& motion) { return motion.to - motion.from; }

}  // namespace

bool touches_from_above(const TraceStep& step, const Vec2d& up) {
  const auto looks_up = [&up](const auto& contact) { return contact.normal.dot(up) > 0; };
  return std::ranges::any_of(step.contacts, looks_up) || std::ranges::any_of(step.met, looks_up);
}

bool is_wall_ahead(const TraceHeader& header, const ExactScenery& solids, const Place& at, const Vec2d& up,
                   double move) {
  const Vec2d there = right_of(up) * std::copysign(header.character.wall_reach, move);
  const std::vector<ExactImpact> impacts = solids.impacts(at, there);
  return std::ranges::any_of(impacts, [&](const ExactImpact& impact) {
    return detail::side_along(impact.normal, up) == (move < 0 ? Side::left : Side::right);
  });
}

void Intent::start_anew(const TraceStep& step) {
  state_ = step.from.value_or(TraceState{});
  const bool is_start = !step.from && step.character < header_->starts.size();
  if (is_start) state_.velocity = header_->starts[step.character].velocity;
  // A character that is given another velocity where it is remembers the rest.
  if (begun_ && step.path.front().position == end_) return;
  pending_left_ = coyote_left_ = 0;
  crushed_ = wall_left_ = wall_right_ = false;
  ground_velocity_ = carrier_velocity_ = Vec2d::Zero();
}

void Intent::note_press(bool pressed, double dt) {
  const std::optional<double>& buffer = header_->character.jump_buffer;
  if (pressed && !state_.jump_held) {
    state_.jump_pending = true;
    pending_left_ = buffer.value_or(0);
  } else if (buffer) {
    pending_left_ = std::max(pending_left_ - dt, 0.0);
    state_.jump_pending = state_.jump_pending && pending_left_ > 0;
  } else if (!pressed) {
    state_.jump_pending = false;
  }
}

bool Intent::may_jump(const TraceStep& step, const WallAhead& wall_ahead) const {
  if (crushed_ || state_.jumping || !(state_.grounded || coyote_left_ > 0)) return false;
  const double move = step.input.move.value_or(0);
  if (!header_->character.no_jump_toward_wall || move == 0) return true;
  return !(move < 0 ? wall_left_ : wall_right_) && !(state_.grounded && wall_ahead && wall_ahead(step, move));
}

/// The upward speed after the button was pressed or released, or while a press is pending.
double Intent::use_button(const TraceStep& step, double dt, double rise, const WallAhead& wall_ahead, Wanted& wanted) {
  const CharacterDef& character = header_->character;
  const bool pressed = step.input.jump;
  if (pressed == state_.jump_held && !state_.jump_pending) return rise;
  note_press(pressed, dt);
  if (state_.jump_held && !pressed && state_.jumping && rise > 0) rise *= character.jump_cut;
  state_.jump_held = pressed;
  if (!state_.jump_pending || !may_jump(step, wall_ahead)) return rise;
  wanted.jumped = state_.jumping = true;
  state_.grounded = state_.jump_pending = false;
  coyote_left_ = 0;
  return character.jump_speed * (pressed ? 1 : character.jump_cut);
}

/// Whether a step in parts jumps after its first part. A character whose jump goes on, or has ended, must have landed
/// in a part before the last one. A new jump rises faster than the step was to rise.
bool Intent::jumped_later(const TraceStep& step) const {
  if (!state_.jump_pending) return false;
  if (step.jumping && !state_.jumping) return true;
  const Vec2d up = up_in(step, *header_);
  const bool landed = std::ranges::any_of(step.contacts, [&](const Contact& contact) {
    return contact.fraction * parts_ < parts_ - 1 && is_walked_on(contact.normal, *header_, up);
  });
  if (!landed) return false;
  if (step.jumping) return step.velocity.dot(up) > rise_;
  if (!step.grounded) return false;
  // It landed once more, if it went up as only a jump does.
  const double dt = length_of(step, *header_);
  for (std::size_t i = 1; i < step.path.size(); ++i) {
    const PathPoint& from = step.path[i - 1];
    const double time = (step.path[i].fraction - from.fraction) * dt;
    if (time > 0 && (step.path[i].position - from.position).dot(up) > header_->character.jump_speed / 2 * time)
      return true;
  }
  return false;
}

/// The button, and the time in the air, in the parts after the first one.
void Intent::end_later_parts(const TraceStep& step) {
  const double part = length_of(step, *header_) / parts_;
  if (jumped_later(step)) {
    state_.jumping = true;
    state_.jump_pending = false;
    coyote_left_ = 0;
  }
  for (int k = 1; k < parts_; ++k) {
    if (state_.jump_pending) note_press(state_.jump_held, part);
    if (!state_.grounded) coyote_left_ = std::max(coyote_left_ - part, 0.0);
  }
}

/// Whether the rise comes from walking up ground: then it ends with the walk.
bool Intent::is_climb_of_walk(double walk, double rise) const {
  const bool ground_is_gone = !state_.ride && !ground_velocity_.isZero(0);
  const double steepest = std::tan(header_->character.max_climb_degrees * std::numbers::pi / 180 + climb_margin);
  return state_.grounded && rise > 0 && !ground_is_gone && rise <= std::abs(walk) * steepest;
}

/// How far the ground takes its rider in the step [m]. A conveyor adds to its mover's way what its surface ran in the
/// step before. A rider that drops through a one-way carrier goes on as fast as it went.
Vec2d Intent::carried(const TraceStep& step, double dt) const {
  if (!state_.ride) return Vec2d::Zero();
  const ColliderDef& ground = header_->scenery.colliders[state_.ride->collider];
  if (step.input.drop && ground.one_way) return state_.ride->velocity * dt;
  const bool is_circle = ground.shape == ColliderDef::Shape::circle;
  if (const VertexWay* way = find_way(step.vertex_ways, state_.ride->collider))
    return is_circle ? Vec2d(state_.ride->velocity * dt) : carried_along(*way);
  Vec2d carried = Vec2d::Zero();
  if (ground.mover != no_mover) carried = way_of(step.movers[ground.mover]);
  if (ground.surface_speed != 0) carried += (state_.ride->velocity - carrier_velocity_) * dt;
  return carried;
}

Wanted Intent::begin(const TraceStep& step, int parts, const WallAhead& wall_ahead) {
  if (!begun_ || step.respawn) start_anew(step);
  begun_ = true;
  const CharacterDef& character = header_->character;
  const double whole = length_of(step, *header_);
  const double dt = whole / parts;
  const Vec2d up = up_in(step, *header_);
  Wanted wanted;
  wanted.parts = parts_ = parts;
  wanted.from_ground = state_.grounded;
  const Vec2d own = seen(state_.ride ? Vec2d(state_.velocity - state_.ride->velocity) : state_.velocity, up);
  double walk = own.x();
  double rise = own.y();
  if (step.input.move) {
    const double acceleration =
        state_.grounded ? character.acceleration : character.air_acceleration.value_or(character.acceleration);
    const double target = std::clamp(*step.input.move, -1.0, 1.0) * character.walk_speed;
    walk += std::clamp(target - walk, -acceleration * dt, acceleration * dt);
  }
  const double change = walk - own.x();
  wanted.walk = walk;
  if (state_.ride) wanted.ridden = state_.ride->collider;
  if (state_.ride) wanted.rode = state_.ride->velocity;
  if (change * own.x() < 0 && is_climb_of_walk(own.x(), rise)) rise *= std::max(walk / own.x(), 0.0);
  rise = use_button(step, dt, rise, wall_ahead, wanted);
  if (character.coyote_time > 0)
    coyote_left_ = state_.grounded ? character.coyote_time : std::max(coyote_left_ - dt, 0.0);
  const Vec2d pull = seen(gravity_in(step, *header_), up) * dt;
  rise += pull.y();
  if (character.max_fall_speed) rise = std::max(rise, -*character.max_fall_speed);
  wanted.jumping = state_.jumping;
  wanted.pending = state_.jump_pending;
  const Vec2d velocity = in_world({walk + pull.x(), rise}, up);
  const Vec2d by_ground = carried(step, whole);
  wanted.displacement = velocity * whole + by_ground;
  wanted.carried = by_ground;
  wanted.velocity = velocity + by_ground / whole;
  wanted.steered = change * whole;
  rise_ = wanted.velocity.dot(up);
  return wanted;
}

void Intent::end(const TraceStep& step) {
  if (parts_ > 1) end_later_parts(step);
  end_ = step.path.back().position;
  state_.velocity = step.velocity;
  state_.grounded = step.grounded;
  const bool promises = party_of(*header_) == Party::promising;
  state_.jumping = promises ? state_.jumping && !step.grounded : step.jumping;
  crushed_ = !step.crushed.empty() || (crushed_ && step.stuck);
  const auto touches = [&](Side side) {
    return std::ranges::any_of(step.contacts, [side](const Contact& contact) { return contact.side == side; });
  };
  wall_left_ = touches(Side::left);
  wall_right_ = touches(Side::right);
  state_.ride = step.ride;
  ground_velocity_ = step.ground_velocity;
  carrier_velocity_ = Vec2d::Zero();
  if (!state_.ride) return;
  const MoverIndex mover = header_->scenery.colliders[state_.ride->collider].mover;
  if (mover != no_mover) carrier_velocity_ = way_of(step.movers[mover]) / length_of(step, *header_);
}

double Intent::rounding(const TraceStep& step, const Wanted& wanted) const {
  const double share = header_->scalar == "float" ? share_of_float : share_of_double;
  double size = wanted.displacement.norm() +
                (state_.velocity.norm() + (state_.ride ? state_.ride->velocity.norm() : 0)) * length_of(step, *header_);
  // Where movers are is rounded, too.
  double largest = 0;
  for (const MoverMotion& motion : step.movers)
    largest = std::max({largest, motion.from.cwiseAbs().maxCoeff(), motion.to.cwiseAbs().maxCoeff()});
  return share * size + 4 * ulp_at(*header_, {largest, 0});
}

}  // namespace paperproof::compare
