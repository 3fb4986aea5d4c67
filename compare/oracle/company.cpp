#include "oracle/company.hpp"

#include "contains.hpp"
#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/hanging.hpp"
#include "oracle/passing.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace paperproof::compare {
namespace {

/// What a normal that was computed otherwise is off.
constexpr double rounding_of_normal = 1e-6;
/// With more contacts with scenery there are too many ways that they may have left.
constexpr std::size_t most_contacts = 4;
constexpr std::size_t most_ways = 100;
/// What a time is off along the normal is not told below this [m].
constexpr double told = 1e-6;

Box2 box_of(const std::vector<Vec2d>& points) {
  Box2 box{points.front(), points.front()};
  for (const Vec2d& point : points) box = box.merged({point, point});
  return box;
}

/// All positions of the way, and of what was requested instead.
Box2 reach_of(const TraceStep& step) {
  const Vec2d start = step.path.front().position;
  const Vec2d wanted = start + step.requested;
  Box2 box = Box2{start, start}.merged({wanted, wanted});
  for (const PathPoint& corner : step.path) box = box.merged({corner.position, corner.position});
  return box;
}

/// Rounded; where a jump leads from one place to another the first one.
Vec2d place_at(const std::vector<PathPoint>& path, double fraction) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (fraction > path[i + 1].fraction) continue;
    const double span = path[i + 1].fraction - path[i].fraction;
    if (!(span > 0)) return path[i].position;
    return path[i].position + (fraction - path[i].fraction) / span * (path[i + 1].position - path[i].position);
  }
  return path.back().position;
}

/// What counts as touching [m]. What the header says of itself excuses nothing where something is promised.
double touch_of(const TraceHeader& header) {
  if (!header.path_exact) return box2d_skin;
  if (party_of(header) == Party::promising) return detail::contact_reach;
  return std::max(detail::contact_reach, tolerance_named(header, "touch"));
}

/// How far it goes in the time of a whole step, as it does from one fraction of it to another [m].
Vec2d rate_between(const PathPoint& from, const PathPoint& to) {
  return (to.position - from.position) / (to.fraction - from.fraction);
}

/// As it goes on from a fraction of the step,
Vec2d rate_after(const std::vector<PathPoint>& path, double fraction) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    if (path[i].fraction <= fraction && fraction < path[i + 1].fraction) return rate_between(path[i], path[i + 1]);
  return Vec2d::Zero();
}

/// and as it comes to it.
Vec2d rate_before(const std::vector<PathPoint>& path, double fraction) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    if (path[i].fraction < fraction && fraction <= path[i + 1].fraction) return rate_between(path[i], path[i + 1]);
  return Vec2d::Zero();
}

const Vec2d& start_of(const TraceStep& step) { return step.path.front().position; }
const Vec2d& end_of(const TraceStep& step) { return step.path.back().position; }

/// The way of another in the turn of the one, in which it stands; where they take no turns its own.
std::vector<PathPoint> way_in_turn(const TraceStep& other, const TraceStep& one) {
  if (!one.turn) return other.path;
  const Vec2d& at = other.turn < one.turn ? end_of(other) : start_of(other);
  return {{at, 0}, {at, 1}};
}

}  // namespace

CompanyJudge::CompanyJudge(const TraceHeader& header)
    : header_(header),
      pair_(header.points),
      box_(box_of(header.points)),
      slop_(detail::slop_of(header)),
      reach_(touch_of(header)) {}

std::vector<CharacterIndex> CompanyJudge::overlapped(std::span<const Vec2d> positions, CharacterIndex character) const {
  std::vector<CharacterIndex> found;
  for (CharacterIndex other = 0; other < positions.size(); ++other)
    if (other != character && pair_.overlap(positions[character], positions[other])) found.push_back(other);
  return found;
}

