#include "oracle/legs.hpp"

#include "oracle/contacts.hpp"
#include "oracle/crush.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/met_surfaces.hpp"
#include "oracle/response_laws.hpp"
#include "oracle/stairs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace paperproof::compare::detail {
namespace {

/// What is computed in another order differs by no more than this, relative to its size.
constexpr double relative_rounding = 1e-9;
/// A start is moved by so much at most, so that it is no nearer to anything than a step keeps [m].
constexpr double restores_start = 2e-6;
/// The legs along a surface may aim so much away from it [m].
constexpr double aims_away = 1e-6;
/// Straight down, to ground that bends by no more than rounded vertices do [m].
constexpr double follows_seam = 2.8e-6;
/// A walk climbs no more of them in one step.
constexpr int most_stairs = 4;

/// A face, and how well its velocity is known; the velocity itself is zero. @param normal as an upright character sees
/// it.
MetSurface face_of(const NearPart& part, const Vec2d& normal, double dt) {
  return {.normal = normal,
          .spread = (part.unsure + part.rim_unsure) / dt,
          .spread_along = (part.unsure_along + part.rim_unsure) / dt};
}

bool comes_against(const MetSurface& at) { return at.velocity.dot(at.normal) + at.spread > 0; }

struct LegJudge : StepView {
  const Wanted& first;  ///< By the first part of the step.
  const LaterParts& later;
  bool held;
  std::size_t begin;                         ///< The leg that is looked at first.
  const Wanted wanted = later.whole(first);  ///< By all parts of the step, but for what later ones steer.
  const int stairs = stairs_climbed(*this, first);
  /// For each corner of the way the parts within `contact_reach`.
  const std::vector<std::vector<NearPart>> touched = touched_parts();
  /// The same, as an upright character sees it.
  const std::vector<MetSurface> surfaces = near_surfaces();
  /// What the step may have at them, across and along up [m/s].
  const Box2 speeds = velocities(surfaces, Vec2d::Zero());

  [[nodiscard]] bool in_parts() const { return first.parts > 1 || later.any(); }

  /// The velocities that the parts of the step want. @param carried this is taken from them [m/s].
  [[nodiscard]] ControlledRange wanted_velocities(const Vec2d& carried) const {
    std::vector<Vec2d> unsteered;
    // Who rides what turns may leave it, and goes on as fast as that went before.
    const bool rides_turning = first.ridden && find_way(step.vertex_ways, *first.ridden) != nullptr;
    const Vec2d left = rides_turning ? Vec2d(first.rode - first.carried / dt) : Vec2d(Vec2d::Zero());
    for (const Wanted* one : {&wanted, &first})
      for (const Vec2d& velocity : {one->velocity, Vec2d(one->displacement / dt), Vec2d(one->velocity + left)})
        unsteered.push_back(seen(velocity - carried - one->steered / dt * right, up));
    ControlledRange range{.unsteered = Box2::around(unsteered)};
    // What turns under its rider takes it along otherwise in each part of the step.
    if (first.from_ground) {
      Box2 unsure{Vec2d::Zero(), Vec2d::Zero()};
      for (const NearPart& part : touched.front())
        for (const NearFace& face : part.faces)
          unsure = unsure.merged(face_of(part, seen(face.normal, up), dt).velocities());
      range.unsteered = range.unsteered + unsure;
    }
    range.least_steering = std::min(first.steered / dt, 0.0);
    range.most_steering = std::max(first.steered / dt, 0.0);
    return range;
  }

  [[nodiscard]] std::vector<std::vector<NearPart>> touched_parts() const {
    std::vector<std::vector<NearPart>> parts;
    for (std::size_t corner = 0; corner < step.path.size(); ++corner) parts.push_back(near(corner, contact_reach));
    return parts;
  }

