/// StepSolver: the whole step, the way through scenery that stands still, and where it leaves the character.
#pragma once

#include "techniques/octagon_sweep/response.hpp"
#include "techniques/octagon_sweep/step_solver.hpp"

namespace paperproof::octagon_sweep {

/// Two unit normals of one plane. Zero: rounding would make two of it. Large: a crease would be taken for a plane.
template <class Scalar>
inline constexpr Scalar same_plane = std::numeric_limits<Scalar>::epsilon() * 16;

/// A way that points into a plane by less than this share of its length runs along it.
template <class Scalar>
inline constexpr Scalar along_plane = std::numeric_limits<Scalar>::epsilon() * 64;

template <class Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar dot(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  return a.x() * b.x() + a.y() * b.y();
}

/// Whether a way goes into a plane that it touches, rather than along it.
template <class Scalar>
[[nodiscard]] bool enters(const Vec2<Scalar>& way, const Vec2<Scalar>& normal) noexcept {
  const Scalar out = dot(way, normal);
  return out < 0 && out < -along_plane<Scalar> * length_of(way);
}

template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::solve(const MoveRequest<Scalar>& request) noexcept {
  position_ = request.position;
  velocity_ = request.velocity;
  start_ = position_;
  drops_ = request.drop;
  V wanted = request.displacement;
  if constexpr (variant.movers) {
    if (request.stays) return keep_place(request);
    wanted = begin_ride(request);
  }
  push_corner(0);
  look_along(wanted);
  const bool near = found_.least_separation < Tolerances<Scalar>{}.hit;
  if (near && !prepare_start(request)) {
    result_.status = MoveStatus::stuck;
    halt();
    if constexpr (variant.movers) {
      note_what_is_left();
      stay(false);
      take_back_crushes();
    }
  } else {
    if constexpr (variant.movers) {
      if (near) moving_.ride.place += position_ - request.position;  // it rests where its gaps were restored
      if (moving_.on_it > 0) {
        halt();
        wanted = V::Zero();
        moving_.anchored = false;
      }
    }
    if (near) look_along(wanted);
    if (request.grounded && !found_.hit) keep_ground();
    if constexpr (variant.movers) {
      travel_among_movers();
      take_back_crushes();
    } else {
      travel();
    }
    result_.grounded = stands();
    if constexpr (variant.snap) follow_ground_down(request);
    if constexpr (variant.movers) end_ride();
  }
  if constexpr (variant.movers) end_wait();
  push_corner(1);
  result_.position = position_;
  result_.velocity = velocity_;
}

/// Ground that was touched and is still touched where the motion ends stops a motion into it, as it stops one that is
/// straight down. A walk goes into its ground by less than the sweep sees where gravity is tiny: it would leave the
/// ground, sink until it is met, and be put back, over and over.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::keep_ground() noexcept {
  const V from = position_;
  const Scalar begin = time_;
  position_ += motion_.way;
  time_ = 1;
  const bool ends_on_ground = stands_on_any();
  position_ = from;
  time_ = begin;
  if (!ends_on_ground) return;
  for_each_near({position_, position_}, [this](PieceIndex piece) {
    const BestAxis<Scalar> best = best_axis<variant>(space_, piece, local(piece, position_));
    if (!stands_on(piece) || space_.covered(piece, best.axis)) return;
    V way = motion_.way;
    if constexpr (variant.movers)
      if (mover_of(piece) != no_mover) way = moving_.around.relative(way, mover_of(piece), time_);
    const LocalMotion motion = make_motion<variant>(space_, local(piece, position_), way);
    if (!enters(way, space_.normal(piece, best.axis)) || !in_way(motion, piece)) return;
    keep({piece, 0, 0, {best.axis, best.axis, false}}, motion.length);
  });
  order_stops();
}

