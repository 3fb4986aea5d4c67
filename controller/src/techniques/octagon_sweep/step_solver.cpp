#include "techniques/octagon_sweep/step_solver.hpp"

#include "techniques/octagon_sweep/certificate.hpp"
#include "techniques/octagon_sweep/contact_geometry.hpp"
#include "techniques/octagon_sweep/escape.hpp"
#include "techniques/octagon_sweep/one_way.hpp"
#include "techniques/octagon_sweep/response.hpp"

namespace paperproof::octagon_sweep {
namespace {

/// Two unit normals of one plane. Zero: rounding would make two of it. Large: a crease would be taken for a plane.
template <class Scalar>
constexpr Scalar same_plane = std::numeric_limits<Scalar>::epsilon() * 16;

/// A way that points into a plane by less than this share of its length runs along it.
template <class Scalar>
constexpr Scalar along_plane = std::numeric_limits<Scalar>::epsilon() * 64;

/// How many pushes may be needed to restore the gaps of a start in a corner; what needs more has no room.
constexpr int restore_rounds = 16;

/// Candidates are collected for this many further steps like the present one. None: every step asks the broad phase.
/// Many: every step looks at pieces it never meets.
constexpr int steps_ahead = 8;
/// And this far to the sides, as a share of the reach ahead: for small turns.
constexpr int sides = 32;

/// How far around itself a character looks for a way out first, in multiples of its larger extent.
constexpr int escape_reach = 8;

template <class Scalar>
Scalar dot(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  return a.x() * b.x() + a.y() * b.y();
}

/// Whether a way goes into a plane that it touches, rather than along it.
template <class Scalar>
bool enters(const Vec2<Scalar>& way, const Vec2<Scalar>& normal) noexcept {
  const Scalar out = dot(way, normal);
  return out < 0 && out < -along_plane<Scalar> * length_of(way);
}

}  // namespace

template <class Scalar>
std::span<const PieceIndex> Neighbourhood<Scalar>::around(const Box2<Scalar>& box, const Vec2<Scalar>& way) noexcept {
  if (!scratch_.valid || !scratch_.candidate_box.contains(box)) {
    const Vec2<Scalar> most = Vec2<Scalar>::Constant(look_ahead_);
    const Vec2<Scalar> ahead = (way * Scalar(steps_ahead)).cwiseMin(most).cwiseMax(-most);
    scratch_.candidate_box = box.merged({box.lower + ahead, box.upper + ahead}).inflated(look_ahead_ / sides);
    const Box2<Scalar> query{scratch_.candidate_box.lower + space_.hull_box().lower,
                             scratch_.candidate_box.upper + space_.hull_box().upper};
    scratch_.candidate_count = broad_phase_.query(query.inflated(Tolerances<Scalar>{}.touch), scratch_.candidates);
    scratch_.valid = true;
  }
  return {scratch_.candidates.data(), scratch_.candidate_count};
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::solve(const MoveRequest<Scalar>& request) noexcept {
  position_ = request.position;
  velocity_ = request.velocity;
  start_ = position_;
  push_corner(0);
  look_along(request.displacement);
  const bool near = found_.least_separation < Tolerances<Scalar>{}.hit;
  if (near && !prepare_start(request)) {
    result_.status = MoveStatus::stuck;
    halt();
  } else {
    if (near) look_along(request.displacement);
    travel();
    result_.grounded = stands();
    if (settings_.snap > 0 && request.grounded && !result_.grounded && velocity_.y() <= 0)
      follow_ground_down(std::abs(position_.x() - request.position.x()));
  }
  push_corner(1);
  result_.position = position_;
  result_.velocity = velocity_;
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::look_along(const V& way) noexcept {
  motion_ = make_motion<Lanes>(space_, position_, way);
  found_.clear();
  for (const PieceIndex piece : neighbourhood_.around(motion_.box(), way)) {
    if (!blocks(space_, motion_, piece)) continue;
    const Clearance<Scalar> clear = clearance(space_, motion_, piece);
    found_.least_separation = std::min(found_.least_separation, clear.start);
    if (clear.clear()) continue;
    const PieceHit<Scalar> hit = sweep_piece(space_, motion_, piece, clear);
    if (hit.hit) keep({piece, hit.stop, hit.axes});
  }
  order_stops();
}

/// Pieces that stop the motion together with the first are met together with it.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::keep(const Stop<Scalar>& stop) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  const Scalar together = motion_.length > 0 ? (tolerances.touch - tolerances.stop) / motion_.length : Scalar(0);
  if (found_.hit && stop.stop > found_.stop + together) return;
  if (!found_.hit || stop.stop < found_.stop) {
    found_.stop = stop.stop;
    std::size_t kept = 0;
    for (const Stop<Scalar>& other : found_.stops)
      if (other.stop <= found_.stop + together) found_.stops[kept++] = other;
    while (found_.stops.size() > kept) found_.stops.pop_back();
  }
  found_.hit = true;
  found_.stops.push_back(stop);
}

/// Puts first the stop whose normal points up most (of equals the lowest index).
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::order_stops() noexcept {
  if (found_.stops.size() < 2) return;
  const auto less_up = [this](const Stop<Scalar>& a, const Stop<Scalar>& b) {
    return space_.normal(a.piece, a.axes.normal).y() < space_.normal(b.piece, b.axes.normal).y();
  };
  std::swap(found_.stops[0], *std::max_element(found_.stops.begin(), found_.stops.end(), less_up));
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::prepare_start(const MoveRequest<Scalar>& request) noexcept {
  if (overlaps(position_)) {
    const std::optional<V> out = find_way_out(request);
    if (!out) return false;
    start_ = position_ = *out;
    push_corner(0);
    return true;
  }
  restore_gap();
  look_along(V::Zero());
  certify_ = found_.least_separation < Tolerances<Scalar>{}.certain;
  return true;
}

/// Looks near first. A large solid may only be left further away than that: then the same is asked again with all that
/// is as near as the answer, or, where there was none, with more, until the whole of the solids has been looked at.
template <std::size_t Lanes, class Scalar>
std::optional<Vec2<Scalar>> StepSolver<Lanes, Scalar>::find_way_out(const MoveRequest<Scalar>& request) noexcept {
  const V extent = space_.hull_box().upper - space_.hull_box().lower;
  const V* const last_free = request.has_last_free ? &request.last_free : nullptr;
  const Scalar whole = reach_of_solids_inside();
  Scalar reach = std::max(extent.x(), extent.y()) * escape_reach;
  neighbourhood_.forget();  // more than what is asked for could give another answer
  while (true) {
    Box2<Scalar> box = Box2<Scalar>{position_, position_}.inflated(reach);
    if (last_free != nullptr) box = box.merged({*last_free, *last_free});
    const std::optional<V> out = way_out<Lanes>(space_, neighbourhood_.around(box), position_, last_free);
    if (!out && reach >= whole) return out;
    const Scalar distance = out ? V(*out - position_).cwiseAbs().maxCoeff() : Scalar(0);
    if (out && distance <= reach) return out;
    reach = std::max(2 * reach, distance);
  }
}

/// How far from the position all pieces of the colliders that are overlapped are within reach [m].
template <std::size_t Lanes, class Scalar>
Scalar StepSolver<Lanes, Scalar>::reach_of_solids_inside() noexcept {
  const std::span<const PieceInfo> pieces = space_.scenery().pieces();
  Box2<Scalar> whole{position_, position_};
  for (const PieceIndex piece : neighbourhood_.around({position_, position_})) {
    if (!overlaps(piece, position_)) continue;
    const auto add = [&](PieceIndex other) { whole = whole.merged(space_.scenery().box(other)); };
    add(piece);
    // The pieces of a collider stand together.
    for (PieceIndex k = piece; k > 0 && pieces[k - 1].collider == pieces[piece].collider; --k) add(k - 1);
    for (PieceIndex k = piece + 1; k < pieces.size() && pieces[k].collider == pieces[piece].collider; ++k) add(k);
  }
  const V below = position_ - whole.lower;
  const V above = whole.upper - position_;
  return std::max(below.maxCoeff(), above.maxCoeff());
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::overlaps(const V& position) noexcept {
  const std::span<const PieceIndex> candidates = neighbourhood_.around({position, position});
  return std::any_of(candidates.begin(), candidates.end(), [&](PieceIndex piece) { return overlaps(piece, position); });
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::overlaps(PieceIndex piece, const V& position) const noexcept {
  return space_.info(piece).one_way_axis == ObstacleInfo::not_one_way &&
         best_axis<Lanes>(space_, piece, position).separation < Tolerances<Scalar>{}.certain &&
         overlaps_exactly(space_, piece, position);
}

/// Pushes out of the nearest piece, again and again, until every gap is at least `hit`; undone where there is no room.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::restore_gap() noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  V q = position_;
  for (int round = 0; round < restore_rounds; ++round) {
    Scalar least = std::numeric_limits<Scalar>::infinity();
    V push = V::Zero();
    for (const PieceIndex piece : neighbourhood_.around({q.cwiseMin(position_), q.cwiseMax(position_)})) {
      if (space_.info(piece).one_way_axis != ObstacleInfo::not_one_way &&
          !on_blocking_side_exactly(space_, piece, position_))
        continue;
      const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, q);
      if (best.separation >= least) continue;
      least = best.separation;
      push = space_.normal(piece, best.axis) * (tolerances.stop - best.separation);
    }
    if (least >= tolerances.hit) {
      if (!clear_way(position_, q)) return;
      position_ = q;
      push_corner(0);
      return;
    }
    q += push;
  }
}

/// Whether a straight way meets nothing, without rounding where it is near.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::clear_way(const V& from, const V& to) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  const Motion<Lanes, Scalar> motion = make_motion<Lanes>(space_, from, V(to - from));
  const Box2<Scalar> box{from.cwiseMin(to), from.cwiseMax(to)};
  for (const PieceIndex piece : neighbourhood_.around(box)) {
    if (!blocks(space_, motion, piece)) continue;
    bool certain = false;
    for (std::size_t axis = 0; axis < space_.axis_count(piece) && !certain; ++axis)
      certain = space_.separation(piece, axis, from) >= tolerances.certain &&
                space_.separation(piece, axis, to) >= tolerances.certain;
    if (!certain && !clear_of_exactly(space_, piece, from, to)) return false;
  }
  return true;
}

/// The way itself: stop at what the sweep found, respond, and sweep again with what is left. What is left only shrinks.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::travel() noexcept {
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

/// Moves along the motion up to `stop`. False where that cannot be certified or leaves the range: then nothing moved.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::advance(Scalar stop) noexcept {
  if (stop == 0) return true;
  const V target = motion_.from + motion_.way * stop;
  const Scalar furthest = std::max(std::abs(target.x()), std::abs(target.y()));
  if (!(furthest <= Tolerances<Scalar>{}.range)) return false;
  if (certify_ && !clear_way(position_, target)) return false;
  position_ = target;
  on_ground_ = false;
  time_ += (1 - time_) * stop;
  push_corner(time_);
  return true;
}

/// Contacts of one moment, the earliest impact first; one per collider and side.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::report(Scalar begin) noexcept {
  auto& contacts = result_.contacts;
  const std::size_t before = contacts.size();
  const V& from = begin == 0 ? start_ : motion_.from;
  for (const Stop<Scalar>& stop : found_.stops) {
    Contact<Scalar> contact;
    contact.collider = space_.scenery().pieces()[stop.piece].collider;
    contact.normal = space_.normal(stop.piece, stop.axes.normal);
    contact.side = side_of_normal(contact.normal.x(), contact.normal.y());
    contact.fraction = begin + (1 - begin) * impact_of(stop, from);
    if (walkable(contact.normal)) {
      met_ground_ = on_ground_ = true;
      ground_ = stop.piece;
    }
    Contact<Scalar>* const known = std::find_if(contacts.begin(), contacts.end(), [&](const Contact<Scalar>& other) {
      return other.collider == contact.collider && other.side == contact.side;
    });
    const bool of_an_earlier_moment = known < contacts.begin() + before;
    if (known != contacts.end() && (of_an_earlier_moment || known->fraction <= contact.fraction)) continue;
    const ContactPlace<Scalar> place = contact_place(space_, stop.piece, stop.axes.normal, position_);
    contact.point = place.point;
    contact.separation = place.separation;
    if (known != contacts.end())
      *known = contact;
    else
      contacts.push_back(contact);
  }
  if (contacts.size() - before > 1)
    std::sort(contacts.begin() + before, contacts.end(),
              [](const Contact<Scalar>& a, const Contact<Scalar>& b) { return a.fraction < b.fraction; });
}

