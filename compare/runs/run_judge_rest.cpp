/// What rests, stands or creeps, and what carries it.
#include "runs/run_judge.hpp"

#include "oracle/exemptions.hpp"
#include "oracle/later_parts.hpp"
#include "oracle/turning.hpp"
#include "oracle/up.hpp"
#include "runs/run_judge_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::compare {

using namespace run_judge;
namespace {

/// Who is no faster stands still [m/s].
constexpr double standstill = 1e-6;
/// Who goes no farther in a step may creep [m].
constexpr double most_crept = 1e-3;
/// Its gap is restored once, and it settles on ground that hardly bends [m].
constexpr double most_drift = 5e-6;
/// Over uneven ground so much of its way is made by the gaps that it keeps.
constexpr double share_of_way = 0.01;

}  // namespace

/// Once position and velocity have repeated, and the same is wanted again, nothing may change any more.
void RunJudge::judge_rest(const TraceStep& record, const Follower& follower) {
  if (follower.last.size() < 2 || record.respawn) return;
  const TraceStep& before = follower.last[1];
  const TraceStep& earlier = follower.last[0];
  const auto same = [](const TraceStep& a, const TraceStep& b) {
    return a.path.back().position == b.path.back().position && a.velocity == b.velocity && a.grounded == b.grounded;
  };
  const auto is_asked_alike = [this](const TraceStep& a, const TraceStep& b) {
    return length_of(a, header_) == length_of(b, header_) && up_in(a, header_) == up_in(b, header_);
  };
  const bool repeated = same(before, earlier) && stands(earlier) && stands(before) && stands(record) &&
                        follower.steps_alone > 2 && follower.last_wanted.displacement == follower.wanted.displacement &&
                        follower.last_wanted.steered == follower.wanted.steered &&
                        before.input.drop == record.input.drop && is_asked_alike(earlier, before) &&
                        is_asked_alike(before, record);
  if (repeated && !same(record, before))
    note(Clause::rest, record,
         fmt::format("changes after position and velocity had repeated: goes {}, ends with ({:.3g}, {:.3g}) m/s, {}",
                     metres((record.path.back().position - before.path.back().position).norm()), record.velocity.x(),
                     record.velocity.y(), record.grounded ? "and stands" : "and does not stand"));
}

/// Who says that it stands still, and wants nothing but to fall, stays where it began to.
void RunJudge::judge_standing(const TraceStep& record, Follower& follower) {
  const Wanted& wanted = follower.wanted;
  const Vec2d up = up_in(record, header_);
  const double across = (wanted.displacement - wanted.displacement.dot(up) * up).norm() / length_of(record, header_);
  const bool as_before =
      follower.last.empty() || (up_in(follower.last.back(), header_) == up &&
                                gravity_in(follower.last.back(), header_) == gravity_in(record, header_));
  const bool stays = record.grounded && record.velocity.norm() <= standstill && across <= standstill &&
                     !wanted.jumped && !wanted.ridden && stands(record) && as_before && follower.steps_alone > 0 &&
                     record.start_overlap.empty() && !header_.guarantees.empty();
  const Vec2d& end = record.path.back().position;
  // What goes farther at once is asked for its velocity.
  const bool creeps = (end - record.path.front().position).norm() <= most_crept;
  if (!stays || !creeps) {
    follower.stood_at.reset();
  } else if (!follower.stood_at) {
    follower.stood_at = end;
  } else if (const double drift = (end - *follower.stood_at).norm(); drift > most_drift + 4 * ulp_at(header_, end)) {
    note(Clause::rest, record, fmt::format("has drifted by {} since it stands still", metres(drift)));
  }
}

/// Gaps are restored and seams followed once each: over many steps that leads nowhere. A hundredth of the way may be
/// made so, on uneven ground.
void RunJudge::judge_creeping(const TraceStep& record, const StepJudgement& judged, Follower& follower) {
  if (record.respawn) follower.crept.setZero();
  follower.crept += judged.crept;
  const double crept = follower.crept.norm();
  if (crept > 2 * most_drift) {
    note(Clause::velocity, record, fmt::format("has crept {} that no velocity made", metres(crept)));
    follower.crept.setZero();
  }
  const double way = (record.path.back().position - record.path.front().position).norm();
  if (crept > 0) follower.crept *= std::max(0.0, 1 - share_of_way * way / crept);
}

/// Whether it says that its ground moves, and has touched nothing that does since it said otherwise.
bool RunJudge::is_ground_velocity_invented(const TraceStep& record, const Follower& follower) const {
  const bool is_kept =
      !follower.last.empty() && !record.grounded && follower.last.back().ground_velocity == record.ground_velocity;
  if (record.ground_velocity.isZero(0) || is_kept || record.respawn || is_beside_what_turns(record)) return false;
  return std::ranges::none_of(record.path, [&](const PathPoint& at) {
    const std::vector<NearPart> parts = scenery().near_parts(Place(at, record.movers), guaranteed_gap);
    return std::ranges::any_of(parts, [this](const NearPart& part) { return moves_or_conveys(part); });
  });
}

