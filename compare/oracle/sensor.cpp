#include "oracle/sensor.hpp"

#include "oracle/depth.hpp"

#include <algorithm>
#include <cassert>

namespace paperproof::compare::detail {
namespace {

/// A stay, in legs of the way: 2.5 is half-way along the third. An end belongs to it only where a leg begins or ends.
struct Stay {
  ExactFraction first;
  ExactFraction last;
  bool has_first = false;
  bool has_last = false;
};

/// The stay in one part along one leg, if any.
std::optional<Stay> stay_in(const ConvexPart& part, std::span<const Vec2d> octagon, const FramePlace& from,
                            const FramePlace& to) {
  assert(part.radius == 0);
  const int unit = std::min(common_unit(part, octagon, from), common_unit(part, octagon, to));
  const std::vector<Integer> at_from = scaled_separations(part, octagon, from, unit);
  const std::vector<Integer> at_to = scaled_separations(part, octagon, to, unit);
  Stay stay{.first = 0, .last = 1, .has_first = true, .has_last = true};
  for (std::size_t i = 0; i < at_from.size(); ++i) {
    const bool in_at_from = at_from[i] < 0;
    const bool in_at_to = at_to[i] < 0;
    if (in_at_from && in_at_to) continue;
    if (!in_at_from && !in_at_to) return std::nullopt;
    const ExactFraction crossing(Ratio{abs(at_from[i]), abs(Integer(at_from[i] - at_to[i]))});
    if (in_at_to && crossing >= stay.first) {
      stay.first = crossing;
      stay.has_first = false;
    }
    if (in_at_from && crossing <= stay.last) {
      stay.last = crossing;
      stay.has_last = false;
    }
  }
  if (stay.first >= stay.last) return std::nullopt;
  return stay;
}

/// The same for a disc.
std::optional<Stay> stay_in_disc(const World& world, ColliderIndex disc, const FramePlace& from, const FramePlace& to) {
  const Group& group = world.group_of(disc);
  if (!Passage(world, group, Way::to(from, to)).meets(disc)) return std::nullopt;
  const auto first_of = [&](const FramePlace& a, const FramePlace& b) {
    const Passage passage(world, group, Way::to(a, b));
    return last_before([&](double until) { return passage.meets_disc(disc, until); });
  };
  Stay stay{.first = 0, .last = 1, .has_first = Passage(world, group, Way::stay(from)).meets(disc)};
  stay.has_last = Passage(world, group, Way::stay(to)).meets(disc);
  if (!stay.has_first) stay.first = first_of(from, to);
  if (!stay.has_last) stay.last = ExactFraction(1) - first_of(to, from);
  if (stay.first >= stay.last) return std::nullopt;
  return stay;
}

/// One after the other; what overlaps, or meets in an instant that belongs to one of them, is one stay.
std::vector<Stay> joined(std::vector<Stay> stays) {
  std::ranges::sort(stays, [](const Stay& a, const Stay& b) { return a.first < b.first; });
  std::vector<Stay> all;
  for (Stay& stay : stays) {
    const bool apart = all.empty() || stay.first > all.back().last ||
                       (stay.first == all.back().last && !stay.has_first && !all.back().has_last);
    if (apart) {
      all.push_back(std::move(stay));
      continue;
    }
    Stay& known = all.back();
    if (stay.first == known.first) known.has_first = known.has_first || stay.has_first;
    if (stay.last == known.last) known.has_last = known.has_last || stay.has_last;
    if (stay.last > known.last) {
      known.last = stay.last;
      known.has_last = stay.has_last;
    }
  }
  return all;
}

/// The fraction of the step at a place that is counted in legs.
ExactFraction fraction_at(const ExactFraction& legs, std::span<const FramePlace> places) {
  std::size_t leg = 0;
  while (leg + 2 < places.size() && legs >= static_cast<double>(leg + 1)) ++leg;
  const ExactFraction from = places[leg].fraction;
  return from + (legs - static_cast<double>(leg)) * (places[leg + 1].fraction - from);
}

}  // namespace

void add_sensor_events(const World& world, ColliderIndex sensor, std::span<const ConvexPart> parts,
                       std::span<const FramePlace> places, std::vector<ExactSensorEvent>& events) {
  std::vector<Stay> stays;
  for (std::size_t leg = 0; leg + 1 < places.size(); ++leg) {
    const Box2 box = world.box_of(Way::to(places[leg], places[leg + 1]));
    for (const ConvexPart& part : parts) {
      if (!part.box.overlaps(box)) continue;
      std::optional<Stay> stay = part.radius > 0 ? stay_in_disc(world, sensor, places[leg], places[leg + 1])
                                                 : stay_in(part, world.points(), places[leg], places[leg + 1]);
      if (!stay) continue;
      stay->first = stay->first + static_cast<double>(leg);
      stay->last = stay->last + static_cast<double>(leg);
      stays.push_back(std::move(*stay));
    }
  }
  for (const Stay& stay : joined(std::move(stays))) {
    const bool before = stay.has_first && stay.first == 0;
    const bool after = stay.has_last && stay.last == static_cast<double>(places.size() - 1);
    if (!before) events.push_back({sensor, ExactSensorEvent::Change::enter, fraction_at(stay.first, places)});
    if (!after) events.push_back({sensor, ExactSensorEvent::Change::exit, fraction_at(stay.last, places)});
  }
}

}  // namespace paperproof::compare::detail
