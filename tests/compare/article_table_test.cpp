/// Runs every row of the three tables in controller/techniques/README.md: the lessons, the statements of the article,
/// and its six demands by technique.
///
/// A check is a code span: `SCENE CONTENDER [KNOB=VALUE]... [full] => CONDITION, ...`, or two runs with `|` between
/// them and `rows equal` or `rows differ`. A condition is `KEY = LOW..HIGH`, or `KEY = VALUE` with a whole number or a
/// word.
#include "compare/scene_runs.hpp"
#include "records/metric.hpp"
#include "records/rows_json.hpp"
#include "runs/contender.hpp"

#include <boost/algorithm/string.hpp>
#include <boost/lexical_cast/try_lexical_convert.hpp>

#include <map>

namespace paperproof::compare {
namespace {

constexpr const char* readme = PAPERPROOF_SOURCE_DIR "/controller/techniques/README.md";
constexpr std::size_t statements = 83;
constexpr std::size_t checks = 142;
constexpr std::size_t demands = 6;

/// The parts of a text between separators, trimmed.
std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  boost::iter_split(parts, text, boost::first_finder(separator));
  for (std::string& part : parts) boost::trim(part);
  return parts;
}

std::vector<std::string> code_spans(const std::string& text) {
  std::vector<std::string> spans;
  const std::vector<std::string> parts = split(text, "`");
  for (std::size_t i = 1; i + 1 < parts.size(); i += 2) spans.push_back(parts[i]);
  return spans;
}

using Cells = std::vector<std::string>;

/// The rows of the table below a heading, its head first, without the line of dashes.
std::vector<Cells> table_below(const std::string& heading) {
  std::ifstream file(readme);
  EXPECT_TRUE(file) << readme;
  std::vector<Cells> rows;
  bool below = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) below = line == heading;
    if (!below || !line.starts_with("|") || line.starts_with("|-")) continue;
    Cells cells;
    // Two runs are separated by an escaped bar.
    for (const std::string& cell : split(line.substr(1, line.rfind('|') - 1), " | "))
      cells.push_back(boost::replace_all_copy(cell, "\\|", "|"));
    rows.push_back(std::move(cells));
  }
  EXPECT_FALSE(rows.empty()) << heading;
  return rows;
}

/// Each scene with each contender once, by what stands in the table.
using Runs = std::map<std::string, Row>;

const Row& row_in(Runs& runs, const std::string& text) {
  if (const auto known = runs.find(text); known != runs.end()) return known->second;
  const std::vector<std::string> words = split(text, " ");
  RunOptions options = alone(words.at(1), 0);
  for (std::size_t i = 2; i < words.size(); ++i) {
    options.full_plan = options.full_plan || words[i] == "full";
    if (words[i] == "full") continue;
    options.knobs.push_back(parse_knob(words[i]));
    EXPECT_TRUE(has_knob(words[1], options.knobs.back().key)) << text;
  }
  return runs[text] = run_scene(built_in(words.at(0)), options).rows.front();
}

/// The first of the metrics that two rows share by which they differ; empty where they are equal. A full plan measures
/// more.
std::string first_difference(const Row& one, const Row& other) {
  for (const Metric& metric : metrics()) {
    const std::optional<double> a = value_of(metric, one);
    const std::optional<double> b = value_of(metric, other);
    if (a && b && *a != *b && !is_cost(metric.key)) return std::string(metric.key);
  }
  return "";
}

double number_in(const std::string& text) {
  double value = NAN;
  return boost::conversion::try_lexical_convert(text, value) ? value : NAN;
}

/// How a row misses a condition; empty where it does not.
std::string fault_of(const Row& row, const std::string& condition) {
  const std::vector<std::string> sides = split(condition, " = ");
  if (sides.size() != 2) return "no condition: " + condition;
  const nlohmann::ordered_json written = row_json(row);
  if (!written.contains(sides[0])) return sides[0] + " is absent (" + row.reason + ") ";
  const nlohmann::ordered_json& found = written[sides[0]];
  const std::string word = found.is_string() ? found.get<std::string>() : found.dump();
  const double value = number_in(word);
  const std::vector<std::string> bounds = split(sides[1], "..");
  if (word == sides[1] || (number_in(bounds.front()) <= value && value <= number_in(bounds.back()))) return "";
  return sides[0] + " is " + word + ", not " + sides[1] + " (" + row.reason + ") ";
}

