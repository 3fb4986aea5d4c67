/// Ways out of what a step begins inside of: whether there is one, and whether the step leaves as it must.
#include "oracle/judge.hpp"

#include "oracle/crush.hpp"
#include "oracle/turning.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

/// The shortest straight way out of what a step begins inside of may be longer by this [m]; a way that is to be shorter
/// ends with as large a gap, and is open as far to both sides.
constexpr double around_way_out = 1e-6;
/// It keeps so far from the rims that it passes: an opening as narrow counts as closed [m].
constexpr double beside_rim = 2 * detail::least_clearance;

}  // namespace

/// Whether there is a way out of what is overlapped where the step begins, or ends.
/// @param in_turning something that turns is overlapped there.
bool Judge::is_stuck_refuted(const Place& at, const WhatTurns& turns, const AmongTurning* turning, bool in_turning) {
  if (!in_turning) return has_way_out(at, turns);
  const auto accept = [&](const Vec2d& out) {
    // How far what turns went on in a part is not known: no way is asked for that this may have taken.
    const double farthest = turning_->has_crushed() ? detail::push_beyond_motion : farthest_out(at);
    return (out - at.position).norm() <= farthest && !ends_on_another_side(at, out);
  };
  return at.fraction == 1 ? turning_->frees_at_end(turning->step, accept) : turning_->frees(turning->step, accept);
}

Judge::Leaving Judge::leaving_of(const Path& path, const WhatTurns& turns, bool from_turning) {
  Leaving leaving{.inside = true, .turning = from_turning};
  if (path.size() < 2 || path[1].fraction != 0 || from_turning) return leaving;
  const Place& start = path[0];
  const Place& out = path[1];
  std::vector<ColliderIndex> inside;
  std::vector<std::pair<ColliderIndex, Place>> sides;
  for (const auto& [collider, episode] : inside_) {
    inside.push_back(collider);
    if (episode.free_from) sides.emplace_back(collider, episode.free_from->place());
  }
  const auto is_left = [&](ColliderIndex collider) { return !scenery_.overlaps(out, collider); };
  leaving.at_once = std::ranges::any_of(inside, is_left);
  leaving.free = std::ranges::all_of(inside, is_left);
  const Vec2d way = out.position - start.position;
  leaving.longer = leaving.free && way.norm() > farthest_out(start) + around_way_out;
  if (leaving.longer || !leaving.free || !(way.norm() > around_way_out)) return leaving;
  const auto open = [&](const Vec2d& end) { return scenery_.meets_only(start, Place(end, start.movers, 0), inside); };
  // Far beyond a rim that it passes the clearance is much.
  const ExactScenery& wider = scenery_for(beside_rim);
  const auto keeps_side = [&](const Vec2d& end) {
    return std::ranges::none_of(sides, [&](const auto& side) {
      const ExactScenery& asked = wider.overlaps(side.second, side.first) ? scenery_ : wider;
      return asked.meets(side.second, Place(end, start.movers, start.fraction), side.first);
    });
  };
  const auto accept = [&](const Vec2d& end) {
    const Vec2d ahead = (end - start.position).normalized();
    const Vec2d aside = Vec2d(-ahead.y(), ahead.x()) * around_way_out;
    return open(end) && open(end + aside) && open(end - aside) && keeps_side(end) &&
           (!turns.left_free || turns.left_free(std::vector<PathPoint>{{start.position, 0}, {end, 1}}));
  };
  const WayQuestion question{.from = start, .end = start, .may_pass = inside, .sides = sides};
  leaving.longer = scenery_.find_free(question, way.norm() - around_way_out, around_way_out, accept).has_value();
  return leaving;
}

/// Whether a way out of what the octagon is inside of leads past some of it.
bool Judge::ends_on_another_side(const Place& at, const Vec2d& out) const {
  return std::ranges::any_of(inside_, [&](const auto& stay) {
    const std::optional<Kept>& free = stay.second.free_from;
    return free && scenery_.meets(free->place(), Place(out, at.movers, at.fraction), stay.first);
  });
}

/// The length up to which a way out is asked for [m]. Whom movers crushed goes no farther than they may push.
double Judge::farthest_out(const Place& at) const {
  std::optional<double> motion;
  for (const auto& [collider, episode] : inside_) {
    const MoverIndex mover = header_.scenery.colliders[collider].mover;
    if (mover == no_mover || !episode.free_from) continue;
    motion = std::max(motion.value_or(0), (at.movers[mover].to - at.movers[mover].from).norm());
  }
  return motion ? *motion + detail::push_beyond_motion : detail::farthest_way_out;
}

/// Asked once for each place: it costs much, and whoever is stuck mostly stays.
bool Judge::has_way_out(const Place& at, const WhatTurns& turns) {
  if (asked_way_out_) {
    const Kept& asked = asked_way_out_->first;
    const bool same = asked.position == at.position && asked.fraction == at.fraction && !turns.left_free &&
                      std::ranges::equal(asked.movers, at.movers, same_motion);
    if (same) return asked_way_out_->second;
  }
  const double farthest = farthest_out(at);
  const std::optional<Vec2d> out = scenery_.way_out(at, farthest);
  const bool found = out && (*out - at.position).norm() <= farthest && !ends_on_another_side(at, *out) &&
                     (!turns.left_free || turns.left_free(std::vector<PathPoint>{{at.position, 0}, {*out, 1}}));
  asked_way_out_.emplace(Kept(at), found);
  return found;
}

}  // namespace paperproof::compare
