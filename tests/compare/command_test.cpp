/// The command as a user runs it: exit status, what it says, which files it writes.
#include "compare/command_workplace.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace paperproof::compare {
namespace {

TEST(Command, counts_runs_in_double_and_in_float_apart) {
  const Workplace place;
  const std::string common = "compare article_bullet --no-timing --contender octagon_sweep ";
  EXPECT_TRUE(holds(place.run(common).out, "octagon_sweep in double: 60 steps in 1 run, 0 runs with a violation"));
  const std::string only_float = place.run(common + "--scalar float").out;
  EXPECT_TRUE(holds(only_float, "octagon_sweep in float, for which nothing is guaranteed: 60 steps in 1 run, 0 runs"));
  EXPECT_EQ(only_float.find("in double"), std::string::npos);
  const std::string turning = "compare turning_arm --no-timing --contender octagon_sweep ";
  EXPECT_TRUE(holds(place.run(turning).out, "octagon_sweep in double: 90 steps in 1 run, 0 runs with a violation"));
  EXPECT_TRUE(holds(place.run(turning + "--scalar float").out, "0 steps in 0 runs")) << "it does not apply there";
}

TEST(Command, shows_the_table_of_a_scene_and_who_is_right) {
  const Workplace place;
  const Finished finished = place.run("compare article_bullet --no-timing");
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(finished.err, "") << "no progress where nobody watches";
  EXPECT_TRUE(begins(finished.out, "article_bullet"));
  for (const char* part : {"octagon_sweep", "penetration_resolution", "tunnels", "wrong"})
    EXPECT_TRUE(holds(finished.out, part));
  EXPECT_TRUE(place.files().empty());
}

std::vector<std::string> in_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Command, answers_on_the_first_screen_who_lets_the_bullet_through_and_what_a_step_costs) {
  const Workplace place;
  const Finished finished = place.run("compare article_bullet thin_platform flush_tiles");
  EXPECT_EQ(finished.status, 0) << finished.err;
  std::vector<std::string> screen = in_lines(finished.out);
  ASSERT_GT(screen.size(), 25U);
  screen.resize(25);
  EXPECT_EQ(screen[1], "exact arithmetic: `platform` is met at 0.600");
  constexpr std::string_view cost_heading = "ns per step";
  ASSERT_TRUE(holds(screen[3], std::string(cost_heading)));
  const std::size_t cost_end = screen[3].find(cost_heading) + cost_heading.size();
  const std::map<std::string, std::string> expected{{"grid", "cannot run"},
                                                    {"pixel_colour", "stopped at 0.600"},
                                                    {"mask", "through"},
                                                    {"discrete", "through"},
                                                    {"penetration_resolution", "through"},
                                                    {"wind_back", "through"},
                                                    {"speculative", "stopped at 0.6"},
                                                    {"speculative_march", "stopped at 0.6"},
                                                    {"octagon_sweep", "stopped at 0.6"},
                                                    {"bounding_box", "through"},
                                                    {"pixel_tile", "stopped at 0.600"},
                                                    {"box2d", "stopped at 0.59"}};
  for (const auto& [contender, outcome] : expected) {
    const std::string first = contender + " ";
    const auto line = std::find_if(screen.begin(), screen.end(), [&](const auto& one) { return begins(one, first); });
    ASSERT_NE(line, screen.end()) << contender;
    EXPECT_TRUE(holds(*line, "  " + outcome)) << contender;
    const std::string up_to_cost = line->substr(0, cost_end);
    const std::string cost = up_to_cost.substr(up_to_cost.find_last_of(' ') + 1);
    EXPECT_TRUE(outcome == "cannot run" ? cost == "-" : std::atof(cost.c_str()) > 1) << *line;
  }
}