  /// All that is near the way, in the order in which it comes to it.
  [[nodiscard]] std::vector<MetSurface> near_surfaces() const {
    std::vector<MetSurface> found;
    const auto add = [&found](const MetSurface& at) {
      const bool is_known = std::ranges::any_of(found, [&](const MetSurface& one) {
        return one.normal == at.normal && one.velocity == at.velocity && one.spread == at.spread &&
               one.spread_along == at.spread_along && one.walkable == at.walkable &&
               one.is_overlapped == at.is_overlapped;
      });
      if (!is_known) found.push_back(at);
    };
    const MoverIndex carrier = first.ridden ? solid(*first.ridden).mover : no_mover;
    for (std::size_t corner = 0; corner < step.path.size(); ++corner)
      for (const NearPart& part : touched[corner]) {
        const bool goes_along = carrier != no_mover && solid(part.collider).mover == carrier;
        for (const NearFace& face : part.faces) {
          const Vec2d normal = seen(face.normal, up);
          Vec2d velocity = seen(part.moved, up) / dt;
          velocity += conveyed(solid(part.collider), normal);
          velocity += part.rim / dt * Vec2d(-normal.y(), normal.x());
          MetSurface at = face_of(part, normal, dt);
          at.walkable = is_walked_on(face.normal, header, up);
          at.is_overlapped = face.separation < 0;
          at.velocity = at.is_overlapped || goes_along ? velocity : imparted(velocity, normal, at.walkable);
          if (find_way(step.vertex_ways, part.collider) != nullptr) {
            at.turning = solid(part.collider).mover;
            at.stands_at = step.path[corner].fraction;
          }
          add(at);
        }
        if (first.from_ground && is_stair(*this, first.carried, place(corner), part))
          add({.normal = {0, 1}, .velocity = seen(part.moved, up) / dt, .walkable = true});
      }
    return found;
  }

  /// All that the step may have at these surfaces, across and along up [m/s]. @param carried see `wanted_velocities`.
  [[nodiscard]] Box2 velocities(std::span<const MetSurface> at_surfaces, const Vec2d& carried) const {
    ControlledRange range = held ? ControlledRange{} : wanted_velocities(carried);
    range.squeezed = push_beyond_motion / dt;
    Box2 all = controlled_bounds(range, at_surfaces);
    if (!held) {
      // What a part of the step has made falls on, and is steered, in the next; or it jumps off ground.
      const Vec2d falls = seen(later.velocity, up);
      const auto goes_on = [&](const Box2& box, double slower, double faster) {
        return box.merged({box.lower + falls + Vec2d(slower, 0), box.upper + falls + Vec2d(faster, 0)});
      };
      all = goes_on(all, 0, 0);
      if (later.steered() > 0) {
        range.least_steering += later.slower;
        range.most_steering += later.faster;
        const Box2 steered = goes_on(controlled_bounds(range, at_surfaces), later.slower, later.faster);
        const Box2 ends = all.merged(asked(at_surfaces));
        all = all.merged(steered);
        all.lower.x() = std::max(all.lower.x(), ends.lower.x());
        all.upper.x() = std::min(all.upper.x(), ends.upper.x());
      }
      for (const MetSurface& at : at_surfaces)
        if (at.walkable && later.jump > 0)
          all.upper.y() = std::max(all.upper.y(), at.velocities().upper.y() + later.jump);
    }
    return step.crushed.empty() ? all : all.merged({});  // a crush ends all motion
  }

  /// The speeds across up that steering ends at, in the air and on each ground: their smallest box, of any height.
  [[nodiscard]] Box2 asked(std::span<const MetSurface> at_surfaces) const {
    const Vec2d speed(later.asked, 0);
    Box2 all{speed, speed};
    for (const MetSurface& at : at_surfaces)
      if (at.walkable) all = all.merged({speed + at.velocities().lower, speed + at.velocities().upper});
    return all;
  }

  /// How far each goes in the step that touches the character and moves [m].
  [[nodiscard]] std::map<ColliderIndex, double> pushes() const {
    std::map<ColliderIndex, double> ways;
    for (const std::vector<NearPart>& parts : touched)
      for (const NearPart& part : parts)
        ways[part.collider] =
            std::max(ways[part.collider], part.moved.norm() + part.unsure + std::abs(part.rim) + part.rim_unsure);
    return ways;
  }

  /// How far the law of pushing lets it be pushed that wants nothing [m].
  [[nodiscard]] double most_pushed() const {
    std::map<ColliderIndex, double> ways = pushes();
    for (const ColliderIndex inside : step.start_overlap) ways.erase(inside);
    double longest = 0;
    for (const auto& [collider, way] : ways) longest = std::max(longest, way);
    return longest > 0 ? longest + push_beyond_motion : 0;
  }

  /// How much farther than the law of pushing says something pushes it [m]. @param own it goes so far itself [m].
  [[nodiscard]] double pushed_too_far(double own) const {
    const double way = (step.path.back().position - step.path[begin].position).norm();
    return std::max(0.0, way - own - most_pushed() - rounding());
  }

  /// Whether what touches it leaves it no motion that is short enough.
  [[nodiscard]] bool must_evade() const {
    return leave_no_motion(surfaces, (wanted.displacement.norm() + most_pushed()) / dt);
  }

