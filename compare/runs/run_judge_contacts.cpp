/// Where and when contacts are, as a record says, and what it says that it dropped through or met.
#include "runs/run_judge.hpp"

#include "contains.hpp"
#include "oracle/contact_place.hpp"
#include "oracle/contacts.hpp"
#include "oracle/hanging.hpp"
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

/// Whether a contact's point is in the character's box at some corner of the way, and no farther from it than it says.
bool is_point_of(const TraceStep& record, const Contact& contact, std::span<const Vec2d> points) {
  constexpr double near = 1e-5;
  const Box2 box = Box2::around(points).inflated(near);
  const auto is_there = [&](const PathPoint& at) {
    const Vec2d point = contact.point - at.position;
    return box.contains({point, point});
  };
  return std::abs(contact.separation) <= near && std::ranges::any_of(record.path, is_there);
}

/// Whether a face of what a contact is with has its normal, or nearly so.
bool has_face(std::span<const NearPart> parts, const Contact& contact) {
  return std::ranges::any_of(parts, [&](const NearPart& part) {
    return part.collider == contact.collider && std::ranges::any_of(part.faces, [&](const NearFace& face) {
             return face.normal.dot(contact.normal) > same_face;
           });
  });
}

}  // namespace

/// Whether a contact was met when it says so: the first one where the exact motion meets it, and each where the way
/// comes to it.
void RunJudge::judge_times(const TraceStep& record, const StepJudgement& judged, const Wanted& wanted) {
  if (judged.beside_another || record.contacts.empty() || !record.start_overlap.empty()) return;
  const auto check = [&](const Contact& contact, double off, double allowed) {
    if (off > allowed && off < std::numeric_limits<double>::infinity())
      note(Clause::time_of_impact, record,
           fmt::format("says it met `{}` at {:.6g} of the step, and that is {} off along the normal",
                       header_.ids[contact.collider], contact.fraction, metres(off)));
  };
  if (judged.first_impact && judged.first_approach) {
    const auto first = std::ranges::min_element(record.contacts, {}, &Contact::fraction);
    const bool is_exact = std::ranges::any_of(judged.contacts, [&](const ExactContact& exact) {
      return exact.collider == first->collider && exact.side == first->side && exact.foreseen;
    });
    // It stops up to 7e-7 m before the impact, and the exact fraction counts from there on.
    if (is_exact)
      check(*first, std::abs(first->fraction - *judged.first_impact) * *judged.first_approach, guaranteed_gap);
  }
  const detail::TurningJudge& turning = followers_.front().judge->turning();
  const bool meets_turning =
      std::ranges::any_of(record.contacts, [&](const auto& contact) { return turning.turns(contact.collider); });
  const bool in_parts = parts_of(record.vertex_ways) > 1;
  for (const Contact& contact : record.contacts) {
    if (in_parts || !turning.turns(contact.collider) || !judged.end_overlap.empty()) continue;
    std::vector<PathPoint> then{{place_at(record.path, contact.fraction), contact.fraction}};
    std::ranges::copy_if(record.path, std::back_inserter(then),
                         [&](const PathPoint& corner) { return corner.fraction == contact.fraction; });
    const bool is_there = std::ranges::any_of(
        then, [&](const PathPoint& at) { return has_face(turning.near(record, at, 3 * guaranteed_gap), contact); });
    if (!is_there)
      note(Clause::time_of_impact, record,
           fmt::format("says it met `{}` at {:.6g} of the step, and was not there", header_.ids[contact.collider],
                       contact.fraction));
  }
  if (in_parts || meets_turning || !record.crushed.empty() || !judged.end_overlap.empty()) return;
  for (const Contact& contact : record.contacts) {
    const MoverIndex mover = header_.scenery.colliders[contact.collider].mover;
    const Vec2d carried =
        mover != no_mover ? Vec2d(record.movers[mover].to - record.movers[mover].from) : Vec2d::Zero();
    // Of one collider that is the first contact: a later one is another face, and is met where the way comes to it.
    const auto is_of_it = [&](const Contact& one) { return one.collider == contact.collider; };
    const Contact& first = *std::ranges::find_if(record.contacts, is_of_it);
    const auto is_there = [&](const PathPoint& corner) {
      const Place at(corner, record.movers);
      if (&first == &contact) return scenery().separation(at, contact.collider) <= guaranteed_gap;
      return has_face(scenery().near_parts(at, guaranteed_gap), contact);
    };
    if (carried != Vec2d::Zero() && is_there(record.path.front()) && &first == &contact) {
      // It gives way from the start, and meets no later than what was requested touches. What begins at rest on its
      // ground may go with it from the start, and meets it by its own motion then.
      const Place start(record.path.front(), record.movers);
      const auto late = [&](const Vec2d& way) {
        const double approach = (carried - way).dot(contact.normal);
        const auto touch = scenery().time_of_impact(start, way, contact.collider);
        const bool at_once = touch && touch->normal.dot(contact.normal) > same_face &&
                             static_cast<double>(touch->fraction) * approach <= guaranteed_gap;
        return at_once && approach > 0 ? (contact.fraction - static_cast<double>(touch->fraction)) * approach : 0;
      };
      const Vec2d up = up_in(record, header_);
      const bool rests = wanted.carried.isZero(0) && right_of(up).dot(record.requested) == 0 &&
                         up.dot(record.requested) <= 0 && detail::is_walkable(contact.normal, header_, up);
      const double off = late(record.requested);
      check(contact, rests ? std::min(off, late(record.requested + carried)) : off, 2 * guaranteed_gap);
      continue;
    }
    // As far along the normal as it is off the time at which the way touches, at the pace of the leg that leads there.
    double off = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < record.path.size(); ++i) {
      const PathPoint& corner = record.path[i];
      if (!is_there(corner)) continue;
      if (contact.fraction == corner.fraction) off = 0;  // it was there, however it came
      const bool waited = i == 0 || !(record.path[i - 1].fraction < corner.fraction);
      const PathPoint& begin = waited ? corner : record.path[i - 1];
      const Vec2d pace =
          waited ? record.requested : Vec2d((corner.position - begin.position) / (corner.fraction - begin.fraction));
      const double approach = (carried - pace).dot(contact.normal);
      if (approach > same_speed * (carried - pace).norm())
        off = std::min(off, std::abs(contact.fraction - corner.fraction) * approach);
      // A motion that grazes stops long before it touches; what it would touch is of one direction with what it
      // reports.
      const Place far(begin.position + pace * (1 - begin.fraction), record.movers, 1);
      const auto touch = scenery().impact_between(Place(begin, record.movers), far, contact.collider);
      if (!touch || !(touch->normal.dot(contact.normal) > same_face)) continue;
      const double when = begin.fraction + static_cast<double>(touch->fraction) * (1 - begin.fraction);
      off = std::min(off, std::abs(contact.fraction - when) * std::abs((carried - pace).dot(touch->normal)));
    }
    check(contact, off, 2 * guaranteed_gap);
  }
}

