/// Stays inside of solids, over steps: what is entered, left, passed, and what crushes.
#include "oracle/judge.hpp"

#include "contains.hpp"
#include "oracle/contacts.hpp"
#include "oracle/crush.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/passing.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

/// Instants at which the depth of a passing is looked at first.
constexpr int depth_samples = 32;
constexpr int depth_refinements = 40;

Place between(const Place& from, const Place& to, double share) {
  return {from.position + share * (to.position - from.position), from.movers,
          from.fraction + share * (to.fraction - from.fraction)};
}

/// Whether the octagon itself went through what crushed it, rather than that through the octagon.
bool went_through(const ExactScenery& scenery, const Vec2d& from, const Place& end, ColliderIndex collider) {
  return scenery.meets(Place(from, end.movers, end.fraction), end, collider);
}

}  // namespace

void Judge::begin_episodes(const Place& start, bool goes_on) {
  // From turn to turn other characters are elsewhere.
  const auto begins = [&](ColliderIndex collider) { return !goes_on || header_.is_body(collider); };
  std::erase_if(inside_, [&](const auto& stay) { return begins(stay.first); });
  if (!goes_on) asked_way_out_.reset();
  for (const ColliderIndex collider : scenery_.overlapped(start))
    if (begins(collider)) inside_[collider] = {.free_from = {}, .depth = scenery_.penetration(start, collider)};
}

void Judge::judge_way(const Path& path, const TraceStep& step, const WhatTurns& turns, StepJudgement& judgement) {
  Touched touched;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    for (const ColliderIndex collider : scenery_.met(path[i], path[i + 1])) touched.emplace(collider, i);
  }
  judge_crushes(path, step, touched, turns, judgement);
  judge_end(path, touched, judgement);
  for (const auto& [collider, corner] : touched) {
    if (is_said_as_crush(path.back(), collider, judgement) &&
        !went_through(scenery_, path[corner].position, path.back(), collider))
      continue;
    if (scenery_.scenery().colliders[collider].one_way) {
      if (!contains(step.dropped_through, collider)) judgement.one_way_broken.push_back(collider);
    } else {
      judge_passing(path, collider, path[corner], path[corner + 1], 0, judgement);
    }
  }
}

/// Where the step leaves the octagon: stays inside solids go on, begin and end. What is left in `touched` was passed
/// within the step.
void Judge::judge_end(const Path& path, Touched& touched, StepJudgement& judgement) {
  for (const ColliderIndex collider : judgement.end_overlap) {
    const auto entered = touched.find(collider);
    const auto [it, is_new] =
        inside_.try_emplace(collider, Episode{.free_from = Kept(path[entered != touched.end() ? entered->second : 0])});
    Episode& episode = it->second;
    const double depth = scenery_.penetration(path.back(), collider);
    episode.depth = std::max(episode.depth, depth);
    // Through a paper it is half its width deep on the way, and less where the step ends.
    if (rim_ > 0 && episode.depth <= rim_) episode.depth = std::max(episode.depth, depth_of(path, collider));
    const bool crushes = is_said_as_crush(path.back(), collider, judgement);
    if (!is_new && crushes) {
      // The octagon left this solid earlier in the step: it is judged from its last free position.
      const auto free = std::find_if(path.rbegin(), path.rend(),
                                     [&](const Place& corner) { return !scenery_.overlaps(corner, collider); });
      if (free != path.rend()) episode.free_from.emplace(*free);
    }
    episode.pressed = episode.pressed || crushes;
    const bool was_rounded = episode.rounded;
    const double rounding = promises_ ? 0 : ulp_at(header_, path.back().position);
    const double excused = std::max(rounding, allowed(Exempt::drawn, header_));
    episode.rounded = (is_new || was_rounded) && depth <= excused;
    if (episode.pressed) {
      judgement.pressed.push_back(collider);
    } else if (episode.rounded && depth <= rounding) {
      judgement.rounded.push_back(collider);
    } else if (episode.rounded) {
      judgement.drawn.push_back(collider);
      judgement.max_penetration = std::max(judgement.max_penetration, depth);
    } else {
      if (!header_.is_body(collider)) judgement.max_penetration = std::max(judgement.max_penetration, depth);
      if (is_new || was_rounded) judgement.entered.push_back(collider);
    }
    touched.erase(collider);
  }
  std::erase_if(inside_, [&](const auto& stay) {
    const ColliderIndex collider = stay.first;  // clang 14 captures no structured binding
    const Episode& episode = stay.second;
    if (contains(judgement.end_overlap, collider)) return false;
    const auto left =
        std::ranges::find_if(path, [&](const Place& corner) { return !scenery_.overlaps(corner, collider); });
    const auto again = std::adjacent_find(
        left, path.end(), [&](const Place& from, const Place& to) { return scenery_.meets(from, to, collider); });
    touched.erase(collider);
    if (again != path.end()) touched.emplace(collider, again - path.begin());
    const auto in_sight = [&](const Place& corner) {
      return !scenery_.meets(episode.free_from->place(), corner, collider);
    };
    if (!episode.free_from || std::any_of(left, path.end(), in_sight)) return true;
    const bool excused = episode.pressed || is_said_as_crush(path.back(), collider, judgement);
    if (!excused || went_through(scenery_, episode.free_from->position, path.back(), collider)) {
      judge_passing(path, collider, episode.free_from->place(), path.back(), episode.depth, judgement);
    }
    return true;
  });
}

/// Whether what it does to the octagon is a matter of the clause `crush`. A mover that is named and had left room
/// breaks that clause, of who promises it, and no other besides.
bool Judge::is_said_as_crush(const Place& end, ColliderIndex collider, const StepJudgement& judgement) const {
  if (contains(judgement.crushed, collider)) return true;
  const MoverIndex mover = header_.scenery.colliders[collider].mover;
  return contains(header_.guarantees, Clause::crush) && contains(judgement.crushed_with_room, collider) &&
         mover != no_mover && end.movers[mover].from != end.movers[mover].to;
}

