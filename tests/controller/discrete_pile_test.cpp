/// Many moving bodies at once: how far a pile sinks into itself, and how still it lies, by the number of rounds.
#include "controller/discrete_support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::article_tests {
namespace {

constexpr double dt = 1.0 / 60;
constexpr double gravity = 10;
constexpr double gap = Tolerances<double>{}.stop;

struct Lying {
  double sunk = 0;    ///< The deepest overlap of any two [m].
  double jitter = 0;  ///< Of the topmost box, from peak to peak [m].
};

/// A slightly crooked tower of boxes of one metre falls onto a floor: ten seconds to come to rest, and five in which it
/// is watched.
Lying watch(int boxes, int rounds) {
  Bodies<double> bodies;
  bodies.add_static_box({40, 1}, {0, -0.5});
  for (int i = 0; i < boxes; ++i) bodies.add_box({1, 1}, {0.05 * (i % 3), 0.5 + 1.1 * i});
  discrete::Solver<double> solver = make_solver();
  Lying lying;
  double lowest = INFINITY;
  double highest = -INFINITY;
  for (int step = 0; step < 900; ++step) {
    for (auto& body : bodies.all) {
      if (body.can_be_moved()) body.velocity.y() -= gravity * dt;
      body.movement = body.velocity * dt;
    }
    solver.solve(bodies.all, rounds);
    for (auto& body : bodies.all) body.position += body.movement;
    if (step < 600) continue;
    for (const auto& body : bodies.all) {
      for (const auto& other : bodies.all) {
        const Vec2d apart = (body.position - other.position).cwiseAbs();
        const double overlap = (body.box.upper + other.box.upper - apart).minCoeff();
        if (&body != &other) lying.sunk = std::max(lying.sunk, overlap);
      }
    }
    lowest = std::min(lowest, bodies.all.back().position.y());
    highest = std::max(highest, bodies.all.back().position.y());
  }
  lying.jitter = highest - lowest;
  return lying;
}

// A resting box is asked to fall by at least g dt² in every step, and by more the faster the box below it gives way:
// the rounds have to push the whole pile up against that. What they leave is the overlap.

TEST(DiscretePile, sinks_less_with_each_doubling_of_the_rounds_and_jitters_with_one_alone) {
  for (const int boxes : {3, 10}) {
    // One round alone lets the top shift by more than it falls in a step; a second one ends that, as the article says
    // of iterations. What remains is a steady overlap, not a movement.
    EXPECT_GT(watch(boxes, 1).jitter, gravity * dt * dt) << boxes;
    double last = 1;  // the boxes' own height
    for (const int rounds : {2, 4, 8, 16, 32, 64}) {
      const Lying lying = watch(boxes, rounds);
      EXPECT_LT(lying.sunk, std::max(last * 3 / 4, gap)) << boxes << " boxes, " << rounds << " rounds";
      EXPECT_LT(lying.jitter, 1e-8) << boxes << " boxes, " << rounds << " rounds";
      EXPECT_EQ(lying.sunk < 0.005, rounds >= (boxes == 3 ? 8 : 64)) << boxes << " boxes, " << rounds << " rounds";
      last = lying.sunk;
    }
  }
}

TEST(DiscretePile, of_one_box_rests_exactly_with_any_number_of_rounds) {
  for (const int rounds : {1, 2, 8}) {
    const Lying lying = watch(1, rounds);
    EXPECT_LE(lying.sunk, 0) << rounds;
    EXPECT_LE(lying.jitter, 1e-15) << rounds;
  }
}

}  // namespace
}  // namespace paperproof::article_tests
