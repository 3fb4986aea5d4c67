/// What the command writes: rows in three formats, to a pipe that closes, and in a run that is killed.
/// tables/calls.json has full disks and all other calls.
#include "compare/command_workplace.hpp"

#include <set>
#include <tuple>

namespace paperproof::compare {
namespace {

using CommandOutputs = CommandTest;

TEST_F(CommandOutputs, report_puts_rows_and_pages_into_one_page) {
#ifndef NDEBUG
  GTEST_SKIP() << "work-precision refuses a build with assertions";
#endif
  const std::string quiet = " --quiet --contender mask,octagon_sweep";
  for (const std::string run : {"compare article_bullet --no-timing --report m.html --rows m.json",
                                "sweep paper --vary speed=10,2000 --vary thickness=0.01,0.1 --rows s.jsonl",
                                "work-precision rest --rows w.jsonl"})
    EXPECT_EQ(place.run(run + quiet).status, 0) << run;
  EXPECT_EQ(place.run("report all.html m.html s.jsonl w.jsonl").status, 0);
  EXPECT_EQ(place.run("report rows.html m.json s.jsonl").status, 0);
  const auto files = place.files();
  const nlohmann::json compared = element(files.at("m.html"), "index");
  const nlohmann::json all = element(files.at("all.html"), "index");
  for (const char* part : {"scenes", "environment", "sections"}) EXPECT_EQ(all.at(part), compared.at(part)) << part;
  ASSERT_EQ(all.at("studies").size(), 2U);
  const nlohmann::json of_rows = element(files.at("rows.html"), "index");
  ASSERT_EQ(of_rows.at("scenes").size(), 1U);
  EXPECT_EQ(of_rows.at("scenes")[0].at("rows"), compared.at("scenes")[0].at("rows"));
  EXPECT_EQ(place.run("report m.html m.html").status, 2) << "it would overwrite what it reads";
  EXPECT_EQ(place.run("compare article_bullet --quiet --strip /dev/null/x.svg").status, 2);
}

TEST_F(CommandOutputs, json_lines_keep_what_is_done_when_the_command_is_interrupted) {
  place.write("long.json", good_with("\"steps\": 20", "\"steps\": 1000000000"));
  (void)place.run("compare article_bullet long.json --no-timing --quiet --contender octagon_sweep --rows rows.jsonl",
                  "timeout -s INT 4");
  const std::vector<nlohmann::json> read = json_lines(place.files().at("rows.jsonl"));
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].at("paperproof_rows"), 1);
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) EXPECT_EQ(read[i].at("scene"), "article_bullet");
}

TEST_F(CommandOutputs, a_signal_removes_what_is_not_whole) {
  place.write("long.json", good_with("\"steps\": 20", "\"steps\": 1000000000"));
  // Signals the command as soon as both files are open, and waits for its end.
  place.write("then.sh", R"("$@" & p=$!
until test -e rows.json.part -a -e page.html.part; do sleep 0.01; done
for signal in $signals; do kill -s $signal $p; sleep 0.1; ls *.part >left.$signal 2>/dev/null; done
wait $p)");
  const auto signalled = [&](const std::string& signals, const std::string& before = "") {
    return place
        .run("compare long.json --no-timing --quiet --contender octagon_sweep --rows rows.json --report page.html",
             "signals='" + signals + "' timeout 60 sh then.sh " + before)
        .status;
  };
  const auto parts = [&] {
    std::size_t count = 0;
    for (const char* name : {"rows.json.part", "page.html.part"}) count += std::filesystem::remove(place.path(name));
    return count;
  };
  for (const auto& [name, number, left] : {std::tuple{"TERM", 15, 0U}, {"HUP", 1, 0U}, {"KILL", 9, 2U}}) {
    EXPECT_EQ(signalled(name), 128 + number);
    EXPECT_EQ(parts(), left) << name << "; nobody can do anything about KILL";
  }
  // Who starts it with `nohup` wants it to go on. A shell has its jobs in the background ignore INT.
  EXPECT_EQ(signalled("HUP INT TERM", "nohup"), 128 + 15);
  EXPECT_EQ(content(place.path("left.HUP")), "page.html.part\nrows.json.part\n");
  EXPECT_EQ(content(place.path("left.INT")), "page.html.part\nrows.json.part\n");
  EXPECT_EQ(parts(), 0U);
}

TEST_F(CommandOutputs, a_closed_pipe_ends_the_command_quietly_and_leaves_nothing_behind) {
  for (const std::string arguments : {"list scenes", "check technique_gallery",
                                      "compare article_bullet --no-timing --rows rows.json --report r.html"}) {
    // The reader is gone before the command begins.
    const std::string call = " '" PAPERPROOF_COMMAND "' </dev/null " + arguments;
    EXPECT_EQ(place.shell("{ sleep 0.5;" + call + " 2>said; echo $? >status; } | true"), 0);
    EXPECT_EQ(place.files(), (std::map<std::string, std::string>{{"said", ""}, {"status", "141\n"}})) << arguments;
  }
}

TEST_F(CommandOutputs, the_page_of_a_sweep_has_replays_of_its_cells_and_so_has_a_page_of_its_rows) {
  runs(
      "sweep paper --vary speed=10:2000:log12 --vary thickness=0.001,0.01,0.1 --no-timing --quiet "
      "--contender penetration_resolution,octagon_sweep,box2d --rows r.jsonl --report p.html");
  runs("report rows.html r.jsonl");
  const std::string of_rows = written("rows.html");
  const nlohmann::json replays = element(of_rows, "cells-0");
  const nlohmann::json of_sweep = element(written("p.html"), "cells-0");
  EXPECT_EQ(replays.size(), 108U) << "each cell has one case";
  // What counts as bad differs, and with it which cells come first.
  EXPECT_TRUE(std::set(replays.begin(), replays.end()) == std::set(of_sweep.begin(), of_sweep.end()));
  const nlohmann::json index = element(of_rows, "index");
  for (const nlohmann::json& grid : index.at("studies")[0].at("grids"))
    for (const nlohmann::json& line : grid.at("cells"))
      for (const nlohmann::json& cell : line) {
        const std::string replay = unpacked(replays.at(cell.at(4).get<std::size_t>()).at("replay").dump());
        EXPECT_NE(replay.find("\"contender\":" + grid.at("title").dump()), std::string::npos) << replay;
        const bool through = replay.find(R"("kind":"tunnel")") != std::string::npos;
        EXPECT_EQ(through, begins(cell.at(2).get<std::string>(), "tunnels")) << cell;
      }
}

}  // namespace
}  // namespace paperproof::compare
