#include "oracle/legs.hpp"

#include "oracle/contacts.hpp"
#include "oracle/met_surfaces.hpp"
#include "oracle/stairs.hpp"
#include "oracle/up.hpp"

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

}  // namespace

std::vector<NearPart> parts_near(const ExactScenery& scenery, const TraceStep& step, const WhatTurns& turns,
                                 std::size_t corner, double within) {
  std::vector<NearPart> parts = scenery.near_parts(Place(step.path[corner], step.movers), within);
  if (turns.near)
    for (NearPart& part : turns.near(step.path[corner], within)) parts.push_back(std::move(part));
  return parts;
}

double depth_in(std::span<const NearPart> parts) {
  double depth = 0;
  for (const NearPart& part : parts) depth += std::max(0.0, -part.faces.front().separation);
  return depth;
}

int stairs_climbed(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step,
                   const WhatTurns& turns, const Wanted& wanted) {
  const double highest = header.character.step_height + contact_reach;
  if (!(header.character.step_height > 0) || !wanted.from_ground || wanted.jumped || !step.grounded) return 0;
  const Vec2d up = up_in(step, header);
  const Vec2d walk = wanted.displacement - wanted.displacement.dot(up) * up;
  const auto stops = [&](const NearPart& part, const NearFace& face) {
    return face.normal.dot(walk - part.moved) < 0 && !is_walked_on(face.normal, header, up);
  };
  const auto is_stopped = [&](std::size_t corner) {
    const std::vector<NearPart> parts = parts_near(scenery, step, turns, corner, contact_reach);
    return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
      return std::any_of(part.faces.begin(), part.faces.end(), [&](const NearFace& face) { return stops(part, face); });
    });
  };
  // There or before: what stopped it may have gone on since.
  const auto was_stopped = [&](std::size_t corner) {
    while (!is_stopped(corner))
      if (corner-- == 0) return false;
    return true;
  };
  int climbed = 0;
  for (std::size_t k = 2; k < step.path.size(); ++k) {
    const Vec2d leg = seen(step.path[k - 1].position - step.path[k - 2].position, up);
    const bool goes_on_at_once = step.path[k].fraction == step.path[k - 1].fraction;
    const bool straight = std::abs(leg.x()) <= 4 * ulp_at(header, step.path[k].position);
    if (!goes_on_at_once || !straight || !(leg.y() > 0 && leg.y() <= highest)) continue;
    const PathPoint& atop = step.path[std::min(k + 1, step.path.size() - 1)];
    const Vec2d made = seen(atop.position - step.path[k - 2].position, up);
    const bool leads_on = made.y() > guaranteed_touch && made.x() * walk.dot(right_of(up)) > 0;
    if (leads_on && was_stopped(k - 2)) ++climbed;
  }
  return std::min(climbed, most_stairs);
}

LegJudge::LegJudge(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step, const Wanted& wanted,
                   const WhatTurns& turns, const LaterParts& later, bool held)
    : header_(header),
      scenery_(scenery),
      step_(step),
      first_(wanted),
      wanted_(later.whole(wanted)),
      turns_(turns),
      later_(later),
      up_(up_in(step, header)),
      right_(right_of(up_)),
      dt_(length_of(step, header)),
      held_(held),
      stairs_(stairs_climbed(header, scenery, step, turns, wanted)),
      surfaces_(near_surfaces()),
      speeds_(velocities(surfaces_, Vec2d::Zero())) {}

/// The velocities that the parts of the step want. @param carried this is taken from them [m/s].
ControlledRange LegJudge::wanted_velocities(const Vec2d& carried) const {
  std::vector<Vec2d> unsteered;
  // Who rides what turns may leave it, and goes on as fast as that went before.
  const bool turns = first_.ridden && find_way(step_.vertex_ways, *first_.ridden) != nullptr;
  const Vec2d left = turns ? Vec2d(first_.rode - first_.carried / dt_) : Vec2d(Vec2d::Zero());
  for (const Wanted* wanted : {&wanted_, &first_})
    for (const Vec2d& velocity : {wanted->velocity, Vec2d(wanted->displacement / dt_), Vec2d(wanted->velocity + left)})
      unsteered.push_back(seen(velocity - carried - wanted->steered / dt_ * right_, up_));
  ControlledRange range{.unsteered = Box2::around(unsteered)};
  // What turns under its rider takes it along otherwise in each part of the step.
  if (first_.from_ground) {
    Box2 unsure{Vec2d::Zero(), Vec2d::Zero()};
    for (const NearPart& part : near(0, contact_reach))
      for (const NearFace& face : part.faces)
        unsure = unsure.merged(face_of(part, seen(face.normal, up_), dt_).velocities());
    range.unsteered = {range.unsteered.lower + unsure.lower, range.unsteered.upper + unsure.upper};
  }
  range.least_steering = std::min(first_.steered / dt_, 0.0);
  range.most_steering = std::max(first_.steered / dt_, 0.0);
  return range;
}