  [[nodiscard]] double rounding() const {
    double rounding = relative_rounding * (1 + wanted.displacement.norm());
    const Vec2d* last = nullptr;
    for (const PathPoint& corner : step.path) {
      if (last == nullptr || *last != corner.position) rounding += 4 * ulp_at(header, corner.position);
      last = &corner.position;
    }
    return rounding;
  }

  /// The character waits where something turns: its way is late by this [m].
  [[nodiscard]] double waited() const {
    return step.vertex_ways.empty() ? 0 : waited_in_part * wanted.displacement.norm();
  }

  /// Whether something that comes against it touches it: nothing else pushes.
  [[nodiscard]] bool is_pushed() const { return std::ranges::any_of(surfaces, comes_against); }

  /// How far it goes straight down to ground at once, and so no farther than a walk is held to it [m]: with its last
  /// leg, or with one in each of the parts of the step.
  [[nodiscard]] double snapped() const {
    if (header.character.snap == 0) return 0;
    const bool many = first.parts > 1;
    if (!many && !(wanted.from_ground && step.grounded)) return 0;
    const auto looks_up = [&](const NearPart&, const NearFace& face) { return face.normal.dot(up) > 0; };
    double down = 0;
    int legs = 0;
    for (std::size_t k = many ? 1 : step.path.size() - 1; k > 0 && k < step.path.size(); ++k) {
      const Vec2d leg = seen(step.path[k].position - step.path[k - 1].position, up);
      const bool at_once = step.path[k - 1].fraction == step.path[k].fraction;
      const bool is_straight = std::abs(leg.x()) <= rounding() && leg.y() < 0;
      if (!at_once || !is_straight || legs == first.parts || !any_face(touched[k], looks_up)) continue;
      down += std::min(-leg.y(), header.character.snap);
      ++legs;
    }
    return down;
  }

  /// How fast what pushes it at once has carried it already [m/s].
  [[nodiscard]] Vec2d own_carrier() const {
    const auto goes_so = [&](const NearPart& part) { return part.moved == first.carried; };
    const bool is_there = std::ranges::any_of(touched.front(), goes_so);
    return is_there ? Vec2d(first.carried / dt) : Vec2d(Vec2d::Zero());
  }

  [[nodiscard]] bool knows_speeds() const {
    return std::ranges::all_of(surfaces,
                               [](const MetSurface& at) { return std::isfinite(at.spread + at.spread_along); });
  }

  [[nodiscard]] double way_gained() const {
    const double gained = farther(speeds, {});
    if (!(gained > 0) || !is_pushed()) return gained;
    if (held) return pushed_too_far(0);
    if (must_evade()) return pushed_too_far(wanted.displacement.norm());
    // Pushed at once, it goes on as if all rested: each motion counts once.
    const Box2 pushed = controlled_bounds({.squeezed = push_beyond_motion / dt}, surfaces);
    double way = 0;
    for (const auto& [collider, its] : pushes()) way += its;
    const Vec2d most = Vec2d::Constant(way + push_beyond_motion);
    const Box2 push{(pushed.lower * dt).cwiseMax(-most), (pushed.upper * dt).cwiseMin(most)};
    std::vector<MetSurface> resting = surfaces;
    for (MetSurface& at : resting)
      at = {.normal = at.normal, .walkable = at.walkable, .is_overlapped = at.is_overlapped};
    return farther(velocities(resting, own_carrier()), push);
  }

  /// How much farther the way is, in one direction, than at these velocities [m]. @param push of what comes against it,
  /// across and along up [m].
  [[nodiscard]] double farther(const Box2& allowed, const Box2& push) const {
    Vec2d above = Vec2d::Zero();
    Vec2d below = Vec2d::Zero();
    for (std::size_t leg = begin; leg + 1 < step.path.size(); ++leg) {
      const PathPoint& from = step.path[leg];
      const PathPoint& to = step.path[leg + 1];
      const Vec2d way = seen(to.position - from.position, up);
      const double time = (to.fraction - from.fraction) * dt;
      above += (way - allowed.upper * time).cwiseMax(0);
      below += (allowed.lower * time - way).cwiseMax(0);
    }
    const double everywhere = rounding() + waited();
    Vec2d room_above = Vec2d::Zero();
    Vec2d room_below = Vec2d::Zero();
    const double gap = restores_start + aims_away * static_cast<double>(1 + surfaces.size());
    for (const MetSurface& at : surfaces) {
      room_above = room_above.cwiseMax(gap * at.normal);
      room_below = room_below.cwiseMax(-gap * at.normal);
    }
    room_above += push.upper;
    room_below -= push.lower;
    room_below.y() += follows_seam;
    if (!held) room_below.y() += snapped();
    if (!held && stairs > 0) {
      // Atop it goes on at once to where it would have come, and no farther.
      const Vec2d way = seen(step.path.back().position - step.path[begin].position, up);
      const bool to_the_right = wanted.displacement.dot(right) > 0;
      const double gained = to_the_right ? way.x() - std::max(allowed.upper.x(), 0.0) * dt - room_above.x()
                                         : std::min(allowed.lower.x(), 0.0) * dt - way.x() - room_below.x();
      if (gained > everywhere) return gained;
      (to_the_right ? room_above : room_below).x() +=
          (std::max(allowed.upper.x(), 0.0) - std::min(allowed.lower.x(), 0.0)) * dt;
      room_above.y() += stairs * header.character.step_height;
      room_below.y() += stairs * header.character.step_height;
    }
    return std::max({0.0, (above - room_above).maxCoeff() - everywhere, (below - room_below).maxCoeff() - everywhere});
  }

