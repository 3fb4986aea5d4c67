/// One-way platforms under octagon_sweep: the truth table.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace paperproof::stepping {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A platform from (-2, 0) to (2, 0), turned around the origin, that lets through what comes from below.
ColliderDef platform(double angle = 0) {
  const Vec2d end{2 * std::cos(angle), 2 * std::sin(angle)};
  return chain({-end, end}, Vec2d{0, 1});
}

struct Row {
  const char* words;
  Vec2d from;
  Vec2d way;
  bool blocked;
};

TEST(OneWay, blocks_what_comes_against_its_normal_from_wholly_above) {
  const double h = half_height;
  const double w = half_width;
  for (const Row& row : {
           Row{"falling onto it", {0, h + 1}, {0, -4}, true},
           Row{"falling onto it, slanting", {-1, h + 1}, {2, -4}, true},
           Row{"resting on it", {0, h + 5e-7}, {0, -0.1}, true},
           Row{"touching it exactly", {0, h}, {0, -0.1}, true},
           Row{"rising through it", {0, -h - 1}, {0, 4}, false},
           Row{"rising through it, slanting", {-1, -h - 1}, {2, 4}, false},
           Row{"rising while it is across it", {0, 0}, {0, 4}, false},
           Row{"falling while it is across it", {0, 0.1}, {0, -4}, false},
           Row{"falling with the feet an ulp below it", {0, std::nextafter(h, 0.0)}, {0, -0.1}, false},
           Row{"falling from below it", {0, -h - 0.1}, {0, -4}, false},
           Row{"walking into its end, feet below and head above", {-2 - w - 1, 0}, {4, 0}, false},
           Row{"walking along on it", {0, h + 5e-7}, {1, 0}, false},
           Row{"falling past its end", {2 + w + 1e-6, h + 1}, {0, -4}, false},
       }) {
    Stepper<double> mover({platform()});
    const MoveResult<double>& move = mover.at(row.from.x(), row.from.y()).fly(row.way.x(), row.way.y());
    EXPECT_EQ(!move.contacts.empty(), row.blocked) << row.words;
    if (row.blocked) {
      EXPECT_GE(move.position.y(), h) << row.words;
      EXPECT_LE(move.position.y(), h + 1e-6) << row.words;
      EXPECT_EQ(move.contacts[0].normal, Vec2d(0, 1)) << row.words;
      EXPECT_TRUE(move.grounded) << row.words;
    } else {
      EXPECT_EQ(move.position, Vec2d(row.from + row.way)) << row.words;
      EXPECT_EQ(move.velocity, row.way) << row.words;
    }
  }
}

TEST(OneWay, blocks_along_the_normal_of_a_slope) {
  for (const double degrees : {-40.0, -20.0, 20.0, 40.0}) {
    const double angle = degrees * degree;
    const Vec2d n{-std::sin(angle), std::cos(angle)};
    const Vec2d above = n * 2;
    const Vec2d below = n * -2;
    Stepper<double> faller({platform(angle)});
    const MoveResult<double>& fall = faller.at(above.x(), above.y()).fly(0, -4);
    ASSERT_FALSE(fall.contacts.empty()) << degrees;
    EXPECT_NEAR(fall.contacts[0].normal.dot(n), 1, 1e-15) << degrees;
    Stepper<double> riser({platform(angle)});
    EXPECT_TRUE(riser.at(below.x(), below.y()).fly(0, 4).contacts.empty()) << degrees;
    EXPECT_EQ(riser.state.position, Vec2d(below + Vec2d(0, 4))) << degrees;
    // Rising, and all the same against the normal: the slope is met from above, from the side.
    Stepper<double> slanting({platform(angle)});
    const Vec2d way = Vec2d{4 * (degrees > 0 ? 1 : -1), 0.5};
    ASSERT_LT(way.dot(n), 0);
    const Vec2d start = n * 1 - way * 0.1;
    EXPECT_FALSE(slanting.at(start.x(), start.y()).fly(way.x(), way.y()).contacts.empty()) << degrees;
  }
}