/// @param from, to both free of the collider; the straight way between them meets it.
void Judge::judge_passing(const Path& path, ColliderIndex collider, const Place& from, const Place& to, double depth,
                          StepJudgement& judgement) const {
  if (rim_ > 0) {
    const double deepest = std::max(depth, depth_of(path, collider));
    if (deepest <= rim_) return judgement.note_clipped(judgement.clipped, collider, deepest);
  }
  judgement.tunnelled.push_back(collider);
  Passing passing = detail::describe_passing(scenery_, from, to, collider);
  passing.speed = way_past(path, collider) / dt_;
  judgement.passings.push_back(passing);
}

/// Length of the way relative to a collider [m].
double Judge::way_past(const Path& path, ColliderIndex collider) const {
  const MoverIndex mover = header_.scenery.colliders[collider].mover;
  double length = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    length += ((path[i + 1].position - path[i + 1].offset(mover)) - (path[i].position - path[i].offset(mover))).norm();
  }
  return length;
}

/// The largest depth on the way: between entry and exit of every leg at equal distances, then closing in on the deepest
/// (the depth in one convex part has a single peak along a leg).
double Judge::depth_of(const Path& path, ColliderIndex collider) const {
  double deepest = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const auto in = scenery_.impact_between(path[i], path[i + 1], collider);
    const auto out = scenery_.impact_between(path[i + 1], path[i], collider);
    const double first = in ? static_cast<double>(in->fraction) : 0;
    const double last = out ? 1 - static_cast<double>(out->fraction) : 1;
    if (!in && !out) continue;
    const auto depth_at = [&](double t) { return scenery_.penetration(between(path[i], path[i + 1], t), collider); };
    const double apart = (last - first) / depth_samples;
    double best = first;
    double depth = depth_at(first);
    const auto look = [&](double t) {
      const double here = depth_at(t);
      if (here > depth) {
        depth = here;
        best = t;
      }
    };
    for (int k = 1; k <= depth_samples; ++k) look(first + k * apart);
    double reach = apart;
    for (int k = 0; k < depth_refinements; ++k, reach /= 2) {
      look(std::max(first, best - reach / 2));
      look(std::min(last, best + reach / 2));
    }
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

void Judge::judge_crushes(const Path& path, const TraceStep& step, const Touched& touched, const WhatTurns& turns,
                          StepJudgement& judgement) {
  const auto goes = [&](ColliderIndex collider) {
    const MoverIndex mover = header_.scenery.colliders[collider].mover;
    return mover != no_mover && step.movers[mover].from != step.movers[mover].to;
  };
  const auto comes_closer_to = [&](const Place& early, ColliderIndex collider) {
    const Place late(early.position, step.movers, 1);
    return scenery_.meets(early, late, collider) ||
           scenery_.separation(late, collider) < scenery_.separation(early, collider);
  };
  // To where it began, or to where it was held: a mover that takes it along to there may go away from the former.
  std::size_t held = path.size() - 1;
  while (held > 0 && path[held - 1].position == path.back().position) --held;
  const auto comes_closer = [&](ColliderIndex collider) {
    return goes(collider) && (comes_closer_to(path.front(), collider) || comes_closer_to(path[held], collider));
  };
  std::vector<ColliderIndex> pressing = step.crushed;
  // What a contender that promises nothing ends inside of, and was inside of in no earlier step.
  std::vector<ColliderIndex> entered;
  if (!promises_) entered = judgement.end_overlap;
  std::erase_if(entered, [this](ColliderIndex collider) { return inside_.contains(collider); });
  if (!entered.empty()) {
    // Who promises nothing has no word for it, or not for all: what comes closer and is in reach is asked for.
    for (const ColliderIndex collider : scenery_.near(path.front(), path.back(), own_reach(header_)))
      if (!contains(pressing, collider) && comes_closer(collider)) pressing.push_back(collider);
  }
  if (pressing.empty()) return;
  detail::Meetings meetings{touched, {}};
  for (const auto& [collider, episode] : inside_) {
    std::optional<Place>& free = meetings.before[collider];
    if (episode.free_from) free = episode.free_from->place();
  }
  judgement.room = detail::find_room(scenery_, scenery_for(detail::least_clearance), path, pressing, meetings,
                                     detail::pushed_by(step), turns);
  const bool has_room = judgement.room && !judgement.beside_another;
  // One mover may press the octagon after another that goes away more slowly; but each of them touches it.
  const double within = std::max(detail::contact_reach, promises_ ? 0 : own_reach(header_));
  const auto touches = [&](ColliderIndex collider) {
    return touched.contains(collider) || std::ranges::any_of(path, [&](const Place& corner) {
             return scenery_.separation(corner, collider) <= within;
           });
  };
  const auto presses = [&](ColliderIndex collider) { return comes_closer(collider) && touches(collider); };
  const bool pressed = std::ranges::any_of(step.crushed, presses);
  for (const ColliderIndex collider : step.crushed) {
    const bool moves = pressed && goes(collider) && touches(collider);
    judgement.excused_crush = judgement.excused_crush || (moves && judgement.room && judgement.beside_another);
    (moves && !has_room ? judgement.crushed : judgement.crushed_with_room).push_back(collider);
  }
  if (has_room) return;
  for (const std::vector<ColliderIndex>& excused : {pressing, entered})
    for (const ColliderIndex collider : excused)
      if (!entered.empty() && !contains(judgement.crushed, collider) && !contains(step.crushed, collider))
        judgement.crushed.push_back(collider);
}

}  // namespace paperproof::compare
