/// Flights past a corner at distances down to an ulp: octagon_sweep and exact arithmetic agree about hit and miss, but
/// for what comes nearer than the hit distance.
#include "oracle/exact.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::test {
namespace {

/// A miss may be called a contact where the largest separation falls below the hit distance. Neighbouring facets of the
/// octagon enclose up to 63.4 degrees, so that this region reaches 1 / cos(31.7°) times as far at a corner.
const double called_a_contact = Tolerances<double>{}.hit / std::cos(std::atan(2.0) / 2) * 1.001;

/// A flight along `way` past the triangle's first corner. The octagon comes `nearer` than touching it.
struct Flight {
  SceneryDef scenery;
  Vec2d from;
  Vec2d way;
};

Flight past_a_corner(Random& random, double nearer) {
  const double heading = random.chance(0.3) ? random.integer(0, 7) * std::numbers::pi / 4 : random.angle();
  const Vec2d along{std::cos(heading), std::sin(heading)};
  const Vec2d side{-along.y(), along.x()};  // the triangle is on this side of the flight
  const Vec2d corner{random.between(-100, 100), random.between(-100, 100)};
  const auto behind = [&](double turned) {
    const double angle = heading + std::numbers::pi / 2 + turned;
    return Vec2d{corner + Vec2d{std::cos(angle), std::sin(angle)} * random.between(0.5, 2)};
  };
  Flight flight;
  flight.scenery.colliders.push_back(
      {.points = {corner, behind(-random.between(0.2, 1.4)), behind(random.between(0.2, 1.4))}});
  double reach = 0;
  const CharacterShape shape = CharacterShape::article();
  for (const Vec2d& point : shape.points()) reach = std::max(reach, side.dot(point));
  flight.from = corner - side * (reach - nearer) - along * random.between(2, 5);
  flight.way = along * random.between(8, 20);
  return flight;
}

TEST(NearMiss, is_told_from_a_hit_as_exact_arithmetic_does) {
  constexpr std::uint64_t seed = 71;
  constexpr int flights = sampled(20000);
  Random random(seed);
  int hits = 0;
  int too_near_to_tell = 0;
  for (int n = 0; n < flights; ++n) {
    const double nearer = random.either_sign_log_between(1e-16, 1e-1);
    const Flight flight = past_a_corner(random, nearer);
    const Scenery<double> scenery(flight.scenery);
    const Controller<double> controller(scenery, {});
    const std::span<const Vec2d> hull = controller.character().shape.hull();
    const compare::ExactScenery oracle(scenery.as_run(), {hull.begin(), hull.end()});
    Scratch<double> scratch = controller.make_scratch();
    StepReport<double> report;
    CharacterState<double> state;
    state.position = flight.from;
    state.velocity = flight.way;
    ASSERT_EQ(controller.step(state, {}, {{0, 0}, 1}, scratch, report), StepStatus::moved);

    const auto exact = oracle.time_of_impact(flight.from, flight.way, 0);
    const bool contact = !report.move.contacts.empty();
    hits += exact ? 1 : 0;
    if (exact) {
      ASSERT_TRUE(contact) << "seed " << seed << ", flight " << n << ", nearer by " << nearer;
      const double off = std::abs(static_cast<double>(exact->fraction) - report.move.contacts[0].fraction);
      ASSERT_LE(off * std::abs(flight.way.dot(exact->normal)), 1e-6) << "seed " << seed << ", flight " << n;
    } else if (contact) {
      ++too_near_to_tell;
      // The flight itself is placed to a few ulp of 100 m.
      ASSERT_GE(nearer, -called_a_contact - 1e-13) << "seed " << seed << ", flight " << n;
    } else {
      ASSERT_EQ(state.position, Vec2d(flight.from + flight.way)) << "seed " << seed << ", flight " << n;
    }
    const auto& path = report.move.path;
    for (std::size_t i = 1; i < path.size(); ++i)
      ASSERT_TRUE(oracle.met(path[i - 1].position, path[i].position).empty())
          << "seed " << seed << ", flight " << n << ", nearer by " << nearer;
  }
  EXPECT_GE(hits, flights * 3 / 10);
  EXPECT_LE(hits, flights * 7 / 10);
  EXPECT_GE(too_near_to_tell, flights / 10) << "the flights must come this near";
}

}  // namespace
}  // namespace paperproof::test
