/// What a step takes of the wanted motion, and by which law: the part of the ledger about stops.
#include "metrics/ledger_step.hpp"

#include "oracle/turning_room.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace paperproof::compare::detail {
namespace {

/// Velocities of one law differ by less, as a share of the wanted one: in double, and in Box2D's float.
constexpr double same_velocity = 1e-9;
constexpr double same_velocity_in_float = 1e-5;
/// A normal that Box2D reports is of the face whose normal is as near as this: it is in float.
constexpr double one_normal = 1e-5;
/// Rounds of Box2D's velocity solver.
constexpr int solver_rounds = 8;
/// A ghost turns a velocity if it adds more than this along its normal [m/s].
constexpr double turned = 1e-4;

using Touch = Contact<double>;

double width_of(const std::vector<Vec2d>& hull) {
  const auto [left, right] =
      std::minmax_element(hull.begin(), hull.end(), [](const Vec2d& a, const Vec2d& b) { return a.x() < b.x(); });
  return right->x() - left->x();
}

Vec2d way_of(const TraceStep& step) { return step.path.back().position - step.path.front().position; }

/// Of a surface that goes along with its mover and may be a conveyor [m/s].
Vec2d velocity_of(const LedgerParty& who, const TraceStep& step, const Touch& touch, double dt) {
  const ColliderDef& collider = who.header->scenery.colliders[touch.collider];
  const Vec2d conveyed = collider.surface_speed * Vec2d(touch.normal.y(), -touch.normal.x());
  return conveyed + moved_by_step(*who.header, step, touch.collider, touch.point, touch.fraction) / dt;
}

/// What turns has no one velocity. By so much those of a collider differ over the size of the character [m/s].
double spread_of(const LedgerParty& who, const TraceStep& step, ColliderIndex collider, double dt) {
  const VertexWay* turning = find_way(step.vertex_ways, collider);
  if (turning == nullptr) return 0;
  double size = 0;
  for (const Vec2d& a : who.header->points)
    for (const Vec2d& b : who.header->points) size = std::max(size, (a - b).norm());
  return std::abs(RigidMotion(turning->vertices.front(), turning->vertices.back()).angle()) * size / dt;
}

double widest_spread(std::span<const MetSurface> surfaces) {
  double spread = 0;
  for (const MetSurface& one : surfaces) spread = std::max(spread, one.spread);
  return spread;
}

}  // namespace

std::vector<MetSurface> StepLedger::met_by_mine() const {
  const double least_up = std::cos(mine_.header->character.max_climb_degrees * std::numbers::pi / 180) - 1e-12;
  std::vector<MetSurface> surfaces;
  for (const Touch& touch : m_.contacts) {
    const bool walkable = touch.normal.y() >= least_up;
    const Vec2d velocity = velocity_of(mine_, m_, touch, dt_);
    // Ground carries; walls impart nothing along themselves.
    const Vec2d imparted = walkable ? velocity : Vec2d(velocity.dot(touch.normal) * touch.normal);
    const double spread = spread_of(mine_, m_, touch.collider, dt_);
    surfaces.push_back({touch.normal, imparted, walkable, touch.fraction >= 1, spread});
  }
  return surfaces;
}

std::vector<MetSurface> StepLedger::near_reference() const {
  std::vector<MetSurface> surfaces;
  const auto add = [&](const Vec2d& normal, const Vec2d& velocity, double spread) {
    const bool known = std::any_of(surfaces.begin(), surfaces.end(), [&](const MetSurface& one) {
      return (one.normal - normal).norm() < same_velocity && one.velocity == velocity;
    });
    if (!known) surfaces.push_back({.normal = normal, .velocity = velocity, .spread = spread});
  };
  const auto is_of_ghost = [this](ColliderIndex collider, const NearFace& face) {
    return std::any_of(r_.contacts.begin(), r_.contacts.end(), [&](const Touch& touch) {
      return touch.collider == collider && is_ghost(now_.reference.judged, touch) &&
             (touch.normal - face.normal).norm() < one_normal;
    });
  };
  const std::vector<Vec2d>& hull = reference_.header->points;
  for (const PathPoint<double>& corner : r_.path)
    for (const NearPart& part :
         reference_solids_.at(corner.fraction).near_parts(Place(corner, r_.movers), box2d_skin + rounding_))
      for (const NearFace& face : part.faces) {
        if (face.separation > box2d_skin + rounding_ || is_of_ghost(part.collider, face)) continue;
        const Vec2d foot = *std::min_element(hull.begin(), hull.end(), [&](const Vec2d& a, const Vec2d& b) {
          return a.dot(face.normal) < b.dot(face.normal);
        });
        const Vec2d moved =
            moved_by_step(*reference_.header, r_, part.collider, corner.position + foot, corner.fraction);
        add(face.normal, moved / dt_, spread_of(reference_, r_, part.collider, dt_));
      }
  return surfaces;
}

