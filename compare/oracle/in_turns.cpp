#include "oracle/in_turns.hpp"

#include "contains.hpp"

#include <algorithm>
#include <string>

namespace paperproof::compare {
namespace {

/// Of a turn the own body is farther away than this, and than the way goes [m].
constexpr double far_away = 100;

const Vec2d& begin_of(const TraceStep& step) { return step.path.front().position; }
const Vec2d& finish_of(const TraceStep& step) { return step.path.back().position; }

std::optional<CharacterIndex> carrier_of(const std::optional<TraceRide>& ride) {
  return ride ? ride->character : std::nullopt;
}

}  // namespace

InTurns::InTurns(const TraceHeader& header, std::size_t movers)
    : header_(header),
      pair_(header.points),
      first_body_(static_cast<ColliderIndex>(header.scenery.colliders.size())),
      carriers_(header.characters) {
  header_.bodies = header.characters;
  if (!header_.turning.empty()) header_.turning.resize(movers + header.characters);
  for (std::size_t k = 0; k < header.characters; ++k) {
    ColliderDef body;
    body.points = header.points;
    body.mover = static_cast<MoverIndex>(movers + k);
    header_.scenery.colliders.push_back(std::move(body));
    header_.ids.push_back("character " + std::to_string(k));
  }
}

MoverMotion InTurns::motion_of(const TraceStep& other, const TraceStep& one, const Carrier& carrier) const {
  const Vec2d& from = begin_of(other);
  const Vec2d& to = finish_of(other);
  if (other.character == one.character) {
    const Vec2d away = from + Vec2d(far_away + 4 * (one.requested.norm() + (to - from).norm()), 0);
    return {away, away};
  }
  const Vec2d& at = begin_of(one);
  const bool is_later = other.turn > one.turn;
  const auto pushes_or_recedes = [&] {
    return is_later ? pair_.meet_between(at, from, at, to) : pair_.recedes(at, from, to);
  };
  if (contains(one.moving, other.character) && (carrier == other.character || pushes_or_recedes())) return {from, to};
  const Vec2d& stands = is_later ? from : to;
  return {stands, stands};
}

TraceStep InTurns::turn_of(const TraceStep& one, std::span<const TraceStep> steps, const Carrier& carrier) const {
  TraceStep turn = one;
  for (const TraceStep& other : steps) turn.movers.push_back(motion_of(other, one, carrier));
  // What others push it against is met after them.
  turn.contacts.clear();
  for (const CrowdContact& met : one.met)
    turn.contacts.push_back(
        {.collider = body_of(met.other), .normal = met.normal, .fraction = met.fraction, .side = met.side});
  turn.contacts.insert(turn.contacts.end(), one.contacts.begin(), one.contacts.end());
  std::ranges::stable_sort(turn.contacts, [](const Contact& a, const Contact& b) { return a.fraction < b.fraction; });
  turn.met.clear();
  if (const Carrier on = carrier_of(one.ride)) {
    const MoverMotion& motion = turn.movers[turn.movers.size() - steps.size() + *on];
    const Vec2d velocity = (motion.to - motion.from) / length_of(one, header_);
    const Vec2d change = velocity - one.ride->velocity;
    turn.ride = TraceRide{.collider = body_of(*on), .velocity = velocity};
    turn.velocity += change;
    turn.ground_velocity += change;
  }
  if (turn.from && carrier_of(turn.from->ride)) turn.from->ride->collider = body_of(*turn.from->ride->character);
  return turn;
}

std::vector<TraceStep> InTurns::turns(std::span<const TraceStep> steps) {
  std::vector<TraceStep> turns;
  for (const TraceStep& step : steps) {
    Carrier& carrier = carriers_[step.character];
    if (step.respawn) carrier = step.from ? carrier_of(step.from->ride) : std::nullopt;
    turns.push_back(turn_of(step, steps, carrier));
    carrier = carrier_of(step.ride);
  }
  return turns;
}

}  // namespace paperproof::compare
