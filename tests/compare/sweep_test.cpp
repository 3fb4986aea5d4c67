/// Sweeps: axes, Cases, borders, and jobs in child processes.
#include "studies/sweep.hpp"
#include "scenes/load.hpp"
#include "studies/processes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <thread>
#include <tuple>

namespace paperproof::compare {
namespace {

using Values = std::vector<std::string>;

TEST(SweepAxes, are_logarithmic_linear_or_listed_and_end_where_they_say) {
  for (const auto& [text, values] : {std::pair{"speed=10:1000:log3", Values{"10", "100", "1000"}},
                                     {"phase=0:1:lin5", {"0", "0.25", "0.5", "0.75", "1"}},
                                     {"thickness=0.001,0.01,0.1", {"0.001", "0.01", "0.1"}},
                                     {"speed=7:9:lin1", {"7"}}})
    EXPECT_EQ(parse_axis(text).values, values) << text;
  EXPECT_EQ(parse_axis("speed=10:2000:log12").values.size(), 12U);
  EXPECT_EQ(parse_axis("speed=10:2000:log12").values.back(), "2000");
}

TEST(Sweep, has_each_combination_once_with_the_contender_varying_fastest) {
  Sweep sweep;
  sweep.scene = "paper";
  sweep.axes = {parse_axis("speed=10,40"), parse_axis("thickness=0.001,0.01,0.1")};
  sweep.contenders = {{"mask"}, {"octagon_sweep"}};
  ASSERT_EQ(sweep.size(), 12U);
  std::set<std::string> ids;
  for (std::size_t i = 0; i < sweep.size(); ++i) ids.insert(id_of(sweep.at(i)));
  EXPECT_EQ(ids.size(), 12U);
  EXPECT_EQ(command_of(sweep.at(0)),
            "paperproof compare paper --set speed=10 --set thickness=0.001 --contender mask --no-reference");
  EXPECT_EQ(command_of(sweep.at(3)),
            "paperproof compare paper --set speed=10 --set thickness=0.01 --contender octagon_sweep --no-reference");
  EXPECT_EQ(id_of(sweep.at(0)), "a6e87314b7434c74") << "it changed: rows of earlier sweeps cannot be gone on with";
}

/// Passes something above `border`; cannot be run from `from` to `to`.
std::function<Row(double)> passes_above(double border, double from = 1e9, double to = 1e9) {
  return [=](double value) {
    Row row;
    row.tunnels = value > border ? 1 : 0;
    row.verdict = value > border ? Verdict::tunnels : Verdict::holds;
    if (value >= from && value <= to) row.verdict = Verdict::failed;
    return row;
  };
}

TEST(FindBorder, brackets_a_border_that_is_known) {
  for (const auto& [least, most, border] :
       {std::tuple{0.1, 1e5, 123.4}, {0.0, 1.0, 0.3}, {-1.0, 1.0, 0.0}, {-1e3, 2e6, -7.0}}) {
    const Row found = find_border("x", least, most, passes_above(border));
    ASSERT_TRUE(found.border_low && found.border_high) << border;
    EXPECT_LE(*found.border_low, border);
    EXPECT_GT(*found.border_high, border);
    EXPECT_LE(*found.border_high - *found.border_low, 1e-4 * std::max(1.0, std::abs(*found.border_high))) << border;
    EXPECT_EQ(found.verdict, Verdict::tunnels) << "the row is that of the upper end";
  }
  const Row at_zero = find_border("x", -1, 1, passes_above(0));
  EXPECT_EQ(at_zero.border_low, 0);
  EXPECT_LT(at_zero.border_high.value(), 1e-300);
  const Row never = find_border("speed_m_s", 0.1, 1e5, passes_above(1e9));
  EXPECT_EQ(never.border_low, 1e5);
  EXPECT_FALSE(never.border_high);
  const Row always = find_border("speed_m_s", 0.1, 1e5, passes_above(0));
  EXPECT_FALSE(always.border_low);
  EXPECT_EQ(always.border_high, 0.1);
}

TEST(FindBorder, takes_another_measure_and_no_number_for_no_hold) {
  const auto slow = [](const Row& row) { return row.distance_m.value_or(0) < 20; };
  const auto moving = [](double value) {
    Row row;
    row.distance_m = value;
    return row;
  };
  EXPECT_NEAR(*find_border("speed_m_s", 1, 100, moving, 8, slow).border_high, 20, 0.002);
  const auto explodes = [](double value) {
    Row row;
    row.verdict = value > 7 ? Verdict::failed : Verdict::holds;
    row.finite = value <= 7;
    return row;
  };
  EXPECT_NEAR(*find_border("speed_m_s", 1, 100, explodes).border_low, 7, 0.001);
}

TEST(FindBorder, ends_where_a_run_cannot_be_made_and_says_so) {
  const Row row = find_border("x", 1, 100, passes_above(1e9, 50));
  EXPECT_EQ(row.verdict, Verdict::failed);
  EXPECT_GT(row.border_low.value(), 40);
  EXPECT_FALSE(row.border_high);
  EXPECT_EQ(find_border("x", 1, 100, passes_above(50, 49, 51), 2).verdict, Verdict::failed) << "in the bisection";
}

TEST(Processes, a_job_that_aborts_hangs_or_exits_is_a_result_and_the_others_run) {
  Values taken;
  Jobs jobs;
  jobs.count = 12;
  jobs.lost = [](std::size_t, const std::string& reason) { return reason; };
  jobs.take = [&taken](std::size_t job, const std::string& text) {
    EXPECT_EQ(job, taken.size()) << "in order";
    taken.push_back(text);
  };
  jobs.run = [](std::size_t job) -> std::string {
    if (job == 3) {
      std::fputs("first line\nAssertion failed: it is so\n", stderr);
      std::signal(SIGABRT, SIG_DFL);
      std::abort();
    }
    if (job == 5) std::this_thread::sleep_for(std::chrono::hours(1));
    if (job == 8) std::_Exit(0);
    return std::to_string(job * job);
  };
  run_in_processes(jobs, {.workers = 2, .limit = std::chrono::seconds(1)});
  ASSERT_EQ(taken.size(), 12U);
  const std::map<std::size_t, std::string> lost{
      {3, "Aborted: Assertion failed: it is so"}, {5, "took too long"}, {8, "ended unasked"}};
  for (std::size_t job = 0; job < taken.size(); ++job)
    EXPECT_NE(taken[job].find(lost.contains(job) ? lost.at(job) : std::to_string(job * job)), std::string::npos)
        << taken[job];
}

TEST(Families, have_members_under_their_old_names_and_defaults_in_range) {
  for (const SceneFamily& family : scene_families())
    for (const ParameterDef& def : family.parameters)
      EXPECT_TRUE(def.least <= def.usual && def.usual <= def.most) << family.name << " " << def.key;
  const Scene paper = load_scene("paper_1e-3", {});
  EXPECT_EQ((std::map<std::string, double>(paper.parameters.begin(), paper.parameters.end()).at("thickness_m")), 1e-3);
  EXPECT_TRUE(paper.source.starts_with("builtin:paper_1e-3#")) << paper.source;
}

TEST(CommonParameters, turn_any_scene) {
  const auto turned = [](const std::string& key, double value) {
    const std::vector<ParameterSetting> settings{{key, value}};
    return load_scene("jump_into_wall", settings);
  };
  const Scene usual = load_scene("jump_into_wall", {});
  const Scene slow = turned("dt", usual.dt / 4);
  EXPECT_EQ(slow.steps, 4 * usual.steps) << "as long as before";
  EXPECT_EQ(slow.input.back().step, 4 * usual.input.back().step) << "at the same time";
  const Scene large = turned("scale", 8);
  EXPECT_EQ(large.scenery.colliders.front().points.front(), 8 * usual.scenery.colliders.front().points.front());
  EXPECT_EQ(large.character.jump_speed, 8 * usual.character.jump_speed);
  const Scene far = turned("origin", 1024);
  EXPECT_EQ(far.start.position, usual.start.position + Vec2d(1024, 0));
  EXPECT_TRUE(far.answers.empty()) << "they are of the scene as it was";
  EXPECT_THROW((void)turned("thickness", 1), InputError);
  EXPECT_THROW((void)turned("dt", 0), InputError);
}

}  // namespace
}  // namespace paperproof::compare
