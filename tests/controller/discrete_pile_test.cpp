/// Many moving bodies at once: how far a pile sinks into itself, and how still it lies, by the number of rounds.
#include "controller/discrete_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::article_tests {
namespace {

constexpr double dt = 1.0 / 60;
constexpr double gravity = 10;
constexpr double gap = Tolerances<double>{}.stop;

/// Boxes of one metre on a floor, falling.
class Pile {
 public:
  Pile(std::vector<Vec2d> centres, int rounds) : rounds_(rounds) {
    bodies_.add_static_box({40, 1}, {0, -0.5});
    for (const Vec2d& centre : centres) bodies_.add_box({1, 1}, centre);
  }

  /// Side by side in a slightly crooked tower.
  static std::vector<Vec2d> tower(int boxes) {
    std::vector<Vec2d> centres;
    for (int i = 0; i < boxes; ++i) centres.emplace_back(0.05 * (i % 3), 0.5 + 1.1 * i);
    return centres;
  }
  /// Five in the lowest row, one less in each that follows, each over the joint of two.
  static std::vector<Vec2d> pyramid() {
    std::vector<Vec2d> centres;
    for (int row = 0; row < 5; ++row) {
      for (int i = 0; i < 5 - row; ++i) centres.emplace_back(1.05 * i + 0.525 * row, 0.5 + 1.1 * row);
    }
    return centres;
  }

  void step() {
    for (auto& body : bodies_.all) {
      if (!body.can_be_moved()) continue;
      body.velocity.y() -= gravity * dt;
      body.movement = body.velocity * dt;
    }
    solver_.solve(bodies_.all, rounds_);
    for (auto& body : bodies_.all) {
      body.position += body.movement;
      body.movement.setZero();
    }
  }

  /// The deepest overlap of any two [m].
  [[nodiscard]] double overlap() const {
    double worst = 0;
    for (std::size_t i = 0; i < bodies_.all.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vec2d apart = (bodies_.all[i].position - bodies_.all[j].position).cwiseAbs();
        const Vec2d reach = bodies_.all[i].box.upper + bodies_.all[j].box.upper;
        worst = std::max(worst, (reach - apart).minCoeff());
      }
    }
    return worst;
  }

  [[nodiscard]] double top() const { return bodies_.all.back().position.y(); }

 private:
  Bodies<double> bodies_;
  int rounds_;
  discrete::Solver<double> solver_ = make_solver();
};

struct Lying {
  double sunk = 0;    ///< The deepest overlap once it lies [m].
  double jitter = 0;  ///< Of the topmost box, from peak to peak [m].
};

/// Ten seconds to come to rest, and five in which it is watched.
Lying watch(Pile pile) {
  for (int step = 0; step < 600; ++step) pile.step();
  Lying lying;
  double lowest = pile.top();
  double highest = lowest;
  for (int step = 0; step < 300; ++step) {
    pile.step();
    lying.sunk = std::max(lying.sunk, pile.overlap());
    lowest = std::min(lowest, pile.top());
    highest = std::max(highest, pile.top());
  }
  lying.jitter = highest - lowest;
  return lying;
}

// A resting box is asked to fall by at least g dt² in every step, and by more the faster the box below it gives way:
// the rounds have to push the whole pile up against that. What they leave is the overlap.

TEST(DiscretePile, sinks_less_with_each_doubling_of_the_rounds) {
  double last = 1;  // the boxes' own height
  for (const int rounds : {2, 4, 8, 16, 32, 64}) {
    const double sunk = watch(Pile(Pile::tower(10), rounds)).sunk;
    EXPECT_LT(sunk, last * 3 / 4) << rounds << " rounds";
    last = sunk;
  }
  EXPECT_LT(last, 0.005) << "with 64 rounds ten boxes sink into each other by less than 5 mm";
  EXPECT_GT(last, gap) << "and still do";
}

TEST(DiscretePile, of_three_boxes_needs_eight_rounds_for_five_millimetres) {
  EXPECT_GT(watch(Pile(Pile::tower(3), 4)).sunk, 0.005);
  EXPECT_LT(watch(Pile(Pile::tower(3), 8)).sunk, 0.005);
}

TEST(DiscretePile, in_a_pyramid_keeps_to_the_bound_of_a_tower_of_its_height) {
  const double tower = watch(Pile(Pile::tower(5), 16)).sunk;
  const double pyramid = watch(Pile(Pile::pyramid(), 16)).sunk;
  EXPECT_LT(pyramid, 2 * tower);
  EXPECT_LT(pyramid, 0.05);
}

TEST(DiscretePile, jitters_with_one_round_and_lies_still_with_more) {
  // One round alone lets the top shift by more than it falls in a step; a second one ends that, as the article says of
  // iterations. What remains is a steady overlap, not a movement.
  for (const int boxes : {3, 10}) {
    const double fall = gravity * dt * dt;
    EXPECT_GT(watch(Pile(Pile::tower(boxes), 1)).jitter, fall) << boxes;
    for (const int rounds : {2, 4, 8, 16, 32}) {
      EXPECT_LT(watch(Pile(Pile::tower(boxes), rounds)).jitter, 1e-8) << boxes << " boxes, " << rounds << " rounds";
    }
  }
}

TEST(DiscretePile, of_one_box_rests_exactly_with_any_number_of_rounds) {
  for (const int rounds : {1, 2, 8}) {
    const Lying lying = watch(Pile({{0, 2}}, rounds));
    EXPECT_LE(lying.sunk, 0);
    EXPECT_LE(lying.jitter, 1e-15);
  }
}

}  // namespace
}  // namespace paperproof::article_tests