TEST(OneWay, is_jumped_through_and_landed_on) {
  Stepper<double> jumper({rectangle(-9, -4, 9, -3), platform()});
  jumper.gravity = {0, -30};
  jumper.at(0, -3 + half_height + 0.01).steps(20);
  ASSERT_TRUE(jumper.state.grounded);
  jumper.with_velocity(0, 17).state.grounded = false;  // 17² / 60 = 4.8 m up: through and beyond
  bool passed_freely = true;
  double highest = -3;
  for (int n = 0; n < 240; ++n) {
    const double rising = jumper.state.velocity.y();
    jumper.step();
    highest = std::max(highest, jumper.state.position.y());
    if (rising > 0.5) passed_freely = passed_freely && jumper.report.move.contacts.empty();
  }
  EXPECT_TRUE(passed_freely);
  EXPECT_GT(highest, half_height + 0.5);
  EXPECT_TRUE(jumper.state.grounded);
  EXPECT_GT(jumper.state.position.y(), half_height);
  EXPECT_LE(jumper.state.position.y(), half_height + 1e-6);
}

TEST(OneWay, a_jump_that_ends_across_it_falls_back) {
  Stepper<double> jumper({rectangle(-9, -4, 9, -3), platform()});
  jumper.gravity = {0, -30};
  jumper.at(0, -3 + half_height + 0.01).steps(20);
  jumper.with_velocity(0, 12).state.grounded = false;  // 12² / 60 = 2.4 m: the apex is at 0.03 m, across the platform
  jumper.steps(240);
  EXPECT_TRUE(jumper.state.grounded);
  EXPECT_LE(jumper.state.position.y(), -3 + half_height + 1e-6) << "back on the floor";
}

TEST(OneWay, the_other_direction_blocks_the_other_way) {
  // A trap door in a ceiling: what comes from above passes, what comes from below does not.
  Stepper<double> riser({chain({{-2, 0}, {2, 0}}, Vec2d{0, -1})});
  EXPECT_FALSE(riser.at(0, -2).fly(0, 4).contacts.empty());
  Stepper<double> faller({chain({{-2, 0}, {2, 0}}, Vec2d{0, -1})});
  EXPECT_TRUE(faller.at(0, 2).fly(0, -4).contacts.empty());
  // A gate: only to the right.
  for (const double way : {4.0, -4.0}) {
    Stepper<double> walker({chain({{0, -2}, {0, 2}}, Vec2d{1, 0})});
    EXPECT_EQ(walker.at(-way / 2, 0).fly(way, 0).contacts.empty(), way > 0);
  }
}

TEST(OneWay, a_segment_along_its_direction_blocks_nothing) {
  for (const Vec2d& way : {Vec2d{4, 0}, Vec2d{-4, 0}, Vec2d{0, 4}, Vec2d{0, -4}}) {
    Stepper<double> mover({chain({{0, -1}, {0, 1}}, Vec2d{0, 1})});
    const Vec2d from = way * -0.5;
    EXPECT_TRUE(mover.at(from.x(), from.y()).fly(way.x(), way.y()).contacts.empty()) << way.transpose();
  }
}

/// A platform of half a metre with its top at y = 0.
ColliderDef slab() {
  ColliderDef slab = rectangle(-2, -0.5, 2, 0);
  slab.one_way = Vec2d{0, 1};
  return slab;
}

/// As `Stepper::fly`, over a solid and over its top as a chain: the same bits.
void expect_flies_as_over_a_chain(const ColliderDef& solid, const ColliderDef& top, const Vec2d& from,
                                  const Vec2d& way) {
  Stepper<double> over_solid({solid});
  Stepper<double> over_chain({top});
  const MoveResult<double>& a = over_solid.at(from.x(), from.y()).fly(way.x(), way.y());
  const MoveResult<double>& b = over_chain.at(from.x(), from.y()).fly(way.x(), way.y());
  EXPECT_EQ(a.position, b.position) << from.transpose() << " by " << way.transpose();
  EXPECT_EQ(a.contacts.size(), b.contacts.size()) << from.transpose() << " by " << way.transpose();
  EXPECT_EQ(a.grounded, b.grounded);
}