/// All that is near the way, in the order in which it comes to it.
std::vector<MetSurface> LegJudge::near_surfaces() const {
  std::vector<MetSurface> surfaces;
  const auto add = [&surfaces](const MetSurface& at) {
    const bool is_known = std::any_of(surfaces.begin(), surfaces.end(), [&](const MetSurface& one) {
      return one.normal == at.normal && one.velocity == at.velocity && one.spread == at.spread &&
             one.spread_along == at.spread_along && one.walkable == at.walkable &&
             one.is_overlapped == at.is_overlapped;
    });
    if (!is_known) surfaces.push_back(at);
  };
  const auto mover_of = [this](ColliderIndex collider) { return header_.scenery.colliders[collider].mover; };
  for (std::size_t corner = 0; corner < step_.path.size(); ++corner)
    for (const NearPart& part : near(corner, contact_reach)) {
      const bool goes_along =
          first_.ridden && mover_of(*first_.ridden) != no_mover && mover_of(part.collider) == mover_of(*first_.ridden);
      for (const NearFace& face : part.faces) {
        const Vec2d normal = seen(face.normal, up_);
        Vec2d velocity = seen(part.moved, up_) / dt_;
        velocity += conveyed(header_.scenery.colliders[part.collider], normal);
        velocity += part.rim / dt_ * Vec2d(-normal.y(), normal.x());
        MetSurface at = face_of(part, normal, dt_);
        at.walkable = is_walked_on(face.normal, header_, up_);
        at.is_overlapped = face.separation < 0;
        at.velocity = at.is_overlapped || goes_along ? velocity : imparted(velocity, normal, at.walkable);
        if (find_way(step_.vertex_ways, part.collider) != nullptr) {
          at.turning = mover_of(part.collider);
          at.stands_at = step_.path[corner].fraction;
        }
        add(at);
      }
      if (first_.from_ground &&
          is_stair(header_, scenery_, step_, first_.carried, Place(step_.path[corner], step_.movers), part))
        add({.normal = {0, 1}, .velocity = seen(part.moved, up_) / dt_, .walkable = true});
    }
  return surfaces;
}

/// All that the step may have at these surfaces, across and along up [m/s]. @param carried see `wanted_velocities`.
Box2 LegJudge::velocities(std::span<const MetSurface> surfaces, const Vec2d& carried) const {
  ControlledRange range = held_ ? ControlledRange{} : wanted_velocities(carried);
  range.squeezed = push_beyond_motion / dt_;
  Box2 all = controlled_bounds(range, surfaces);
  if (!held_) {
    // What a part of the step has made falls on, and is steered, in the next; or it jumps off ground.
    const Vec2d falls = seen(later_.velocity, up_);
    const auto goes_on = [&](const Box2& box, double slower, double faster) {
      return box.merged({box.lower + falls + Vec2d(slower, 0), box.upper + falls + Vec2d(faster, 0)});
    };
    all = goes_on(all, 0, 0);
    if (later_.steered() > 0) {
      range.least_steering += later_.slower;
      range.most_steering += later_.faster;
      const Box2 steered = goes_on(controlled_bounds(range, surfaces), later_.slower, later_.faster);
      const Box2 ends = all.merged(asked(surfaces));
      all = all.merged(steered);
      all.lower.x() = std::max(all.lower.x(), ends.lower.x());
      all.upper.x() = std::min(all.upper.x(), ends.upper.x());
    }
    for (const MetSurface& at : surfaces)
      if (at.walkable && later_.jump > 0)
        all.upper.y() = std::max(all.upper.y(), at.velocities().upper.y() + later_.jump);
  }
  return step_.crushed.empty() ? all : all.merged({});  // a crush ends all motion
}

/// The speeds across up that steering ends at, in the air and on each ground: their smallest box, of any height.
Box2 LegJudge::asked(std::span<const MetSurface> surfaces) const {
  const Vec2d speed(later_.asked, 0);
  Box2 all{speed, speed};
  for (const MetSurface& at : surfaces)
    if (at.walkable) all = all.merged({speed + at.velocities().lower, speed + at.velocities().upper});
  return all;
}