bool RunJudge::moves_or_conveys(const NearPart& part) const {
  return !part.moved.isZero(0) || header_.scenery.colliders[part.collider].surface_speed != 0;
}

/// Whether the step goes on ground that moves or conveys, and on no other, all along, and is held there by gravity.
bool RunJudge::is_carried_unsaid(const TraceStep& record, const Follower& follower) const {
  const bool goes_on = !follower.last.empty() && !record.respawn && !record.from && follower.last.back().grounded;
  const bool plain = record.grounded && record.start_overlap.empty() && record.crushed.empty() && !record.stuck &&
                     !record.dropped && record.dropped_through.empty() && !follower.wanted.jumped &&
                     !is_beside_what_turns(record) && header_.substeps == 1;
  if (!goes_on || !plain) return false;
  const Vec2d up = up_in(record, header_);
  if (!(gravity_in(record, header_).dot(up) < 0)) return false;
  const auto stands_on_what_moves = [&](const PathPoint& at) {
    bool stands = false;
    for (const NearPart& part : scenery().near_parts(Place(at, record.movers), guaranteed_gap))
      for (const NearFace& face : part.faces) {
        if (!(face.normal.dot(up) > 0)) continue;
        if (!moves_or_conveys(part)) return false;
        stands = stands || is_walked_on(face.normal, header_, up);
      }
    return stands;
  };
  return std::ranges::all_of(record.path, stands_on_what_moves);
}

/// What it says that it rides is there, and goes as it says.
void RunJudge::judge_carrier(const SolidsInStep& there, const Follower& follower) {
  const TraceStep& record = there.step();
  if (header_.guarantees.empty()) return;
  if (is_ground_velocity_invented(record, follower))
    note(Clause::wanted, record, "says that its ground moves, and none does");
  if (!record.ride) {
    if (is_carried_unsaid(record, follower))
      note(Clause::ground_missed, record, "stands on what moves all along, and says no ride");
    return;
  }
  const ColliderIndex carrier = record.ride->collider;
  const Place end(record.path.back(), record.movers);
  const Vec2d up = up_in(record, header_);
  double off = std::numeric_limits<double>::infinity();
  for (const NearPart& part : there.at(1).near_parts(end, guaranteed_gap))
    for (const NearFace& face : part.faces) {
      if (part.collider != carrier || !(face.normal.dot(up) > 0)) continue;
      const Vec2d foot =
          *std::ranges::min_element(header_.points, {}, [&](const Vec2d& point) { return point.dot(face.normal); });
      for (const SolidsInStep::Carrying& by :
           there.carrying(carrier, end.position + foot, detail::extent_of(header_.points))) {
        const Vec2d velocity = by.velocity + conveyed(header_.scenery.colliders[carrier], face.normal);
        const Vec2d other = seen(record.ride->velocity - velocity, face.normal);
        off = std::min(off, std::max(std::abs(other.x()) - by.along, std::abs(other.y()) - by.across) -
                                (same_speed + detail::waited_in_part) * (1 + velocity.norm()));
      }
    }
  if (off == std::numeric_limits<double>::infinity())
    note(Clause::ground_invented, record, "says it rides `" + header_.ids[carrier] + "`, which is not there");
  else if (off > 0)
    note(Clause::velocity, record,
         fmt::format("says it rides `{}` at a velocity that is {:.3g} m/s off", header_.ids[carrier], off));
}

/// A rider that goes nowhere on its mover keeps its place there.
void RunJudge::judge_ride(const TraceStep& record, const Follower& follower) {
  if (follower.last.empty() || record.respawn || !record.ride || !record.vertex_ways.empty()) return;
  const std::optional<TraceRide>& before = follower.last.back().ride;
  const ColliderDef& ground = header_.scenery.colliders[record.ride->collider];
  if (!before || before->collider != record.ride->collider || ground.mover == no_mover || ground.surface_speed != 0)
    return;
  const MoverMotion& motion = record.movers[ground.mover];
  const Vec2d up = up_in(record, header_);
  const Vec2d own = follower.wanted.displacement - (motion.to - motion.from);
  const bool stays = std::abs(own.dot(right_of(up))) == 0 && own.dot(up) <= 0 &&
                     std::ranges::all_of(record.contacts, [&](const Contact& contact) {
                       return contact.collider == record.ride->collider;
                     });
  if (!stays || follower.last.size() < 2) return;
  const std::optional<TraceRide>& earlier = follower.last[0].ride;
  if (!earlier || earlier->collider != before->collider) return;
  const Vec2d drift = (record.path.back().position - motion.to) - (record.path.front().position - motion.from);
  const double ulps = ulp_at(header_, record.path.back().position) + ulp_at(header_, record.path.front().position) +
                      ulp_at(header_, motion.to) + ulp_at(header_, motion.from);
  if (drift.cwiseAbs().maxCoeff() > ulps && drift.norm() < guaranteed_gap)
    note(Clause::rest, record, fmt::format("drifts {} on what carries it", metres(drift.norm())));
}

}  // namespace paperproof::compare