std::vector<TraceStep> CompanyJudge::acting_on(CharacterIndex character, std::span<const TraceStep> steps) const {
  const TraceStep& one = steps[character];
  if (!one.turn) return {};
  const auto goes_evenly = [&](const TraceStep& other) {
    const Vec2d& from = start_of(other);
    const Vec2d& to = end_of(other);
    const std::vector<NearFace> faces = pair_.near_faces(start_of(one), from, detail::contact_reach);
    const bool stands_on_it = std::any_of(faces.begin(), faces.end(), [&](const NearFace& face) {
      return face.separation >= 0 && detail::is_walkable(face.normal, header_, up_in(one, header_));
    });
    if (stands_on_it) return true;
    if (other.turn > one.turn) return pair_.meet_between(start_of(one), from, start_of(one), to);
    const double rounding = ulp_at(header_, from) + ulp_at(header_, to);
    return !pair_.meet_between(start_of(one), from, start_of(one), to) &&
           pair_.separation(start_of(one), to) >= pair_.separation(start_of(one), from) - rounding;
  };
  std::vector<TraceStep> acting(steps.begin(), steps.end());
  for (TraceStep& acts : acting) {
    const TraceStep& other = steps[acts.character];
    if (acts.character == character) continue;
    acts.path =
        goes_evenly(other) ? std::vector<PathPoint>{{start_of(other), 0}, {end_of(other), 1}} : way_in_turn(other, one);
    acts.requested = end_of(acts) - start_of(acts);
    acts.steered = 0;
    acts.contacts.clear();
    acts.met.clear();
  }
  return acting;
}

/// What of the others is near one of them at a corner of its way.
std::vector<NearPart> CompanyJudge::near_of(CharacterIndex character, std::span<const TraceStep> steps,
                                            const PathPoint& corner, double within) const {
  std::vector<NearPart> parts;
  for (const TraceStep& other : steps) {
    if (other.character == character) continue;
    NearPart part{.collider = no_collider,
                  .moved = end_of(other) - start_of(other),
                  .faces = pair_.near_faces(corner.position, place_at(other.path, corner.fraction), within)};
    if (part.faces.empty()) continue;
    part.comes = corner.fraction > 0 ? rate_before(other.path, corner.fraction) : other.requested;
    part.goes = rate_after(other.path, corner.fraction);
    parts.push_back(std::move(part));
  }
  return parts;
}

Others CompanyJudge::others_of(CharacterIndex character, std::span<const TraceStep> all,
                               std::span<const TraceStep> acting) const {
  const std::span<const TraceStep> steps = acting.empty() ? all : acting;
  const TraceStep& one = steps[character];
  const auto any_other = [character](std::span<const TraceStep> of, const auto& is) {
    return std::any_of(of.begin(), of.end(),
                       [&](const TraceStep& other) { return other.character != character && is(other); });
  };
  Others others;
  for (const TraceStep& other : all)
    if (other.character != character)
      others.longest_way =
          std::max({others.longest_way, other.requested.norm(), (end_of(other) - start_of(other)).norm()});
  others.touched = any_other(steps, [&](const TraceStep& other) { return may_meet(one, other) && touch(one, other); });
  others.left_free = [this, all, character, any_other](Way way) {
    return !any_other(all, [&](const TraceStep& other) {
      const std::vector<PathPoint> theirs = way_in_turn(other, all[character]);
      return !(pair_.separation(way.back().position, theirs.back().position) >= detail::least_clearance) ||
             pair_.meet(way, theirs);
    });
  };
  others.near = [this, steps, character](const PathPoint& corner, double within) {
    return near_of(character, steps, corner, within);
  };
  if (one.turn)
    others.near_at_end = [this, all, character](double within) {
      return near_of(character, all, all[character].path.back(), within);
    };
  others.handed_on = [this, all, character] { return handed_on(character, all); };
  others.add_moments = [steps, character](std::vector<PathPoint>& path) {
    for (const TraceStep& other : steps) {
      if (other.character == character) continue;
      for (const PathPoint& corner : other.path) {
        const auto next = std::lower_bound(path.begin(), path.end(), corner.fraction,
                                           [](const auto& own, double fraction) { return own.fraction < fraction; });
        if (next == path.end() || next->fraction == corner.fraction) continue;
        path.insert(next, {place_at(path, corner.fraction), corner.fraction});
      }
    }
  };
  others.impacts_at_end = [this, all, character](const Vec2d& displacement) {
    const Vec2d from = end_of(all[character]);
    std::vector<ExactImpact> impacts;
    for (const TraceStep& other : all) {
      if (other.character == character) continue;
      if (const auto impact = pair_.first_impact(from, displacement, end_of(other), Vec2d::Zero()))
        impacts.push_back({.collider = no_collider, .fraction = impact->fraction, .normal = impact->normal});
    }
    return impacts;
  };
  return others;
}