TEST(OneWaySolid, blocks_as_its_top_does_and_nowhere_else) {
  int held = 0;
  for (double x = -4; x <= 4; x += 0.25)
    for (double y = -3; y <= 3; y += 0.25)
      for (const Vec2d& way : {Vec2d{0, -4}, Vec2d{0, 4}, Vec2d{4, 0}, Vec2d{-4, 0}, Vec2d{3, -3}, Vec2d{-3, 2}}) {
        expect_flies_as_over_a_chain(slab(), platform(), {x, y}, way);
        Stepper<double> mover({slab()});
        held += !mover.at(x, y).fly(way.x(), way.y()).contacts.empty();
      }
  EXPECT_GT(held, 200);
  Stepper<double> walker({slab()});
  EXPECT_TRUE(walker.at(-4, 0).fly(8, 0).contacts.empty()) << "through its side";
  EXPECT_EQ(walker.state.position, Vec2d(4, 0));
}

TEST(OneWaySolid, is_jumped_through_and_landed_on) {
  Stepper<double> jumper({rectangle(-9, -4, 9, -3), slab()});
  jumper.gravity = {0, -30};
  jumper.at(0, -3 + half_height + 0.01).steps(20);
  jumper.with_velocity(0, 17).state.grounded = false;
  for (int n = 0; n < 240; ++n) {
    const double rising = jumper.state.velocity.y();
    jumper.step();
    if (rising > 0.5) {
      ASSERT_TRUE(jumper.report.move.contacts.empty()) << n;
    }
  }
  EXPECT_TRUE(jumper.state.grounded);
  EXPECT_EQ(jumper.report.move.ground.collider, 1U);
  EXPECT_NEAR(jumper.state.position.y(), half_height + 5e-7, 5e-7);
  const Vec2d rest = jumper.state.position;
  jumper.steps(600);
  EXPECT_EQ(jumper.state.position, rest);
  jumper.step({.move = std::nullopt, .jump = false, .drop = true});
  ASSERT_EQ(jumper.report.dropped_through.size(), 1U);
  EXPECT_EQ(jumper.report.dropped_through[0], 1U);
  jumper.steps(100);
  EXPECT_NEAR(jumper.state.position.y(), -3 + half_height + 5e-7, 5e-7) << "on the floor";
}

TEST(OneWaySolid, that_is_concave_holds_on_each_of_its_tops) {
  // A table upside down: two rims at y = 2, a floor at y = 0, 4 m wide.
  const auto bowl = [] {
    ColliderDef def = polygon({{-3, -1}, {3, -1}, {3, 2}, {2, 2}, {2, 0}, {-2, 0}, {-2, 2}, {-3, 2}});
    def.one_way = Vec2d{0, 1};
    return def;
  };
  for (const auto& [x, top] : {std::pair{0.0, 0.0}, {-2.5, 2.0}, {2.5, 2.0}}) {
    Stepper<double> faller({bowl()});
    faller.at(x, 5).steps(200);
    EXPECT_TRUE(faller.state.grounded);
    EXPECT_NEAR(faller.state.position.y(), top + half_height + 5e-7, 5e-7);
  }
  Stepper<double> walker({bowl()});
  walker.at(0, 3).steps(100);
  walker.steps(60, {.move = 1.0});
  EXPECT_GT(walker.state.position.x(), 3) << "the inner sides of the rims hold nobody";
}

TEST(OneWaySolid, whose_top_bends_is_one_surface_and_its_hole_is_nothing) {
  ColliderDef roof = polygon({{-3, -2}, {3, -2}, {3, -0.75}, {0, 0}, {-3, -0.75}});
  roof.holes = {{{-1, -1.5}, {1, -1.5}, {1, -1}, {-1, -1}}};
  roof.one_way = Vec2d{0, 1};
  const ColliderDef top = chain({{-3, -0.75}, {0, 0}, {3, -0.75}}, Vec2d{0, 1});
  for (double x = -4; x <= 4; x += 0.25)
    for (double y = -3; y <= 3; y += 0.25)
      for (const Vec2d& way : {Vec2d{0, -4}, Vec2d{0, 4}, Vec2d{3, -1}, Vec2d{-3, -1}})
        expect_flies_as_over_a_chain(roof, top, {x, y}, way);
}

