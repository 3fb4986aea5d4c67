/// The command as a user runs it: exit status, what it says, which files it writes.
#include "compare/command_workplace.hpp"

#include <algorithm>

namespace paperproof::compare {

void check_call(const Json& row) {
  const Workplace place;
  const auto list = [&](const char* key) { return row.value(key, std::vector<std::string>()); };
  for (const auto& [name, text] : object_in(row, "files").items()) place.write(name, quoted(text_in(text)));
  for (const std::string& call : list("before")) ASSERT_EQ(place.run(call).status, 0) << call;
  ASSERT_EQ(place.shell(row.value("first", "true")), 0);
  for (const std::string& call : list("calls")) {
    const Finished finished = place.run(call);
    EXPECT_EQ(finished.status, row.value("status", 0)) << call << "\n" << finished.err;
    for (const std::string& part : list("out")) EXPECT_TRUE(holds(finished.out, part)) << call;
    for (const std::string& part : list("not_out")) EXPECT_FALSE(holds(finished.out, part)) << call;
    EXPECT_TRUE(holds(finished.err, row.value("says", ""))) << call;
    if (row.contains("err")) EXPECT_EQ(finished.err, row["err"]) << call;
    if (!row.contains("row") && !row.contains("reason") && !row.contains("not_reason")) continue;
    const Json last = Json::parse(finished.out).at("rows").back();
    for (const auto& [key, value] : object_in(row, "row").items()) EXPECT_EQ(last.value(key, Json()), value) << last;
    const std::string reason = quoted(last.value("reason", ""));
    EXPECT_TRUE(holds(reason, quoted(row.value("reason", "")))) << last;
    if (row.contains("not_reason")) EXPECT_FALSE(holds(reason, row["not_reason"].get<std::string>()));
  }
}

namespace {

using Command = CommandTest;
using CommandConvert = CommandTest;

const bool calls = table_tests<CommandTest>("calls.json", check_call);

TEST_F(Command, answers_on_the_first_screen_who_lets_the_bullet_through_and_what_a_step_costs) {
  const Finished finished = runs("compare article_bullet thin_platform flush_tiles");
  EXPECT_EQ(finished.err, "") << "no progress where nobody watches";
  EXPECT_TRUE(place.files().empty());
  std::vector<std::string> screen(25);
  std::istringstream text(finished.out);
  for (std::string& line : screen) ASSERT_TRUE(std::getline(text, line)) << finished.out;
  EXPECT_EQ(screen[1], "exact arithmetic: `platform` is met at 0.600");
  constexpr std::string_view cost_heading = "ns per step";
  ASSERT_TRUE(holds(screen[3], std::string(cost_heading)));
  const std::size_t cost_end = screen[3].find(cost_heading) + cost_heading.size();
  const std::map<std::string, std::string> expected{{"grid", "cannot run"},
                                                    {"pixel_colour", "stopped at 0.600"},
                                                    {"penetration_resolution", "through"},
                                                    {"octagon_sweep", "stopped at 0.6"},
                                                    {"box2d", "stopped at 0.59"}};
  for (const auto& [contender, outcome] : expected) {
    const std::string first = contender + " ";
    const auto line = std::find_if(screen.begin(), screen.end(), [&](const auto& one) { return begins(one, first); });
    ASSERT_NE(line, screen.end()) << contender;
    EXPECT_TRUE(holds(*line, "  " + outcome)) << contender;
    const std::size_t cost_begin = line->find_last_of(' ', cost_end - 1) + 1;
    const std::string cost = line->substr(cost_begin, cost_end - cost_begin);
    EXPECT_TRUE(outcome == "cannot run" ? cost == "-" : std::atof(cost.c_str()) > 1) << *line;
  }
}

TEST_F(Command, gives_rows_alone_when_asked_for_json_of_each_contender_and_scalar) {
  const Finished finished = place.run(
      "compare article_bullet --no-timing --json --contender speculative_march,octagon_sweep "
      "--scalar double,float --knob unit=0.5");
  EXPECT_EQ(finished.err, "");
  const nlohmann::json rows = nlohmann::json::parse(finished.out).at("rows");
  ASSERT_EQ(rows.size(), 4U) << "octagon_sweep in both, and Box2D beside them";
  EXPECT_EQ(rows[0]["knob"], "unit=0.5");
  // The bullet, 0.9375 m above the platform, stops at the last whole unit before it.
  EXPECT_DOUBLE_EQ(rows[0]["max_contact_gap_m"].get<double>(), 0.4375);
  EXPECT_FALSE(rows[1].contains("knob"));
  EXPECT_EQ(rows[2]["scalar"], "float");
}

TEST_F(Command, check_says_who_will_run_and_why_the_others_do_not) {
  // The same as `compare` finds, for each contender.
  const std::string turning =
      R"(], "movers": [ { "id": "arm", "polygon": [[6,0],[8,0],[8,1],[6,1]], "path": [ { "t": 0, "at": [0,0] } ], "angle": [ { "t": 0, "at": 0 }, { "t": 1, "at": 1 } ] } ],
         "characters": [ { "position": [2, 3] } ] })";
  place.write("company.json", with(good_scene, "]\n}", turning));
  const Finished checked = runs("check company.json");
  EXPECT_TRUE(holds(checked.out, "contenders run; octagon_sweep does not, so that status 0 guarantees nothing\n"));
  std::size_t running = 0;
  const nlohmann::json rows = nlohmann::json::parse(runs("compare company.json --no-timing --json").out);
  for (const nlohmann::json& row : rows.at("rows")) {
    const bool can_run = row.at("verdict") != "not_applicable";
    running += can_run;
    const std::string no = "  not " + row.at("contender").get<std::string>() + ": " + row.value("reason", "") + "\n";
    EXPECT_TRUE(can_run || holds(checked.out, no)) << no;
  }
  EXPECT_TRUE(holds(checked.out, "  compare    " + std::to_string(running) + " of 13 contenders run"));
}

TEST_F(CommandConvert, writes_a_scene_that_reads_back_as_the_same) {
  for (const char* scene : {"article_bullet", "plank_on_springs"}) {
    runs(std::string("convert ") + scene + " once.json");
    runs("convert once.json twice.json");
    EXPECT_EQ(written("once.json"), written("twice.json")) << scene;
  }
}

}  // namespace
}  // namespace paperproof::compare
