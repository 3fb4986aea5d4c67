/// `sweep` and `merge` as a user runs them.
#include "compare/command_workplace.hpp"
#include "support/steps_wanted.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace paperproof::compare {
namespace {

const std::string sweep =
    "sweep paper --vary speed=10:2000:log12 --vary thickness=0.001,0.01,0.1 --contender penetration_resolution "
    "--contender octagon_sweep --contender box2d --no-timing --quiet ";

std::string written(const Workplace& place, const std::string& name) { return content(place.path(name)); }

std::string rows_in(const std::string& text) { return text.substr(text.find('\n') + 1); }

TEST(CommandSweep, gives_a_row_for_each_case_whatever_the_number_of_jobs) {
  const Workplace place;
  const Finished finished = place.run(sweep + "--rows r.jsonl --jobs 2");
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(place.run(sweep + "--rows one.jsonl --jobs 1").status, 0);
  EXPECT_EQ(written(place, "r.jsonl"), written(place, "one.jsonl"));
  std::istringstream lines(rows_in(written(place, "r.jsonl")));
  int rows = 0;
  int through = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    const nlohmann::json row = nlohmann::json::parse(line);
    EXPECT_TRUE(row.at("parameters").contains("speed_m_s"));
    EXPECT_TRUE(row.at("parameters").contains("thickness_m"));
    EXPECT_TRUE(row.contains("case"));
    if (row.at("contender") == "octagon_sweep") {
      EXPECT_EQ(row.at("verdict"), "holds") << line;
    }
    through += row.at("contender") == "penetration_resolution" && row.at("tunnels") > 0;
  }
  EXPECT_EQ(rows, 108);
  EXPECT_GT(through, 20);
}

TEST(CommandSweep, shards_merged_are_the_whole) {
  const Workplace place;
  EXPECT_EQ(place.run(sweep + "--rows r.jsonl").status, 0);
  for (const char* part : {"1", "2", "3"})
    EXPECT_EQ(place.run(sweep + "--shard " + part + "/3 --rows s" + part + ".jsonl").status, 0);
  EXPECT_EQ(place.run("merge s3.jsonl s1.jsonl s2.jsonl --rows m.jsonl").status, 0);
  EXPECT_EQ(rows_in(written(place, "m.jsonl")), rows_in(written(place, "r.jsonl")));
  EXPECT_EQ(place.run("merge s1.jsonl s2.jsonl s2.jsonl --rows n.jsonl").status, 2);
  EXPECT_EQ(place.run(sweep + "--shard 4/3 --rows x.jsonl").status, 2);
}

TEST(CommandSweep, logs_how_far_it_is_to_a_file_of_its_own) {
  const Workplace place;
  EXPECT_EQ(place.run(sweep + "--rows r.jsonl --log progress.txt").status, 0);
  const std::string log = written(place, "progress.txt");
  EXPECT_TRUE(holds(log, "108 of 108 cases, 100.0 % in ")) << log;
  EXPECT_EQ(place.run(sweep + "--rows r.jsonl --log r.jsonl").status, 2);
  EXPECT_EQ(place.run(sweep + "--log nowhere/progress.txt").status, 2);
}