/// The way itself: stop at what the sweep found, respond, and sweep again with what is left. What is left only shrinks.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::travel() noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  FixedVector<V, 16> held;  // normals met since the last progress
  V way = motion_.way;
  V plain_way = way;  // without the aim back to the gap
  bool may_aim = true;
  for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
    if (way.x() == 0 && way.y() == 0) return;
    if (iteration > 0) look_along(way);
    const bool aimed = way.x() != plain_way.x() || way.y() != plain_way.y();
    if (found_.hit && found_.stop == 0 && aimed) {
      // There is no room to restore the gap: give that up for this step.
      way = plain_way;
      may_aim = false;
      continue;
    }
    const Scalar begin = time_;
    if (!advance(found_.hit ? found_.stop : Scalar(1))) return halt();
    if (!found_.hit) return;
    report(begin);

    const Stop<Scalar>& stop = found_.stops[0];
    const V normal = space_.normal(stop.piece, stop.axes.normal);
    if (found_.stop * motion_.length > tolerances.touch) held.clear();
    for (const V& other : held)
      if (dot(other, normal) > 1 - same_plane<Scalar>) return;  // the same plane again: no progress to be had
    held.push_back(normal);

    plain_way = respond(V(plain_way * (1 - found_.stop)), normal, settings_.walkable_cosine);
    velocity_ = respond(velocity_, normal, settings_.walkable_cosine);
    for (const V& other : held) {
      if (!enters(plain_way, other) && !enters(velocity_, other)) continue;
      ended_in_crease_ = true;
      return halt();
    }
    way = may_aim ? aimed_back(plain_way, stop) : plain_way;
  }
  result_.status = MoveStatus::dropped;
}

/// A slide along a plane that is nearer than it should be ends at the right gap.
template <Variant variant, class Scalar>
Vec2<Scalar> StepSolver<variant, Scalar>::aimed_back(const V& way, const Stop<Scalar>& at) const noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  if (way.x() == 0 && way.y() == 0) return way;
  const Scalar gap = space_.separation(at.piece, at.axes.normal, local(at.piece, position_));
  if (!(gap < tolerances.stop - tolerances.restore) || gap < 0) return way;
  return way + space_.normal(at.piece, at.axes.normal) * (tolerances.stop - gap);
}

template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::halt() noexcept {
  velocity_ = V::Zero();
}

/// Standing: something walkable is touched where the step ended and the motion went into it, or the motion was held by
/// contacts that together block a fall.
template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::stands() noexcept {
  if (on_ground_) return true;
  if (ended_in_crease_)
    return std::any_of(result_.contacts.begin(), result_.contacts.end(),
                       [](const Contact<Scalar>& contact) { return contact.normal.y() > 0; });
  if (!met_ground_) return false;
  return stands_on(ground_) || stands_on_any();  // mostly the first
}

template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::stands_on_any() noexcept {
  bool any = false;
  for_each_near({position_, position_}, [&](PieceIndex piece) { any = any || stands_on(piece); });
  return any;
}

template <Variant variant, class Scalar>
bool StepSolver<variant, Scalar>::stands_on(PieceIndex piece) const noexcept {
  if (dropped(piece)) return false;
  constexpr Scalar touch = Tolerances<Scalar>{}.touch;
  const BestAxis<Scalar> best = best_axis<variant>(space_, piece, local(piece, position_));
  return std::abs(best.separation) <= touch && walkable(space_.normal(piece, best.axis));
}

/// Where a walk left the ground, and there is ground not far below.
template <Variant variant, class Scalar>
void StepSolver<variant, Scalar>::follow_ground_down(const MoveRequest<Scalar>& request) noexcept {
  if (settings_.snap <= 0 || !request.grounded || result_.grounded) return;
  if constexpr (variant.movers)
    if (pinned()) return;  // it stays where it was crushed
  V travelled = position_ - request.position;
  V left_ground = V::Zero();  // velocity of what was walked on
  if constexpr (variant.movers) {
    left_ground = moving_.ride.velocity;
    travelled -= left_ground * request.dt;
  }
  if (velocity_.y() > left_ground.y()) return;
  const Scalar steepest = std::abs(travelled.x()) * settings_.walkable_tangent + Tolerances<Scalar>{}.touch;
  look_along({0, -std::min(settings_.snap, steepest)});
  if (!found_.hit) return;
  const PieceIndex piece = found_.stops[0].piece;
  const V normal = space_.normal(piece, found_.stops[0].axes.normal);
  if (!walkable(normal) || !advance(found_.stop)) return;
  result_.grounded = true;
  V velocity = velocity_;
  if constexpr (variant.movers) velocity -= ground_velocity(piece, normal);
  const V pressed{velocity.x(), -std::abs(velocity.x()) * settings_.walkable_tangent - 1};
  velocity_ = respond(pressed, normal, settings_.walkable_cosine);
  if constexpr (variant.movers) velocity_ += ground_velocity(piece, normal);
}

}  // namespace paperproof::octagon_sweep