/// How far each goes in the step that touches the character and moves [m].
std::map<ColliderIndex, double> LegJudge::pushes() const {
  std::map<ColliderIndex, double> ways;
  for (std::size_t corner = 0; corner < step_.path.size(); ++corner)
    for (const NearPart& part : near(corner, contact_reach))
      ways[part.collider] =
          std::max(ways[part.collider], part.moved.norm() + part.unsure + std::abs(part.rim) + part.rim_unsure);
  return ways;
}

/// How far the law of pushing lets it be pushed that wants nothing [m].
double LegJudge::most_pushed() const {
  std::map<ColliderIndex, double> ways = pushes();
  for (const ColliderIndex inside : step_.start_overlap) ways.erase(inside);
  double longest = 0;
  for (const auto& [collider, way] : ways) longest = std::max(longest, way);
  return longest > 0 ? longest + push_beyond_motion : 0;
}

/// How much farther than the law of pushing says something pushes it [m]. @param wanted it goes so far itself [m].
double LegJudge::pushed_too_far(std::size_t first, double wanted) const {
  const double way = (step_.path.back().position - step_.path[first].position).norm();
  return std::max(0.0, way - wanted - most_pushed() - rounding());
}

/// Whether what touches it leaves it no motion that is short enough.
bool LegJudge::must_evade() const {
  return leave_no_motion(surfaces_, (wanted_.displacement.norm() + most_pushed()) / dt_);
}

double LegJudge::rounding() const {
  double rounding = relative_rounding * (1 + wanted_.displacement.norm());
  const Vec2d* last = nullptr;
  for (const PathPoint& corner : step_.path) {
    if (last == nullptr || *last != corner.position) rounding += 4 * ulp_at(header_, corner.position);
    last = &corner.position;
  }
  return rounding;
}

/// The character waits where something turns: its way is late by this [m].
double LegJudge::waited() const { return step_.vertex_ways.empty() ? 0 : waited_in_part * wanted_.displacement.norm(); }

/// Whether something that comes against it touches it: nothing else pushes.
bool LegJudge::is_pushed() const { return std::any_of(surfaces_.begin(), surfaces_.end(), comes_against); }

/// How far it goes straight down to ground at once, and so no farther than a walk is held to it [m]: with its last leg,
/// or with one in each of the parts of the step.
double LegJudge::snapped() const {
  if (header_.character.snap == 0) return 0;
  const bool in_parts = first_.parts > 1;
  if (!in_parts && !(wanted_.from_ground && step_.grounded)) return 0;
  const auto ends_on_ground = [&](std::size_t corner) {
    const std::vector<NearPart> parts = near(corner, contact_reach);
    return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
      return std::any_of(part.faces.begin(), part.faces.end(),
                         [&](const NearFace& face) { return face.normal.dot(up_) > 0; });
    });
  };
  double down = 0;
  int legs = 0;
  for (std::size_t k = in_parts ? 1 : step_.path.size() - 1; k > 0 && k < step_.path.size(); ++k) {
    const Vec2d leg = seen(step_.path[k].position - step_.path[k - 1].position, up_);
    const bool at_once = step_.path[k - 1].fraction == step_.path[k].fraction;
    const bool is_straight = std::abs(leg.x()) <= rounding() && leg.y() < 0;
    if (!at_once || !is_straight || legs == first_.parts || !ends_on_ground(k)) continue;
    down += std::min(-leg.y(), header_.character.snap);
    ++legs;
  }
  return down;
}

/// How fast what pushes it at once has carried it already [m/s].
Vec2d LegJudge::own_carrier() const {
  const std::vector<NearPart> parts = near(0, contact_reach);
  const bool is_there =
      std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) { return part.moved == first_.carried; });
  return is_there ? Vec2d(first_.carried / dt_) : Vec2d(Vec2d::Zero());
}

bool LegJudge::knows_speeds() const {
  return std::all_of(surfaces_.begin(), surfaces_.end(),
                     [](const MetSurface& at) { return std::isfinite(at.spread + at.spread_along); });
}