double CompanyJudge::handed_on(CharacterIndex character, std::span<const TraceStep> steps) const {
  // One after the other they need not touch at one moment.
  const auto are_linked = [this](const TraceStep& one, const TraceStep& other) {
    return may_meet(one, other) && (one.turn || touch(one, other));
  };
  std::vector<CharacterIndex> linked{character};
  for (std::size_t i = 0; i < linked.size(); ++i)
    for (const TraceStep& other : steps)
      if (!contains(linked, other.character) && are_linked(steps[linked[i]], other)) linked.push_back(other.character);
  // On the steepest ground that is walked on.
  const double steepest = 1 / std::cos(header_.character.max_climb_degrees * std::numbers::pi / 180);
  std::map<MoverIndex, double> movers;
  double most = 0;
  for (const CharacterIndex member : linked) {
    const TraceStep& step = steps[member];
    const Vec2d up = up_in(step, header_);
    const Vec2d unsteered = step.requested - step.steered * right_of(up);
    if (member != character) most += std::max(step.requested.norm(), unsteered.norm()) * steepest;
    const Box2 places = reach_of(step);
    const Box2 covered{places.lower + box_.lower, places.upper + box_.upper};
    for (const ColliderDef& def : header_.scenery.colliders) {
      if (def.mover == no_mover) continue;
      const Vec2d& from = step.movers[def.mover].from;
      const Vec2d& to = step.movers[def.mover].to;
      Box2 swept = box_of(def.points);
      swept = Box2{swept.lower + from.cwiseMin(to), swept.upper + from.cwiseMax(to)};
      if (swept.inflated(def.radius + (to - from).norm() + reach_).overlaps(covered))
        movers[def.mover] = (to - from).norm();
    }
  }
  for (const auto& [mover, way] : movers) most += way;
  return most;
}

template <class Visit>
bool CompanyJudge::any_moment(const TraceStep& one, const TraceStep& other, const Visit& visit) {
  for (const PathPoint& corner : one.path)
    if (visit(corner.position, place_at(other.path, corner.fraction), corner.fraction)) return true;
  for (const PathPoint& corner : other.path)
    if (visit(place_at(one.path, corner.fraction), corner.position, corner.fraction)) return true;
  return false;
}

double CompanyJudge::nearest(const TraceStep& one, const TraceStep& other) const {
  double gap = std::numeric_limits<double>::infinity();
  any_moment(one, other, [&](const Vec2d& mine, const Vec2d& theirs, double) {
    gap = std::min(gap, pair_.separation(mine, theirs));
    return false;
  });
  return gap;
}

bool CompanyJudge::has_face(const TraceStep& one, const TraceStep& other, const Vec2d& normal) const {
  return any_moment(one, other, [&](const Vec2d& mine, const Vec2d& theirs, double) {
    const std::vector<NearFace> faces = pair_.near_faces(mine, theirs, 2 * reach_);
    return std::any_of(faces.begin(), faces.end(),
                       [&](const NearFace& face) { return (face.normal - normal).norm() <= rounding_of_normal; });
  });
}

