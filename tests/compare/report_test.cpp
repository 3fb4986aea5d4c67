/// The page: its texts, its tables, its file; and how it is read back.
#include "compare/report_pages.hpp"
#include "report/page_reader.hpp"
#include "support/refusal.hpp"

#include <cmath>

namespace paperproof::compare {
namespace {

const std::string hostile_text = "</script><script>throw 1</script><!-- & \" ' ]]>";

/// Every text of it tries to end its element.
Report hostile_report() {
  ReportScene scene = walk_of(5);
  scene.name = scene.sentence = hostile_text;
  scene.description = "\"quotes\", <b>tags</b> & a \xE2\x82\xAC, and bytes that are not UTF-8: \xFF\xFE.";
  scene.rows[0].reason = hostile_text;
  scene.rows[0].findings = {hostile_text};
  ReportRun& run = scene.runs[0];
  run.header.ids[2] = hostile_text;
  run.header.plan = LevelPlan{.omitted = {{"movers", hostile_text}}};
  run.events = {{1, ReportEvent::Kind::note, hostile_text}};
  Report report = report_of(scene);
  report.scenes.push_back(walk_of(3));
  report.facts.environment.emplace_back(hostile_text, hostile_text);
  report.facts.guarantee_notes.push_back(hostile_text);
  report.facts.tolerances.push_back({hostile_text, 1});
  return report;
}

TEST_F(ReportTest, the_page_refers_to_nothing_outside_of_itself_and_no_text_leaves_its_element) {
  const Report report = hostile_report();
  const std::string text = page(report);
  for (const char* reference : {"http:", "https:", "src=", "url(", "@import", "<link", "import(", "fetch(",
                                "XMLHttpRequest", "WebSocket", "sendBeacon", "/*STYLE*/", "/*SCRIPT*/", "<!--DATA-->"})
    EXPECT_EQ(text.find(reference), std::string::npos) << reference;
  EXPECT_EQ(text.find(hostile_text), std::string::npos);
  EXPECT_EQ(count_of(text, "throw 1<"), 0U);
  // One element per scene, the index, the catcher of errors and the page's own script.
  EXPECT_EQ(count_of(text, "</script"), report.scenes.size() + 3);
  EXPECT_EQ(count_of(text, "<script"), report.scenes.size() + 3);
  const json scene = element(text, "index")["scenes"][0];
  EXPECT_EQ(scene["name"], hostile_text);
  EXPECT_EQ(scene["description"],
            "\"quotes\", <b>tags</b> & a \xE2\x82\xAC, and bytes that are not UTF-8: \xEF\xBF\xBD\xEF\xBF\xBD.");
  EXPECT_NE(unpacked(element(text, "replay-0").dump()).find(json(hostile_text).dump()), std::string::npos);
}

TEST_F(ReportTest, a_metric_that_does_not_apply_is_absent_and_one_that_is_not_finite_says_so) {
  ReportScene scene = walk_of(5);
  scene.rows.resize(2);
  scene.rows[0].max_contact_gap_m = 5e-7;
  scene.rows[0].max_penetration_m = std::nan("");
  scene.rows[1].verdict = Verdict::not_applicable;
  scene.runs.clear();
  const std::string text = page(report_of(scene));
  const json rows = element(text, "index")["scenes"][0]["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_FALSE(rows[0].contains("contact_precision"));
  EXPECT_EQ(rows[0]["max_contact_gap_m"], 5e-7);
  EXPECT_EQ(rows[0]["max_penetration_m"], "not finite");
  EXPECT_EQ(rows[1]["verdict"], "not applicable");
  EXPECT_TRUE(element(text, "replay-0").is_null()) << "a scene without runs keeps its rows";
  EXPECT_TRUE(element(page(Report{}), "index")["scenes"].empty());
}

TEST_F(ReportTest, a_finished_page_replaces_the_old_one_and_a_writer_that_is_dropped_leaves_it) {
  std::ofstream(path()) << "old";
  {
    ReportWriter writer(path());
    writer.add(walk_of(3));
  }
  EXPECT_EQ(content(path()), "old");
  EXPECT_EQ(files_left(), 1U);
  const std::string text = page(hostile_report());
  EXPECT_EQ(text.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_EQ(files_left(), 1U);
  EXPECT_EQ(text, page(hostile_report())) << "the same report gives the same bytes";
  const std::string missing = path() + ".no_such_folder/report.html";
  EXPECT_TRUE(begins(test::refusal_by<std::runtime_error>([&] { write_report(missing, hostile_report()); }), missing));
}

TEST_F(ReportTest, a_page_is_read_back_as_it_was_written) {
  const std::string text = page(hostile_report());
  const PageReader reader(path());
  EXPECT_EQ(json(reader.index()), element(text, "index"));
  for (std::size_t scene = 0; scene < 2; ++scene)
    EXPECT_EQ(json::parse(reader.replay(scene)), element(text, "replay-" + std::to_string(scene)));
  std::ofstream(path()) << with(text, element(text, "replay-0").dump(), R"({"quantum":1})");
  EXPECT_THROW(static_cast<void>(PageReader(path()).replay(0)), std::runtime_error) << "steps in another format";
  std::ofstream(path()) << "<html></html>";
  EXPECT_THROW(PageReader{path()}, std::runtime_error);
}

}  // namespace
}  // namespace paperproof::compare