/// What it says that it dropped through is one-way, was asked for, and was passed, or stood upon where a leg begins: by
/// the octagon itself or, as rounding may name a chain whose tip is grazed, by one a little to its side.
void RunJudge::judge_drops(const TraceStep& record) {
  for (const Contact& contact : record.contacts)
    if (record.input.drop && header_.scenery.colliders[contact.collider].one_way)
      note(Clause::contact_invented, record,
           "reports a contact with `" + header_.ids[contact.collider] + "`, which blocks nobody who drops");
  constexpr double aside = 1e-5;
  for (const ColliderIndex chain : record.dropped_through) {
    const std::optional<Vec2d>& one_way = header_.scenery.colliders[chain].one_way;
    const detail::TurningJudge& turning = followers_.front().judge->turning();
    // How it passes one that turns is not judged.
    const double within = beside + record.requested.norm() + turning.longest_way(record);
    bool passes = one_way && turning.turns(chain) && contains(turning.near_at_begin(record, within), chain);
    for (std::size_t i = 1; i < record.path.size() && one_way && !passes; ++i)
      for (const double shift : {0.0, aside, -aside}) {
        Place from(record.path[i - 1], record.movers);
        Place to(record.path[i], record.movers);
        for (Place* place : {&from, &to}) place->position += shift * Vec2d(one_way->y(), -one_way->x());
        Place below = from;
        below.position -= guaranteed_gap * *one_way;
        passes = passes || scenery().meets(from, to, chain) || scenery().meets(from, below, chain);
      }
    if (!record.input.drop || !passes)
      note(Clause::one_way, record, "says it dropped through `" + header_.ids[chain] + "`, and did not");
  }
}

/// A character meets others, and not itself. In turns its contact with their bodies is judged: see `InTurns`.
void RunJudge::judge_met(const TraceStep& record) {
  for (const CrowdContact& met : record.met)
    if (met.other >= followers_.size() || met.other == record.character)
      note(Clause::contact_invented, record, fmt::format("met character {}, which is no other one", met.other));
}

/// Where each contact says that it is; and of several that the motion meets first, at one time, each is reported.
void RunJudge::judge_places(const TraceStep& record, const StepJudgement& judged) {
  const bool excused = !record.start_overlap.empty() || !judged.end_overlap.empty() || record.stuck ||
                       !record.crushed.empty() || record.contacts.empty() || header_.guarantees.empty();
  if (excused) return;
  const detail::TurningJudge& turning = followers_.front().judge->turning();
  for (const Contact& contact : record.contacts) {
    const auto wrong = [&](Clause clause, const char* how) {
      note(clause, record, fmt::format("has a contact with `{}` {}", header_.ids[contact.collider], how));
    };
    if (detail::side_along(contact.normal, up_in(record, header_)) != contact.side)
      wrong(Clause::normal, "on another side than its normal says");
    if (turning.turns(contact.collider)) {
      if (!is_point_of(record, contact, header_.points))
        wrong(Clause::contact_invented, "in a point that it does not come to");
      continue;
    }
    if (header_.is_body(contact.collider)) continue;  // a meeting has no point
    if (const std::optional<PlaceFault> fault = place_fault(header_, record, contact))
      note(fault->clause, record, fault->words);
  }
  for (const ExactContact& exact : judged.contacts) {
    const auto is_it = [&](const Contact& one) { return one.collider == exact.collider && one.side == exact.side; };
    const auto on_side = [&](const Contact& one) { return one.side == exact.side; };
    // Of a side where none is reported the metrics tell.
    if (exact.first && std::ranges::any_of(record.contacts, on_side) && std::ranges::none_of(record.contacts, is_it))
      note(Clause::contact_missed, record,
           fmt::format("does not report a contact: `{}`, {}", header_.ids[exact.collider], name_of(exact.side)));
  }
}

}  // namespace paperproof::compare