TEST(CommandSweep, goes_on_behind_what_a_kill_left) {
  const Workplace place;
  EXPECT_EQ(place.run(sweep + "--rows r.jsonl").status, 0);
  const std::string whole = written(place, "r.jsonl");
  const std::size_t header = whole.find('\n') + 1;
  for (const std::size_t kept : {header, header + 10, whole.size() / 3, whole.size() - 1, whole.size()}) {
    std::ofstream(place.path("k.jsonl"), std::ios::binary) << whole.substr(0, kept);
    EXPECT_EQ(place.run(sweep + "--rows k.jsonl --resume").status, 0);
    EXPECT_EQ(written(place, "k.jsonl"), whole) << kept;
  }
  // A file system that was not shut down leaves zeros.
  for (const std::string& cut : {whole.substr(0, header + 10), whole.substr(0, header) + std::string(100, '\0'),
                                 whole.substr(0, header) + std::string(100, '\0') + "\n"}) {
    std::ofstream(place.path("k.jsonl"), std::ios::binary) << cut;
    const Finished resumed = place.run(with(sweep, "--quiet", "") + "--rows k.jsonl --resume");
    EXPECT_EQ(resumed.status, 0);
    EXPECT_EQ(resumed.err, "k.jsonl:2: this last row is cut short; its case is run again\n");
    EXPECT_EQ(written(place, "k.jsonl"), whole);
  }
  const Finished other = place.run("sweep paper --vary speed=1,2 --contender mask --rows k.jsonl --resume");
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(holds(other.err, "has rows of another sweep")) << other.err;
  EXPECT_EQ(place.run(sweep + "--rows k.csv --resume").status, 2);
  std::ofstream(place.path("k.jsonl"), std::ios::binary) << whole << whole.substr(whole.find('\n', header) + 1);
  const Finished more = place.run(sweep + "--rows k.jsonl --resume");
  EXPECT_EQ(more.status, 2) << "more rows than cases";
  EXPECT_TRUE(holds(more.err, "more rows than there are cases")) << more.err;
  std::ofstream(place.path("k.jsonl"), std::ios::binary) << whole.substr(0, header) << "{}\n";
  EXPECT_EQ(place.run(sweep + "--rows k.jsonl --resume").status, 2) << "not a row of this sweep";
}

nlohmann::json element(const std::string& page, const std::string& id) {
  const std::string opening = "id=\"" + id + "\">";
  const std::size_t from = page.find(opening) + opening.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(CommandSweep, its_page_has_replays_of_its_cells_and_so_has_a_page_of_its_rows) {
  const Workplace place;
  std::ofstream(place.path("good.json")) << good_scene;
  const std::string of_file =
      "sweep good.json --vary gravity=10,20 --contender mask --quiet --rows f.jsonl --report f.html";
  EXPECT_EQ(place.run(sweep + "--rows r.jsonl --report p.html").status, 0);
  EXPECT_EQ(place.run(of_file).status, 0);
  EXPECT_EQ(element(written(place, "f.html"), "cells-0").size(), 2U);
  std::filesystem::remove(place.path("good.json"));
  EXPECT_EQ(place.run("report rows.html r.jsonl f.jsonl").status, 0);
  EXPECT_EQ(place.run("report pages.html p.html f.html").status, 0);
  const std::string of_rows = written(place, "rows.html");
  const nlohmann::json replays = element(of_rows, "cells-0");
  const nlohmann::json of_sweep = element(written(place, "p.html"), "cells-0");
  EXPECT_EQ(replays.size(), 108U) << "each cell has one case";
  // What counts as bad differs, and with it which cells come first.
  EXPECT_TRUE(std::set(replays.begin(), replays.end()) == std::set(of_sweep.begin(), of_sweep.end()));
  EXPECT_TRUE(element(of_rows, "cells-1").empty()) << "its scene is gone";
  EXPECT_TRUE(element(written(place, "pages.html"), "cells-0") == of_sweep);
  EXPECT_EQ(element(written(place, "pages.html"), "cells-1").size(), 2U);
  const nlohmann::json index = element(of_rows, "index");
  for (const nlohmann::json& grid : index.at("studies")[0].at("grids"))
    for (const nlohmann::json& line : grid.at("cells"))
      for (const nlohmann::json& cell : line) {
        const nlohmann::json& run = replays.at(cell.at(4).get<std::size_t>()).at("replay").at("runs").at(0);
        EXPECT_EQ(run.at("contender"), grid.at("title"));
        bool through = false;
        for (const nlohmann::json& event : run.at("events")) through = through || event.at(1) == "tunnel";
        EXPECT_EQ(through, begins(cell.at(2).get<std::string>(), "tunnels")) << cell;
      }
}

TEST(CommandSweep, the_command_in_a_row_gives_its_case_again) {
  const Workplace place;
  EXPECT_EQ(place.run(sweep + "--rows r.jsonl").status, 0);
  std::istringstream lines(rows_in(written(place, "r.jsonl")));
  std::string line;
  for (int skip = 0; skip < 50; ++skip) std::getline(lines, line);
  const nlohmann::json row = nlohmann::json::parse(line);
  const std::string command = row.at("command");
  ASSERT_TRUE(begins(command, "paperproof "));
  (void)place.run(command.substr(11) + " --no-timing --quiet --rows again.json");
  const nlohmann::json again = nlohmann::json::parse(written(place, "again.json")).at("rows").at(0);
  for (const char* key : {"verdict", "tunnels", "steps", "max_penetration_m"})
    EXPECT_EQ(again.at(key), row.at(key)) << key;
  EXPECT_EQ(again.at("parameters"), row.at("parameters"));
}

TEST(CommandSweep, finds_a_border_and_writes_csv_and_a_page) {
  const Workplace place;
  const Finished finished = place.run(
      "sweep paper --find-border speed --vary thickness=0.01,0.1 --contender penetration_resolution --rows f.jsonl");
  EXPECT_EQ(finished.status, 0) << finished.err;
  std::istringstream lines(rows_in(written(place, "f.jsonl")));
  int rows = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    const nlohmann::json row = nlohmann::json::parse(line);
    EXPECT_LT(row.at("border_low"), row.at("border_high"));
    EXPECT_EQ(row.at("border"), "speed_m_s");
  }
  EXPECT_EQ(rows, 2);
  EXPECT_EQ(place.run("sweep paper --vary speed=10,100 --contender mask --rows f.csv --report f.html").status, 0);
  EXPECT_TRUE(holds(written(place, "f.csv"), "parameters.speed_m_s"));
  EXPECT_TRUE(holds(written(place, "f.html"), "do not hold"));
}

