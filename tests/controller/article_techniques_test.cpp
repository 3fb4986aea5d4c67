/// What several techniques do with the same situations, and what they refuse. What they do at a chain and among movers,
/// and how they slide, is in tests/situations/techniques.json.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace paperproof::stepping {
namespace {

TEST(EveryTechnique, ends_exactly_where_it_wants_in_the_free_and_has_contacts_at_fraction_zero_where_it_is_held) {
  const std::vector<ColliderDef> corner{box(-4, -1, 4, 0), box(-4, 0, -1, 4), box(1, 0, 4, 4)};
  for (const std::string_view kind : technique_names()) {
    if (kind == "octagon_sweep") continue;  // is the controller itself
    SCOPED_TRACE(kind);
    Stepper stepper(corner, {}, kind);
    EXPECT_EQ(make_technique({.name = kind}, *stepper.scenery, {})->name(), kind);
    if (kind == "grid") continue;  // stands in the middle of its square, beside nothing
    EXPECT_EQ(stepper.fly_from({0.123, 6.456}, {1.3, -0.7}).position, Vec2d(0.123, 6.456) + Vec2d(1.3, -0.7));
    EXPECT_TRUE(stepper.report.move.contacts.empty());
    for (const double wall : {-1.0, 1.0}) {
      const auto& contacts = stepper.fly_from({wall * (1 - half_width), half_height}, {wall * px, -px}).contacts;
      EXPECT_FALSE(contacts.empty());
      for (const Contact& contact : contacts) {
        EXPECT_GE(contact.fraction, 0);
        EXPECT_FALSE(std::signbit(contact.fraction)) << "no negative zero";
      }
    }
  }
}

TEST(EveryTechnique, names_a_knob_that_is_out_of_range) {
  std::vector<std::pair<ArticleKnobs, std::string>> cases{{{.iterations = 0}, "iterations:"},
                                                          {{.points = 6}, "points:"}};
  for (const double bad : {0.0, nan, infinity}) cases.push_back({{.unit = bad}, "unit:"});
  for (const double bad : {0.0, -1.0, 1e-9, nan, infinity}) cases.push_back({{.square = bad}, "square:"});
  for (const double bad : {0.0, -1.0, 1001.0, nan})
    cases.push_back({{.raster_pixels_per_metre = bad}, "raster_pixels_per_metre:"});
  for (const int bad : {0, -4, 4097}) cases.push_back({{.pixels_per_tile = bad}, "pixels_per_tile:"});
  const Scenery square(SceneryDef{{box(0, 0, 1, 1)}});
  for (const std::string_view kind : technique_names()) {
    SCOPED_TRACE(kind);
    const auto message = [&](const ArticleKnobs& knobs) {
      return refusal_by<std::invalid_argument>(
          [&] { static_cast<void>(make_controller(square, CharacterDef{}, {.name = kind, .article = knobs})); });
    };
    EXPECT_EQ(message({}), "");
    for (const auto& [bad, begins] : cases) EXPECT_EQ(message(bad).substr(0, begins.size()), begins);
  }
}

ColliderDef conveyor(ColliderDef def, double speed) {
  def.surface_speed = speed;
  return def;
}

constexpr std::array moving_kinds{"discrete", "penetration_resolution", "speculative_march", "speculative"};

TEST(Movers, that_carry_and_crush_make_no_technique_take_memory) {
  // The floor goes to and fro. The ceiling comes down by 1/64 m in each step, of which 10.4 are free.
  const double free = 10.4 / 64;
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    Stepper rider({box(-9, -3, 9, 0, 0), box(-9, 2 * half_height + free, 9, 9, 1)}, {}, kind);
    rider.gravity = {0, -px};
    rider.dt = 1;
    rider.at(0, half_height).report.reserve(8);
    const std::size_t before = tests::allocations();
    for (int step = 1; step <= 30; ++step) {
      const double aside = step % 2 == 1 ? 0.1 : 0;
      rider.movers[0] = {{0.1 - aside, 0}, {aside, 0}};
      rider.movers[1] = {{0, (1 - step) / 64.0}, {0, -step / 64.0}};
      rider.step();
    }
    EXPECT_EQ(tests::allocations(), before);
    EXPECT_EQ(rider.report.status, StepStatus::crushed);
  }
}