/// The time of impact of the collider, as a fraction of the motion. Where its piece is met long after it was stopped at,
/// as a rim that is grazed, another piece of the same collider may be met in between.
template <std::size_t Lanes, class Scalar>
Scalar StepSolver<Lanes, Scalar>::impact_of(const Stop<Scalar>& stop, const V& from) noexcept {
  Scalar earliest = time_of_impact(space_, from, motion_.way, stop.piece, stop.axes);
  if ((earliest - stop.stop) * motion_.length <= 2 * Tolerances<Scalar>{}.stop) return earliest;
  const std::span<const PieceInfo> pieces = space_.scenery().pieces();
  for (const PieceIndex other : neighbourhood_.around(motion_.box(), motion_.way)) {
    if (other == stop.piece || pieces[other].collider != pieces[stop.piece].collider) continue;
    if (!blocks(space_, motion_, other)) continue;
    const Clearance<Scalar> clear = clearance(space_, motion_, other);
    if (clear.clear()) continue;
    const PieceHit<Scalar> hit = sweep_piece(space_, motion_, other, clear);
    if (hit.hit) earliest = std::min(earliest, time_of_impact(space_, from, motion_.way, other, hit.axes));
  }
  return earliest;
}

/// A slide along a plane that is nearer than it should be ends at the right gap.
template <std::size_t Lanes, class Scalar>
Vec2<Scalar> StepSolver<Lanes, Scalar>::aimed_back(const V& way, const Stop<Scalar>& at) const noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  if (way.x() == 0 && way.y() == 0) return way;
  const Scalar gap = space_.separation(at.piece, at.axes.normal, position_);
  if (!(gap < tolerances.stop - tolerances.restore) || gap < 0) return way;
  return way + space_.normal(at.piece, at.axes.normal) * (tolerances.stop - gap);
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::halt() noexcept {
  velocity_ = V::Zero();
}