/// What was requested of a character, and all that its contacts with scenery may have left of it.
std::vector<Vec2d> CompanyJudge::ways_of(const TraceStep& step) const {
  std::vector<Vec2d> ways{step.requested};
  for (const Contact& contact : step.contacts) {
    const MoverIndex mover = header_.scenery.colliders[contact.collider].mover;
    const Vec2d own = mover == no_mover ? Vec2d::Zero() : Vec2d(step.movers[mover].to - step.movers[mover].from);
    for (std::size_t i = 0, before = ways.size(); i < before; ++i)
      for (const Vec2d& left :
           detail::ways_left(ways[i], own, step.steered, contact.normal, header_, up_in(step, header_)))
        ways.push_back(left);
  }
  return ways;
}

bool CompanyJudge::must_meet(const TraceStep& one, const TraceStep& other) const {
  const auto goes_freely = [](const TraceStep& step, CharacterIndex whom) {
    return !step.stuck && !step.dropped && step.crushed.empty() && step.start_overlap.empty() &&
           step.start_overlap_characters.empty() && step.contacts.size() <= most_contacts &&
           std::all_of(step.met.begin(), step.met.end(), [&](const auto& met) { return met.other == whom; });
  };
  if (!header_.path_exact || !may_meet(one, other)) return false;
  if (!goes_freely(one, other.character) || !goes_freely(other, one.character)) return false;
  const std::vector<Vec2d> ways = ways_of(one);
  return any_moment(one, other, [&](const Vec2d& mine, const Vec2d& theirs, double fraction) {
    if (!(fraction < 1) || !(pair_.separation(mine, theirs) <= detail::contact_reach)) return false;
    const Vec2d goes = rate_after(other.path, fraction);
    return std::all_of(ways.begin(), ways.end(), [&](const Vec2d& way) {
      const auto impact = pair_.first_impact(mine, way, theirs, goes);
      if (!impact) return false;
      if (one.turn && -way.dot(impact->normal) <= detail::least_approach * way.norm()) return false;
      const double approach = -(way - goes).dot(impact->normal);
      const double until = static_cast<double>(impact->fraction) * approach;
      return approach >= detail::least_approach * (way - goes).norm() && until <= detail::contact_reach &&
             until + detail::least_clearance <= (1 - fraction) * approach;
    });
  });
}

std::vector<Vec2d> CompanyJudge::ways_at(const TraceStep& one, std::span<const TraceStep> steps,
                                         double fraction) const {
  std::vector<Vec2d> ways = one.contacts.size() <= most_contacts ? ways_of(one) : std::vector<Vec2d>{one.requested};
  const Vec2d mine = place_at(one.path, fraction);
  for (const TraceStep& other : steps) {
    if (other.character == one.character || ways.size() > most_ways) continue;
    const std::vector<NearFace> faces = pair_.near_faces(mine, place_at(other.path, fraction), reach_);
    if (faces.empty()) continue;
    for (std::size_t i = 0, before = ways.size(); i < before; ++i)
      for (const Vec2d& left : detail::ways_left(ways[i], rate_after(other.path, fraction), one.steered,
                                                 faces.front().normal, header_, up_in(one, header_)))
        ways.push_back(left);
  }
  return ways;
}