double LegJudge::way_gained(std::size_t first) const {
  const double gained = farther(first, speeds_, {});
  if (!(gained > 0) || !is_pushed()) return gained;
  if (held_) return pushed_too_far(first, 0);
  if (must_evade()) return pushed_too_far(first, wanted_.displacement.norm());
  // Pushed at once, it goes on as if all rested: each motion counts once.
  const Box2 pushed = controlled_bounds({.squeezed = push_beyond_motion / dt_}, surfaces_);
  double way = 0;
  for (const auto& [collider, its] : pushes()) way += its;
  const Vec2d most = Vec2d::Constant(way + push_beyond_motion);
  const Box2 push{(pushed.lower * dt_).cwiseMax(-most), (pushed.upper * dt_).cwiseMin(most)};
  std::vector<MetSurface> resting = surfaces_;
  for (MetSurface& at : resting) at = {.normal = at.normal, .walkable = at.walkable, .is_overlapped = at.is_overlapped};
  return farther(first, velocities(resting, own_carrier()), push);
}

/// How much farther the way is, in one direction, than at these velocities [m]. @param push of what comes against it,
/// across and along up [m].
double LegJudge::farther(std::size_t first, const Box2& speeds, const Box2& push) const {
  Vec2d above = Vec2d::Zero();
  Vec2d below = Vec2d::Zero();
  for (std::size_t leg = first; leg + 1 < step_.path.size(); ++leg) {
    const PathPoint& from = step_.path[leg];
    const PathPoint& to = step_.path[leg + 1];
    const Vec2d way = seen(to.position - from.position, up_);
    const double time = (to.fraction - from.fraction) * dt_;
    above += (way - speeds.upper * time).cwiseMax(0);
    below += (speeds.lower * time - way).cwiseMax(0);
  }
  const double everywhere = rounding() + waited();
  Vec2d room_above = Vec2d::Zero();
  Vec2d room_below = Vec2d::Zero();
  const double gap = restores_start + aims_away * static_cast<double>(1 + surfaces_.size());
  for (const MetSurface& at : surfaces_) {
    room_above = room_above.cwiseMax(gap * at.normal);
    room_below = room_below.cwiseMax(-gap * at.normal);
  }
  room_above += push.upper;
  room_below -= push.lower;
  room_below.y() += follows_seam;
  if (!held_) room_below.y() += snapped();
  if (!held_ && stairs_ > 0) {
    // Atop it goes on at once to where it would have come, and no farther.
    const Vec2d way = seen(step_.path.back().position - step_.path[first].position, up_);
    const bool to_the_right = wanted_.displacement.dot(right_) > 0;
    const double gained = to_the_right ? way.x() - std::max(speeds.upper.x(), 0.0) * dt_ - room_above.x()
                                       : std::min(speeds.lower.x(), 0.0) * dt_ - way.x() - room_below.x();
    if (gained > everywhere) return gained;
    (to_the_right ? room_above : room_below).x() +=
        (std::max(speeds.upper.x(), 0.0) - std::min(speeds.lower.x(), 0.0)) * dt_;
    room_above.y() += stairs_ * header_.character.step_height;
    room_below.y() += stairs_ * header_.character.step_height;
  }
  return std::max({0.0, (above - room_above).maxCoeff() - everywhere, (below - room_below).maxCoeff() - everywhere});
}

double LegJudge::speed_gained() const {
  const Vec2d velocity = seen(step_.velocity, up_);
  const double gained = std::max((velocity - speeds_.upper).maxCoeff(), (speeds_.lower - velocity).maxCoeff());
  const double largest = std::max(speeds_.lower.cwiseAbs().maxCoeff(), speeds_.upper.cwiseAbs().maxCoeff());
  return gained <= relative_rounding * (1 + largest) ? 0 : gained;
}

/// Whether something touches it that comes against it, or turns: it may move it at once.
bool LegJudge::is_moved_at_once() const {
  const auto turns = [](const MetSurface& at) { return at.spread > 0; };
  if (is_pushed() || std::any_of(surfaces_.begin(), surfaces_.end(), turns)) return true;
  if (!turns_.near) return false;
  return std::any_of(step_.path.begin(), step_.path.end(),
                     [this](const PathPoint& corner) { return !turns_.near(corner, contact_reach).empty(); });
}

/// Whether nothing but the law of response moves it: it goes in one part, and nothing moves it at once, but for gaps
/// that are restored, and seams and ground that are followed.
bool LegJudge::goes_by_law() const {
  const bool in_parts = first_.parts > 1 || later_.any();
  return !step_.dropped && !in_parts && stairs_ == 0 && !is_moved_at_once();
}

