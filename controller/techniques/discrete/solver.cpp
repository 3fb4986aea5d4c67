#include "techniques/discrete/solver.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace paperproof::discrete {

void Solver::reserve(std::size_t bodies, std::size_t pairs) {
  reaches_.reserve(bodies);
  parents_.reserve(bodies);
  most_pairs_ = pairs;
  pairs_.reserve(pairs);
  planned_.reserve(pairs);
  solved_.reserve(pairs);
}

bool Solver::solve_once(std::span<Body> bodies) {
  find_pairs(bodies);
  find_islands(bodies);
  plan(bodies);
  solved_.clear();
  for (const Planned& each : planned_) {
    Body& first = bodies[each.bodies.first];
    Body& second = bodies[each.bodies.second];
    // An earlier impact may have changed this one, or prevented it.
    const auto impact = find_impact(first, second, touch_);
    if (!impact) continue;
    solved_.push_back({.bodies = each.bodies, .impact = *impact});
    push_apart(solved_.back(), first, second);
  }
  return !solved_.empty();
}

/// Along the axis on which they reach over more, fewer overlap. What cannot be moved is compared with what can alone.
void Solver::find_pairs(std::span<const Body> bodies) {
  reaches_.clear();
  Box2 all = Box2::nowhere();
  for (const Body& body : bodies) {
    reaches_.push_back({body.total_box(), static_cast<BodyIndex>(reaches_.size()), body.can_be_moved()});
    all = all.merged(reaches_.back().box);
  }
  const Eigen::Index axis = all.size().x() < all.size().y() ? 1 : 0;
  std::ranges::sort(reaches_, {}, [axis](const Reach& each) { return std::pair(each.box.lower[axis], each.body); });
  std::size_t movable = reaches_.size();
  for (std::size_t i = reaches_.size(); i-- > 0;) {
    reaches_[i].next_movable = movable;
    if (reaches_[i].can_be_moved) movable = i;
  }
  pairs_.clear();
  overflowed_ = false;
  for (std::size_t i = 0; i < reaches_.size(); ++i) {
    const Reach& one = reaches_[i];
    const auto after = [&](std::size_t k) { return one.can_be_moved ? k + 1 : reaches_[k].next_movable; };
    for (std::size_t j = after(i); j < reaches_.size(); j = after(j)) {
      const Reach& other = reaches_[j];
      if (!(other.box.lower[axis] <= one.box.upper[axis])) break;
      if (!one.box.overlaps(other.box)) continue;
      overflowed_ = overflowed_ || pairs_.size() == most_pairs_;
      if (overflowed_) break;
      const bool in_order = one.can_be_moved && (!other.can_be_moved || one.body < other.body);
      pairs_.push_back(in_order ? Pair{one.body, other.body} : Pair{other.body, one.body});
    }
  }
  std::ranges::sort(pairs_);
}

void Solver::find_islands(std::span<const Body> bodies) {
  parents_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) parents_.push_back(static_cast<BodyIndex>(i));
  // On the way to a root each body is hung one up, so that no way grows long.
  const auto root_of = [this](BodyIndex body) {
    while (parents_[body] != body) body = parents_[body] = parents_[parents_[body]];
    return body;
  };
  for (const Pair& pair : pairs_) {
    if (!bodies[pair.second].can_be_moved()) continue;
    const BodyIndex a = root_of(pair.first);
    const BodyIndex b = root_of(pair.second);
    parents_[std::max(a, b)] = std::min(a, b);
  }
  // A parent's index is lower, so its own way to the root is one step by now.
  for (BodyIndex& parent : parents_) parent = parents_[parent];
}

void Solver::plan(std::span<const Body> bodies) {
  planned_.clear();
  for (const Pair& pair : pairs_) {
    const auto impact = find_impact(bodies[pair.first], bodies[pair.second], touch_);
    if (impact) planned_.push_back({parents_[pair.first], impact->time, pair});
  }
  std::sort(planned_.begin(), planned_.end(), [](const Planned& a, const Planned& b) {
    return std::tie(a.island, a.time, a.bodies.first, a.bodies.second) <
           std::tie(b.island, b.time, b.bodies.first, b.bodies.second);
  });
}

void Solver::push_apart(SolvedImpact& solved, Body& first, Body& second) const noexcept {
  const Vec2d& normal = solved.impact.normal;
  const double share = first.inverse_mass / (first.inverse_mass + second.inverse_mass);
  const Vec2d push = normal * (solved.impact.depth + gap_);
  solved.first_push = push * share;
  solved.second_push = push * (share - 1);
  first.movement += solved.first_push;
  second.movement += solved.second_push;
  const Vec2d relative = first.velocity - second.velocity;
  const double approach = relative.dot(normal);
  if (!(approach < 0)) return;
  first.velocity -= normal * (approach * share);
  second.velocity += normal * (approach * (1 - share));
}

}  // namespace paperproof::discrete
