#include "oracle/company.hpp"

#include "contains.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/passing.hpp"

#include <algorithm>
#include <array>

namespace paperproof::compare {
namespace {

/// All positions of the way, and of what was requested instead.
Box2 reach_of(const TraceStep& step) {
  std::vector<Vec2d> places{step.path.front().position + step.requested};
  for (const PathPoint& corner : step.path) places.push_back(corner.position);
  return Box2::around(places);
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

Vec2d place_at(std::span<const PathPoint> way, double fraction) {
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    if (fraction > way[i + 1].fraction) continue;
    const double span = way[i + 1].fraction - way[i].fraction;
    if (!(span > 0)) return way[i].position;
    const double share = std::max(0.0, fraction - way[i].fraction) / span;
    return way[i].position + share * (way[i + 1].position - way[i].position);
  }
  return way.back().position;
}

CompanyJudge::CompanyJudge(const TraceHeader& header)
    : header_(header), pair_(header.points), box_(Box2::around(header.points)), rim_(detail::rim_of(header)) {}

std::vector<CharacterIndex> CompanyJudge::overlapped(std::span<const Vec2d> positions, CharacterIndex character) const {
  std::vector<CharacterIndex> found;
  for (CharacterIndex other = 0; other < positions.size(); ++other)
    if (other != character && pair_.overlap(positions[character], positions[other])) found.push_back(other);
  return found;
}

bool CompanyJudge::is_beside_another(const TraceStep& one, std::span<const TraceStep> steps) const {
  const auto is_near = [&](const Vec2d& mine, const Vec2d& theirs) {
    return pair_.separation(mine, theirs) <= own_reach(header_) ||
           pair_.meet_between(mine, theirs, mine + one.requested, theirs);
  };
  const auto comes_near = [&](const TraceStep& other) {
    return std::ranges::any_of(
               one.path,
               [&](const PathPoint& at) { return is_near(at.position, place_at(other.path, at.fraction)); }) ||
           std::ranges::any_of(
               other.path, [&](const PathPoint& at) { return is_near(place_at(one.path, at.fraction), at.position); });
  };
  return !one.turn && std::ranges::any_of(steps, [&](const TraceStep& other) {
    return other.character != one.character && may_meet(one, other) && comes_near(other);
  });
}

bool CompanyJudge::continues(const TraceStep& step) const {
  return !step.respawn && !last_ends_.empty() && last_ends_[step.character] == start_of(step);
}

bool CompanyJudge::may_meet(const TraceStep& one, const TraceStep& other) const {
  const auto covered = [this](const TraceStep& step) {
    const Box2 places = reach_of(step);
    const double size = std::max(places.lower.cwiseAbs().maxCoeff(), places.upper.cwiseAbs().maxCoeff());
    return (places + box_).inflated(box2d_skin + size * 0x1p-48);
  };
  return covered(one).overlaps(covered(other));
}

void CompanyJudge::judge(std::span<const TraceStep> steps, std::span<StepJudgement> judgements) {
  for (const TraceStep& step : steps)
    if (step.path.empty()) return;
  for (std::size_t i = 0; i < steps.size(); ++i)
    for (std::size_t j = i + 1; j < steps.size(); ++j) judge_pair(steps[i], steps[j], judgements[i]);
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
  if (rim_ > 0) {
    const double deepest = pair_.deepest(one, other);
    if (deepest <= rim_) return judgement.note_clipped(company.clipped, whom, deepest);
  }
  company.passed.push_back(whom);
}

}  // namespace paperproof::compare
