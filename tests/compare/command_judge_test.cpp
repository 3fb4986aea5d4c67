/// `paperproof judge` of traces that the command wrote.
#include "compare/command_workplace.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

/// Writes t.SCENE.octagon_sweep.double.jsonl.
void trace(const Workplace& place, const std::string& scene_and_options) {
  const std::string options = " --contender octagon_sweep --scalar double --no-reference --no-timing --quiet --trace t";
  ASSERT_EQ(place.run("compare " + scene_and_options + options).status, 0);
}

/// Without its last lines.
std::string cut(const std::string& text, int lines) {
  std::size_t end = text.size();
  for (; lines > 0; --lines) end = text.rfind('\n', end - 2) + 1;
  return text.substr(0, end);
}

TEST(CommandJudge, takes_the_settings_of_the_scene) {
  const Workplace place;
  const std::string judge = "judge t.closing_lift.octagon_sweep.double.jsonl --scene closing_lift";
  trace(place, "closing_lift --set clearance=-0.1");
  EXPECT_EQ(place.run(judge + " --set clearance=-0.1").status, 0);
  EXPECT_EQ(place.run(judge).status, 1) << "with another clearance nothing crushes it";
  EXPECT_EQ(place.run(judge + " --set no_such=1").status, 2);
  EXPECT_TRUE(holds(place.run("judge t.closing_lift.octagon_sweep.double.jsonl --set clearance=-0.1").err,
                    "--set requires --scene"));
}

TEST(CommandJudge, asks_for_every_step_of_the_run) {
  const Workplace place;
  trace(place, "article_bullet");
  const std::string name = "t.article_bullet.octagon_sweep.double.jsonl";
  const std::string whole = content(place.path(name));
  ASSERT_TRUE(holds(whole, ",\"steps\":60,"));
  place.write("cut.jsonl", cut(whole, 1));
  place.write("unsaid.jsonl", with(cut(whole, 1), "\"steps\":60,", ""));
  const std::string broken =
      "\n  continuity on 1 step, first in step 58: the trace ends with this step, and the run has 60";
  EXPECT_EQ(place.run("judge " + name + " --scene article_bullet").status, 0);
  for (const char* spoilt : {"cut.jsonl", "cut.jsonl --scene article_bullet", "unsaid.jsonl --scene article_bullet"}) {
    const Finished finished = place.run(std::string("judge ") + spoilt);
    EXPECT_EQ(finished.status, 1) << spoilt;
    EXPECT_TRUE(holds(finished.out, broken)) << spoilt << finished.out;
  }
  EXPECT_EQ(place.run("judge unsaid.jsonl").status, 0) << "nobody says how long the run was";
}

TEST(CommandJudge, takes_the_number_of_steps_that_ran) {
  const Workplace place;
  trace(place, "article_bullet --steps 20");
  const std::string judge = "judge t.article_bullet.octagon_sweep.double.jsonl";
  EXPECT_EQ(place.run(judge).status, 0);
  EXPECT_EQ(place.run(judge + " --scene article_bullet --steps 20").status, 0);
  const Finished other = place.run(judge + " --scene article_bullet");
  EXPECT_EQ(other.status, 0);
  EXPECT_TRUE(holds(other.out, "\n  the scene has 60 steps\n")) << other.out;
  EXPECT_EQ(place.run(judge + " --scene article_bullet --steps 60").status, 1) << "who asks for 60 gets 20";
}

TEST(CommandJudge, accuses_no_run_that_a_refusal_ended) {
  const Workplace place;
  place.write("far.json", R"({"paperproof_scene": 1, "name": "far", "gravity": [0, 0], "dt": 0.5, "steps": 60,
    "character": {"position": [0, 0], "velocity": [300000, 0]},
    "scenery": [{"id": "floor", "polygon": [[-4, -9], [4, -9], [4, -8], [-4, -8]]}]})");
  trace(place, "far.json");
  const std::string name = "t.far.octagon_sweep.double.jsonl";
  const std::string text = content(place.path(name));
  ASSERT_TRUE(holds(text, "\"steps\":60") && holds(text, "\"refused\":"));
  for (const std::string& options : {std::string(), std::string(" --scene far.json"), std::string(" --all")}) {
    const Finished finished = place.run("judge " + name + options);
    EXPECT_FALSE(holds(finished.out, "continuity")) << finished.out << finished.err;
    EXPECT_TRUE(holds(finished.out, "1 step refused")) << finished.out << finished.err;
  }
}

TEST(CommandJudge, asks_no_number_of_steps_of_lockstep) {
  const Workplace place;
  ASSERT_EQ(place.run("compare article_bullet --mode lockstep --no-timing --quiet --trace t").status, 0);
  for (const std::string& name : {std::string("t.article_bullet.octagon_sweep.double.jsonl"),
                                  std::string("t.twin_of_octagon_sweep.article_bullet.box2d.float.jsonl")}) {
    const std::string text = content(place.path(name));
    ASSERT_FALSE(text.empty() || holds(text, "\"steps\":")) << name;
    place.write("cut.jsonl", cut(text, 1));
    EXPECT_FALSE(holds(place.run("judge cut.jsonl").out, "continuity")) << name;
  }
}

}  // namespace
}  // namespace paperproof::compare
