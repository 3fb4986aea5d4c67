/// The page: its texts, its tables, its file.
#include "compare/report_pages.hpp"

#include <limits>
#include <set>

namespace paperproof::compare {
namespace {

TEST_F(ReportTest, the_page_refers_to_nothing_outside_of_itself) {
  const std::string text = page(sample_report());
  for (const char* reference : {"http:", "https:", "src=", "url(", "@import", "<link", "import(", "fetch(",
                                "XMLHttpRequest", "WebSocket", "sendBeacon"}) {
    EXPECT_EQ(text.find(reference), std::string::npos) << reference;
  }
  EXPECT_EQ(text.find("/*STYLE*/"), std::string::npos);
  EXPECT_EQ(text.find("/*SCRIPT*/"), std::string::npos);
  EXPECT_EQ(text.find("<!--DATA-->"), std::string::npos);
}

TEST_F(ReportTest, text_that_ends_a_script_stays_inside_its_element) {
  Report report = sample_report();
  report.environment.emplace_back(hostile_text(), hostile_text());
  report.guarantee_notes.push_back(hostile_text());
  report.tolerances.push_back({hostile_text(), 1});
  report.scenes[0].rows[0].reason = hostile_text();
  report.scenes[0].rows[0].findings = {hostile_text()};
  report.scenes[0].runs[0].header.plan = Plan{.omitted = {{Stage::movers, hostile_text()}}};
  report.scenes[0].runs[0].events = {{1, ReportEvent::Kind::note, hostile_text()}};
  const std::string text = page(report);
  EXPECT_EQ(text.find(hostile_text()), std::string::npos);
  EXPECT_EQ(count_of(text, "throw 1<"), 0U);
  // One element per scene, the index, the catcher of errors and the page's own script.
  EXPECT_EQ(count_of(text, "</script"), report.scenes.size() + 3);
  EXPECT_EQ(count_of(text, "<script"), report.scenes.size() + 3);
}

TEST_F(ReportTest, texts_come_back_as_they_were) {
  const std::string text = page(sample_report());
  const json index = data(text, "index");
  EXPECT_EQ(index["scenes"][2]["name"], hostile_text());
  const std::string description = index["scenes"][2]["description"];
  EXPECT_NE(description.find("<b>tags</b> & a \xE2\x82\xAC,"), std::string::npos);
  EXPECT_NE(description.find("\xEF\xBF\xBD"), std::string::npos) << "bytes that are not UTF-8 become U+FFFD";
  EXPECT_EQ(data(text, "replay-2")["sceneries"][0]["ids"]["3"], hostile_text());
}

TEST_F(ReportTest, a_metric_that_does_not_apply_is_absent_and_one_that_is_not_finite_says_so) {
  const json rows = data(page(sample_report()), "index")["scenes"];
  EXPECT_FALSE(rows[0]["rows"][0].contains("contact_precision"));
  EXPECT_EQ(rows[0]["rows"][0]["max_contact_gap_m"], 5e-7);
  EXPECT_EQ(rows[0]["rows"][1]["verdict"], "tunnels");
  EXPECT_EQ(rows[1]["rows"][2]["verdict"], "not applicable");
  EXPECT_EQ(rows[2]["rows"][0]["max_penetration_m"], "not finite");
}

TEST_F(ReportTest, an_empty_report_is_a_page) {
  const std::string text = page(Report{});
  EXPECT_TRUE(data(text, "index")["scenes"].empty());
}

TEST_F(ReportTest, a_scene_without_runs_keeps_its_rows) {
  ReportScene scene = sample_report().scenes[0];
  scene.runs.clear();
  const std::string text = page(report_of(scene));
  EXPECT_EQ(data(text, "index")["scenes"][0]["rows"].size(), 3U);
  EXPECT_TRUE(data(text, "replay-0")["runs"].empty());
}

TEST_F(ReportTest, a_file_that_cannot_be_written_is_named) {
  const std::string missing = path() + ".no_such_folder/report.html";
  try {
    write_report(missing, sample_report());
    FAIL() << "it was written";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).find(missing), 0U) << error.what();
  }
}

TEST_F(ReportTest, a_writer_that_is_dropped_leaves_the_old_file_alone) {
  std::ofstream(path()) << "old";
  {
    ReportWriter writer(path());
    writer.add(sample_report().scenes[0]);
  }
  EXPECT_EQ(read(path()), "old");
  EXPECT_EQ(files_left(), 1U);
}

TEST_F(ReportTest, a_finished_report_replaces_the_old_one_and_leaves_nothing_beside_it) {
  std::ofstream(path()) << "old";
  const std::string text = page(sample_report());
  EXPECT_EQ(text.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_EQ(files_left(), 1U);
}

TEST_F(ReportTest, the_same_report_gives_the_same_bytes) {
  const std::string first = page(sample_report());
  EXPECT_EQ(first, page(sample_report()));
}

}  // namespace
}  // namespace paperproof::compare
