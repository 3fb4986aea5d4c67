/// The first overlap with what turns, against answers that are fractions, and against many moments one by one.
#include "oracle/first_meeting.hpp"

#include "compare/exact_shapes.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace paperproof::compare::detail {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Kind = Meeting::Kind;
using Path = std::vector<PathPoint<double>>;

constexpr double closely = 1e-12;

std::vector<std::size_t> all_of(const VertexWay& way) {
  std::vector<std::size_t> numbers(way.vertices.front().size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  return numbers;
}

Meeting met(const Path& path, const VertexWay& way, Asked asked = Asked::when) {
  return first_meeting(octagon(), path, way, all_of(way), asked);
}

Path staying(const Vec2d& at) { return {{at, 0}, {at, 1}}; }

/// A plank about (0, 0), 2 m long and flat at first: its end comes up by a metre on a straight line, as the other one
/// goes down.
VertexWay see_saw() { return {.collider = 0, .instants = {0, 1}, .vertices = {{{-1, 0}, {1, 0}}, {{-1, -1}, {1, 1}}}}; }

/// A square whose lowest corner is its position.
const std::vector<Vec2d> on_its_tip{{0, 0}, {1, 1}, {0, 2}, {-1, 1}};

TEST(FirstMeeting, the_line_of_a_plank_comes_up_to_a_foot_after_a_fraction_that_is_known) {
  // At time t the plank is the line y = t x. The right foot is 0.5 m beside its middle and 0.375 m up: t = 3/4.
  const Meeting found = met(staying({0.5 - 0.15625, 0.375 + 0.625}), see_saw());
  ASSERT_EQ(found.kind, Kind::meets);
  EXPECT_LE(found.low, 0.75);
  EXPECT_GT(found.high, 0.75) << "a touch is no overlap";
  EXPECT_NEAR(found.low, 0.75, closely);
  EXPECT_NEAR(found.high, 0.75, closely);
}

TEST(FirstMeeting, the_tip_of_a_plank_meets_the_feet_above_it) {
  // Both feet are beyond: the tip, at x = 1, comes to height t.
  const Meeting found = met(staying({1, 0.625 + 0.625}), see_saw());
  ASSERT_EQ(found.kind, Kind::meets);
  EXPECT_NEAR(found.low, 0.625, closely);
  EXPECT_NEAR(found.high, 0.625, closely);
}

TEST(FirstMeeting, a_fall_onto_a_plank_that_rises_is_where_the_two_heights_agree) {
  // Feet at 1.5 - t, the tip at t: t = 3/4.
  const Meeting found = met({{{1, 1.5 + 0.625}, 0}, {{1, 0.5 + 0.625}, 1}}, see_saw());
  ASSERT_EQ(found.kind, Kind::meets);
  EXPECT_NEAR(found.high, 0.75, closely);
}

TEST(FirstMeeting, a_parabola_that_touches_and_goes_back_is_no_overlap_and_a_hair_less_room_is_one) {
  // A tip goes to the left along y = h, from x = 1 to 0: the plank is t (1 - t) high there, at most 1/4.
  const auto passing = [](double height) {
    const VertexWay way = see_saw();
    return first_meeting(on_its_tip, Path{{{1, height}, 0}, {{0, height}, 1}}, way, all_of(way)).kind;
  };
  EXPECT_EQ(passing(0.25), Kind::apart);
  EXPECT_EQ(passing(one_ulp_up(0.25)), Kind::apart);
  EXPECT_EQ(passing(one_ulp_down(0.25)), Kind::meets);
  EXPECT_EQ(passing(0.25 - 1e-9), Kind::meets);
}

TEST(FirstMeeting, a_parabola_with_its_top_at_no_binary_fraction_is_decided_at_its_vertex) {
  // The tip goes from x = 1 to -2 at height h over the plank y = t x: h - t (1 - 3 t), least at t = 1/6 where it is
  // h - 1/12.
  const VertexWay way{.collider = 0, .instants = {0, 1}, .vertices = {{{-4, 0}, {4, 0}}, {{-4, -4}, {4, 4}}}};
  const auto passing = [&](double height, double end) {
    const Path path{{{1, height}, 0}, {{1 - 3 * end, height}, end}};
    return first_meeting(on_its_tip, path, way, all_of(way)).kind;
  };
  EXPECT_EQ(passing(one_ulp_up(1.0 / 12), 0.5), Kind::apart);
  EXPECT_EQ(passing(one_ulp_down(1.0 / 12), 0.5), Kind::meets);
}

TEST(FirstMeeting, a_thin_plank_that_goes_through_in_one_chord_is_met) {
  for (const double thickness : {0.1, 1e-3, 1e-9, 0.0}) {
    VertexWay way{.collider = 0, .instants = {0, 1}, .vertices = {{{-3, -2}, {3, -2}}, {{-3, 2}, {3, 2}}}};
    if (thickness > 0) {
      way.vertices[0].insert(way.vertices[0].end(), {{3, -2 + thickness}, {-3, -2 + thickness}});
      way.vertices[1].insert(way.vertices[1].end(), {{3, 2 + thickness}, {-3, 2 + thickness}});
    }
    const Meeting found = met(staying({0, 0}), way);
    ASSERT_EQ(found.kind, Kind::meets) << thickness;
    EXPECT_NEAR(found.high, (2 - thickness - 0.625) / 4, closely) << thickness;
    EXPECT_EQ(met(staying({4, 0}), way).kind, Kind::apart) << "beside it";
  }
}

TEST(FirstMeeting, an_arm_on_chords_is_met_on_its_chord_and_not_on_the_arc) {
  // A tip on two chords of a quarter of a circle: at height 1/√2 it is back on the circle, before that inside of it.
  const double half = std::sqrt(0.5);
  const VertexWay way{
      .collider = 0, .instants = {0, 0.5, 1}, .vertices = {{{0, 0}, {1, 0}}, {{0, 0}, {half, half}}, {{0, 0}, {0, 1}}}};
  // Feet at x from 0.8 on; the tip is at 0.85 on the chord where the circle would be at 0.9.
  const double x = 0.85;
  const double share = (1 - x) / (1 - half);
  const double height = share * half;
  const Meeting found = met(staying({x, height + 0.625}), way);
  ASSERT_EQ(found.kind, Kind::meets);
  EXPECT_NEAR(found.high, 0.5 * share, closely);
}

TEST(FirstMeeting, resting_on_what_goes_along_is_apart_and_an_ulp_deeper_is_not) {
  const VertexWay lift{.collider = 0,
                       .instants = {0, 0.25, 1},
                       .vertices = {{{-1, -1}, {1, -1}, {1, 0}, {-1, 0}},
                                    {{-1, -0.75}, {1, -0.75}, {1, 0.25}, {-1, 0.25}},
                                    {{-1, 0}, {1, 0}, {1, 1}, {-1, 1}}}};
  EXPECT_EQ(met({{{0, 0.625}, 0}, {{0, 1.625}, 1}}, lift).kind, Kind::apart);
  EXPECT_EQ(met({{{0, 0.625}, 0}, {{0, one_ulp_down(1.625)}, 1}}, lift).kind, Kind::meets);
  EXPECT_EQ(met({{{0, 0.625}, 0}, {{0.5, 0.875}, 0.25}, {{0.5, 1.625}, 1}}, lift).kind, Kind::apart);
}

TEST(FirstMeeting, a_leap_in_no_time_meets_what_is_in_between_then) {
  const Path leap{{{-1, 0.4 + 0.625}, 0}, {{-1, 0.4 + 0.625}, 0.5}, {{2, 0.4 + 0.625}, 0.5}, {{2, 0.4 + 0.625}, 1}};
  const Meeting found = met(leap, see_saw());
  ASSERT_EQ(found.kind, Kind::meets) << "the tip is at height 0.5 then";
  EXPECT_EQ(found.low, 0.5);
  EXPECT_EQ(found.high, 0.5);
  Path over = leap;
  for (PathPoint<double>& corner : over) corner.position.y() += 0.7;
  EXPECT_EQ(met(over, see_saw()).kind, Kind::apart);
}

TEST(FirstMeeting, a_single_corner_asks_about_its_moment) {
  const Vec2d at(1, 0.5 + 0.625);
  EXPECT_EQ(met({{at, 0.5}}, see_saw()).kind, Kind::apart) << "they touch";
  EXPECT_EQ(met({{at, one_ulp_up(0.5)}}, see_saw()).kind, Kind::meets);
  EXPECT_EQ(met({{at, 0}}, see_saw()).kind, Kind::apart);
}

TEST(FirstMeeting, an_octagon_that_is_all_inside_is_met_at_once) {
  const VertexWay way{.collider = 0,
                      .instants = {0, 1},
                      .vertices = {{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}}};
  const Meeting found = met(staying({0, 0}), way);
  EXPECT_EQ(found.kind, Kind::meets);
  EXPECT_NEAR(found.high, 0, closely);
}

TEST(FirstMeeting, far_from_the_origin_the_answers_are_exact_as_well) {
  const double far = 0x1p20;
  VertexWay way = see_saw();
  for (auto& vertices : way.vertices)
    for (Vec2d& v : vertices) v += Vec2d(far, -far);
  const double foot = 0.625;  // no rounding: the sums are multiples of 2^-32
  EXPECT_EQ(met(staying({far + 1, -far + 1 + foot}), way).kind, Kind::apart);
  EXPECT_EQ(met(staying({far + 1, -far + 1 - 0x1p-30 + foot}), way).kind, Kind::meets);
}

/// A piece that turns about a point and goes along, on chords.
struct Turning {
  std::vector<Vec2d> points;
  double from;
  double to;
  Vec2d begin;
  Vec2d end;

  [[nodiscard]] VertexWay way(int chords) const {
    VertexWay way;
    for (int k = 0; k <= chords; ++k) {
      const double t = static_cast<double>(k) / chords;
      const double angle = from + t * (to - from);
      way.instants.push_back(t);
      way.vertices.emplace_back();
      for (const Vec2d& p : points)
        way.vertices.back().emplace_back(begin + t * (end - begin) +
                                         Vec2d(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                                               std::sin(angle) * p.x() + std::cos(angle) * p.y()));
    }
    return way;
  }
};

/// Vertices and positions of a moment are rounded here: enough where the moment is not a touch.
bool overlaps_at(const VertexWay& way, const Path& path, double t) {
  std::size_t k = 0;
  while (k + 2 < way.instants.size() && way.instants[k + 1] < t) ++k;
  const double share = (t - way.instants[k]) / (way.instants[k + 1] - way.instants[k]);
  std::vector<Vec2d> ring;
  for (std::size_t i = 0; i < way.vertices[k].size(); ++i)
    ring.push_back(way.vertices[k][i] + share * (way.vertices[k + 1][i] - way.vertices[k][i]));
  const Vec2d at = path[0].position + t * (path[1].position - path[0].position);
  const ColliderDef def = ring.size() == 2 ? chain(ring) : polygon(ring);
  return ExactScenery(scenery({def}), octagon()).overlaps(at, 0);
}

TEST(FirstMeeting, free_before_and_overlapping_after_by_another_formulation) {
  constexpr std::uint64_t seed = 62;
  Random random(seed);
  constexpr int rounds = 600;
  constexpr int moments = 40;
  int touched = 0;
  int undecided = 0;
  for (int i = 0; i < rounds; ++i) {
    const double thin = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-4 : 0.1;
    Turning piece{.points = {{-0.7, 0}, {0.7, 0}}, .from = random.between(-7, 7), .to = 0, .begin = {}, .end = {}};
    if (thin > 0) piece.points = {{-0.7, 0}, {0.7, 0}, {0.7, thin}, {-0.7, thin}};
    piece.to = piece.from + random.between(-2, 2);
    piece.begin = random.point(1.2);
    piece.end = random.point(1.2);
    const Vec2d start = random.point(1.6);
    const Path path{{start, 0}, {start + random.point(1), 1}};
    const VertexWay way = piece.way(1 + random.below(9));
    const Meeting found = met(path, way);
    EXPECT_EQ(met(path, way, Asked::whether).kind, found.kind) << "seed " << seed << " round " << i;
    undecided += found.kind == Kind::undecided;
    const double free_until = found.kind == Kind::apart ? 1 : found.low;
    for (int k = 0; k < moments && free_until > 0; ++k)
      ASSERT_FALSE(overlaps_at(way, path, free_until * k / moments)) << "seed " << seed << " round " << i;
    if (found.kind != Kind::meets || found.high < 1e-9) continue;
    ++touched;
    EXPECT_LE(found.high - found.low, 1e-9) << "seed " << seed << " round " << i;
    EXPECT_FALSE(overlaps_at(way, path, std::max(0.0, found.low - 1e-10))) << "seed " << seed << " round " << i;
    EXPECT_TRUE(overlaps_at(way, path, std::min(1.0, found.high + 1e-10))) << "seed " << seed << " round " << i;
  }
  EXPECT_EQ(undecided, 0) << "nothing at random touches without an overlap";
  EXPECT_GT(touched, rounds * 2 / 10);
  EXPECT_LT(touched, rounds * 8 / 10);
}

}  // namespace
}  // namespace paperproof::compare::detail
