/// The techniques that search along the article's points, with their knobs. What each does without is in
/// tests/situations/techniques.json.
#include "controller/article_support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::article_tests {
namespace {

using Response = ArticleKnobs::Response;

TEST(WindBack, goes_back_along_the_movement_by_units_until_free_as_a_mask_that_shortens_does) {
  // Feet start 4 pixels above the floor and would end 6 below, 10 pixels along: 2-norm sqrt(200) pixels. Free where
  // 4 - 10 (1 - k / sqrt(200)) >= 0, that is k >= 0.6 sqrt(200) = 8.49: nine units.
  const double fraction = 1 - std::ceil(0.6 * std::sqrt(200.0)) / std::sqrt(200.0);
  for (const std::string_view kind : {"wind_back", "mask"}) {
    SCOPED_TRACE(kind);
    Rig rig(kind, {rectangle(-2, -2, 2, 0)}, {.response = Response::shorten});
    const MoveResult& result = rig.move({0, half_height + 4 * px}, {10 * px, -10 * px});
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
    Rig rig(each.kind, {rectangle(-9, -2, 9, 0)}, {.response = each.response});
    EXPECT_EQ(rig.move({0, 10 * px}, {px, -3 * px}).position, Vec2d(0, 10 * px)) << each.kind;
    EXPECT_EQ(rig.result.status, StepStatus::stuck) << each.kind;
    EXPECT_EQ(rig.move({0, 10 * px}, {0, 30 * px}).position, Vec2d(0, 40 * px)) << each.kind;
    EXPECT_EQ(rig.result.status, StepStatus::moved) << each.kind;
  }
}

TEST(FlushTiles, a_point_does_not_fall_down_the_seam_between_two) {
  for (const std::string_view kind : {"wind_back", "penetration_resolution", "speculative_march", "speculative"}) {
    SCOPED_TRACE(kind);
    for (const auto objects : {ArticleKnobs::Objects::each, ArticleKnobs::Objects::all}) {
      Rig rig(kind, {rectangle(-1, -1, 0, 0), rectangle(0, -1, 1, 0)}, {.objects = objects}, diamond());
      const MoveResult& result = rig.move({0, 1}, {0, -1});
      EXPECT_NEAR(result.position.y(), 0.5, px);
      EXPECT_EQ(result.contacts.size(), 1U);
    }
  }
}

}  // namespace
}  // namespace paperproof::article_tests