double CompanyJudge::off_at(const TraceStep& one, const TraceStep& other, const CrowdContact& met,
                            std::span<const TraceStep> steps) const {
  double off = std::max(0.0, pair_.separation(place_at(one.path, met.fraction), place_at(other.path, met.fraction)));
  any_moment(one, other, [&](const Vec2d& mine, const Vec2d& theirs, double fraction) {
    if (off <= told) return true;
    if (pair_.separation(mine, theirs) > reach_) return false;
    const auto look = [&](const Vec2d& pace) {
      if (const double approach = -pace.dot(met.normal); approach > detail::least_approach * pace.norm())
        off = std::min(off, std::abs(met.fraction - fraction) * approach);
    };
    look(rate_before(one.path, fraction) - rate_before(other.path, fraction));
    std::vector<Vec2d> mine_goes = ways_at(one, steps, fraction);
    std::vector<Vec2d> theirs_goes = ways_at(other, steps, fraction);
    mine_goes.push_back(rate_after(one.path, fraction));
    theirs_goes.push_back(rate_after(other.path, fraction));
    for (const Vec2d& my_way : mine_goes)
      for (const Vec2d& their_way : theirs_goes) look(my_way - their_way);
    if (fraction == met.fraction) off = 0;
    return off <= told;
  });
  return off;
}

bool CompanyJudge::turns_aside(const TraceStep& one, const TraceStep& other, const ExactContact& exact) const {
  const MoverIndex mover = header_.scenery.colliders[exact.collider].mover;
  const Vec2d its = mover == no_mover ? Vec2d::Zero() : Vec2d(one.movers[mover].to - one.movers[mover].from);
  return any_moment(one, other, [&](const Vec2d& mine, const Vec2d& theirs, double fraction) {
    if (!(fraction <= exact.touched) || pair_.separation(mine, theirs) > reach_) return false;
    const Vec2d goes = rate_after(other.path, fraction);
    const auto impact = pair_.first_impact(mine, one.requested, theirs, goes);
    if (!impact || !(fraction + static_cast<double>(impact->fraction) <= exact.touched)) return false;
    if (exact.foreseen) return true;
    const std::vector<Vec2d> ways =
        detail::ways_left(one.requested, goes, one.steered, impact->normal, header_, up_in(one, header_));
    return std::any_of(ways.begin(), ways.end(),
                       [&](const Vec2d& way) { return !((way - its).dot(exact.normal) < 0); });
  });
}

bool CompanyJudge::touch(const TraceStep& one, const TraceStep& other) const { return nearest(one, other) <= reach_; }

bool CompanyJudge::continues(const TraceStep& step) const {
  return !step.respawn && !last_ends_.empty() && last_ends_[step.character] == start_of(step);
}

bool CompanyJudge::may_meet(const TraceStep& one, const TraceStep& other) const {
  const auto covered = [this](const TraceStep& step) {
    const Box2 places = reach_of(step);
    const double size = std::max(places.lower.cwiseAbs().maxCoeff(), places.upper.cwiseAbs().maxCoeff());
    return Box2{places.lower + box_.lower, places.upper + box_.upper}.inflated(box2d_skin + size * 0x1p-48);
  };
  return covered(one).overlaps(covered(other));
}

void CompanyJudge::judge(std::span<const TraceStep> steps, std::span<StepJudgement> judgements) {
  for (const TraceStep& step : steps)
    if (step.path.empty()) return;
  for (std::size_t i = 0; i < steps.size(); ++i)
    for (std::size_t j = i + 1; j < steps.size(); ++j) judge_pair(steps[i], steps[j], judgements[i]);
  if (!steps.front().turn) judge_first_impacts(steps, judgements);
  for (std::size_t i = 0; i < steps.size() && !steps.front().turn; ++i) {
    const std::vector<TraceStep> acting = acting_on(steps[i].character, steps);
    for (const TraceStep& other : acting) judge_first_impact(steps[i], other, judgements[i]);
    for (const TraceStep& other : acting.empty() ? steps : std::span(acting))
      if (other.character != steps[i].character && may_meet(steps[i], other)) excuse(steps[i], other, judgements[i]);
  }
  last_ends_.clear();
  for (const TraceStep& step : steps) last_ends_.push_back(end_of(step));
}