TEST(OneWaySolid, beside_another_is_walked_over_like_one_and_dropped_through) {
  ColliderDef left = rectangle(-2, -0.5, 0, 0);
  ColliderDef right = rectangle(0, -0.5, 2, 0);
  left.one_way = right.one_way = Vec2d{0, 1};
  Stepper<double> walker({left, right});
  walker.gravity = {0, -30};
  walker.at(-1.5, half_height + 0.01).steps(20);
  walker.steps(30, {.move = 1.0});
  EXPECT_GT(walker.state.position.x(), 0.5);
  EXPECT_EQ(walker.state.velocity.x(), CharacterDef{}.walk_speed);
  EXPECT_TRUE(walker.state.grounded);
  walker.at(0, half_height + 5e-7).with_velocity(0, 0);
  walker.steps(10);
  walker.step({.move = std::nullopt, .jump = false, .drop = true});
  EXPECT_EQ(walker.report.dropped_through.size(), 2U);
}

TEST(OneWaySolid, that_moves_carries_who_stands_on_it_and_passes_who_is_beneath) {
  ColliderDef lift = slab();
  lift.mover = 0;
  Stepper<double> rider({lift});
  rider.gravity = {0, -30};
  rider.at(0, half_height + 0.01).steps(20);
  for (int n = 0; n < 60; ++n) {
    rider.step_with_mover_by(0.01, 0.02);
    ASSERT_TRUE(rider.state.grounded) << n;
  }
  EXPECT_NEAR(rider.state.position.x(), 0.6, 1e-6);
  EXPECT_NEAR(rider.state.position.y(), 1.2 + half_height, 2e-6);
  // It comes down over who stands below: nobody is crushed, and it is not in the way.
  Stepper<double> below({rectangle(-9, -4, 9, -3), lift});
  below.gravity = {0, -30};
  below.at(0, -3 + half_height + 0.01).steps(20);
  const Vec2d rest = below.state.position;
  for (int n = 0; n < 100; ++n) {
    ASSERT_EQ(below.step_with_mover_by(0, -0.02), StepStatus::moved) << n;
    ASSERT_EQ(below.state.position, rest) << n;
  }
}

/// Holding right, until the character falls past the height `below`, for at most ten seconds.
/// @return the lowest the middle of its bottom was above the line from the start until it was beyond `end`.
double walk_to_the_end(Stepper<double>& walker, const std::vector<Vec2d>& line, double end) {
  double lowest = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 600 && walker.state.position.x() < end; ++n) {
    walker.step({.move = 1.0, .jump = false, .drop = false});
    const double x = walker.state.position.x();
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (x < line[i - 1].x() || x > line[i].x()) continue;
      const double share = (x - line[i - 1].x()) / (line[i].x() - line[i - 1].x());
      const double height = line[i - 1].y() + share * (line[i].y() - line[i - 1].y());
      lowest = std::min(lowest, walker.state.position.y() - half_height - height);
    }
  }
  return lowest;
}

TEST(OneWaySurface, with_a_peak_holds_who_is_dropped_on_it) {
  Stepper<double> faller({chain({{-4, -1}, {0, 0}, {4, -1}}, Vec2d{0, 1})});
  faller.gravity = {0, -30};
  faller.at(0, 1).steps(60, {.move = 0.0});
  EXPECT_TRUE(faller.state.grounded);
  EXPECT_GT(faller.state.position.y(), half_height);
  EXPECT_LE(faller.state.position.y(), half_height + 1e-6);
  ASSERT_FALSE(faller.report.move.contacts.empty());
  EXPECT_EQ(faller.report.move.contacts[0].normal, Vec2d(0, 1)) << "the octagon's bottom, on the vertex";
}

TEST(OneWaySurface, is_walked_over_to_its_end) {
  std::vector<Vec2d> noise;
  for (int i = 0; i <= 32; ++i) noise.emplace_back(-4 + i * 0.25, (i * 7 % 3 - 1) * 1e-6);
  std::vector<Vec2d> arch;
  for (int i = 0; i <= 16; ++i)
    arch.emplace_back(-4 * std::cos(std::numbers::pi * i / 16), 1.5 * std::sin(std::numbers::pi * i / 16));
  for (const std::vector<Vec2d>& line : {std::vector<Vec2d>{{-4, 0}, {0, 1}, {4, 0}}, noise, arch}) {
    for (const bool in_parts : {false, true}) {
      std::vector<ColliderDef> colliders{chain(line, Vec2d{0, 1})};
      if (in_parts) {
        colliders.clear();
        for (std::size_t i = 1; i < line.size(); ++i)
          colliders.push_back(i % 2 == 0 ? chain({line[i - 1], line[i]}, Vec2d{0, 1})
                                         : chain({line[i], line[i - 1]}, Vec2d{0, 1}));
      }
      Stepper<double> walker(std::move(colliders));
      walker.gravity = {0, -30};
      walker.at(-2, 3).steps(30);
      EXPECT_GT(walk_to_the_end(walker, line, 4), 0) << line.size() << " points, in parts: " << in_parts;
      EXPECT_GE(walker.state.position.x(), 4);
      EXPECT_LT(walker.state.position.y(), half_height + 0.5) << "and beyond it, down";
    }
  }
}

