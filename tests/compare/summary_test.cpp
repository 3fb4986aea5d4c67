/// Verdicts, and what is said of many rows: outcomes in plain words, all scenes in one table, the gallery, and who is
/// on the front of a motion. tables/summary.json has the rows.
#include "compare/table.hpp"
#include "records/rows_json.hpp"
#include "records/verdict.hpp"
#include "runs/gallery.hpp"
#include "runs/row_views.hpp"
#include "studies/front.hpp"
#include "support/expected.hpp"
#include "words.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace paperproof::compare {
namespace {

using paperproof::test::refuse_other_keys;

/// The same with one space for several.
std::string single_spaced(const std::string& text) {
  std::string single;
  std::unique_copy(text.begin(), text.end(), std::back_inserter(single),
                   [](char a, char b) { return a == ' ' && b == ' '; });
  return single;
}

Axis axis_named(const std::string& name) {
  for (const Axis axis : {Axis::safety, Axis::progress, Axis::answer, Axis::validity})
    if (name_of(axis) == name) return axis;
  throw std::invalid_argument("no such axis: " + name);
}

/// Adds faults, and settles the row again.
void check_settled(Row& row, const Json& said) {
  refuse_other_keys(said, " faults verdict reason because ", "what settles");
  for (const Json& fault : said.at("faults")) {
    const Verdict verdict = row_of({{"verdict", fault.at(1)}}).verdict;
    ASSERT_EQ(name_of(verdict), fault.at(1)) << "no such verdict";
    add_fault(row, axis_named(fault.at(0)), verdict, fault.at(2));
  }
  settle(row);
  EXPECT_EQ(name_of(row.verdict), said.at("verdict"));
  EXPECT_EQ(row.reason, said.at("reason"));
}

void check_rows(const Json& said) {
  std::vector<Row> rows;
  for (const Json& one : said.at("of")) rows.push_back(row_of(one));
  rows.back().exact_first_impact = said.value("solid", "");  // no file has it
  mark_front(rows);
  Json found{{"outcome", outcome_of(rows[0])},
             {"exact_answer", exact_answer(rows)},
             {"gallery", gallery_lines(gallery_of(rows))},
             {"words_of_front", words_of_front("fall", rows)}};
  for (const Row& row : rows) found["front"].push_back(row_json(row).value("on_front", Json()));
  for (const auto& [key, value] : found.items()) EXPECT_EQ(value, said.value(key, value)) << key;
  for (const auto& [key, text] : {std::pair("summary", summary_table(rows)), std::pair("table", compare::table(rows))})
    for (const Json& part : said.value(key, Json::array()))
      EXPECT_TRUE(holds(single_spaced(text), part.get<std::string>())) << text;
  for (const Json& settled : said.value("settles", Json::array())) check_settled(rows[0], settled);
}

const bool table = table_tests(
    "summary.json", " of solid outcome exact_answer gallery summary table front words_of_front settles ", check_rows);

TEST(Words, of_a_sentence_are_left_out_where_a_terminal_has_no_room) {
  EXPECT_EQ(shortened("one two three", 13), "one two three");
  EXPECT_EQ(shortened("one two three", 12), "one two …");
  const std::string umlauts = "\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4";
  EXPECT_EQ(shortened(umlauts, 10), "\u00e4\u00e4\u00e4 …") << "no character is cut in two";
  EXPECT_EQ(in_lines("A is 0.5 m. B is 1 m."), "A is 0.5 m.\nB is 1 m.\n");
}

TEST(Gallery, a_number_that_is_none_is_a_failure) {
  Row odd;
  odd.rest_peak_to_peak_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(failure_of(odd));
}

}  // namespace
}  // namespace paperproof::compare