void CompanyJudge::judge_pair(const TraceStep& one, const TraceStep& other, StepJudgement& judgement) {
  const std::pair key(one.character, other.character);
  if (!continues(one) || !continues(other)) {
    inside_.erase(key);
    if (pair_.overlap(start_of(one), start_of(other))) inside_[key] = std::nullopt;
  }
  if (!inside_.contains(key) && !may_meet(one, other)) return;
  if (!pair_.overlap(end_of(one), end_of(other))) return judge_apart(one, other, judgement);
  const bool is_new = inside_.try_emplace(key, std::pair(start_of(one), start_of(other))).second;
  const double depth = -pair_.separation(end_of(one), end_of(other));
  if (is_new && party_of(header_) != Party::promising && depth <= ulp_at(header_, end_of(one))) {
    inside_.erase(key);
    judgement.company.rounded.push_back(other.character);
    return;
  }
  judgement.max_penetration = std::max(judgement.max_penetration, depth);
  judgement.company.overlap.push_back(other.character);
  if (is_new) judgement.company.entered.push_back(other.character);
}

/// The two are apart where the step ends.
void CompanyJudge::judge_apart(const TraceStep& one, const TraceStep& other, StepJudgement& judgement) {
  const auto stay = inside_.find({one.character, other.character});
  const bool was_apart = stay == inside_.end();
  if (was_apart && header_.path_exact) {
    judge_ways(one.path, way_in_turn(other, one), other.character, judgement);
    if (one.turn && !contains(judgement.company.passed, other.character))
      judge_ways(way_in_turn(one, other), other.path, other.character, judgement);
    return;
  }
  const FreeFrom from = was_apart ? FreeFrom(std::pair(start_of(one), start_of(other))) : stay->second;
  if (!was_apart) inside_.erase(stay);
  if (!from) return;
  const std::array<PathPoint, 2> of_one{{{from->first, 0}, {end_of(one), 1}}};
  const std::array<PathPoint, 2> of_other{{{from->second, 0}, {end_of(other), 1}}};
  judge_ways(of_one, of_other, other.character, judgement);
}

/// Written so that a depth that is no number is a passing.
void CompanyJudge::judge_ways(Way one, Way other, CharacterIndex whom, StepJudgement& judgement) const {
  if (!pair_.meet(one, other)) return;
  StepJudgement::Company& company = judgement.company;
  (slop_ > 0 && pair_.deepest(one, other) <= slop_ ? company.corner_cut : company.passed).push_back(whom);
}

std::optional<CompanyJudge::Impact> CompanyJudge::first_impact(const TraceStep& one, const TraceStep& other) const {
  const auto impact = pair_.first_impact(start_of(one), one.requested, start_of(other), other.requested);
  if (!impact) return std::nullopt;
  const Vec2d way = one.requested - other.requested;
  const double approach = -way.dot(impact->normal);
  const bool comparable = !one.stuck && !other.stuck && pair_.separation(start_of(one), start_of(other)) > reach_ &&
                          approach >= detail::least_approach * way.norm();
  return Impact{one.character, other.character, static_cast<double>(impact->fraction), comparable};
}

/// A character that has met anything no longer goes as requested, and may turn aside those that are near.
void CompanyJudge::judge_first_impacts(std::span<const TraceStep> steps, std::span<StepJudgement> judgements) const {
  std::vector<Impact> impacts;
  std::vector<double> earliest;
  for (const StepJudgement& judgement : judgements)
    earliest.push_back(judgement.first_impact.value_or(std::numeric_limits<double>::infinity()));
  for (std::size_t i = 0; i < steps.size(); ++i)
    for (std::size_t j = i + 1; j < steps.size(); ++j) {
      if (!may_meet(steps[i], steps[j])) continue;
      const std::optional<Impact> impact = first_impact(steps[i], steps[j]);
      if (!impact) continue;
      impacts.push_back(*impact);
      for (const std::size_t who : {i, j}) earliest[who] = std::min(earliest[who], impact->fraction);
    }
  for (const Impact& impact : impacts) {
    const auto turned_by_a_third = [&] {
      for (std::size_t k = 0; k < steps.size(); ++k) {
        if (k == impact.one || k == impact.other || earliest[k] >= impact.fraction) continue;
        if (may_meet(steps[k], steps[impact.one]) || may_meet(steps[k], steps[impact.other])) return true;
      }
      return false;
    };
    const bool both_first = earliest[impact.one] == impact.fraction && earliest[impact.other] == impact.fraction;
    for (const auto& [who, whom] : {std::pair(impact.one, impact.other), {impact.other, impact.one}}) {
      if (earliest[who] != impact.fraction) continue;
      judgements[who].first_impact = impact.fraction;
      judgements[who].first_met = whom;
      judgements[who].first_impact_comparable = impact.comparable && both_first && !turned_by_a_third();
    }
  }
}