TEST(CommandSweep, merge_keeps_borders_beside_the_cases_that_they_end_at) {
  const Workplace place;
  const std::string sweep_of = "sweep paper --vary thickness=0.01 --contender octagon_sweep --quiet ";
  EXPECT_EQ(place.run(sweep_of + "--find-border speed=1:100000 --rows e.jsonl").status, 0);
  EXPECT_EQ(place.run(sweep_of + "--vary speed=1,100000 --rows f.jsonl").status, 0);
  EXPECT_EQ(place.run("merge f.jsonl e.jsonl --rows m.jsonl").status, 0);
  const std::string merged = written(place, "m.jsonl");
  EXPECT_EQ(std::count(merged.begin(), merged.end(), '\n'), 4);
}

TEST(CommandStudy, corner_seam_and_squeeze_are_sweeps_prepared) {
  const Workplace place;
  for (const auto& [study, rows] : {std::pair{"corner", 12 + 25 + 16}, {"seam", 100}, {"squeeze", 4 + 9 + 9}}) {
    const Finished finished =
        place.run(std::string("study ") + study + " --contender octagon_sweep --rows " + study + ".jsonl");
    EXPECT_EQ(finished.status, 0) << finished.err;
    const std::string text = written(place, std::string(study) + ".jsonl");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), rows + 1) << study;
    EXPECT_FALSE(holds(text, "\"verdict\":\"violates\""));
  }
}

