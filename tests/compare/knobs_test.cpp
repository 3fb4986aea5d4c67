/// The knobs of the command line: who has which, and what cannot be one.
#include "runs/knobs.hpp"
#include "compare/scene_runs.hpp"
#include "runs/technique_parts.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>

namespace paperproof::compare {
namespace {

using Bits = std::vector<std::uint64_t>;

/// Where one box is under another: going back out of the thick one leads into the thin one.
Scene plate_above_a_floor() {
  Scene scene = built_in("article_bullet");
  scene.scenery.colliders = {{.points = {{-4, -3}, {4, -3}, {4, 0}, {-4, 0}}},
                             {.points = {{-4, 1}, {4, 1}, {4, 1.01}, {-4, 1.01}}}};
  scene.character = {};
  scene.start = {.position = {0, 2.5}, .velocity = {0, -180}};
  scene.steps = 3;
  return scene;
}

/// The feet begin in the floor, an arm in a low wall that is looked at first. Lifted out of the floor it is above the
/// wall.
Scene low_wall_on_a_floor() {
  Scene scene = built_in("flush_tiles");
  constexpr double px = 1.0 / 32;
  scene.scenery.colliders = {{.points = {{8 * px, -1}, {4, -1}, {4, 4 * px}, {8 * px, 4 * px}}},
                             {.points = {{-4, -1}, {4, -1}, {4, 0}, {-4, 0}}}};
  scene.start = {.position = {0, 8 * px}};
  scene.steps = 3;
  return scene;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all{plate_above_a_floor(), low_wall_on_a_floor()};
  for (const char* name : {"article_bullet", "flush_tiles", "slope_joints", "stuck_points", "ledge_hang", "wedge_60",
                           "wedge_5", "jump_into_overhang", "jump_into_corner", "concave_corner", "exact_fit_shaft"})
    all.push_back(built_in(name));
  return all;
}

/// Every position of the first second, and the memory; empty where the technique cannot express the scene.
Bits run(const TechniqueDef& def, const Scene& scene) {
  Bits bits;
  try {
    const Scenery<double> scenery(scene.scenery);
    const Controller<double> controller = make_controller(scenery, rules_for(*find_technique(def.name), scene), def);
    Scratch<double> scratch = controller.make_scratch();
    CharacterState<double> state;
    state.position = scene.start.position;
    state.velocity = scene.start.velocity;
    StepReport<double> report;
    bits.push_back(controller.technique().memory_bytes());
    for (int step = 0; step < std::min(scene.steps, 60); ++step) {
      const Input input{.move = scene.gravity.y() != 0 ? std::optional<double>(1) : std::nullopt,
                        .jump = step % 20 > 10};
      static_cast<void>(controller.step(state, input, {scene.gravity, scene.dt}, scratch, report));
      bits.push_back(std::bit_cast<std::uint64_t>(state.position.x()));
      bits.push_back(std::bit_cast<std::uint64_t>(state.position.y()));
    }
  } catch (const NotExpressible&) {
    bits.clear();
  }
  return bits;
}

struct Turn {
  const char* text;
  std::function<void(ArticleKnobs&)> turn;
};

class EachKnob : public ::testing::TestWithParam<Turn> {};

TEST_P(EachKnob, changes_those_techniques_that_have_it_and_no_other) {
  const KnobSetting setting = parse_knob(GetParam().text);
  const std::vector<Scene> all = scenes();
  for (const std::string_view kind : technique_names()) {
    bool changes = false;
    for (const Scene& scene : all) {
      TechniqueDef usual;
      usual.name = kind;
      TechniqueDef turned = usual;
      if (has_knob(kind, setting.name))
        turn_knobs(std::span(&setting, 1), turned);
      else
        GetParam().turn(turned.article);
      changes = changes || run(usual, scene) != run(turned, scene);
    }
    EXPECT_EQ(changes, has_knob(kind, setting.name)) << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(
    OfTheArticle, EachKnob,
    ::testing::Values(Turn{"unit=0.1", [](ArticleKnobs& knobs) { knobs.unit = 0.1; }},
                      Turn{"iterations=1", [](ArticleKnobs& knobs) { knobs.iterations = 1; }},
                      Turn{"points=4", [](ArticleKnobs& knobs) { knobs.points = 4; }},
                      Turn{"pairs=all", [](ArticleKnobs& knobs) { knobs.pairs = ArticleKnobs::Pairs::all; }},
                      Turn{"response=shorten",
                           [](ArticleKnobs& knobs) { knobs.response = ArticleKnobs::Response::shorten; }},
                      Turn{"objects=all", [](ArticleKnobs& knobs) { knobs.objects = ArticleKnobs::Objects::all; }},
                      Turn{"square=0.5", [](ArticleKnobs& knobs) { knobs.square = 0.5; }},
                      Turn{"raster_pixels_per_metre=8", [](ArticleKnobs& knobs) { knobs.raster_pixels_per_metre = 8; }},
                      Turn{"pixels_per_tile=7", [](ArticleKnobs& knobs) { knobs.pixels_per_tile = 7; }}),
    [](const ::testing::TestParamInfo<Turn>& turn) { return parse_knob(turn.param.text).name; });

TEST(JumpRules, are_decided_by_the_knob_then_by_the_scene_then_by_who_it_is) {
  const std::vector<KnobSetting> on{parse_knob("jump_rules=on")};
  const std::vector<KnobSetting> off{parse_knob("jump_rules=off")};
  Scene scene = built_in("article_bullet");
  const auto in_force = [&](std::string_view kind, std::span<const KnobSetting> knobs) {
    return jump_rules_in_force(rules_for(*find_technique(kind), scene, knobs));
  };
  for (const std::optional<bool> said : {std::optional<bool>(), std::optional(false), std::optional(true)}) {
    scene.jump_rules = {said, said};
    for (const std::string_view kind : technique_names()) {
      EXPECT_EQ(in_force(kind, on), 1) << kind;
      EXPECT_EQ(in_force(kind, off), 0) << kind;
      EXPECT_EQ(in_force(kind, {}), said.value_or(kind != "octagon_sweep") ? 1 : 0) << kind;
      EXPECT_TRUE(has_knob(kind, "jump_rules"));
    }
    EXPECT_EQ(jump_rules_in_force(rules_for_twin(scene)), said.value_or(false) ? 1 : 0);
  }
  scene.jump_rules = {.no_jump_toward_wall = false};
  EXPECT_EQ(in_force("speculative", {}), 0.5) << "the scene speaks of one of the two";
  EXPECT_FALSE(rules_for(*find_technique("speculative"), scene).no_jump_toward_wall);
  EXPECT_THROW(check_knob(parse_knob("jump_rules=1"), "grid"), std::invalid_argument);
}

TEST(JumpRules, stand_in_every_row) {
  RunOptions options = quick();
  Scene scene = built_in("jump_into_overhang");
  const auto value_in = [](const Row& row) {
    const auto found = std::find_if(row.parameters.begin(), row.parameters.end(),
                                    [](const auto& each) { return each.first == "jump_rules"; });
    return found == row.parameters.end() ? -1 : found->second;
  };
  for (const Row& row : run_scene(scene, options).rows)
    EXPECT_EQ(value_in(row), row.contender == "octagon_sweep" || is_reference(row.contender) ? 0 : 1) << row.contender;
  options.knobs = {parse_knob("jump_rules=off")};
  for (const Row& row : run_scene(scene, options).rows) {
    EXPECT_EQ(value_in(row), 0) << row.contender;
    if (row.verdict == Verdict::not_applicable) continue;
    EXPECT_EQ(row.knob, is_reference(row.contender) ? "" : "jump_rules=off") << row.contender;
  }
  scene.jump_rules = {true, true};
  options.knobs.clear();
  for (const Row& row : run_scene(scene, options).rows) EXPECT_EQ(value_in(row), 1) << row.contender;
}

TEST(Knobs, of_all_that_are_turned_a_technique_names_its_own) {
  const std::vector<KnobSetting> knobs{parse_knob("unit=0.5"), parse_knob("square=2"), parse_knob("points=4")};
  EXPECT_EQ(turned_knobs(knobs, "speculative"), "unit=0.5 points=4");
  EXPECT_EQ(turned_knobs(knobs, "grid"), "square=2");
  EXPECT_EQ(turned_knobs(knobs, "octagon_sweep"), "");
}

TEST(Knobs, what_is_none_or_has_no_such_value_is_refused) {
  for (const char* text : {"", "unit", "=1", "width=1", "Unit=1", " unit=1"})
    EXPECT_THROW(static_cast<void>(parse_knob(text)), std::invalid_argument) << text;
  for (const char* text : {"unit=", "unit=0", "unit=-1", "unit=nan", "unit=1m", "unit= 1", "iterations=0",
                           "iterations=1.5", "iterations=99999999999", "points=5", "pairs=some", "response="})
    EXPECT_THROW(check_knob(parse_knob(text), "speculative"), std::invalid_argument) << text;
  EXPECT_THROW(check_knob(parse_knob("iterations=61"), "octagon_sweep"), std::invalid_argument);
  EXPECT_NO_THROW(check_knob(parse_knob("iterations=61"), "speculative"));
  EXPECT_THROW(check_knob(parse_knob("raster_pixels_per_metre=1001"), "mask"), std::invalid_argument);
}

}  // namespace
}  // namespace paperproof::compare
