/// What a step takes of the wanted motion, and by which law: the part of the ledger about stops.
#include "metrics/ledger_step.hpp"
#include "oracle/engine_laws.hpp"
#include "oracle/response_laws.hpp"
#include "oracle/up.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace paperproof::compare::detail {
namespace {

/// Velocities of Box2D's law differ by less, as a share of the wanted one: they are in float.
constexpr double same_velocity_in_float = 1e-5;
/// Exact normals of one direction.
constexpr double same_normal = 1e-9;
/// A normal that Box2D reports is of the face whose normal is as near as this: it is in float.
constexpr double one_normal = 1e-5;
/// Rounds of Box2D's velocity solver.
constexpr int solver_rounds = 8;
/// A ghost turns a velocity if it adds more than this along its normal [m/s].
constexpr double turned = 1e-4;

double width_of(const std::vector<Vec2d>& hull) {
  const auto [left, right] =
      std::ranges::minmax_element(hull, [](const Vec2d& a, const Vec2d& b) { return a.x() < b.x(); });
  return right->x() - left->x();
}

Vec2d way_of(const TraceStep& step) { return step.path.back().position - step.path.front().position; }

/// The length of the side of the character that faces a surface with that normal [m]; 0 where a corner does.
double side_towards(const std::vector<Vec2d>& hull, const Vec2d& normal) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec2d& point : hull) lowest = std::min(lowest, point.dot(normal));
  const Vec2d along(normal.y(), -normal.x());
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (const Vec2d& point : hull) {
    if (point.dot(normal) > lowest + box2d_skin) continue;
    from = std::min(from, point.dot(along));
    to = std::max(to, point.dot(along));
  }
  return to - from;
}

double widest_spread(std::span<const MetSurface> surfaces) {
  double spread = 0;
  for (const MetSurface& one : surfaces) spread = std::max(spread, one.spread);
  return spread;
}

}  // namespace

std::vector<MetSurface> StepLedger::near_reference() const {
  std::vector<MetSurface> surfaces;
  const auto add = [&](const Vec2d& normal, const Vec2d& velocity, double spread) {
    const bool known = std::ranges::any_of(surfaces, [&](const MetSurface& one) {
      return (one.normal - normal).norm() < same_normal && one.velocity == velocity;
    });
    if (!known) surfaces.push_back({.normal = normal, .velocity = velocity, .spread = spread});
  };
  const auto is_of_ghost = [this](ColliderIndex collider, const NearFace& face) {
    return std::ranges::any_of(r_.contacts, [&](const Contact& touch) {
      return touch.collider == collider && is_ghost(now_.reference.judged, touch) &&
             (touch.normal - face.normal).norm() < one_normal;
    });
  };
  const std::vector<Vec2d>& hull = reference_.header->points;
  for (const PathPoint& corner : r_.path)
    for (const NearPart& part :
         reference_solids_.at(corner.fraction).near_parts(Place(corner, r_.movers), box2d_skin + rounding_))
      for (const NearFace& face : part.faces) {
        if (face.separation > box2d_skin + rounding_ || is_of_ghost(part.collider, face)) continue;
        const Vec2d foot =
            *std::ranges::min_element(hull, {}, [&](const Vec2d& point) { return point.dot(face.normal); });
        const Vec2d moved = reference_solids_.moved(part.collider, corner.position + foot, corner.fraction);
        add(face.normal, moved / dt_, reference_solids_.spread(part.collider, moved, side_towards(hull, face.normal)));
      }
  return surfaces;
}

bool StepLedger::is_turned_by_ghost() const {
  const Vec2d added = r_.velocity - r_.requested / dt_;
  return std::ranges::any_of(r_.contacts, [&](const Contact& touch) {
    return is_ghost(now_.reference.judged, touch) && added.dot(touch.normal) > turned;
  });
}

/// What the step takes of the wanted way and velocity.
void StepLedger::add_stop() {
  const Vec2d way_apart = (way_of(m_) - m_.requested) - (way_of(r_) - r_.requested);
  const Vec2d speed_apart = (m_.velocity * dt_ - m_.requested) - (r_.velocity * dt_ - r_.requested);
  taken_ = std::max(way_apart.norm(), speed_apart.norm());
  if (!(taken_ > same_event)) return;
  Event event{.kind = EventKind::stop,
              .words = fmt::format(
                  "wanted ({:.4g}, {:.4g}) m/s: {} ends with ({:.4g}, {:.4g}), Box2D with ({:.4g}, {:.4g}); their "
                  "ways are {:.3g} m apart",
                  m_.requested.x() / dt_, m_.requested.y() / dt_, mine_.header->contender, m_.velocity.x(),
                  m_.velocity.y(), r_.velocity.x(), r_.velocity.y(), way_apart.norm())};
  event.cause = cause_of_stop(way_apart, speed_apart, event);
  events_.push_back(std::move(event));
}

bool StepLedger::follows_our_law() const {
  const Vec2d up = up_in(m_, *mine_.header);
  ControlledStep step{.wanted = m_.requested / dt_, .up = up};
  step.unsteered = step.wanted - m_.steered / dt_ * right_of(up);
  step.side_hit_ends_rise = mine_.header->character.side_hit_ends_rise;
  const auto follows = [&](bool grounded) {
    const Wanted wanted{.velocity = step.wanted, .from_ground = grounded};
    return !velocity_fault(step, met_surfaces(mine_solids_, m_.contacts, wanted), m_.velocity);
  };
  if (m_.respawn) return follows(m_.from && m_.from->grounded);
  if (before_ != nullptr) return follows(before_->mine.step.grounded);
  return follows(false) || follows(true);  // a step that is not compared is not known
}

bool StepLedger::follows_box2ds_law(std::optional<Cause>& otherwise) const {
  const Vec2d wanted = r_.requested / dt_;
  const std::vector<MetSurface> near = near_reference();
  const double tolerance =
      same_velocity_in_float * std::max(1.0, wanted.norm()) + rounding_ / dt_ / ulps + widest_spread(near);
  // A character that lands without speed across on what carries it is carried at once.
  Vec2d landed = r_.velocity;
  if (r_.ride && landed.x() == r_.ride->velocity.x()) landed.x() = 0;
  const auto follows = [&](const std::vector<MetSurface>& surfaces) {
    const std::vector<Vec2d> outcomes = frictionless_outcomes(wanted, surfaces);
    return distance_from(outcomes, r_.velocity) <= tolerance || distance_from(outcomes, landed) <= tolerance;
  };
  if (follows(near)) return true;
  std::vector<MetSurface> reported;  // one for each collider and side: the step before may tell of another edge
  Vec2d kept = Vec2d::Zero();
  for (const Ledger::Moment* moment : {&now_, before_}) {
    if (moment == nullptr) continue;
    const TraceStep& step = moment->reference.step;
    for (const Contact& touch : step.contacts)
      reported.push_back({.normal = touch.normal,
                          .velocity = velocity_of(SolidsInStep(*reference_.header, *reference_.solids, step), touch)});
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
