/// Verdicts, and what is said of many rows: outcomes in plain words, all scenes in one table, and the gallery: who
/// fails where, and who is the cheapest of those that do not.
#include "compare/scene_files.hpp"
#include "compare/scene_runs.hpp"
#include "records/verdict.hpp"
#include "runs/gallery.hpp"
#include "runs/row_views.hpp"
#include "words.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace paperproof::compare {
namespace {

Row row(const std::string& scene, const std::string& contender, std::optional<double> ns = {}) {
  Row row;
  row.scene = scene;
  row.contender = contender;
  row.ns_per_step = ns;
  return row;
}

TEST(Headline, says_the_worst_that_happened_in_plain_words) {
  Row one = row("a", "one");
  const auto says = [&](auto member, const auto& value) {
    one.*member = value;
    return outcome_of(one);
  };
  EXPECT_EQ(outcome_of(one), "meets nothing");
  one.first_contact_fraction = 0.6;
  EXPECT_EQ(says(&Row::first_contact_step, 0), "stopped at 0.600");
  EXPECT_EQ(says(&Row::first_contact_step, 12), "stopped at 0.600 of step 12");
  EXPECT_EQ(says(&Row::hanging_steps, 7), "hangs on 7 steps");
  EXPECT_EQ(says(&Row::steps_ending_inside, 3), "ends inside on 3 steps");
  EXPECT_EQ(says(&Row::tunnels, 1), "through");
  EXPECT_EQ(says(&Row::tunnels, 2), "through on 2 steps");
  EXPECT_EQ(says(&Row::verdict, Verdict::not_applicable), "cannot run");
}

TEST(Headline, trusts_the_one_with_a_guarantee) {
  std::vector<Row> rows{row("a", "mask"), row("a", "octagon_sweep")};
  EXPECT_EQ(exact_answer(rows), "") << "there is nothing to meet";
  rows[0].exact_first_impact_step = 3;
  rows[0].exact_first_impact_fraction = 0.25;
  EXPECT_EQ(exact_answer(rows), "exact arithmetic: a solid is met at 0.250 of step 3");
  rows[1].exact_first_impact_step = 2;
  rows[1].exact_first_impact_fraction = 0.5;
  rows[1].exact_first_impact = "`paper`";
  EXPECT_EQ(exact_answer(rows), "exact arithmetic: `paper` is met at 0.500 of step 2");
}

TEST(Summary, adds_up_steps_and_counts_scenes) {
  std::vector<Row> rows{row("a", "one", 30), row("a", "two"), row("b", "one", 10), row("b", "two"),
                        row("c", "one", 20)};
  rows[0].tunnels = 3;
  rows[2].tunnels = 0;
  rows[4].tunnels = 2;
  rows[1].tunnels = 0;
  rows[3].verdict = Verdict::not_applicable;
  const std::string text = summary_table(rows);
  std::string single;  // spaces
  std::unique_copy(text.begin(), text.end(), std::back_inserter(single),
                   [](char a, char b) { return a == ' ' && b == ' '; });
  for (const char* line : {"contender scenes through ns/step\n", "\none 3 5 in 2 20\n", "\ntwo 1 0 -\n"})
    EXPECT_TRUE(holds(single, line)) << "nothing is said of inside, as no row has it";
}

TEST(Words, of_a_sentence_are_left_out_where_a_terminal_has_no_room) {
  EXPECT_EQ(shortened("one two three", 13), "one two three");
  EXPECT_EQ(shortened("one two three", 12), "one two …");
  const std::string umlauts = "\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4";
  EXPECT_EQ(shortened(umlauts, 10), "\u00e4\u00e4\u00e4 …") << "no character is cut in two";
  EXPECT_EQ(in_lines("A is 0.5 m. B is 1 m."), "A is 0.5 m.\nB is 1 m.\n");
}

TEST(Gallery, names_the_worst_failure_and_the_largest_lead) {
  std::vector<Row> rows{row("a", "one", 10),  row("a", "two", 30), row("b", "one", 10),
                        row("b", "two", 100), row("c", "one", 20), row("c", "two", 5)};
  rows[4].contact_recall = 0.5;
  rows[1].verdict = Verdict::tunnels;
  rows[1].reason = "step 3: passed `paper`";
  const std::vector<GalleryEntry> gallery = gallery_of(rows);
  ASSERT_EQ(gallery.size(), 2U);
  ASSERT_TRUE(gallery[0].fails && gallery[0].cheapest && gallery[1].fails && gallery[1].cheapest);
  EXPECT_EQ(gallery[0].fails->scene, "c");
  EXPECT_EQ(gallery[0].fails->failure.words, "misses 50 % of the contacts that exact arithmetic has");
  EXPECT_EQ(gallery[0].cheapest->scene, "a") << "where nobody else is without a failure";
  EXPECT_EQ(gallery[0].cheapest->next, "");
  EXPECT_EQ(gallery[1].fails->failure.words, "step 3: passed `paper`");
  EXPECT_EQ(gallery[1].cheapest->scene, "c");
}

TEST(Gallery, a_run_without_a_number_is_no_failure_and_a_nan_is_one) {
  EXPECT_FALSE(failure_of(row("a", "one", 1)));
  Row odd = row("a", "one", 1);
  odd.rest_peak_to_peak_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(failure_of(odd));
}

TEST(Verdict, is_the_worst_of_all_axes_and_the_reason_names_each) {
  Row row;
  settle(row);
  EXPECT_EQ(row.verdict, Verdict::holds);
  EXPECT_EQ(row.reason, "");
  add_fault(row, Axis::validity, Verdict::flagged, "3 steps beyond the cap");
  add_fault(row, Axis::safety, Verdict::tunnels, "passes the paper");
  add_fault(row, Axis::progress, Verdict::flagged, "hangs on 2 steps");
  add_fault(row, Axis::progress, Verdict::flagged, "drops 1 step");
  settle(row);
  EXPECT_EQ(row.verdict, Verdict::tunnels) << "the cap hides no tunnel";
  EXPECT_EQ(row.reason,
            "safety: passes the paper; progress: hangs on 2 steps, drops 1 step; validity: 3 steps beyond the cap");
  add_fault(row, Axis::answer, Verdict::flagged, "1 m off");
  settle(row);
  EXPECT_EQ(row.verdict, Verdict::tunnels);
  EXPECT_TRUE(row.reason.ends_with("; answer: 1 m off; validity: 3 steps beyond the cap")) << row.reason;
  add_fault(row, Axis::progress, Verdict::violates, "loses its way");
  add_fault(row, Axis::safety, Verdict::tunnels, "passes the floor");
  settle(row);
  EXPECT_EQ(row.verdict, Verdict::violates) << "what breaks a guarantee is worse than a tunnel";
}

TEST(Verdict, of_a_run_that_was_not_made_stays) {
  for (const Verdict verdict : {Verdict::failed, Verdict::not_applicable}) {
    Row row;
    row.verdict = verdict;
    row.reason = "no slopes";
    add_fault(row, Axis::progress, Verdict::flagged, "hangs");
    settle(row);
    EXPECT_EQ(row.verdict, verdict);
    EXPECT_EQ(row.reason, "no slopes");
  }
}

}  // namespace
}  // namespace paperproof::compare