TEST(Command, prints_one_table_over_several_scenes_and_all_of_them_when_asked) {
  const Workplace place;
  const std::string scenes = "compare article_bullet thin_platform --no-timing";
  const std::string one = place.run(scenes).out;
  EXPECT_TRUE(holds(one, "2 scenes\n"));
  EXPECT_EQ(one.find("verdict"), std::string::npos);
  EXPECT_EQ(one.find("thin_platform"), std::string::npos);
  const std::string all = place.run(scenes + " --all-tables").out;
  EXPECT_TRUE(holds(all, "\nthin_platform: "));
  EXPECT_TRUE(holds(all, "verdict"));
  EXPECT_TRUE(holds(all, "2 scenes\n"));
  for (const std::string& text : {one, all})
    for (const std::string& line : in_lines(text)) EXPECT_LE(line.size(), 300U) << line;
}

TEST(Command, runs_a_scene_from_a_file_and_writes_what_it_is_asked_for) {
  const Workplace place;
  place.write("good.json", good_scene);
  const Finished finished = place.run(
      "compare good.json --no-timing --quiet --contender octagon_sweep --rows rows.json --report report.html --trace "
      "t");
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(finished.out, "");
  EXPECT_EQ(finished.err, "");
  const auto files = place.files();
  EXPECT_EQ(files.size(), 5U);
  for (const char* name : {"rows.json", "report.html", "t.good.octagon_sweep.double.jsonl", "t.good.box2d.float.jsonl"})
    EXPECT_EQ(files.count(name), 1U) << name;
  EXPECT_EQ(nlohmann::json::parse(files.at("rows.json")).at("rows").size(), 2U);
}

TEST(Command, takes_several_contenders_and_scalars_with_commas) {
  const Workplace place;
  const Finished finished =
      place.run("compare article_bullet --no-timing --json --contender octagon_sweep,grid --scalar double,float");
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(nlohmann::json::parse(finished.out).at("rows").size(), 5U) << "two of each, and Box2D beside them";
}

TEST(Command, turns_the_knobs_of_those_that_have_them) {
  const Workplace place;
  const Finished finished = place.run(
      "compare article_bullet --no-timing --no-reference --json --contender speculative_march,mask --knob unit=0.5 "
      "--trace t");
  ASSERT_EQ(finished.status, 0) << finished.err;
  const auto rows = nlohmann::json::parse(finished.out)["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["knob"], "unit=0.5");
  // The bullet, 0.9375 m above the platform, stops at the last whole unit before it.
  EXPECT_DOUBLE_EQ(rows[0]["max_contact_gap_m"].get<double>(), 0.4375);
  EXPECT_FALSE(rows[1].contains("knob"));
  EXPECT_TRUE(holds(place.files().at("t.article_bullet.speculative_march.double.jsonl"), R"("knob":"unit=0.5")"));
}

TEST(Command, puts_rows_alone_on_standard_output_when_asked_for_json) {
  const Workplace place;
  const Finished finished = place.run("compare article_bullet wedge_60 --no-timing --json");
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  const nlohmann::json read = nlohmann::json::parse(finished.out, nullptr, false);
  ASSERT_FALSE(read.is_discarded()) << finished.out;
  EXPECT_EQ(read.at("paperproof_rows"), 1);
  int scenes = 0;
  for (const auto& row : read.at("rows"))
    if (row.at("contender") == "octagon_sweep") {
      ++scenes;
      EXPECT_EQ(row.at("verdict"), "holds");
    }
  EXPECT_EQ(scenes, 2);
}

TEST(Command, lists_names_first_and_checks_scenes) {
  const Workplace place;
  const Finished scenes = place.run("list scenes");
  EXPECT_EQ(scenes.status, 0);
  EXPECT_TRUE(begins(scenes.out, "article_bullet ")) << "no heading";
  const Finished contenders = place.run("list contenders");
  EXPECT_TRUE(holds(contenders.out, "octagon_sweep\n"));
  place.write("good.json", good_scene);
  EXPECT_EQ(place.run("check good.json").status, 0);
  place.write("bad.json", "{}");
  const Finished bad = place.run("check bad.json");
  EXPECT_EQ(bad.status, 2);
  EXPECT_TRUE(begins(bad.err, "bad.json: "));
  EXPECT_EQ(bad.out, "");
}

TEST(Command, check_says_who_will_run_and_why_the_others_do_not) {
  const Workplace place;
  EXPECT_TRUE(holds(place.run("check article_bullet").out,
                    "\n  compare    12 of 13 contenders run\n             not grid: the grid cannot express "));
  // The same as `compare` finds, for each contender.
  const std::string turning =
      R"(], "movers": [ { "id": "arm", "polygon": [[6,0],[8,0],[8,1],[6,1]], "path": [ { "t": 0, "at": [0,0] } ], "angle": [ { "t": 0, "at": 0 }, { "t": 1, "at": 1 } ] } ],
         "characters": [ { "position": [2, 3] } ] })";
  place.write("company.json", with(good_scene, "]\n}", turning));
  const Finished checked = place.run("check company.json");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_TRUE(holds(checked.out, "contenders run; octagon_sweep does not, so that status 0 guarantees nothing\n"));
  const Finished compared = place.run("compare company.json --no-timing --json");
  EXPECT_EQ(compared.status, 0) << compared.err;
  std::size_t running = 0;
  const nlohmann::json rows = nlohmann::json::parse(compared.out);
  for (const nlohmann::json& row : rows.at("rows")) {
    if (row.at("verdict") != "not_applicable")
      ++running;
    else
      EXPECT_TRUE(holds(checked.out, "  not " + row.at("contender").get<std::string>() + ": " +
                                         row.at("reason").get<std::string>() + "\n"));
  }
  EXPECT_TRUE(holds(checked.out, "  compare    " + std::to_string(running) + " of 13 contenders run"));
}

