#include "studies/bullet.hpp"

#include "embedded.hpp"
#include "runs/run_case.hpp"
#include "scenes/load.hpp"
#include "support/expected.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <tuple>

namespace paperproof::compare {
namespace {

TEST(Wilson, is_as_tabulated) {
  EXPECT_DOUBLE_EQ(wilson(0, 0).high, 1);
  EXPECT_DOUBLE_EQ(wilson(0, 10).low, 0);
  EXPECT_NEAR(wilson(0, 10).high, 0.2775, 1e-4);
  EXPECT_NEAR(wilson(5, 10).low, 0.2366, 1e-4);
  EXPECT_NEAR(wilson(5, 10).high, 0.7634, 1e-4);
  EXPECT_NEAR(wilson(10, 10).low, 0.7225, 1e-4);
}

TEST(BulletTheory, is_as_worked_out_by_hand) {
  // Without a lowest speed none passes. The rows 0, 0.3125, 0.9375, 1.25 leave wind_back a gap of circles from
  // 0.10385 m on.
  for (const auto& [contender, thickness, lowest] :
       std::vector<std::tuple<NamedContender, double, std::optional<double>>>{
           {{"penetration_resolution"}, 0.01, 0.6},
           {{"discrete"}, 0.1, 81},
           {{"mask"}, 0.1, (1.25 + 2.0 / 32) * 60},  // three rows, less one
           {{"mask"}, 0.01, 0},                      // no middle of a pixel is in it
           {{"pixel_colour"}, 0.1, {}},
           {{"speculative_march"}, 0.01, 0.6},
           {{"speculative_march"}, 0.1, {}},  // thicker than its unit
           {{"wind_back"}, 0.1, 6.2308},
           {{"box2d", {{"continuous", "off"}}}, 0.1, 38.7},
           {{"box2d", {{"bullet", "off"}, {"solids", "dynamic"}}}, 0.1, 41.7},
           {{"box2d"}, 0.1, {}}}) {
    const BulletTheory theory = bullet_theory(contender, thickness);
    ASSERT_EQ(theory.lowest.has_value(), lowest.has_value()) << contender.called() << " " << thickness;
    EXPECT_NEAR(theory.lowest.value_or(0), lowest.value_or(0), contender.name == "wind_back" ? 1e-3 : 1e-9);
  }
  EXPECT_TRUE(bullet_theory({"octagon_sweep"}, 0.01).known);
  for (const auto& [who, thickness, words] : {std::tuple{"penetration_resolution", 0.01, "0.6"},
                                              {"mask", 0.01, "any"},
                                              {"octagon_sweep", 0.1, "never"},
                                              {"octagon_sweep in float", 0.1, "-"},
                                              {"box2d bullet=off solids=dynamic", 0.1, "41.7"}})
    EXPECT_EQ(bullet_theory_in_words(who, thickness), words) << who;
}

TEST(RunCase, of_what_there_is_not_is_a_failed_row) {
  Case one;
  one.scene = "paper";
  one.parameters = {{"speed", "-3"}};
  one.contender = "octagon_sweep";
  const Row row = run_case(one);
  EXPECT_EQ(row.verdict, Verdict::failed);
  EXPECT_NE(row.reason.find("expected speed from 0.1"), std::string::npos) << row.reason;
  one.scene = "papr";
  EXPECT_EQ(run_case(one).verdict, Verdict::failed);
}

/// Their texts have no schema.
TEST(PreparedStudies, have_no_key_that_nothing_reads) {
  using paperproof::test::refuse_other_keys;
  const auto check_parts = [](const nlohmann::json& parts) {
    for (const nlohmann::json& part : parts)
      refuse_other_keys(part,
                        " title question scene axes steps set border range only also because instead either_way "
                        "most_off replicas_along has_slopes phases ",
                        "a part");
  };
  for (const nlohmann::json& study : nlohmann::json::parse(prepared_studies_file.front().text)) {
    refuse_other_keys(study, " name help title paragraphs grid in_one_table parts groups promised others ", "a study");
    check_parts(study.value("parts", nlohmann::json::array()));
    for (const char* one : {"promised", "others"})
      if (study.contains(one)) check_parts(nlohmann::json::array({study[one]}));
    for (const nlohmann::json& group : study.value("groups", nlohmann::json::array())) {
      refuse_other_keys(group, " name question parts ", "a group");
      check_parts(group.at("parts"));
    }
  }
}

TEST(PreparedStudies, ask_for_cases_that_can_be_run_in_every_corner_of_every_grid_and_more_in_a_larger_one) {
  int loaded = 0;
  for (const PreparedStudy& study : prepared_studies()) {
    std::vector<std::size_t> cases;
    for (const GridSize size : {GridSize::quick, GridSize::standard, GridSize::full}) {
      cases.push_back(0);
      for (const StudyPart& part : study.parts(size, {})) {
        EXPECT_NO_THROW(check(part.sweep)) << part.title;
        cases.back() += part.sweep.size();
        Sweep sweep = part.sweep;
        sweep.contenders.resize(1);
        for (SweepAxis& axis : sweep.axes) axis.values = {axis.values.front(), axis.values.back()};
        for (std::size_t index = 0; index < sweep.size(); ++index) {
          std::vector<ParameterSetting> settings;
          const Case one = sweep.at(index);
          for (const Case::Setting& each : one.parameters)
            settings.push_back(parse_setting(each.key + "=" + each.value));
          EXPECT_NO_THROW(static_cast<void>(load_scene(one.scene, settings))) << command_of(one);
          ++loaded;
        }
      }
    }
    EXPECT_TRUE(cases[0] < cases[1] && cases[1] < cases[2]) << study.name;
  }
  EXPECT_GT(loaded, 500);
}

struct Count {
  int cases = 0;
  int through = 0;
};
/// The cases of a part in which a contender runs, and passes a solid.
Count through_in(const std::vector<StudyPart>& parts, const std::string& title, const std::string& called) {
  Count count;
  for (const StudyPart& part : parts) {
    if (part.title != title) continue;
    Sweep sweep = part.sweep;
    std::erase_if(sweep.contenders, [&](const NamedContender& one) { return one.called() != called; });
    for (std::size_t index = 0; index < sweep.size(); ++index) {
      const Row row = run_at(sweep, index);
      count.cases += was_judged(row);
      count.through += row.tunnels.value_or(0) > 0;
    }
  }
  return count;
}

TEST(PreparedStudies, find_the_holes_of_box2d_on_their_quick_grids) {
  std::map<std::string, std::vector<StudyPart>> studies;
  for (const PreparedStudy& study : prepared_studies()) studies[study.name] = study.parts(GridSize::quick, {});
  studies.erase("stability");  // has tests of its own
  const std::string wedge = "a wedge hit at 100 m/s, by solver iterations";
  EXPECT_GT(through_in(studies["corner"], wedge, "box2d").through, 0);
  EXPECT_GT(through_in(studies["squeeze"], "walls that close in", "box2d").through, 0);
  EXPECT_GT(through_in(studies["squeeze"], "a lift under a ceiling", "box2d movers=transform").through, 0);
  EXPECT_GT(through_in(studies["bullet"], "paper that comes", "box2d movers=transform").through, 0);
  const Count by_velocity = through_in(studies["bullet"], "paper that comes", "box2d");
  EXPECT_GT(by_velocity.cases, 0);
  EXPECT_EQ(by_velocity.through, 0);
  EXPECT_GT(through_in(studies["bullet"], "a wall far from the origin", "box2d").through, 0);
  EXPECT_GT(through_in(studies["bullet"], "", "box2d bullet=off solids=dynamic").through, 0);
  for (auto& [name, parts] : studies)
    for (const StudyPart& part : parts) {
      if (part.title.empty() || part.title == wedge || part.sweep.border) continue;
      const Count ours = through_in({part}, part.title, "octagon_sweep");
      EXPECT_GT(ours.cases, 0) << name << ": " << part.title;
      EXPECT_EQ(ours.through, 0) << name << ": " << part.title;
    }
}

}  // namespace
}  // namespace paperproof::compare