TEST(MovingRefusals, of_steps_that_conveyors_make_too_long) {
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    Stepper by_conveyor({conveyor(box(-9, -1, 9, 0), 1e300)}, {}, kind);
    EXPECT_EQ(by_conveyor.fly_from({0, 1}, {0, -2}).status, StepStatus::out_of_range);
    EXPECT_EQ(by_conveyor.report.move.position, Vec2d(0, 1));
  }
}

TEST(MovingRefusals, of_what_a_technique_cannot_express_say_so) {
  const auto refusal = [](std::string_view kind, const ColliderDef& collider) {
    return refusal_by<NotExpressible>([&] { Stepper({collider}, {}, kind); });
  };
  const ColliderDef mover = box(0, 0, 1, 1, 0);
  const ColliderDef belt = conveyor(box(0, 0, 1, 1), 1);
  for (const std::string_view kind : {"grid", "pixel_colour", "pixel_tile", "mask", "wind_back"})
    for (const ColliderDef& each : {mover, belt})
      EXPECT_EQ(refusal(kind, each), std::string(kind) + " is for scenery that stands still");
  for (const std::string_view kind : {"wind_back", "penetration_resolution", "speculative", "discrete"})
    EXPECT_EQ(refusal(kind, compare::circle({0, 0}, 1)),
              std::string(kind) + " knows no circles: make a polygon of them");
  EXPECT_EQ(refusal("bounding_box", mover), "");
  EXPECT_EQ(refusal("bounding_box", belt), "bounding_box carries nobody: there is a conveyor");
}

/// A long double holds every sum of doubles of these sizes, but for less than any gap.
bool overlap(const Box2& piece, const Vec2d& position, const Box2& character) {
  const auto wide = [](const Vec2d& v) { return v.cast<long double>(); };
  return (wide(piece.lower) - wide(position) - wide(character.upper)).maxCoeff() < 0 &&
         (wide(piece.upper) - wide(position) - wide(character.lower)).minCoeff() > 0;
}

/// In random scenes.
TEST(BoundingBox, ends_free_to_the_last_bit_and_moves_no_further_than_asked) {
  Random random(41);
  int hits = 0;
  int tried = 0;
  const int scenes = test::sampled(200);
  for (int scene = 0; scene < scenes; ++scene) {
    std::vector<ColliderDef> boxes;
    for (int i = 0; i < 30; ++i) {
      const Vec2d low = random.point(9);
      const Vec2d high = low + Vec2d{random.between(0.1, 2), random.between(0.1, 2)};
      boxes.push_back(box(low.x(), low.y(), high.x(), high.y()));
    }
    Stepper stepper(boxes, {}, TechniqueDef{.name = "bounding_box", .article = {.iterations = 64}});
    const auto free = [&](const Vec2d& position) {
      return std::ranges::none_of(stepper.scenery->boxes(), [&](const Box2& piece) {
        return overlap(piece, position, CharacterShape::article().box());
      });
    };
    for (int sweep = 0; sweep < 100; ++sweep) {
      const Vec2d start = random.point(9);
      if (!free(start)) continue;
      const Vec2d wanted = random.point(4);
      const Vec2d end = start + wanted;
      const MoveResult& result = stepper.fly_from(start, wanted);
      ASSERT_TRUE(free(result.position)) << "seed 41, scene " << scene << ", sweep " << sweep;
      ASSERT_EQ(result.position, result.position.cwiseMax(start.cwiseMin(end)).cwiseMin(start.cwiseMax(end)))
          << "seed 41, scene " << scene << ", sweep " << sweep;
      ASSERT_EQ(result.contacts.empty(), result.position == end) << "seed 41, scene " << scene << ", sweep " << sweep;
      ++tried;
      hits += result.contacts.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(hits, tried * 3 / 10);
  EXPECT_LT(hits, tried * 7 / 10);
}

}  // namespace
}  // namespace paperproof::stepping