TEST(Command, says_what_a_scene_does_not_need_and_writes_it_into_traces) {
  const Workplace place;
  const Finished plan = place.run("plan article_bullet");
  EXPECT_EQ(plan.status, 0) << plan.err;
  EXPECT_TRUE(begins(plan.out, "article_bullet\n  broad phase  all_pairs: 1 piece"));
  EXPECT_TRUE(holds(plan.out, "without      jump: "));
  EXPECT_EQ(place.run("plan article_bullet --input random:1").out.find("without      jump: "), std::string::npos);
  EXPECT_EQ(place.run("plan nothing").status, 2);

  const std::string compare = "compare article_bullet --no-timing --quiet --contender octagon_sweep --trace ";
  EXPECT_EQ(place.run(compare + "planned").status, 0);
  EXPECT_EQ(place.run(compare + "full --plan full").status, 0);
  const auto files = place.files();
  const std::string planned = files.at("planned.article_bullet.octagon_sweep.double.jsonl");
  const std::string full = files.at("full.article_bullet.octagon_sweep.double.jsonl");
  const nlohmann::json header = nlohmann::json::parse(planned.substr(0, planned.find('\n')));
  EXPECT_EQ(header["plan"]["broad_phase"], "all_pairs");
  EXPECT_EQ(header["plan"]["omitted"][0]["stage"], "movers");
  EXPECT_TRUE(nlohmann::json::parse(full.substr(0, full.find('\n')))["plan"]["omitted"].empty());
  EXPECT_EQ(planned.substr(planned.find('\n')), full.substr(full.find('\n')))
      << "the steps are the same to the last bit";
}

TEST(CommandConvert, writes_a_scene_that_reads_back_as_the_same) {
  const Workplace place;
  for (const char* scene : {"article_bullet", "plank_on_springs"}) {
    EXPECT_EQ(place.run(std::string("convert ") + scene + " once.json").status, 0) << scene;
    EXPECT_EQ(place.run("convert once.json twice.json").status, 0) << scene;
    EXPECT_EQ(content(place.path("once.json")), content(place.path("twice.json"))) << scene;
    EXPECT_EQ(place.run("check once.json").status, 0) << scene;
  }
  EXPECT_EQ(place.run("convert article_bullet").status, 2) << "where to";
}

}  // namespace
}  // namespace paperproof::compare
