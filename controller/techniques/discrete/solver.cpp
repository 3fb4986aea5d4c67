#include "techniques/discrete/solver.hpp"

#include <tuple>

namespace paperproof::discrete {
namespace {

/// Of what can be moved: from here on a sweep is faster than looking at everything, as measured.
constexpr std::size_t worth_sweeping = 64;

}  // namespace

void Solver::reserve(std::size_t bodies, std::size_t pairs) {
  reaches_.movable.reserve(bodies);
  reaches_.fixed.reserve(bodies);
  parents_.reserve(bodies);
  pairs_.limit(pairs);
  planned_.reserve(pairs);
  solved_.reserve(pairs);
}

int Solver::solve(std::span<Body> bodies, int rounds) {
  int used = 0;
  while (used < rounds && solve_once(bodies)) ++used;
  return used;
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

void Solver::find_pairs(std::span<const Body> bodies) {
  reaches_.movable.clear();
  reaches_.fixed.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    (bodies[i].can_be_moved() ? reaches_.movable : reaches_.fixed)
        .push_back({bodies[i].total_box(), static_cast<BodyIndex>(i)});
  pairs_.clear();
  if (reaches_.movable.size() < worth_sweeping)
    find_pairs_one_by_one(reaches_, pairs_);
  else
    find_pairs_by_sweep(reaches_, pairs_);
}

BodyIndex Solver::island_of(BodyIndex body) const noexcept { return parents_[body]; }

void Solver::find_islands(std::span<const Body> bodies) {
  parents_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) parents_.push_back(static_cast<BodyIndex>(i));
  // On the way to a root each body is hung one up, so that no way grows long.
  const auto root_of = [this](BodyIndex body) {
    while (parents_[body] != body) body = parents_[body] = parents_[parents_[body]];
    return body;
  };
  for (const Pair& pair : pairs_.all()) {
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
  for (const Pair& pair : pairs_.all()) {
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