TEST(OneWaySurface, is_cut_where_it_turns_back_and_not_joined_where_three_chains_meet) {
  // The lower run of a hairpin goes back under the upper one: who is below the upper one is held by the lower one.
  Stepper<double> between({chain({{-2, 2}, {2, 2}, {2.5, 1}, {-2, 0}}, Vec2d{0, 1})});
  between.gravity = {0, -30};
  between.at(-1, 0.3 + half_height).steps(60);
  EXPECT_GT(between.state.position.y() - half_height, 0);
  EXPECT_LT(between.state.position.y() - half_height, 1);
  // A peak of two chains holds. Where a third one begins in it none goes on from another, and each is thought on
  // straight: upon the vertex the octagon is above none of them.
  const ColliderDef left = chain({{-4, -1}, {0, 0}}, Vec2d{0, 1});
  const ColliderDef right = chain({{0, 0}, {4, -1}}, Vec2d{0, 1});
  const ColliderDef third = chain({{0, 0}, {4, -8}}, Vec2d{0, 1});
  for (const bool three : {false, true}) {
    std::vector<ColliderDef> colliders{left, right};
    if (three) colliders.push_back(third);
    Stepper<double> faller(std::move(colliders));
    faller.gravity = {0, -30};
    faller.at(0, 1).steps(60, {.move = 0.0});
    EXPECT_EQ(faller.state.grounded, !three);
    EXPECT_EQ(faller.state.position.y() > half_height, !three);
  }
}

/// Steps of a character that stands on the platform, `drops` of them with the button down.
template <class Scalar>
void stand_and_drop(Stepper<Scalar>& character, int drops) {
  character.gravity = {0, -30};
  character.at(0, half_height + 0.01).steps(20);
  ASSERT_TRUE(character.state.grounded);
  character.steps(drops, {.move = std::nullopt, .jump = false, .drop = true});
}

/// Every technique that knows one-way chains.
class Dropping : public testing::TestWithParam<std::string_view> {};

TEST_P(Dropping, leaves_the_ledge_and_is_held_by_the_next_one_once_the_button_is_up) {
  Stepper<double> character({platform(), chain({{-2, -2}, {2, -2}}, Vec2d{0, 1}), rectangle(-9, -5, 9, -4)}, {},
                            GetParam());
  stand_and_drop(character, 1);
  EXPECT_FALSE(character.state.grounded);
  ASSERT_EQ(character.report.dropped_through.size(), 1U);
  EXPECT_EQ(character.report.dropped_through[0], 0U);
  for (int n = 0; n < 100; ++n) {
    character.step();
    ASSERT_TRUE(character.report.dropped_through.empty()) << n;
  }
  EXPECT_TRUE(character.state.grounded);
  EXPECT_NEAR(character.state.position.y(), -2 + half_height, 0.04);
}

TEST_P(Dropping, goes_through_every_ledge_while_the_button_is_down_and_through_nothing_else) {
  Stepper<double> character({platform(), chain({{-2, -2}, {2, -2}}, Vec2d{0, 1}), rectangle(-9, -5, 9, -4)}, {},
                            GetParam());
  stand_and_drop(character, 0);
  std::vector<ColliderIndex> passed;
  for (int n = 0; n < 100; ++n) {
    character.step({.move = std::nullopt, .jump = false, .drop = true});
    for (const ColliderIndex chain : character.report.dropped_through) passed.push_back(chain);
  }
  EXPECT_EQ(passed, (std::vector<ColliderIndex>{0, 1}));
  EXPECT_TRUE(character.state.grounded) << "on the floor";
  EXPECT_NEAR(character.state.position.y(), -4 + half_height, 0.04);
}