  [[nodiscard]] double speed_gained() const {
    const Vec2d velocity = seen(step.velocity, up);
    const double gained = std::max((velocity - speeds.upper).maxCoeff(), (speeds.lower - velocity).maxCoeff());
    const double largest = std::max(speeds.lower.cwiseAbs().maxCoeff(), speeds.upper.cwiseAbs().maxCoeff());
    return gained <= relative_rounding * (1 + largest) ? 0 : gained;
  }

  /// Whether something touches it that comes against it, or turns: it may move it at once.
  [[nodiscard]] bool is_moved_at_once() const {
    const auto does_turn = [](const MetSurface& at) { return at.spread > 0; };
    if (is_pushed() || std::ranges::any_of(surfaces, does_turn)) return true;
    if (!turns.near) return false;
    return std::ranges::any_of(step.path,
                               [this](const PathPoint& corner) { return !turns.near(corner, contact_reach).empty(); });
  }

  /// Whether nothing but the law of response moves it: it goes in one part, and nothing moves it at once, but for gaps
  /// that are restored, and seams and ground that are followed.
  [[nodiscard]] bool goes_by_law() const { return !step.dropped && !in_parts() && stairs == 0 && !is_moved_at_once(); }

  [[nodiscard]] Vec2d crept() const {
    Vec2d crept = Vec2d::Zero();
    for (std::size_t leg = 0; leg + 1 < step.path.size(); ++leg) {
      const Vec2d way = seen(step.path[leg + 1].position - step.path[leg].position, up);
      const double time = (step.path[leg + 1].fraction - step.path[leg].fraction) * dt;
      crept += way - way.cwiseMin((speeds.upper * time).cwiseMax(0)).cwiseMax((speeds.lower * time).cwiseMin(0));
    }
    const bool is_asked = !crept.isZero(0) && !held && snapped() == 0 && goes_by_law();
    return is_asked ? in_world(crept, up) : Vec2d(Vec2d::Zero());
  }

  /// How far the way may leave the motion of the law at so many surfaces [m].
  [[nodiscard]] double room_at(std::size_t count) const {
    return restores_start + follows_seam + aims_away * static_cast<double>(1 + count) + waited() + rounding();
  }

  [[nodiscard]] double end_error() const {
    const std::vector<PathPoint>& path = step.path;
    std::size_t end = path.size() - 1;
    while (end > 0 && !(path[end - 1].fraction < path[end].fraction)) --end;
    const bool is_asked = end > 0 && !held && !in_parts() && !step.dropped && step.crushed.empty() && snapped() == 0 &&
                          !header.character.side_hit_ends_rise && stairs == 0;
    if (!is_asked) return 0;
    const PathPoint& from = path[end - 1];
    const PathPoint& to = path[end];
    // A contact that is met where the leg ends changes the velocity there. It tells of a moment just after its corner.
    const auto follows = [&](const Contact& met) { return met.fraction - from.fraction > to.fraction - met.fraction; };
    if (std::ranges::any_of(step.contacts, follows)) return 0;
    const Vec2d way = to.position - from.position;
    const double time = (to.fraction - from.fraction) * dt;
    double off = (way - step.velocity * time).norm();
    // Two surfaces that press it out take it farther than the speed that they give it.
    const bool is_limited =
        is_pushed() && surfaces.size() > 1 && !step.velocity.isZero(0) && way.norm() > step.velocity.norm() * time;
    if (is_limited) off = std::abs(way.dot(right_of(step.velocity.normalized())));
    double unsure = 0;
    for (const MetSurface& at : surfaces) unsure = std::max(unsure, std::hypot(at.spread, at.spread_along));
    const double room = unsure * time + room_at(surfaces.size());
    return off <= room || must_evade() ? 0 : off;
  }

