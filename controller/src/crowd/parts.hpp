/// What the step of a crowd does with reports and ways.
#pragma once

#include "crowd/timetable.hpp"

#include <paperproof/crowd.hpp>
#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace paperproof::crowd {

template <class Scalar>
[[nodiscard]] Scalar dot(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  return a.x() * b.x() + a.y() * b.y();
}

/// One contact per collider and normal, the earliest, as a technique reports them.
template <class Scalar>
void add_contact(MoveResult<Scalar>& move, const Contact<Scalar>& contact) noexcept {
  const bool known = std::any_of(move.contacts.begin(), move.contacts.end(), [&](const Contact<Scalar>& other) {
    return other.collider == contact.collider && other.normal == contact.normal;
  });
  if (!known) move.contacts.push_back(contact);
}

template <class Scalar>
void add_corner(MoveResult<Scalar>& move, const PathPoint<Scalar>& corner) noexcept {
  const bool known = !move.path.empty() && move.path.back().position == corner.position &&
                     move.path.back().fraction == corner.fraction;
  if (!known) move.path.push_back(corner);
}

template <class Scalar>
void clear(StepReport<Scalar>& report) noexcept {
  report.status = StepStatus::moved;
  report.move.clear();
  report.sensors.clear();
  report.dropped_through.clear();
}

template <class Scalar>
void clear(CrowdMember<Scalar>& member) noexcept {
  clear(member.step);
  member.met.clear();
  member.started_overlapping.clear();
  member.stayed = false;
}

/// @param normal from the other towards this one.
template <class Scalar>
void note_meeting(CrowdMember<Scalar>& member, std::size_t other, const Vec2<Scalar>& normal,
                  Scalar fraction) noexcept {
  const CrowdContact<Scalar> contact{static_cast<CharacterIndex>(other), normal, fraction,
                                     side_of_normal(normal.x(), normal.y())};
  const bool known = std::any_of(member.met.begin(), member.met.end(), [&](const CrowdContact<Scalar>& earlier) {
    return earlier.other == contact.other && earlier.side == contact.side;
  });
  if (!known) member.met.push_back(contact);
}

/// Impacts are not found in the order of their times.
template <class Scalar>
void sort_by_time(FixedVector<CrowdContact<Scalar>, 16>& met) noexcept {
  std::sort(met.begin(), met.end(), [](const CrowdContact<Scalar>& a, const CrowdContact<Scalar>& b) {
    return std::tie(a.fraction, a.other, a.side) < std::tie(b.fraction, b.other, b.side);
  });
}

/// An impact is handled: both report it.
template <class Scalar>
void note_impact(const NextMeeting<Scalar>& next, CrowdReport<Scalar>& report) noexcept {
  const Meeting<Scalar>& meeting = next.meeting;
  ++report.impacts;
  note_meeting(report.members[next.first], next.second, meeting.normal, meeting.impact);
  note_meeting(report.members[next.second], next.first, Vec2<Scalar>(-meeting.normal), meeting.impact);
}

/// Those that overlap by more than rounding.
template <class Scalar>
void note_overlaps(const PairSpace<Scalar>& space, std::span<const CharacterState<Scalar>> states,
                   CrowdReport<Scalar>& report) noexcept {
  const Vec2<Scalar> extent = space.box().upper - space.box().lower;
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (std::size_t j = i + 1; j < states.size(); ++j) {
      const Vec2<Scalar> between = states[j].position - states[i].position;
      if (std::abs(between.x()) > extent.x() || std::abs(between.y()) > extent.y()) continue;
      const Scalar apart = space.separation(states[i].position, states[j].position);
      if (apart >= -Tolerances<Scalar>{}.certain) continue;
      report.members[i].started_overlapping.push_back(static_cast<CharacterIndex>(j));
      report.members[j].started_overlapping.push_back(static_cast<CharacterIndex>(i));
    }
  }
}

/// Bound of the rounding of a component of these rates along a normal.
template <class Scalar>
[[nodiscard]] Scalar noise_of(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  const Scalar largest = std::max({std::abs(a.x()), std::abs(a.y()), std::abs(b.x()), std::abs(b.y())});
  return std::numeric_limits<Scalar>::epsilon() * 64 * largest;
}