/// What is wrong with a check; empty where it holds.
std::string fault_of(const std::string& check, Runs& runs) {
  const std::vector<std::string> sides = split(check, "=>");
  if (sides.size() != 2) return "no check";
  const std::vector<std::string> names = split(sides[0], "|");
  std::string fault;
  if (names.size() == 2) {
    const std::string difference = first_difference(row_in(runs, names[0]), row_in(runs, names[1]));
    if (sides[1] != (difference.empty() ? "rows equal" : "rows differ")) fault = "they differ in '" + difference + "'";
    return fault;
  }
  for (const std::string& condition : split(sides[1], ", ")) fault += fault_of(row_in(runs, names[0]), condition);
  return fault;
}

/// @return how many checks a cell has. One at least must be there, and all must hold.
std::size_t run_checks(const std::string& cell, Runs& runs) {
  std::size_t ran = 0;
  for (const std::string& span : code_spans(cell)) {
    if (span.find("=>") == std::string::npos) continue;
    ++ran;
    EXPECT_EQ(fault_of(span, runs), "") << span;
  }
  EXPECT_GT(ran, 0U) << "nothing is checked: " << cell;
  return ran;
}

TEST(ArticleTable, has_a_check_in_every_row_and_all_of_them_hold) {
  Runs runs;
  const std::vector<Cells> rows = table_below("## The statements");
  EXPECT_EQ(rows.size() - 1, statements);
  std::size_t ran_checks = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 4U) << rows[i].front();
    const std::string& result = rows[i][2];
    EXPECT_TRUE(result == "shown" || result == "refuted" || result == "reading") << result << " in " << rows[i][1];
    ran_checks += run_checks(rows[i][3], runs);
  }
  EXPECT_EQ(ran_checks, checks);
}

TEST(ArticleTable, has_a_lesson_of_each_technique) {
  Runs runs;
  const std::vector<Cells> rows = table_below("## Lessons");
  ASSERT_EQ(rows.size() - 1, all_techniques().size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(code_spans(rows[i][1]).at(0), all_techniques()[i - 1].name);
    run_checks(rows[i][2], runs);
  }
}

TEST(ArticleTable, has_each_of_the_six_demands_for_each_technique) {
  Runs runs;
  const std::vector<Cells> rows = table_below("## The six demands");
  ASSERT_EQ(rows.front().size(), 1 + demands);
  ASSERT_EQ(rows.size() - 1, all_techniques().size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 1 + demands) << rows[i].front();
    const std::string technique = code_spans(rows[i].front()).at(0);
    EXPECT_EQ(technique, all_techniques()[i - 1].name);
    for (std::size_t k = 1; k <= demands; ++k) {
      const std::string scene = code_spans(rows.front()[k]).at(0);
      const std::string check = scene + " " + technique + " => " + code_spans(rows[i][k]).at(0);
      EXPECT_EQ(fault_of(check, runs), "") << check;
    }
  }
}

TEST(ArticleTable, would_notice_a_number_that_is_wrong) {
  Runs runs;
  for (const char* right : {"article_bullet mask => tunnels = 1, verdict = tunnels",
                            "article_bullet speculative => first_contact_fraction = 0.599..0.601"})
    EXPECT_EQ(fault_of(right, runs), "") << right;
  for (const char* wrong : {"article_bullet mask => tunnels = 0", "article_bullet mask => verdict = holds",
                            "article_bullet mask => tunnels = one", "article_bullet mask => nothing = 1",
                            "article_bullet mask => nothing = absent", "article_bullet mask => tunnels",
                            "article_bullet mask", "article_bullet speculative => first_contact_fraction = 0.601..0.7",
                            "article_bullet mask | article_bullet speculative => rows equal",
                            "article_bullet mask | article_bullet mask => rows differ"})
    EXPECT_NE(fault_of(wrong, runs), "") << wrong;
}

}  // namespace
}  // namespace paperproof::compare
