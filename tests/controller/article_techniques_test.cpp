/// What several techniques do with the same situations.
#include "controller/passenger.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace paperproof::article_tests {
namespace {

constexpr double gap = Tolerances<double>{}.stop;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// How a technique that keeps the free component stops.
struct Stopping {
  std::string_view kind;
  double most = 0;         ///< Of the gap that it leaves [m];
  bool is_a_stop = false;  ///< or the gap is always that of `Tolerances::stop`.
  bool knows_when = true;  ///< Otherwise its contacts are at the end of the step.
  bool has_corner = true;  ///< The way has a corner where one component stops.
};
constexpr std::array all_stopping{
    Stopping{.kind = "pixel_colour"},
    Stopping{.kind = "pixel_tile"},
    Stopping{.kind = "mask", .has_corner = false},
    Stopping{.kind = "bounding_box", .knows_when = false, .has_corner = false},
    Stopping{.kind = "discrete", .is_a_stop = true, .has_corner = false},
    Stopping{.kind = "penetration_resolution", .most = px, .knows_when = false, .has_corner = false},
    Stopping{.kind = "speculative_march", .most = px},
    Stopping{.kind = "speculative"},
};

template <class Scalar>
class TechniqueIn : public testing::Test {
 protected:
  static constexpr double rounding = 4 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());