TEST_P(Dropping, goes_through_a_solid_ledge_to_the_floor) {
  Stepper<double> character({slab(), rectangle(-9, -5, 9, -4)}, {}, GetParam());
  stand_and_drop(character, 1);
  ASSERT_EQ(character.report.dropped_through.size(), 1U);
  character.steps(100);
  EXPECT_TRUE(character.state.grounded);
  EXPECT_NEAR(character.state.position.y(), -4 + half_height, 0.04);
}

INSTANTIATE_TEST_SUITE_P(Techniques, Dropping,
                         testing::Values("octagon_sweep", "speculative", "speculative_march", "bounding_box",
                                         "discrete"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST(DroppingOff, from_a_ledge_that_rises_keeps_its_speed) {
  ColliderDef lift = platform();
  lift.mover = 0;
  Stepper<double> rider({lift});
  rider.gravity = {0, -30};
  rider.at(0, half_height + 0.01).steps(20);
  for (int n = 0; n < 10; ++n) rider.step_with_mover_by(0, 2.0 / 60);
  ASSERT_EQ(rider.state.ride.ground, 0U);
  rider.step_with_mover_by(0, 2.0 / 60, {.move = std::nullopt, .jump = false, .drop = true});
  EXPECT_EQ(rider.state.ride.ground, Ride<double>::none);
  EXPECT_NEAR(rider.state.velocity.y(), 2 - 30.0 / 60, 1e-12);
  ASSERT_EQ(rider.report.dropped_through.size(), 1U);
  rider.step_with_mover_by(0, 2.0 / 60);
  EXPECT_FALSE(rider.state.grounded) << "partly below it: the ledge is not met again";
}

TEST(DroppingOff, names_only_what_is_passed) {
  const ColliderDef beside = chain({{half_width + 0.01, 0}, {3, 0}}, Vec2d{0, 1});
  const ColliderDef other_way = chain({{-2, -0.2}, {2, -0.2}}, Vec2d{0, -1});
  Stepper<double> character({platform(), beside, other_way});
  character.gravity = {0, -30};
  character.at(0, half_height + 0.5);
  character.state.velocity = {0, -100};
  character.step({.move = std::nullopt, .jump = false, .drop = true});
  ASSERT_EQ(character.report.dropped_through.size(), 1U);
  EXPECT_EQ(character.report.dropped_through[0], 0U);
}

TEST(DroppingOff, comes_out_of_a_solid_through_a_ledge_that_holds_it_otherwise) {
  // In a box of 4 m by 3 m: down is nearest, and there is a ledge under the feet; right is next.
  for (const bool drops : {true, false}) {
    Stepper<double> character({rectangle(-2, -1.5, 2, 1.5), chain({{-9, -2}, {9, -2}}, Vec2d{0, 1})});
    character.gravity = {0, 0};
    character.at(1.1, -1.3);
    ASSERT_GT(character.state.position.y() - half_height, -2) << "wholly above the ledge";
    EXPECT_EQ(character.step({.move = std::nullopt, .jump = false, .drop = drops}), StepStatus::moved);
    const Vec2d out = drops ? Vec2d{1.1, -1.5 - half_height} : Vec2d{2 + half_width, -1.3};
    EXPECT_LE((character.state.position - out).cwiseAbs().maxCoeff(), 1e-6) << drops;
    const auto& passed = character.report.dropped_through;
    EXPECT_EQ(std::vector<ColliderIndex>(passed.begin(), passed.end()), std::vector<ColliderIndex>(drops ? 1 : 0, 1U));
  }
}

TEST(DroppingOff, from_the_ground_beside_a_ledge_does_not_stand_on_it) {
  for (const bool drops : {true, false}) {
    Stepper<double> character({rectangle(-4, -1, 0, 0), chain({{0, 0}, {4, 0}}, Vec2d{0, 1})});
    character.gravity = {0, -1};
    character.dt = 1;
    character.at(-1, half_height + 5e-7).with_velocity(3, 0);
    character.step({.move = std::nullopt, .jump = false, .drop = drops});
    EXPECT_NEAR(character.state.position.x(), 2, 1e-12) << "along the ground, and over the ledge";
    EXPECT_NEAR(character.state.position.y(), half_height, 1e-6);
    EXPECT_EQ(character.state.grounded, !drops);
  }
}

}  // namespace
}  // namespace paperproof::stepping