Vec2d LegJudge::crept() const {
  Vec2d crept = Vec2d::Zero();
  for (std::size_t leg = 0; leg + 1 < step_.path.size(); ++leg) {
    const Vec2d way = seen(step_.path[leg + 1].position - step_.path[leg].position, up_);
    const double time = (step_.path[leg + 1].fraction - step_.path[leg].fraction) * dt_;
    crept += way - way.cwiseMin((speeds_.upper * time).cwiseMax(0)).cwiseMax((speeds_.lower * time).cwiseMin(0));
  }
  const bool is_asked = !crept.isZero(0) && !held_ && snapped() == 0 && goes_by_law();
  return is_asked ? in_world(crept, up_) : Vec2d(Vec2d::Zero());
}

/// How far the way may leave the motion of the law at so many surfaces [m].
double LegJudge::room_at(std::size_t surfaces) const {
  return restores_start + follows_seam + aims_away * static_cast<double>(1 + surfaces) + waited() + rounding();
}

double LegJudge::end_error() const {
  const std::vector<PathPoint>& path = step_.path;
  std::size_t end = path.size() - 1;
  while (end > 0 && !(path[end - 1].fraction < path[end].fraction)) --end;
  const bool in_parts = first_.parts > 1 || later_.any();
  const bool is_asked = end > 0 && !held_ && !in_parts && !step_.dropped && step_.crushed.empty() && snapped() == 0 &&
                        !header_.character.side_hit_ends_rise && stairs_ == 0;
  if (!is_asked) return 0;
  const PathPoint& from = path[end - 1];
  const PathPoint& to = path[end];
  // A contact that is met where the leg ends changes the velocity there. It tells of a moment just after its corner.
  const auto follows = [&](const Contact& met) { return met.fraction - from.fraction > to.fraction - met.fraction; };
  if (std::any_of(step_.contacts.begin(), step_.contacts.end(), follows)) return 0;
  const Vec2d way = to.position - from.position;
  const double time = (to.fraction - from.fraction) * dt_;
  double off = (way - step_.velocity * time).norm();
  // Two surfaces that press it out take it farther than the speed that they give it.
  const bool is_limited =
      is_pushed() && surfaces_.size() > 1 && !step_.velocity.isZero(0) && way.norm() > step_.velocity.norm() * time;
  if (is_limited) off = std::abs(way.dot(right_of(step_.velocity.normalized())));
  double unsure = 0;
  for (const MetSurface& at : surfaces_) unsure = std::max(unsure, std::hypot(at.spread, at.spread_along));
  const double room = unsure * time + room_at(surfaces_.size());
  return off <= room || must_evade() ? 0 : off;
}

double LegJudge::leg_error() const {
  if (!goes_by_law()) return 0;
  // A side hit ends a rise with the step: the way still goes on.
  ControlledStep law{.wanted = first_.displacement / dt_, .up = up_};
  law.unsteered = law.wanted - first_.steered / dt_ * right_;
  law.sides = sides_of(header_, up_);
  const SolidsInStep solids(header_, scenery_, step_);
  const std::vector<MetSurface> surfaces = met_surfaces(solids, step_.contacts, first_);
  std::vector<Vec2d> outcomes{law.wanted};
  std::size_t met = 0;
  double off = 0;
  for (std::size_t leg = 0; leg + 1 < step_.path.size(); ++leg) {
    const PathPoint& from = step_.path[leg];
    const PathPoint& to = step_.path[leg + 1];
    const auto is_there = [&](const MetSurface& at) {
      return std::any_of(step_.path.begin(), step_.path.begin() + static_cast<std::ptrdiff_t>(leg) + 1,
                         [&](const PathPoint& corner) {
                           return scenery_.separation(Place(corner, step_.movers), at.collider) <= contact_reach;
                         });
    };
    for (; met < surfaces.size() && is_there(surfaces[met]); ++met) {
      const std::vector<Vec2d> made = controlled_outcomes(law, std::span(surfaces).first(met + 1));
      outcomes.insert(outcomes.end(), made.begin(), made.end());
      if (met + 1 == surfaces.size()) outcomes.push_back(step_.velocity);  // judged for itself
    }
    const double time = (to.fraction - from.fraction) * dt_;
    if (!(time > 0)) continue;
    double least = HUGE_VAL;
    for (const Vec2d& outcome : outcomes)
      least = std::min(least, (to.position - from.position - outcome * time).norm());
    off += least;
  }
  // Each collider is aimed away from once, however often the way turns.
  std::set<ColliderIndex> aimed_at;
  for (const Contact& contact : step_.contacts) aimed_at.insert(contact.collider);
  const double room = room_at(aimed_at.size());
  return off <= room ? 0 : off;
}

}  // namespace paperproof::compare::detail