bool StepLedger::is_turned_by_ghost() const {
  const Vec2d added = r_.velocity - r_.requested / dt_;
  return std::any_of(r_.contacts.begin(), r_.contacts.end(), [&](const Touch& touch) {
    return is_ghost(now_.reference.judged, touch) && added.dot(touch.normal) > turned;
  });
}

/// What the step takes of the wanted way and velocity.
void StepLedger::add_stop() {
  const Vec2d way_apart = (way_of(m_) - m_.requested) - (way_of(r_) - r_.requested);
  const Vec2d speed_apart = (m_.velocity * dt_ - m_.requested) - (r_.velocity * dt_ - r_.requested);
  taken_ = std::max(way_apart.norm(), speed_apart.norm());
  if (!(taken_ > same_event)) return;
  Event event{
      EventKind::stop,
      {},
      false,
      fmt::format("wanted ({:.4g}, {:.4g}) m/s: {} ends with ({:.4g}, {:.4g}), Box2D with ({:.4g}, {:.4g}); their "
                  "ways are {:.3g} m apart",
                  m_.requested.x() / dt_, m_.requested.y() / dt_, mine_.header->contender, m_.velocity.x(),
                  m_.velocity.y(), r_.velocity.x(), r_.velocity.y(), way_apart.norm())};
  event.cause = cause_of_stop(way_apart, speed_apart, event);
  events_.push_back(std::move(event));
}

bool StepLedger::follows_our_law() const {
  const Vec2d wanted = m_.requested / dt_;
  const SteeredVelocity steered{wanted, wanted - Vec2d(m_.steered / dt_, 0)};
  const std::vector<MetSurface> met = met_by_mine();
  return distance_from(controlled_outcomes(steered, met), m_.velocity) <=
         same_velocity * std::max(1.0, wanted.norm()) + widest_spread(met);
}

bool StepLedger::follows_box2ds_law(std::optional<Cause>& otherwise) const {
  const Vec2d wanted = r_.requested / dt_;
  const std::vector<MetSurface> near = near_reference();
  const double tolerance =
      same_velocity_in_float * std::max(1.0, wanted.norm()) + rounding_ / dt_ / ulps + widest_spread(near);
  const auto follows = [&](const std::vector<MetSurface>& surfaces) {
    return distance_from(frictionless_outcomes(wanted, surfaces), r_.velocity) <= tolerance;
  };
  if (follows(near)) return true;
  std::vector<MetSurface> reported;  // one for each collider and side: the step before may tell of another edge
  Vec2d kept = Vec2d::Zero();
  for (const Ledger::Moment* moment : {&now_, before_}) {
    if (moment == nullptr) continue;
    const TraceStep& step = moment->reference.step;
    for (const Touch& touch : step.contacts)
      reported.push_back({.normal = touch.normal, .velocity = velocity_of(reference_, step, touch, dt_)});
    kept = step.velocity - step.requested / dt_;
  }
  const double tilt = least_edge / width_of(reference_.header->points);
  if (known_.close_vertices && (follows(reported) || is_turned_by_tilt(wanted, r_.velocity, near, tilt))) {
    otherwise = Cause::outline;
  } else if (is_short_of_limit(wanted, r_.velocity, near, kept, solver_rounds)) {
    otherwise = Cause::solver_iterations;
  }
  return false;
}

/// By the laws alone.
std::optional<Cause> StepLedger::cause_of_stop(const Vec2d& way_apart, const Vec2d& speed_apart, Event& event) const {
  const StepJudgement& mine = now_.mine.judged;
  if (mine.hangs || mine.motion_lost > 0) return Cause::error_of_ours;
  if (taken_ <= rounding_) return Cause::float_rounding;
  if (!follows_our_law()) return std::nullopt;
  if (std::optional<Cause> otherwise; !follows_box2ds_law(otherwise)) return otherwise;
  event.both_right = true;
  const bool one_wish = (m_.requested - r_.requested).norm() <= rounding_;
  if (!one_wish) return known_.lockstep ? std::optional(Cause::intent) : std::nullopt;
  if (!only_mine_.empty() || !only_reference_.empty()) return std::nullopt;
  if (speed_apart.norm() > same_event + rounding_) return Cause::response_law;
  return way_apart.norm() <= within_skins + rounding_ ? std::optional(Cause::skin) : std::nullopt;
}

/// Of a stop that no law explains: what is so in this step and the laws do not know.
std::optional<Cause> StepLedger::circumstance_of_stop() const {
  if (is_turned_by_ghost()) return Cause::ghost_collision;
  if (r_.capped && r_.requested.norm() > longest_way && way_of(r_).norm() <= longest_way + rounding_)
    return Cause::travel_cap;
  if (is_crushed(now_.mine.judged) || is_crushed(now_.reference.judged)) return Cause::crush;
  if (is_inside(m_) || (is_inside(r_) && !known_.entered)) return Cause::start_inside;
  if (now_.beside_another || !m_.met.empty() || !r_.met.empty()) return Cause::company;
  return std::nullopt;
}

}  // namespace paperproof::compare::detail