/// Standing: something walkable is touched where the step ended and the motion went into it, or the motion was held by
/// contacts that together block a fall.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::stands() noexcept {
  if (on_ground_) return true;
  if (ended_in_crease_)
    return std::any_of(result_.contacts.begin(), result_.contacts.end(),
                       [](const Contact<Scalar>& contact) { return contact.normal.y() > 0; });
  if (!met_ground_) return false;
  if (stands_on(ground_)) return true;  // mostly
  const std::span<const PieceIndex> candidates = neighbourhood_.around({position_, position_});
  return std::any_of(candidates.begin(), candidates.end(), [this](PieceIndex piece) { return stands_on(piece); });
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::stands_on(PieceIndex piece) const noexcept {
  constexpr Scalar touch = Tolerances<Scalar>{}.touch;
  const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, position_);
  return std::abs(best.separation) <= touch && walkable(space_.normal(piece, best.axis));
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::follow_ground_down(Scalar travelled_sideways) noexcept {
  const Scalar steepest = travelled_sideways * settings_.walkable_tangent + Tolerances<Scalar>{}.touch;
  const V down{0, -std::min(settings_.snap, steepest)};
  look_along(down);
  if (!found_.hit) return;
  const V normal = space_.normal(found_.stops[0].piece, found_.stops[0].axes.normal);
  if (!walkable(normal) || !advance(found_.stop)) return;
  result_.grounded = true;
  const V pressed{velocity_.x(), -std::abs(velocity_.x()) * settings_.walkable_tangent - 1};
  velocity_ = respond(pressed, normal, settings_.walkable_cosine);
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::push_corner(Scalar fraction) noexcept {
  if (!result_.path.empty() && result_.path.back().fraction == fraction && result_.path.back().position == position_)
    return;
  result_.path.push_back({position_, fraction});
}

// Only what is called from outside: the rest, called from one place each, is inlined.
template void StepSolver<8, float>::solve(const MoveRequest<float>&) noexcept;
template void StepSolver<8, double>::solve(const MoveRequest<double>&) noexcept;
template void StepSolver<12, float>::solve(const MoveRequest<float>&) noexcept;
template void StepSolver<12, double>::solve(const MoveRequest<double>&) noexcept;

}  // namespace paperproof::octagon_sweep
