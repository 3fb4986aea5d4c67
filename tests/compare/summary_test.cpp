/// What stands on the first screen: outcomes in plain words, and all scenes in one table.
#include "runs/summary.hpp"
#include "compare/scene_files.hpp"
#include "compare/scene_runs.hpp"
#include "runs/headline.hpp"
#include "runs/text_columns.hpp"
#include "words.hpp"

#include <sstream>

namespace paperproof::compare {
namespace {

Row row(const std::string& scene, const std::string& contender) {
  Row row;
  row.scene = scene;
  row.contender = contender;
  return row;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The words of the line that begins with a name.
std::vector<std::string> line_of(const std::string& text, const std::string& name) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(name + " ")) return words_of(line);
  return {};
}

TEST(Headline, says_the_worst_that_happened_in_plain_words) {
  Row one = row("a", "one");
  EXPECT_EQ(outcome_of(one), "meets nothing");
  one.first_contact_step = 0;
  one.first_contact_fraction = 0.6;
  EXPECT_EQ(outcome_of(one), "stopped at 0.600");
  one.first_contact_step = 12;
  EXPECT_EQ(outcome_of(one), "stopped at 0.600 of step 12");
  one.hanging_steps = 7;
  EXPECT_EQ(outcome_of(one), "hangs on 7 steps");
  one.steps_ending_inside = 3;
  EXPECT_EQ(outcome_of(one), "ends inside on 3 steps");
  one.tunnels = 1;
  EXPECT_EQ(outcome_of(one), "through");
  one.tunnels = 2;
  EXPECT_EQ(outcome_of(one), "through on 2 steps");
  one.verdict = Verdict::failed;
  EXPECT_EQ(outcome_of(one), "failed");
  one.verdict = Verdict::not_applicable;
  EXPECT_EQ(outcome_of(one), "cannot run");
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
  std::vector<Row> rows{row("a", "one"), row("a", "two"), row("b", "one"), row("b", "two"), row("c", "one")};
  rows[0].tunnels = 3;
  rows[2].tunnels = 0;
  rows[4].tunnels = 2;
  rows[1].tunnels = 0;
  rows[3].verdict = Verdict::not_applicable;
  rows[0].ns_per_step = 30;
  rows[2].ns_per_step = 10;
  rows[4].ns_per_step = 20;
  const std::string text = summary_table(rows);
  EXPECT_EQ(line_of(text, "contender"), (std::vector<std::string>{"contender", "scenes", "through", "ns/step"}))
      << "nothing is said of inside, as no row has it:\n"
      << text;
  EXPECT_EQ(line_of(text, "one"), (std::vector<std::string>{"one", "3", "5", "in", "2", "20"}));
  EXPECT_EQ(line_of(text, "two"), (std::vector<std::string>{"two", "1", "0", "-"}));
}

TEST(Summary, tells_number_types_and_knobs_apart_and_names_failures) {
  std::vector<Row> rows{row("a", "one"), row("a", "one"), row("a", "one"), row("b", "one")};
  rows[1].scalar = "float";
  rows[2].knob = "unit=1";
  rows[3].verdict = Verdict::failed;
  const std::string text = summary_table(rows);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5) << "a heading, three rows, and what they mean:\n" << text;
  EXPECT_TRUE(holds(text, "one in float"));
  EXPECT_TRUE(holds(text, "one with unit=1"));
  EXPECT_TRUE(holds(text, "failed"));
}

TEST(Words, of_a_sentence_are_left_out_where_a_terminal_has_no_room) {
  EXPECT_EQ(shortened("one two three", 13), "one two three");
  EXPECT_EQ(shortened("one two three", 12), "one two …");
  const std::string umlauts = "\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4";
  EXPECT_EQ(shortened(umlauts, 10), "\u00e4\u00e4\u00e4 …") << "no character is cut in two";
  EXPECT_EQ(in_lines("A is 0.5 m. B is 1 m."), "A is 0.5 m.\nB is 1 m.\n");
  EXPECT_EQ(in_lines(""), "");
}

}  // namespace
}  // namespace paperproof::compare
