/// The proof that a piece which turns and a character stay apart.
#include "campaign/shapes.hpp"
#include "geometry/exact.hpp"
#include "geometry/pose.hpp"
#include "support/random_runs.hpp"
#include "turning/proof.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace paperproof::test {
namespace {

using turning::PieceWay;
using turning::stay_apart;

const std::vector<Vec2d> unit_box{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

std::vector<Vec2d> shifted(std::vector<Vec2d> points, const Vec2d& by) {
  for (Vec2d& point : points) point += by;
  return points;
}

std::vector<Vec2d> rotated(std::vector<Vec2d> points, double angle) {
  for (Vec2d& point : points) point = geometry::Turn(angle)(point);
  return points;
}

TEST(ProofOfTurns, knows_ways_that_pass_and_ways_that_meet) {
  for (const double gap : {1e-6, 1e-10}) {
    const PieceWay beside{shifted(unit_box, {1 + gap, 0}), shifted(unit_box, {1 + gap, 3})};
    EXPECT_EQ(stay_apart({unit_box, {0, 0}, {0, 5}}, beside, 1e-9), gap > 1e-9) << gap;
  }
  // Through each other within the time, apart at both ends.
  EXPECT_FALSE(stay_apart({unit_box, {0, 0}, {0, 0}}, {shifted(unit_box, {-2, 0}), shifted(unit_box, {2, 0})}, 1e-9));
  // A paper turns past a corner: it ends 1 mm before the corner, or 1 mm behind it.
  const std::vector<Vec2d> paper{{0, 0}, {2, 0}};
  for (const double gap : {1e-3, -1e-3}) {
    const Vec2d corner = geometry::Turn(0.2)(Vec2d(1, gap));
    const Vec2d at = corner + Vec2d(-0.5, 0.5);  // it is the lower right corner of the box
    EXPECT_EQ(stay_apart({unit_box, at, at}, {paper, rotated(paper, 0.2)}, 1e-9), gap > 0) << gap;
  }
}

/// Against a twin that looks at many moments.
TEST(ProofOfTurns, agrees_with_many_moments) {
  int apart = 0;
  int meet = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    Random random(seed);
    const int corners = random.integer(2, 7);
    const double size = random.log_between(1e-3, 3);
    std::vector<Vec2d> piece;
    for (int i = 0; i < corners; ++i) piece.push_back(size * compare::towards(2 * std::numbers::pi * i / corners));
    const double first_angle = random.angle();
    const double turn = random.between(-0.3, 0.3);
    const Vec2d at{random.between(-2, 2), random.between(-2, 2)};
    const Vec2d by{random.between(-1, 1), random.between(-1, 1)};
    const Vec2d way{random.between(-1, 1), random.between(-1, 1)};
    const PieceWay moving{shifted(rotated(piece, first_angle), at),
                          shifted(rotated(piece, first_angle + turn), at + by)};
    const bool proved = stay_apart({unit_box, {0, 0}, way}, moving, 1e-9);
    bool overlaps = false;
    for (int i = 0; i <= 500 && !overlaps; ++i) {
      const double share = i / 500.0;
      std::vector<Vec2d> here = moving.from;
      for (std::size_t k = 0; k < here.size(); ++k) here[k] += (moving.to[k] - moving.from[k]) * share;
      overlaps = !stay_apart({unit_box, way * share, way * share}, {here, here}, -1e-9);
    }
    ASSERT_FALSE(proved && overlaps) << "seed " << seed;
    if (!proved && !overlaps) continue;  // less than the moments show
    (proved ? apart : meet) += 1;
  }
  EXPECT_GE(apart, 500);
  EXPECT_GE(meet, 500);
  EXPECT_GE(apart + meet, 3960);
}

/// The corner of a box is just inside of a long side, or outside, that has a corner which is flat but for 1e-12 m. So
/// far from the origin rounding turns that corner inside out.
TEST(ProofOfTurns, believes_no_edge_with_its_own_piece_beyond_it) {
  int apart = 0;
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    Random random(seed);
    const double edge = random.log_between(1e-3, 0.1);
    const double angle = random.angle();
    const Vec2d at{random.between(-1e6, 1e6), random.between(-1e6, 1e6)};
    const auto piece = shifted(rotated({{0, 0}, {edge, -1e-12}, {edge + 3, 0}, {1.5, 2}}, angle), at);
    const double depth = random.log_between(1e-10, 1e-6) * (random.chance(0.5) ? 1 : -1);
    const Vec2d touched = at + geometry::Turn(angle)(Vec2d(edge + random.between(1, 2.5), depth));
    const Vec2d up = geometry::Turn(angle)(Vec2d(0, 1));
    const Vec2d corner{std::copysign(0.5, up.x()), std::copysign(0.5, up.y())};
    const auto is_left = [&](std::size_t i, std::size_t j) {
      return geometry::orientation_sign_of_sum(piece[i], piece[j], std::array{Vec2d(touched - corner), corner}) > 0;
    };
    const bool overlaps = is_left(0, 2) && is_left(2, 3) && is_left(3, 0);
    const bool proved = stay_apart({unit_box, touched - corner, touched - corner}, {piece, piece}, 1e-9);
    ASSERT_FALSE(proved && overlaps) << "seed " << seed;
    apart += proved;
    inside += overlaps;
  }
  EXPECT_GE(apart, 1000);
  EXPECT_GE(inside, 1000);
}

}  // namespace
}  // namespace paperproof::test