/// In the turn of the one: another goes as it acts then, whatever meets it.
void CompanyJudge::judge_first_impact(const TraceStep& one, const TraceStep& other, StepJudgement& judgement) const {
  if (other.character == one.character || !may_meet(one, other)) return;
  const std::optional<Impact> impact = first_impact(one, other);
  if (!impact || impact->fraction > judgement.first_impact.value_or(1)) return;
  judgement.first_impact = impact->fraction;
  judgement.first_met = other.character;
  judgement.first_impact_comparable = impact->comparable;
}

void CompanyJudge::excuse(const TraceStep& one, const TraceStep& other, StepJudgement& judgement) const {
  const bool near = touch(one, other);
  bool opposed = false;
  const Vec2d up = up_in(one, header_);
  const double across = seen(one.requested, up).x();
  const Vec2d wanted = in_world({across + std::copysign(reach_, across), 0}, up);
  // The other comes from ahead, or from above on a shoulder.
  const auto is_pushed = [&](const Vec2d& mine, const Vec2d& theirs) {
    const auto impact = pair_.first_impact(mine, wanted, theirs, other.requested);
    return impact && impact->normal.dot(wanted) < 0;
  };
  const auto look = [&](const Vec2d& mine, const Vec2d& theirs) {
    if (judgement.ghost_speed_loss == 0 && judgement.motion_lost == 0) return;
    opposed = opposed || pair_.meet_between(mine, theirs, mine + wanted, theirs) || is_pushed(mine, theirs);
  };
  for (const PathPoint& corner : one.path) look(corner.position, place_at(other.path, corner.fraction));
  for (const PathPoint& corner : other.path) look(place_at(one.path, corner.fraction), corner.position);
  const bool may_be_pushed = near && !header_.path_exact;
  if (opposed || may_be_pushed) judgement.ghost_speed_loss = judgement.motion_lost = 0;
  if (!near) return;
  const bool excused = allowed(Exempt::company, header_) > 0;
  for (const Contact& contact : one.contacts) {
    const std::pair touch(contact.collider, contact.side);
    const bool exact = std::any_of(judgement.contacts.begin(), judgement.contacts.end(), [&](const ExactContact& each) {
      return each.collider == contact.collider && each.side == contact.side;
    });
    if (exact) continue;
    judgement.dont_care.push_back(contact.collider);
    if (excused) judgement.excused_by_company.push_back(contact.collider);
    const bool faced = std::find(judgement.faced.begin(), judgement.faced.end(), touch) != judgement.faced.end();
    if (!excused && faced) judgement.deflected.push_back(touch);
  }
  // What another turned aside before is not met by what was requested.
  std::erase_if(judgement.contacts, [&](const ExactContact& exact) {
    const auto is_it = [&exact](const Contact& contact) {
      return contact.collider == exact.collider && contact.side == exact.side;
    };
    return std::none_of(one.contacts.begin(), one.contacts.end(), is_it) && (excused || turns_aside(one, other, exact));
  });
  judgement.ghosts.clear();
  if (!judgement.first_met) judgement.first_impact_comparable = false;
}

}  // namespace paperproof::compare
