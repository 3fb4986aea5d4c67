#include "techniques/discrete/solver.hpp"

#include <tuple>

namespace paperproof::discrete {

template <class Scalar>
void Solver<Scalar>::reserve(std::size_t bodies, std::size_t pairs) {
  boxes_.reserve(bodies);
  parents_.reserve(bodies);
  pairs_.reserve(pairs);
  planned_.reserve(pairs);
  solved_.reserve(pairs);
}

template <class Scalar>
int Solver<Scalar>::solve(std::span<Body<Scalar>> bodies, int rounds) {
  int used = 0;
  while (used < rounds && solve_once(bodies)) ++used;
  return used;
}

template <class Scalar>
bool Solver<Scalar>::solve_once(std::span<Body<Scalar>> bodies) {
  find_pairs(bodies);
  find_islands(bodies);
  plan(bodies);
  solved_.clear();
  for (const Planned& each : planned_) {
    Body<Scalar>& first = bodies[each.bodies.first];
    Body<Scalar>& second = bodies[each.bodies.second];
    // An earlier impact may have changed this one, or prevented it.
    const auto impact = find_impact<Scalar>(first, second, touch_);
    if (!impact) continue;
    push_apart(*impact, first, second);
    solved_.push_back({each.bodies, *impact});
  }
  return !solved_.empty();
}

template <class Scalar>
void Solver<Scalar>::find_pairs(std::span<const Body<Scalar>> bodies) {
  boxes_.clear();
  for (const Body<Scalar>& body : bodies) boxes_.push_back(body.total_box());
  pairs_.clear();
  const auto count = static_cast<BodyIndex>(bodies.size());
  for (BodyIndex i = 0; i < count; ++i) {
    if (!bodies[i].can_be_moved()) continue;
    for (BodyIndex j = 0; j < count; ++j) {
      const bool seen = j <= i && bodies[j].can_be_moved();
      if (!seen && boxes_[i].overlaps(boxes_[j])) pairs_.push_back({i, j});
    }
  }
}

template <class Scalar>
BodyIndex Solver<Scalar>::island_of(BodyIndex body) const noexcept {
  while (parents_[body] != body) body = parents_[body];
  return body;
}

template <class Scalar>
void Solver<Scalar>::find_islands(std::span<const Body<Scalar>> bodies) {
  parents_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) parents_.push_back(static_cast<BodyIndex>(i));
  for (const Pair& pair : pairs_) {
    if (!bodies[pair.second].can_be_moved()) continue;
    const BodyIndex a = island_of(pair.first);
    const BodyIndex b = island_of(pair.second);
    parents_[std::max(a, b)] = std::min(a, b);
  }
  // A parent's index is lower, so its own way to the root is one step by now.
  for (BodyIndex& parent : parents_) parent = parents_[parent];
}

template <class Scalar>
void Solver<Scalar>::plan(std::span<const Body<Scalar>> bodies) {
  planned_.clear();
  for (const Pair& pair : pairs_) {
    const auto impact = find_impact<Scalar>(bodies[pair.first], bodies[pair.second], touch_);
    if (impact) planned_.push_back({parents_[pair.first], impact->time, pair});
  }
  std::sort(planned_.begin(), planned_.end(), [](const Planned& a, const Planned& b) {
    return std::tie(a.island, a.time, a.bodies.first, a.bodies.second) <
           std::tie(b.island, b.time, b.bodies.first, b.bodies.second);
  });
}

template <class Scalar>
void Solver<Scalar>::push_apart(const Impact<Scalar>& impact, Body<Scalar>& first,
                                Body<Scalar>& second) const noexcept {
  const Scalar share = first.inverse_mass / (first.inverse_mass + second.inverse_mass);
  const Vec2<Scalar> push = impact.normal * (impact.depth + gap_);
  first.movement += push * share;
  second.movement -= push * (1 - share);
  const Vec2<Scalar> relative = first.velocity - second.velocity;
  const Scalar approach = relative.dot(impact.normal);
  if (!(approach < 0)) return;
  first.velocity -= impact.normal * (approach * share);
  second.velocity += impact.normal * (approach * (1 - share));
}

template class Solver<float>;
template class Solver<double>;

}  // namespace paperproof::discrete
