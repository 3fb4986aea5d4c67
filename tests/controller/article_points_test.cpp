/// The techniques that search along the article's points: what each does that no other does, and against each other.
#include "controller/article_support.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace paperproof::article_tests {
namespace {

using Response = ArticleKnobs::Response;

TEST(WindBack, goes_back_along_the_movement_by_units_until_free_as_a_mask_that_shortens_does) {
  // Feet start 4 pixels above the floor and would end 6 below, 10 pixels along: 2-norm sqrt(200) pixels. Free where
  // 4 - 10 (1 - k / sqrt(200)) >= 0, that is k >= 0.6 sqrt(200) = 8.49: nine units.
  const double fraction = 1 - std::ceil(0.6 * std::sqrt(200.0)) / std::sqrt(200.0);
  for (const std::string_view kind : {"wind_back", "mask"}) {
    SCOPED_TRACE(kind);
    Rig<double> rig(kind, {rectangle(-2, -2, 2, 0)}, {.response = Response::shorten});
    const MoveResult<double>& result = rig.move({0, half_height + 4 * px}, {10 * px, -10 * px});
    EXPECT_NEAR(result.position.x(), 10 * px * fraction, 1e-15);
    EXPECT_NEAR(result.position.y(), half_height + 4 * px - 10 * px * fraction, 1e-15);
    EXPECT_EQ(result.velocity.y(), 0);
    ASSERT_EQ(result.contacts.size(), 1U);
    EXPECT_EQ(result.contacts[0].side, Side::bottom);
    EXPECT_NEAR(result.contacts[0].fraction, fraction, 1e-15);
  }
}

TEST(StartInside, is_stuck_where_the_search_goes_back_and_free_once_an_end_is) {
  struct Case {
    std::string_view kind;
    Response response = Response::component;
  };
  for (const Case& each : {Case{"wind_back"}, Case{"mask"}, Case{"mask", Response::shorten}}) {
    Rig<double> rig(each.kind, {rectangle(-9, -2, 9, 0)}, {.response = each.response});
    EXPECT_EQ(rig.move({0, 10 * px}, {px, -3 * px}).position, Vec2d(0, 10 * px)) << each.kind;
    EXPECT_EQ(rig.result.status, MoveStatus::stuck) << each.kind;
    EXPECT_EQ(rig.move({0, 10 * px}, {0, 30 * px}).position, Vec2d(0, 40 * px)) << each.kind;
    EXPECT_EQ(rig.result.status, MoveStatus::moved) << each.kind;
  }
}

TEST(StartInside, gives_the_march_nothing_to_go_back_and_penetration_resolution_takes_one_unit) {
  Rig<double> rig("speculative_march", {rectangle(-2, -2, 2, 0)});
  const MoveResult<double>& result = rig.move({0, half_height - px / 2}, {0, -3 * px});
  EXPECT_EQ(result.contacts[0].fraction, 0);
  EXPECT_EQ(result.position.y(), half_height + px / 2);
}

TEST(PenetrationResolution, is_pushed_out_by_whole_units) {
  // The end is 6.25 pixels in the floor: seven units, which is 0.75 above it.
  Rig<double> rig("penetration_resolution", {rectangle(-2, -2, 2, 0)});
  const MoveResult<double>& result = rig.move({0, half_height + 4 * px}, {10 * px, -10.25 * px});
  EXPECT_EQ(result.position, Vec2d(10 * px, half_height + 0.75 * px));
  EXPECT_EQ(result.velocity, Vec2d(10 * px, 0));
}

TEST(SpeculativeMarch, does_not_look_beyond_the_end) {
  // 3.5 px down to 0.25 px above the hill, where the right foot is: the last step is half a unit.
  Rig<double> rig("speculative_march", {{.points = {{-2, -2}, {2, -2}, {2, 2}}}});
  const MoveResult<double>& result = rig.move({0, 28.75 * px}, {0, -3.5 * px});
  EXPECT_EQ(result.position.y(), 25.25 * px);
  EXPECT_TRUE(result.contacts.empty());
}

TEST(FlushTiles, a_point_does_not_fall_down_the_seam_between_two) {
  for (const std::string_view kind : article_kinds) {
    SCOPED_TRACE(kind);
    for (const auto objects : {ArticleKnobs::Objects::each, ArticleKnobs::Objects::all}) {
      Rig<double> rig(kind, {rectangle(-1, -1, 0, 0), rectangle(0, -1, 1, 0)}, {.objects = objects}, diamond());
      const MoveResult<double>& result = rig.move({0, 1}, {0, -1});
      EXPECT_NEAR(result.position.y(), 0.5, px);
      EXPECT_EQ(result.contacts.size(), 1U);
    }
  }
}

TEST(FlushTiles, a_computed_contact_is_found_on_the_seam_between_two_thin_ones) {
  // The end is far below: only the time of impact can stop it. One tile ends lower: the seam begins where both are.
  for (const double step_down : {0.0, 0.125}) {
    const std::vector<ColliderDef> tiles{rectangle(-1, -0.25, 0, 0), rectangle(0, -0.25, 1, -step_down)};
    Rig<double> rig("speculative", tiles, {}, diamond());
    EXPECT_NEAR(rig.move({0, 1}, {0, -3}).position.y(), 0.5 - step_down, 1e-15);
  }
  // Tiles that do not share a piece of the seam leave it open: a point without width passes between them.
  Rig<double> rig("speculative", {rectangle(-1, -0.25, 0, 0), rectangle(0, -0.75, 1, -0.5)}, {}, diamond());
  EXPECT_TRUE(rig.move({0, 1}, {0, -3}).contacts.empty());
}

TEST(Speculative, ends_a_fall_for_a_frame_where_the_feet_reach_a_wall) {
  // The pairs are tested in the article's order, each along the whole vector: a foot that is taken into a wall counts
  // as a hit of the bottom pair, although nothing is below it.
  Rig<double> rig("speculative", {rectangle(1, -9, 3, 9)});
  const MoveResult<double>& result = rig.move({0, 0}, {54 * px, -54 * px});
  EXPECT_NEAR(result.position.y(), -27 * px, 1e-15) << "where the foot, 27 px away, met the wall";
  EXPECT_NEAR(result.position.x(), 22 * px, 1e-15) << "where the arm did";
  EXPECT_TRUE(result.grounded);
  EXPECT_EQ(result.contacts[0].side, Side::bottom);
  EXPECT_EQ(result.contacts[0].normal, Vec2d(-1, 0));
}

TEST(Objects, are_left_one_by_one_and_a_later_one_may_push_into_an_earlier_one) {
  // The feet are 2 px deep in a floor whose top, at 1 px, is inside of a plate that comes first and reaches to 4 px.
  const std::vector<ColliderDef> colliders{rectangle(-3, px / 2, 3, 4 * px), rectangle(-3, -3, 3, px)};
  struct Case {
    ArticleKnobs::Objects objects;
    int iterations;
    double feet;  ///< Where they end [px].
  };
  for (const Case& each : {Case{ArticleKnobs::Objects::each, 1, 1}, Case{ArticleKnobs::Objects::each, 2, 4},
                           Case{ArticleKnobs::Objects::all, 1, 4}}) {
    Rig<double> rig("penetration_resolution", colliders, {.iterations = each.iterations, .objects = each.objects});
    const MoveResult<double>& result = rig.move({0, half_height + 8 * px}, {0, -9 * px});
    EXPECT_EQ(result.position.y(), half_height + each.feet * px) << each.iterations;
  }
}

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
