/// `sweep`, `study`, `merge`, `diff` and `demo` as a user runs them.
#include "compare/command_workplace.hpp"

#include <algorithm>
#include <iterator>
#include <set>

namespace paperproof::compare {
namespace {

const std::string sweep =
    "sweep paper --vary speed=10:2000:log12 --vary thickness=0.001,0.01,0.1 --contender penetration_resolution "
    "--contender octagon_sweep --contender box2d --no-timing --quiet ";

using CommandSweep = CommandTest;
using CommandStudy = CommandTest;

TEST_F(CommandSweep, gives_a_row_for_each_case_whatever_the_number_of_jobs_or_shards) {
  runs(sweep + "--rows r.jsonl --jobs 2 --log progress.txt");
  EXPECT_TRUE(holds(written("progress.txt"), "108 of 108 cases, 100.0 % in "));
  runs(sweep + "--rows one.jsonl --jobs 1");
  EXPECT_EQ(written("r.jsonl"), written("one.jsonl"));
  for (const std::string part : {"1", "2", "3"}) runs(sweep + "--shard " + part + "/3 --rows s" + part + ".jsonl");
  runs("merge s3.jsonl s1.jsonl s2.jsonl --rows m.jsonl");
  EXPECT_EQ(rows_in(written("m.jsonl")), rows_in(written("r.jsonl")));
  const std::vector<nlohmann::json> rows = rows_of("r.jsonl");
  EXPECT_EQ(rows.size(), 108U);
  int through = 0;
  for (const nlohmann::json& row : rows) {
    EXPECT_TRUE(row.at("parameters").contains("speed_m_s") && row.at("parameters").contains("thickness_m"));
    EXPECT_TRUE(row.contains("case"));
    EXPECT_TRUE(row.at("contender") != "octagon_sweep" || row.at("verdict") == "holds") << row;
    through += row.at("contender") == "penetration_resolution" && row.at("tunnels") > 0;
  }
  EXPECT_GT(through, 20);
  // The command in a row gives its case again.
  const nlohmann::json& row = rows.at(49);
  const std::string command = row.at("command");
  ASSERT_TRUE(begins(command, "paperproof "));
  (void)place.run(command.substr(11) + " --no-timing --quiet --rows again.json");
  const nlohmann::json again = nlohmann::json::parse(written("again.json")).at("rows").at(0);
  for (const char* key : {"verdict", "tunnels", "steps", "max_penetration_m", "parameters"})
    EXPECT_EQ(again.at(key), row.at(key)) << key;
}

TEST_F(CommandSweep, goes_on_behind_what_a_kill_left) {
  runs(sweep + "--rows r.jsonl");
  const std::string whole = written("r.jsonl");
  const std::size_t header = whole.find('\n') + 1;
  for (const std::size_t kept : {header, header + 10, whole.size() / 3, whole.size() - 1, whole.size()}) {
    place.write("k.jsonl", whole.substr(0, kept));
    runs(sweep + "--rows k.jsonl --resume");
    EXPECT_EQ(written("k.jsonl"), whole) << kept;
  }
  // A file system that was not shut down leaves zeros.
  for (const std::string& cut : {whole.substr(0, header + 10), whole.substr(0, header) + std::string(100, '\0'),
                                 whole.substr(0, header) + std::string(100, '\0') + "\n"}) {
    place.write("k.jsonl", cut);
    EXPECT_EQ(runs(with(sweep, "--quiet", "") + "--rows k.jsonl --resume").err,
              "k.jsonl:2: this last row is cut short; its case is run again\n");
    EXPECT_EQ(written("k.jsonl"), whole);
  }
  const auto refused = [&](const std::string& of, const std::string& left) {
    place.write("k.jsonl", left);
    const Finished finished = place.run(of + "--rows k.jsonl --resume");
    EXPECT_EQ(finished.status, 2);
    return finished.err;
  };
  EXPECT_TRUE(holds(refused("sweep paper --vary speed=1,2 --contender mask ", whole), "has rows of another sweep"));
  EXPECT_TRUE(holds(refused(sweep, whole + whole.substr(whole.find('\n', header) + 1)), "more rows than there are"));
  EXPECT_NE(refused(sweep, whole.substr(0, header) + "{}\n"), "") << "not a row of this sweep";
}

TEST_F(CommandSweep, its_page_has_replays_of_its_cells_and_so_has_a_page_of_its_rows) {
  runs(sweep + "--rows r.jsonl --report p.html");
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

TEST_F(CommandSweep, finds_a_border_for_each_contender_and_merges_them_with_the_cases_that_they_end_at) {
  const std::string both = "sweep paper --vary thickness=0.1 --contender penetration_resolution,octagon_sweep --quiet ";
  runs(both + "--find-border speed=1:100000 --rows e.jsonl");
  const std::vector<nlohmann::json> rows = rows_of("e.jsonl");
  EXPECT_LT(rows.at(0).at("border_low"), rows.at(0).at("border_high"));
  EXPECT_EQ(rows.at(0).at("border"), "speed_m_s");
  runs(both + "--vary speed=1,100000 --rows f.jsonl");
  runs("merge f.jsonl e.jsonl --rows m.jsonl");
  EXPECT_EQ(rows_of("m.jsonl").size(), 6U);
}

TEST_F(CommandStudy, of_any_kind_is_sharded_merged_and_gone_on_with) {
  for (const std::string name : {"squeeze --contender octagon_sweep", "disagreement flush_tiles article_bullet"}) {
    const std::string study = "study " + name + " --quiet --rows ";
    runs(study + "r.jsonl --report r.html");
    const std::string whole = written("r.jsonl");
    for (const std::string part : {"1", "2"}) runs(study + "s" + part + ".jsonl --shard " + part + "/2");
    runs("merge s2.jsonl s1.jsonl --rows m.jsonl");
    EXPECT_EQ(rows_in(written("m.jsonl")), rows_in(whole));
    place.write("k.jsonl", whole.substr(0, whole.size() / 2));
    runs(study + "k.jsonl --resume --report k.html");
    EXPECT_EQ(written("k.jsonl"), whole);
    EXPECT_EQ(written("k.html"), written("r.html")) << "rows from before the kill count in the page";
  }
  EXPECT_EQ(place.run("study disagreement article_bullet --rows k.jsonl --resume").status, 2);
  EXPECT_TRUE(
      holds(runs("stability --grid quick --shard 1/150 --rows b.jsonl").out, "rest and steps: A drop of 0.25 m"));
  EXPECT_EQ(rows_of("b.jsonl").size(), 3U);
}

TEST_F(CommandStudy, bullet_counts_and_gives_the_lowest_speeds) {
  const std::string out = runs("study bullet --contender penetration_resolution --rows r.jsonl").out;
  std::string single;  // spaces
  std::unique_copy(out.begin(), out.end(), std::back_inserter(single),
                   [](char a, char b) { return a == ' ' && b == ' '; });
  for (const char* part : {"contender cases hold through rate 95 % from to ",
                           "penetration_resolution 288 40 232 0.8056 0.755949 0.847118 ", "paper that comes",
                           "at holds up to fails from theory\n",  // of the lowest speeds
                           " thickness_m=0.01 0.6069 0.6069 0.6\n", " thickness_m=0.1 6.127 6.128 6\n"})
    EXPECT_TRUE(holds(single, part)) << part;
}

TEST_F(CommandSweep, diff_names_what_changed_and_nothing_else) {
  runs(sweep + "--rows r.jsonl");
  const std::string rows = written("r.jsonl");
  EXPECT_EQ(runs("diff r.jsonl r.jsonl").out, "0 rows differ, 108 the same, costs apart\n");
  const std::string changed = with(rows, "\"tunnels\":1", "\"tunnels\":2");
  place.write("s.jsonl", changed);
  const Finished differs = place.run("diff r.jsonl s.jsonl");
  EXPECT_EQ(differs.status, 1);
  EXPECT_TRUE(holds(differs.out, "tunnels 1 -> 2\n1 row differs"));
  place.write("t.jsonl", changed.substr(0, changed.rfind('\n', changed.size() - 2) + 1));
  EXPECT_TRUE(holds(place.run("diff s.jsonl t.jsonl").out, "only in s.jsonl"));
}

}  // namespace
}  // namespace paperproof::compare