/// Around the shape on a whole way, and a little more.
template <class Scalar, class Path>
[[nodiscard]] Box2<Scalar> box_along(const PairSpace<Scalar>& space, const Path& path) noexcept {
  Box2<Scalar> box{path[0].position, path[0].position};
  for (const PathPoint<Scalar>& corner : path) box = box.merged({corner.position, corner.position});
  return Box2<Scalar>{box.lower + space.box().lower, box.upper + space.box().upper}.inflated(
      Tolerances<Scalar>{}.touch);
}

/// Who of two that meet goes into the other, faster than that one gives way.
struct MovesIn {
  bool first = false;
  bool second = false;
};

/// @param rates of the two, in metres per step, against which they are judged: their own, or without what carries both.
template <class Scalar>
[[nodiscard]] MovesIn who_moves_in(const Vec2<Scalar>& first_rate, const Vec2<Scalar>& second_rate,
                                   const Vec2<Scalar>& normal) noexcept {
  const Scalar first_toward = -dot(first_rate, normal);
  const Scalar second_toward = dot(second_rate, normal);
  // Who goes along the other has a rate towards it that is nothing but rounding: it must not be halted for that.
  const Scalar noise = noise_of(first_rate, second_rate);
  MovesIn moves;
  moves.first = first_toward > std::max(Scalar(0), -second_toward) + noise;
  moves.second = second_toward > std::max(Scalar(0), -first_toward) + noise;
  // Where rounding hides who comes nearer both stop.
  if (!moves.first && !moves.second) moves = {true, true};
  return moves;
}

/// A velocity that does not go into another character. On its steep sides and its walls the horizontal part ends first:
/// whoever walks into another in the air falls on beside it.
/// @param normal from the other towards this one. @param limit how fast the other gives way along it [m/s].
template <class Scalar>
[[nodiscard]] Vec2<Scalar> slowed(Vec2<Scalar> velocity, const Vec2<Scalar>& normal, Scalar limit,
                                  Scalar walkable_cosine) noexcept {
  Scalar excess = -dot(velocity, normal) - limit;
  if (!(excess > 0)) return velocity;
  const bool steep = normal.y() >= 0 && normal.y() < walkable_cosine;
  if (steep && velocity.x() * normal.x() < 0) {
    const Scalar taken = std::min(excess / std::abs(normal.x()), std::abs(velocity.x()));
    velocity.x() += std::copysign(taken, normal.x());
    excess -= taken * std::abs(normal.x());
  }
  return velocity + normal * std::max(excess, Scalar(0));
}

/// Where a move ended becomes where another did.
template <class Scalar>
void take_end(const MoveResult<Scalar>& from, MoveResult<Scalar>& to) noexcept {
  to.position = from.position;
  to.velocity = from.velocity;
  to.grounded = from.grounded;
  to.ride = from.ride;
}

/// A way is made in parts, and rounding may shift each part. So all pairs are checked once more. Both of a pair that
/// comes too near go back to where they began, which is free; this repeats until no pair meets.
/// @param box_of(i) around the shape along the whole way of a member.
/// @param keep_back(i) replaces its way, and notes that it stayed.
template <class Scalar, class BoxOf, class KeepBack>
void keep_back_what_is_not_clear(const PairSpace<Scalar>& space, std::span<CrowdMember<Scalar>> members,
                                 const BoxOf& box_of, const KeepBack& keep_back) noexcept {
  const auto way_made = [members](std::size_t i) {
    const auto& path = members[i].step.move.path;
    return Way<Scalar>{{path.begin(), path.size()}, 0, 1};
  };
  for (std::size_t i = 0; i < members.size(); ++i)
    if (members[i].step.move.path.overflowed()) keep_back(i);
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        if (members[i].stayed && members[j].stayed) continue;
        if (!box_of(i).overlaps(box_of(j))) continue;
        constexpr Scalar least = Tolerances<Scalar>{}.certain;
        if (!first_meeting(space, way_made(i), way_made(j), Scalar(0), least).meets) continue;
        keep_back(i);
        keep_back(j);
        changed = true;
      }
    }
  }
}

}  // namespace paperproof::crowd
