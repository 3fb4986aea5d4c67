/// The techniques that search against each other, and against what formulas say, on many seeded sweeps.
#include "controller/article_support.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace paperproof::article_tests {
namespace {

TEST(PaperThickness, speculative_stops_at_any_and_the_march_at_a_unit_or_more) {
  Random random(3);
  int passed_thin = 0;
  for (int drop = 0; drop < 4000; ++drop) {
    const double thickness = 5 * px * std::pow(10.0, -random.between(0, 4));
    const double top = -px / 2 - random.between(1, 40) * px;
    const double fall = (-px / 2 - top) + thickness + random.between(0, 50) * px;  // at least to the lower edge
    const std::vector<ColliderDef> paper{rectangle(-2, top - thickness, 2, top)};

    Rig<double> exact("speculative", paper, {}, single_pixel());
    EXPECT_NEAR(exact.move({0, 0}, {0, -fall}).position.y(), top + px / 2, 1e-14) << "seed 3, drop " << drop;

    Rig<double> march("speculative_march", paper, {}, single_pixel());
    const bool stopped = !march.move({0, 0}, {0, -fall}).contacts.empty();
    EXPECT_TRUE(stopped || thickness <= px) << "seed 3, drop " << drop;
    passed_thin += stopped ? 0 : 1;
    if (stopped) {
      // Whole units from the start, and the last one above the paper.
      const double distance = -px / 2 - top;
      EXPECT_NEAR(march.result.position.y(), -std::floor(distance / px) * px, 1e-14) << "seed 3, drop " << drop;
      EXPECT_NEAR(march.result.contacts[0].separation, std::fmod(distance, px), 1e-14) << "seed 3, drop " << drop;
    }
    // Penetration resolution sees where the feet end, and nothing else.
    const double end = -fall - px / 2;
    if (std::abs(end - (top - thickness)) < 1e-9) continue;
    Rig<double> resolution("penetration_resolution", paper, {}, single_pixel());
    const bool inside = top - thickness < end && end < top;
    EXPECT_EQ(resolution.move({0, 0}, {0, -fall}).contacts.empty(), !inside) << "seed 3, drop " << drop;
  }
  EXPECT_GT(passed_thin, 400) << "paper thinner than a unit slips between two steps of the march";
}

using Sides = std::set<Side>;

Sides sides_of(const MoveResult<double>& result) {
  Sides sides;
  for (const Contact<double>& contact : result.contacts) sides.insert(contact.side);
  return sides;
}

TEST(SpeculativeAgreement, computed_and_marched_contacts_end_within_a_unit_of_each_other) {
  // Where one pair hits, the march is less than a unit short of the computed impact, and penetration resolution brings
  // both to within a unit of the outline. Two exceptions, both rare:
  // - two pairs hit: the second is searched along a vector that the first has bent, a little differently in each;
  // - the way of a point through the piece is shorter than a unit: the march steps over it, and a finer one does not.
  Random random(20);
  int hits = 0;
  int by_one_pair = 0;
  int bent_apart = 0;
  int stepped_over = 0;
  constexpr int sweeps = test::sampled(10'000);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const Vec2d centre = random.point(2.5);
    const Vec2d radii{random.between(0.2, 2), random.between(0.2, 2)};
    const std::vector<ColliderDef> piece{{.points = on_an_ellipse(random, centre, radii)}};
    const Vec2d start = random.point(1);
    const Vec2d displacement = random.point(3);
    Rig<double> computed("speculative", piece);
    const Vec2d end = computed.move(start, displacement).position;
    const Sides sides = sides_of(computed.result);
    const auto agrees = [&](double unit, double apart) {
      Rig<double> marched("speculative_march", piece, {.unit = unit});
      const Vec2d difference = marched.move(start, displacement).position - end;
      return sides_of(marched.result) == sides && difference.cwiseAbs().maxCoeff() <= apart + 1e-12;
    };
    hits += sides.empty() ? 0 : 1;
    if (agrees(px, px)) {
      by_one_pair += sides.size() == 1 ? 1 : 0;
    } else if (sides.size() == 2 && agrees(px, 5 * px)) {
      ++bent_apart;
    } else {
      ++stepped_over;
      EXPECT_TRUE(agrees(px / 1024, sides.size() == 2 ? 5 * px : px)) << "seed 20, sweep " << sweep;
    }
  }
  EXPECT_GT(hits, sweeps * 3 / 10);
  EXPECT_LT(hits, sweeps * 7 / 10);
  EXPECT_GT(by_one_pair, sweeps / 10);
  EXPECT_LT(bent_apart, sweeps / 200);
  EXPECT_LT(stepped_over, sweeps / 200);
}

}  // namespace
}  // namespace paperproof::article_tests