  [[nodiscard]] double leg_error() const {
    if (!goes_by_law()) return 0;
    // A side hit ends a rise with the step: the way still goes on.
    ControlledStep law{.wanted = first.displacement / dt, .up = up};
    law.unsteered = law.wanted - first.steered / dt * right;
    law.sides = sides_of(header, up);
    const SolidsInStep solids(header, scenery, step);
    const std::vector<MetSurface> hit = met_surfaces(solids, step.contacts, first);
    std::vector<Vec2d> outcomes{law.wanted};
    std::size_t met = 0;
    double off = 0;
    for (std::size_t leg = 0; leg + 1 < step.path.size(); ++leg) {
      const PathPoint& from = step.path[leg];
      const PathPoint& to = step.path[leg + 1];
      const auto is_there = [&](const MetSurface& at) {
        return std::ranges::any_of(std::span(step.path).first(leg + 1), [&](const PathPoint& corner) {
          return scenery.separation(Place(corner, step.movers), at.collider) <= contact_reach;
        });
      };
      for (; met < hit.size() && is_there(hit[met]); ++met) {
        const std::vector<Vec2d> made = controlled_outcomes(law, std::span(hit).first(met + 1));
        outcomes.insert(outcomes.end(), made.begin(), made.end());
        if (met + 1 == hit.size()) outcomes.push_back(step.velocity);  // judged for itself
      }
      const double time = (to.fraction - from.fraction) * dt;
      if (!(time > 0)) continue;
      double least = HUGE_VAL;
      for (const Vec2d& outcome : outcomes)
        least = std::min(least, (to.position - from.position - outcome * time).norm());
      off += least;
    }
    // Each collider is aimed away from once, however often the way turns.
    std::set<ColliderIndex> aimed_at;
    for (const Contact& contact : step.contacts) aimed_at.insert(contact.collider);
    const double room = room_at(aimed_at.size());
    return off <= room ? 0 : off;
  }
};

}  // namespace

int stairs_climbed(const StepView& at, const Wanted& wanted) {
  const TraceStep& step = at.step;
  const double highest = at.header.character.step_height + contact_reach;
  if (!(at.header.character.step_height > 0) || !wanted.from_ground || wanted.jumped || !step.grounded) return 0;
  const Vec2d walk = wanted.displacement - wanted.displacement.dot(at.up) * at.up;
  const auto stops = [&](const NearPart& part, const NearFace& face) {
    return face.normal.dot(walk - part.moved) < 0 && !is_walked_on(face.normal, at.header, at.up);
  };
  // There or before: what stopped it may have gone on since.
  const auto was_stopped = [&](std::size_t corner) {
    while (!any_face(at.near(corner, contact_reach), stops))
      if (corner-- == 0) return false;
    return true;
  };
  int climbed = 0;
  for (std::size_t k = 2; k < step.path.size(); ++k) {
    const Vec2d leg = seen(step.path[k - 1].position - step.path[k - 2].position, at.up);
    const bool goes_on_at_once = step.path[k].fraction == step.path[k - 1].fraction;
    const bool straight = std::abs(leg.x()) <= 4 * ulp_at(at.header, step.path[k].position);
    if (!goes_on_at_once || !straight || !(leg.y() > 0 && leg.y() <= highest)) continue;
    const PathPoint& atop = step.path[std::min(k + 1, step.path.size() - 1)];
    const Vec2d made = seen(atop.position - step.path[k - 2].position, at.up);
    const bool leads_on = made.y() > guaranteed_touch && made.x() * walk.dot(at.right) > 0;
    if (leads_on && was_stopped(k - 2)) ++climbed;
  }
  return std::min(climbed, most_stairs);
}

LegFaults leg_faults(const StepView& at, const Wanted& wanted, const LaterParts& later, bool held, std::size_t begin,
                     bool as_law) {
  const LegJudge legs{at, wanted, later, held, begin};
  LegFaults found{.knows_speeds = legs.knows_speeds()};
  if (found.knows_speeds) found.way_gained = legs.way_gained();
  if (found.knows_speeds) found.speed_gained = legs.speed_gained();
  if (!as_law) return found;
  found.leg_error = legs.leg_error();
  found.end_error = legs.end_error();
  found.crept = legs.crept();
  return found;
}

}  // namespace paperproof::compare::detail