TEST(CommandStudy, of_several_parts_is_sharded_merged_and_gone_on_with) {
  const Workplace place;
  const std::string study = "study squeeze --contender octagon_sweep --quiet --rows ";
  EXPECT_EQ(place.run(study + "r.jsonl --report r.html").status, 0);
  const std::string whole = written(place, "r.jsonl");
  for (const char* part : {"1", "2"})
    EXPECT_EQ(place.run(study + "s" + part + ".jsonl --shard " + part + "/2").status, 0);
  EXPECT_EQ(place.run("merge s1.jsonl s2.jsonl --rows m.jsonl").status, 0);
  EXPECT_EQ(rows_in(written(place, "m.jsonl")), rows_in(whole));
  std::ofstream(place.path("k.jsonl"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_EQ(place.run(study + "k.jsonl --resume --report k.html").status, 0);
  EXPECT_EQ(written(place, "k.jsonl"), whole);
  EXPECT_EQ(written(place, "k.html"), written(place, "r.html")) << "rows from before the kill count in the maps";
  for (const char* title : {"a fall down a shaft: ", "walls that close in: ", "a lift under a ceiling: "})
    EXPECT_TRUE(holds(written(place, "r.html"), title)) << title;
}

TEST(CommandStudy, bullet_counts_gives_the_lowest_speeds_and_is_sharded) {
  const Workplace place;
  const std::string study = "study bullet --contender penetration_resolution ";
  const Finished whole = place.run(study + "--rows r.jsonl");
  EXPECT_EQ(whole.status, 0) << whole.err;
  EXPECT_TRUE(holds(whole.out, "penetration_resolution    288      232")) << whole.out;
  EXPECT_TRUE(holds(whole.out, "0.6069     0.6            6.128       6")) << "lowest speeds and theory: " << whole.out;
  EXPECT_TRUE(holds(whole.out, "paper that comes")) << whole.out;
  if (test::sanitized) return;  // other tests shard and merge, in less time
  for (const char* part : {"1", "2"})
    EXPECT_EQ(place.run(study + "--quiet --rows s" + part + ".jsonl --shard " + part + "/2").status, 0);
  EXPECT_EQ(place.run("merge s1.jsonl s2.jsonl --rows m.jsonl").status, 0);
  EXPECT_EQ(rows_in(written(place, "m.jsonl")), rows_in(written(place, "r.jsonl")));
}

TEST(CommandDiff, names_what_changed_and_nothing_else) {
  const Workplace place;
  EXPECT_EQ(place.run(sweep + "--rows r.jsonl").status, 0);
  std::string changed = written(place, "r.jsonl");
  const std::size_t at = changed.find("\"tunnels\":1");
  ASSERT_NE(at, std::string::npos);
  changed.replace(at, 11, "\"tunnels\":2");
  std::ofstream(place.path("s.jsonl"), std::ios::binary) << changed;
  const Finished same = place.run("diff r.jsonl r.jsonl");
  EXPECT_EQ(same.status, 0);
  EXPECT_EQ(same.out, "0 rows differ, 108 the same, costs apart\n");
  const Finished differs = place.run("diff r.jsonl s.jsonl");
  EXPECT_EQ(differs.status, 1);
  EXPECT_TRUE(holds(differs.out, "tunnels 1 -> 2\n1 row differs")) << differs.out;
  std::string older = written(place, "r.jsonl");
  for (std::size_t at_commit = 0; (at_commit = older.find("\"commit\":\"", at_commit)) != std::string::npos;)
    older.replace(at_commit += 10, 1, "x");
  std::ofstream(place.path("o.jsonl"), std::ios::binary) << older;
  EXPECT_EQ(place.run("diff r.jsonl o.jsonl").status, 0) << "the same rows of another commit";
  std::ofstream(place.path("t.jsonl"), std::ios::binary)
      << changed.substr(0, changed.rfind('\n', changed.size() - 2) + 1);
  EXPECT_TRUE(holds(place.run("diff s.jsonl t.jsonl").out, "only in s.jsonl"));
  EXPECT_EQ(place.run("diff r.jsonl nothing.jsonl").status, 2);
}

TEST(CommandDemo, shows_where_the_bullet_ends_technique_by_technique) {
  const Workplace place;
  const Finished all = place.run("demo");
  EXPECT_EQ(all.status, 0) << all.err;
  for (const char* part : {"\nmask: through\n", "\noctagon_sweep: stopped at 0.600\n", "\ngrid: cannot run\n",
                           "\nspeculative_march: stopped at 0.600\n", "  end of step 1"})
    EXPECT_TRUE(holds(all.out, part)) << part;
  const Finished one = place.run("demo wind_back");
  EXPECT_TRUE(holds(one.out, "wind_back: through"));
  EXPECT_FALSE(holds(one.out, "octagon_sweep"));
  EXPECT_EQ(place.run("demo windback").status, 2);
}

}  // namespace
}  // namespace paperproof::compare
