#include "scenes/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "oracle/exact.hpp"
#include "scenes/describe.hpp"
#include "scenes/load.hpp"

namespace paperproof::compare {
namespace {

InputEvent event(int step, std::optional<double> move, std::optional<bool> jump) {
  return {.step = step, .move = move, .jump = jump};
}

TEST(Input, nothing_steers_before_an_event_sets_a_direction) {
  const std::vector<InputEvent> events{event(3, std::nullopt, true), event(5, -1, std::nullopt)};
  EXPECT_FALSE(input_at(events, 0).move.has_value());
  EXPECT_FALSE(input_at(events, 4).move.has_value());
  EXPECT_EQ(input_at(events, 5).move, -1);
}

TEST(Input, a_key_holds_until_a_later_event_changes_it) {
  const std::vector<InputEvent> events{event(0, 1, std::nullopt), event(4, std::nullopt, true), event(6, 0.5, false)};
  EXPECT_FALSE(input_at(events, 3).jump);
  EXPECT_TRUE(input_at(events, 5).jump);
  EXPECT_EQ(input_at(events, 5).move, 1);
  EXPECT_FALSE(input_at(events, 6).jump);
  EXPECT_EQ(input_at(events, 1000).move, 0.5);
}

TEST(RandomInput, is_the_same_for_the_same_seed_and_differs_between_seeds) {
  EXPECT_EQ(random_input(7, 3600), random_input(7, 3600));
  EXPECT_NE(random_input(7, 3600), random_input(8, 3600));
}

TEST(RandomInput, a_longer_run_begins_like_a_shorter_one) {
  const std::vector<InputEvent> shorter = random_input(3, 1000);
  const std::vector<InputEvent> longer = random_input(3, 5000);
  ASSERT_LT(shorter.size(), longer.size());
  EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
}

TEST(RandomInput, holds_each_choice_for_15_to_120_steps_and_makes_all_of_them) {
  std::map<double, int> moves;
  int presses = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<InputEvent> events = random_input(seed, 20000);
    std::optional<int> before;
    int pressed = -1;
    for (const InputEvent& e : events) {
      if (e.move) {
        ++moves[*e.move];
        if (before) {
          EXPECT_GE(e.step - *before, 15) << "seed " << seed;
          EXPECT_LE(e.step - *before, 120) << "seed " << seed;
        }
        before = e.step;
      }
      ASSERT_TRUE(e.jump.has_value());
      if (*e.jump) {
        EXPECT_LT(pressed, 0) << "pressed twice without a release, seed " << seed;
        pressed = e.step;
        ++presses;
      } else if (pressed >= 0) {
        EXPECT_GE(e.step - pressed, 4) << "seed " << seed;
        EXPECT_LE(e.step - pressed, 30) << "seed " << seed;
        pressed = -1;
      }
    }
  }
  EXPECT_EQ(moves.size(), 3U);
  for (const auto& [move, count] : moves) EXPECT_GT(count, 100) << "move " << move;
  EXPECT_GT(presses, 100);
}

TEST(BuiltInScenes, every_one_is_valid_has_its_own_name_and_says_what_it_is) {
  std::set<std::string> names;
  for (const BuiltInScene& entry : built_in_scenes()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.description.empty()) << entry.name;
    const std::vector<Scene> scenes = load_scenes(entry.name);
    ASSERT_EQ(scenes.size(), 1U);
    const Scene& scene = scenes.front();
    EXPECT_EQ(scene.name, entry.name);
    EXPECT_EQ(scene.description, entry.description);
    EXPECT_EQ(scene.ids.size(), scene.scenery.colliders.size());
    EXPECT_EQ(std::set<std::string>(scene.ids.begin(), scene.ids.end()).size(), scene.ids.size()) << entry.name;
    EXPECT_GE(scene.steps, 1);
    EXPECT_LE(scene.steps, entry.name == "long_rest" ? 1'000'000 : 10'000) << entry.name;
    EXPECT_NO_THROW(scene.character.validate()) << entry.name;
    EXPECT_TRUE(std::is_sorted(scene.input.begin(), scene.input.end(), [](const auto& a, const auto& b) {
      return a.step < b.step;
    })) << entry.name;
  }
  for (const char* name : {"article_bullet",
                           "thin_platform",
                           "zero_thickness_paper",
                           "grazing_wall",
                           "parallel_pass",
                           "rotated_wall",
                           "corner_to_corner",
                           "wedge_60",
                           "wedge_5",
                           "concave_corner",
                           "flush_tiles",
                           "skier",
                           "slope_joints",
                           "exact_fit_shaft",
                           "shaft_one_ulp_wider",
                           "spike_between_feet",
                           "sliver_drop",
                           "start_overlapping_deep",
                           "start_overlapping_ulp",
                           "far_origin_1e3",
                           "far_origin_1e6",
                           "scaled_1e-3",
                           "scaled_1e3",
                           "gravity_1e6",
                           "long_rest",
                           "sloped_paper_walk",
                           "jump_into_wall",
                           "jump_into_overhang",
                           "jump_into_corner",
                           "ledge_hang",
                           "stuck_points"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

/// Where the free flight of a scene without gravity first meets something, by exact arithmetic.
std::optional<ExactImpact> first_impact_of(const Scene& scene, double steps) {
  const auto hull = scene.character.shape.hull();
  const ExactScenery exact(scene.scenery, {hull.begin(), hull.end()});
  const Vec2d displacement = scene.start.velocity * scene.dt * steps;
  return exact.first_impact(scene.start.position, displacement);
}

TEST(BuiltInScenes, the_articles_bullet_meets_the_platform_at_30_of_50_pixels) {
  const Scene scene = load_scenes("article_bullet").front();
  EXPECT_EQ(scene.gravity, Vec2d(0, 0));
  const std::optional<ExactImpact> impact = first_impact_of(scene, 1);
  ASSERT_TRUE(impact.has_value());
  EXPECT_NEAR(static_cast<double>(impact->fraction), 30.0 / 50.0, 1e-12);
  const Box2<double> box = scene.character.shape.box();
  EXPECT_EQ(box.upper - box.lower, Vec2d(1.0 / 32, 1.0 / 32));
}

TEST(BuiltInScenes, the_bullets_other_speeds_keep_the_distance) {
  for (const auto& [name, pixels_per_frame] :
       {std::pair{"article_bullet_slow", 1.0}, {"article_bullet_fast", 1e3}, {"article_bullet_extreme", 1e5}}) {
    const double frames = 60;
    const std::optional<ExactImpact> impact = first_impact_of(load_scenes(name).front(), frames);
    ASSERT_TRUE(impact.has_value()) << name;
    EXPECT_NEAR(static_cast<double>(impact->fraction) * frames, 30 / pixels_per_frame, 1e-12 * 30) << name;
  }
}

TEST(BuiltInScenes, grazing_walls_are_met_after_distance_over_normal_speed) {
  for (const auto& [name, distance] :
       {std::pair{"grazing_wall", 0.25}, {"grazing_wall_0.1", 0.05}, {"grazing_wall_0.001", 0.004}}) {
    const Scene scene = load_scenes(name).front();
    const std::optional<ExactImpact> impact = first_impact_of(scene, scene.steps);
    ASSERT_TRUE(impact.has_value()) << name;
    const double seconds = static_cast<double>(impact->fraction) * scene.steps * scene.dt;
    EXPECT_NEAR(seconds, distance / scene.start.velocity.x(), 1e-9) << name;
  }
}

TEST(BuiltInScenes, a_corner_meets_a_corner_or_not_by_one_ulp) {
  EXPECT_FALSE(first_impact_of(load_scenes("corner_to_corner").front(), 60).has_value());
  EXPECT_FALSE(first_impact_of(load_scenes("corner_to_corner_minus_ulp").front(), 60).has_value());
  EXPECT_TRUE(first_impact_of(load_scenes("corner_to_corner_plus_ulp").front(), 60).has_value());
  EXPECT_TRUE(first_impact_of(load_scenes("corner_to_corner_hit").front(), 60).has_value());
}

TEST(BuiltInScenes, a_parallel_pass_meets_nothing) {
  for (const char* name : {"parallel_pass", "parallel_pass_30mm", "parallel_pass_0"}) {
    EXPECT_FALSE(first_impact_of(load_scenes(name).front(), 120).has_value()) << name;
  }
}

TEST(BuiltInScenes, rotated_walls_are_met_where_the_octagons_support_reaches_them) {
  const double half = std::sqrt(0.5);
  const Scene scene = load_scenes("rotated_wall").front();
  double support = 0;
  for (const Vec2d& point : scene.character.shape.hull()) support = std::max(support, (point.x() + point.y()) * half);
  const double seconds = (1.5 - support) / (scene.start.velocity.x() * half);
  const std::optional<ExactImpact> impact = first_impact_of(scene, 6);
  ASSERT_TRUE(impact.has_value());
  EXPECT_NEAR(static_cast<double>(impact->fraction) * 6 * scene.dt, seconds, 1e-9);
}

TEST(BuiltInScenes, overlapping_starts_overlap_and_all_others_are_free) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    const Scene scene = load_scenes(entry.name).front();
    const auto hull = scene.character.shape.hull();
    const ExactScenery exact(scene.scenery, {hull.begin(), hull.end()});
    EXPECT_EQ(!exact.overlapped(scene.start.position).empty(), scene.start.resolve_overlap) << entry.name;
  }
}

TEST(BuiltInScenes, the_spike_is_narrower_than_the_feet_are_apart) {
  const Scene scene = load_scenes("spike_between_feet").front();
  const auto feet = scene.character.shape.pair(Side::bottom);
  const auto points = scene.character.shape.points();
  ASSERT_EQ(scene.ids[1], "spike");
  for (const Vec2d& corner : scene.scenery.colliders[1].points) {
    EXPECT_GT(corner.x(), points[feet[0]].x());
    EXPECT_LT(corner.x(), points[feet[1]].x());
  }
}

TEST(BuiltInScenes, scaled_scenes_are_the_same_scene) {
  const Scene one = load_scenes("scaled_1").front();
  for (const auto& [name, scale] : {std::pair{"scaled_1e-3", 1.0 / 1024}, {"scaled_1e3", 1024.0}}) {
    const Scene other = load_scenes(name).front();
    EXPECT_EQ(other.start.position, Vec2d(one.start.position * scale)) << name;
    EXPECT_EQ(other.gravity, Vec2d(one.gravity * scale)) << name;
    EXPECT_EQ(other.character.walk_speed, one.character.walk_speed * scale) << name;
    for (std::size_t i = 0; i < one.scenery.colliders.size(); ++i) {
      for (std::size_t k = 0; k < one.scenery.colliders[i].points.size(); ++k) {
        EXPECT_EQ(other.scenery.colliders[i].points[k], Vec2d(one.scenery.colliders[i].points[k] * scale)) << name;
      }
    }
  }
}

TEST(Describe, counts_what_is_there) {
  const std::string text = describe(load_scenes("flush_tiles").front());
  EXPECT_NE(text.find("64 polygons"), std::string::npos) << text;
  EXPECT_NE(text.find("64 convex"), std::string::npos) << text;
  EXPECT_NE(describe(load_scenes("zero_thickness_paper").front()).find("1 two-sided"), std::string::npos);
}

TEST(Describe, names_one_way_segments_that_block_nothing) {
  Scene scene = load_scenes("article_bullet").front();
  scene.ids.emplace_back("ledge");
  // Level, then straight up along one_way, then level again.
  scene.scenery.colliders.push_back(
      {.shape = ColliderDef::Shape::chain, .points = {{40, 0}, {41, 0}, {41, 1}, {42, 1}}, .one_way = Vec2d(0, 1)});
  EXPECT_NE(describe(scene).find("\"ledge\": 1 segment along its one_way"), std::string::npos) << describe(scene);
  scene.scenery.colliders.back().points[2] = {41.5, 1};
  EXPECT_EQ(describe(scene).find("ledge"), std::string::npos);
}

TEST(LoadScenes, an_unknown_name_is_refused_with_what_is_possible) {
  try {
    (void)load_scenes("no_such_scene");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "no_such_scene: expected the name of a built-in scene (see `paperproof list scenes`), or a file that "
              "ends in .json, .tmx, .tmj, .stl or .png");
  }
}

}  // namespace
}  // namespace paperproof::compare