  static void expect_gap(double found, const Stopping& by) {
    const double stop = by.is_a_stop ? static_cast<double>(Tolerances<Scalar>{}.stop) : 0;
    EXPECT_GE(found, stop - rounding);
    EXPECT_LE(found, by.most + stop + rounding);
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TechniqueIn, Scalars, );

TYPED_TEST(TechniqueIn, leaves_the_gap_of_the_technique_at_a_wall_on_any_side) {
  struct Case {
    Side side;
    ColliderDef wall;
    Vec2d out;
  };
  const double away = 3 * px;
  const std::array cases{
      Case{Side::left, rectangle(-4, -9, -half_width - away, 9), {-1, 0}},
      Case{Side::right, rectangle(half_width + away, -9, 4, 9), {1, 0}},
      Case{Side::bottom, rectangle(-9, -4, 9, -half_height - away), {0, -1}},
      Case{Side::top, rectangle(-9, half_height + away, 9, 4), {0, 1}},
  };
  for (const Stopping& by : all_stopping) {
    SCOPED_TRACE(by.kind);
    for (const Case& each : cases) {
      Rig<TypeParam> rig(by.kind, {each.wall});
      const MoveResult<TypeParam>& result = rig.move({0, 0}, 10.3 * px * each.out);
      const Vec2d end = result.position.template cast<double>();
      const double left = away - end.dot(each.out);
      this->expect_gap(left, by);
      EXPECT_EQ(end.cwiseAbs().minCoeff(), 0);
      EXPECT_TRUE(result.velocity.isZero(0));
      EXPECT_EQ(result.grounded, each.side == Side::bottom);
      ASSERT_EQ(result.contacts.size(), 1U);
      EXPECT_EQ(result.contacts[0].side, each.side);
      EXPECT_EQ(result.contacts[0].normal, (-each.out).template cast<TypeParam>());
      EXPECT_NEAR(result.contacts[0].fraction, by.knows_when ? (3 - by.most / px / 2) / 10.3 : 1,
                  by.most / px / 2 / 10.3 + 1e-6);
      EXPECT_NEAR(result.contacts[0].separation, left, this->rounding);
      if (by.most > 0) continue;
      // Pressing on changes nothing, even by a fraction of a pixel.
      rig.move(end, 0.1 * px * each.out);
      EXPECT_LE((result.position.template cast<double>() - end).norm(), by.is_a_stop ? this->rounding : 0);
      EXPECT_EQ(result.contacts.size(), 1U);
    }
  }
}

TYPED_TEST(TechniqueIn, keeps_the_free_component_and_records_a_corner_in_the_way) {
  for (const Stopping& by : all_stopping) {
    SCOPED_TRACE(by.kind);
    Rig<TypeParam> rig(by.kind, {rectangle(-9, -9, 9, 0)});
    const MoveResult<TypeParam>& result = rig.move({0, half_height + 4 * px}, {10 * px, -10 * px});
    EXPECT_NEAR(result.position.x(), 10 * px, this->rounding);
    this->expect_gap(result.position.y() - half_height, by);
    EXPECT_EQ(result.velocity, Vec2<TypeParam>(10 * px, 0));
    ASSERT_EQ(result.path.size(), by.has_corner ? 3U : 2U);
    EXPECT_EQ(result.path.back().position, result.position);
    if (!by.has_corner || by.most > 0) continue;
    EXPECT_NEAR(result.path[1].fraction, 0.4, 1e-6);
    EXPECT_NEAR(result.path[1].position.x(), 4 * px, 1e-6);
    EXPECT_NEAR(result.path[1].position.y(), half_height, this->rounding);
  }
}

TEST(EveryTechnique, ends_exactly_where_it_wants_in_the_free_and_has_contacts_at_fraction_zero_where_it_is_held) {
  const std::vector<ColliderDef> corner{rectangle(-4, -1, 4, 0), rectangle(-4, 0, -1, 4), rectangle(1, 0, 4, 4)};
  for (const std::string_view kind : technique_names()) {
    SCOPED_TRACE(kind);
    Rig<double> rig(kind, corner);
    EXPECT_EQ(rig.technique->name(), kind);
    if (kind == "grid") continue;  // stands in the middle of its square, beside nothing
    EXPECT_EQ(rig.move({0.123, 6.456}, {1.3, -0.7}).position, Vec2d(0.123, 6.456) + Vec2d(1.3, -0.7));
    EXPECT_TRUE(rig.result.contacts.empty());
    for (const double wall : {-1.0, 1.0}) {
      rig.move({wall * (1 - half_width), half_height}, {wall * px, -px});
      EXPECT_FALSE(rig.result.contacts.empty());
      for (const Contact<double>& contact : rig.result.contacts) {
        EXPECT_GE(contact.fraction, 0);
        EXPECT_FALSE(std::signbit(contact.fraction)) << "no negative zero";
      }
    }
  }
}

TEST(EveryTechnique, refuses_a_step_out_of_range_or_with_too_many_units_and_changes_nothing) {
  for (const std::string_view kind : technique_names()) {
    SCOPED_TRACE(kind);
    Rig<double> rig(kind, {rectangle(0, 0, 3, 3)});
    MoveRequest<double> request;
    request.position = {9.5, 9.625};
    request.technique_memory = {0.25, -0.125};
    const auto status_of = [&](const Vec2d& displacement) {
      request.displacement = displacement;
      rig.technique->move(request, rig.scratch, rig.result);
      return rig.result.status;
    };
    for (const Vec2d& displacement : {Vec2d{3e6, 0}, Vec2d{-3e6, 0}, Vec2d{nan, 0}, Vec2d{0, nan}}) {
      EXPECT_EQ(status_of(displacement), MoveStatus::out_of_range);
      EXPECT_EQ(rig.result.position, request.position);
      const bool has_a_memory = kind == "grid";
      EXPECT_TRUE(!has_a_memory || rig.result.technique_memory == request.technique_memory);
      EXPECT_EQ(rig.result.path.size(), 2U);
    }
    const bool searches = find_technique(kind)->unit != nullptr && kind != "grid" && kind != "speculative";
    EXPECT_EQ(status_of({9e5, 0}) == MoveStatus::refused, searches);
    EXPECT_TRUE(!searches || rig.result.position == request.position);
  }
}

TEST(EveryTechnique, names_a_knob_that_is_out_of_range) {
  struct Case {
    ArticleKnobs knobs;
    std::string begins;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Case> cases{{{.unit = 0}, "unit:"},
                          {{.unit = infinity}, "unit:"},
                          {{.unit = nan}, "unit:"},
                          {{.iterations = 0}, "iterations:"},
                          {{.points = 6}, "points:"}};
  for (const double bad : {0.0, -1.0, 1e-9, nan, infinity}) cases.push_back({{.square = bad}, "square:"});
  for (const double bad : {0.0, -1.0, 1001.0, nan})
    cases.push_back({{.raster_pixels_per_metre = bad}, "raster_pixels_per_metre:"});
  for (const int bad : {0, -4, 4097}) cases.push_back({{.pixels_per_tile = bad}, "pixels_per_tile:"});
  for (const std::string_view kind : technique_names()) {
    SCOPED_TRACE(kind);
    const auto message = [&](const ArticleKnobs& knobs) {
      return refusal_by<std::invalid_argument>([&] { Rig<double>(kind, {rectangle(0, 0, 1, 1)}, knobs); });
    };
    EXPECT_EQ(message({}), "");
    for (const Case& each : cases) EXPECT_EQ(message(each.knobs).substr(0, each.begins.size()), each.begins);
  }
}

/// @param kind the grid knows squares alone, and pictures no one-way chains.
std::vector<ColliderDef> rough_ground(Random& random, std::string_view kind) {
  std::vector<ColliderDef> ground;
  for (int i = -10; i < 10; ++i) ground.push_back(rectangle(i, -1, i + 1, 0));
  for (int i = -9; i < 9; i += 3) ground.push_back(rectangle(i, 0, i + 1, 1));
  if (kind == "grid") return ground;
  for (int i = 0; i < 10; ++i) {
    const double x = random.between(-9, 8);
    ground.push_back({.points = {{x, 0.1}, {x + random.between(0.3, 1), 0.1}, {x, random.between(0.3, 2)}}});
  }
  ground.push_back(chain({{-9, 1}, {-7, 1.5}, {-5, 1}}));
  if (!find_technique(kind)->draws_level) ground.push_back(chain({{5, 1}, {9, 1}}, Vec2d{0, 1}));
  return ground;
}

TYPED_TEST(TechniqueIn,
           gives_over_rough_ground_the_same_bits_by_tree_and_all_pairs_a_way_in_order_and_takes_no_memory) {
  for (const std::string_view kind : technique_names()) {
    SCOPED_TRACE(kind);
    Random random(5);
    const std::vector<ColliderDef> ground = rough_ground(random, kind);
    Rig<TypeParam> tree({.name = kind, .broad_phase = BroadPhaseKind::tree}, ground);
    Rig<TypeParam> all({.name = kind, .broad_phase = BroadPhaseKind::all_pairs}, ground);
    const std::size_t before = tests::allocations();
    int contacts = 0;
    int corners = 0;
    for (int step = 0; step < 2000; ++step) {
      const Vec2d start{random.between(-9, 9), random.between(0, 3)};
      const Vec2d displacement{random.between(-2, 2), random.between(-2, 2)};
      const MoveResult<TypeParam>& result = tree.move(start, displacement);
      all.move(start, displacement);
      ASSERT_EQ(result.position, all.result.position) << "seed 5, step " << step;
      ASSERT_EQ(result.velocity, all.result.velocity) << "seed 5, step " << step;
      ASSERT_EQ(result.contacts.size(), all.result.contacts.size()) << "seed 5, step " << step;
      ASSERT_EQ(result.path[0].position, start.cast<TypeParam>());
      ASSERT_EQ(result.path[0].fraction, 0);
      ASSERT_EQ(result.path.back().position, result.position);
      ASSERT_EQ(result.path.back().fraction, 1);
      for (std::size_t i = 1; i < result.path.size(); ++i)
        ASSERT_LE(result.path[i - 1].fraction, result.path[i].fraction) << "seed 5, step " << step;
      contacts += result.contacts.empty() ? 0 : 1;
      corners += result.path.size() > 2 ? 1 : 0;
    }
    EXPECT_EQ(tests::allocations(), before);
    EXPECT_GT(contacts, 400);
    const bool has_corners = kind.starts_with("speculative") || kind.starts_with("pixel") || kind == "octagon_sweep";
    EXPECT_TRUE(has_corners ? corners > 100 : corners == 0) << corners;
  }
}

TEST(FlushTiles, and_a_one_way_chain_are_walked_over_at_any_speed_and_keep_speed_and_height) {
  const std::vector<ColliderDef> ledge{chain({{40, 0}, {7, 0}, {0, 0}}, Vec2d{0, 1})};
  for (const std::string_view kind : {"pixel_colour", "bounding_box", "speculative_march", "speculative"}) {
    SCOPED_TRACE(kind);
    for (const std::vector<ColliderDef>& floor : {flush_tiles(40), ledge}) {
      if (kind == "pixel_colour" && floor.size() == 1) continue;  // draws no one-way chain
      Passenger walker(kind, floor);
      for (int speed = 1; speed <= 100; ++speed) {
        walker.position = {1, half_height};
        walker.velocity = {0.25 * speed, 0};
        const int steps = std::min(200, 37 * 64 * 4 / speed);
        for (int step = 0; step < steps; ++step) {
          ASSERT_TRUE(walker.step({}).grounded) << "step " << step;
          ASSERT_EQ(walker.velocity, Vec2d(0.25 * speed, 0)) << "step " << step;
          ASSERT_EQ(walker.position.y(), half_height) << "step " << step;
        }
        // Speed and dt are multiples of powers of two: the sum is exact.
        EXPECT_EQ(walker.position.x(), 1 + steps * 0.25 * speed / 64);
      }
    }
  }
}

TEST(Chain, blocks_both_ways_or_only_against_its_normal_and_has_no_inside) {
  struct Case {
    const char* what;
    bool one_way;
    double start;   ///< Height of the feet above the chain [px].
    double motion;  ///< [px]
    double end;     ///< Where the feet end [px].
  };
  constexpr double head = -40;  // where the feet are when the head touches
  const std::array cases{
      Case{"falls onto it", true, 6, -10, 0},
      Case{"stands on its line and is pulled down", true, 0, -2, 0},
      Case{"jumps from it", true, 0, 9, 9},
      Case{"rises through it from below", true, -50, 60, 10},
      Case{"has its head through it and falls back", true, -10, -8, -18},
      Case{"has its feet a hair below it and falls", true, -0.25, -8, -8.25},
      Case{"is below it and falls", true, -50, -8, -58},
      Case{"falls onto one of two sides", false, 6, -10, 0},
      Case{"hits one of two sides with its head", false, head - 6, 10, head},
      Case{"is around one of two sides", false, -20, -1, -21},
  };
  for (const std::string_view kind : {"bounding_box", "discrete", "speculative_march", "speculative"}) {
    SCOPED_TRACE(kind);
    for (const Case& each : cases) {
      const bool sees_an_inside = kind == "bounding_box" || kind == "discrete";
      if (sees_an_inside && each.start == -20) continue;
      Rig<double> rig(kind, {chain({{3, 0}, {-3, 0}}, each.one_way ? std::optional(Vec2d{0, 1}) : std::nullopt)});
      rig.move({0, half_height + each.start * px}, {0, each.motion * px});
      const bool blocked = each.end != each.start + each.motion;
      const double up = each.motion < 0 ? 1 : -1;
      const double above = blocked && kind == "discrete" ? gap * up : 0;
      // A line that is reached counts as crossed: the march ends a unit before one of two sides.
      const double slack = kind == "speculative_march" && !each.one_way ? px : 1e-12;
      EXPECT_NEAR(rig.result.position.y() - half_height, each.end * px + above, slack) << each.what;
      EXPECT_EQ(rig.result.contacts.size(), blocked ? 1U : 0U) << each.what;
      EXPECT_EQ(rig.result.grounded, blocked && up > 0) << each.what;
      for (const Contact<double>& contact : rig.result.contacts) EXPECT_EQ(contact.normal, Vec2d(0, up)) << each.what;
    }
  }
  Rig<double> looks_inside("penetration_resolution", {chain({{-3, 0}, {3, 0}})});
  EXPECT_EQ(looks_inside.move({0, half_height + px}, {0, -8 * px}).position, Vec2d(0, half_height - 7 * px));
}

}  // namespace
}  // namespace paperproof::article_tests
