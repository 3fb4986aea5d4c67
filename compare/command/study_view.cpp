#include "command/study_view.hpp"

#include "records/metric.hpp"
#include "records/verdict.hpp"
#include "runs/environment.hpp"
#include "words.hpp"

#include <fmt/format.h>

namespace paperproof::compare {
namespace {

/// Rows that a page lists one by one.
constexpr std::size_t most_listed = 2000;

/// Whether its contender went beyond a limit that it documents, Box2D's travel cap for example, and stayed safe. A run
/// that comes late for that misses its answer: that is no fault of its own.
bool is_beyond_limits(const Row& row) {
  return row.verdict == Verdict::flagged && falls_short(row, Axis::validity) && !falls_short(row, Axis::safety);
}

/// The values of such keys in a row: `speed_m_s=10 thickness_m=0.01`.
std::string values_of(const Row& row, const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys)
    if (const std::optional<double> value = parameter_of(row, key))
      text += fmt::format("{}{}={:.4g}", text.empty() ? "" : " ", key, *value);
  return text;
}

std::string number_or_dash(const std::optional<double>& number) {
  return number ? fmt::format("{:.4g}", *number) : "-";
}

Cell unless_empty(const std::string& text) { return text.empty() ? std::nullopt : Cell(text); }

/// As `drift 3, energy 1`.
Cell in_words(const std::map<std::string, int>& fails) {
  std::string text;
  for (const auto& [predicate, count] : fails)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", predicate, count);
  return unless_empty(text);
}

}  // namespace

StudyView::StudyView(const PreparedStudy& study, const std::vector<StudyPart>& parts) : study_(study) {
  for (const StudyPart& part : parts) {
    if (part.sweep.border) continue;
    Title& title = entry_of(titles_, part.title);
    title.question = part.question;
    title.keys = axis_keys_of(part.sweep);
    title.bad = part.bad;
    if (!title.keys.empty() && !title.grids)
      title.grids.emplace(part.title, title.keys.front(), title.keys.size() > 1 ? title.keys[1] : "", part.bad);
  }
}

void StudyView::add(const StudyPart& part, const Row& row) {
  if (part.sweep.border) return add_border(part, row);
  Title& title = entry_of(titles_, part.title);
  if (title.grids) title.grids->add(row);
  Score& score = entry_of(title.scores, who_ran(row, title.keys));
  ++score.cases;
  for (const Metric& metric : metrics())
    if (metric.group == Metric::Group::study && metric.kind == Metric::Kind::flag && value_of(metric, row) == 0.0)
      ++score.fails[std::string(metric.key.substr(0, metric.key.find("_ok")))];
  if (row.verdict == Verdict::holds) {
    ++score.holds;
    return;
  }
  if (row.verdict == Verdict::not_applicable) {
    ++score.cannot;
    return;
  }
  const std::string at = values_of(row, title.keys);
  if (title.bad == Bad::does_not_hold && faults_.size() < most_listed)
    faults_.push_back(
        {part.title, who_ran(row), at, std::string(name_of(row.verdict)), shortened(row.reason), row.command});
  if (is_beyond_limits(row)) {
    ++score.beyond;
    return;
  }
  ++(row.verdict == Verdict::failed ? score.failed : row.tunnels.value_or(0) > 0 ? score.through : score.other);
  if (score.first_bad.empty()) score.first_bad = at;
}

void StudyView::add_border(const StudyPart& part, const Row& row) {
  const std::vector<std::string> keys = axis_keys_of(part.sweep);
  Border& border = borders_.emplace_back(Border{part.title, {}, values_of(row, keys), {}, row});
  if (const auto& range = part.sweep.border_range)
    border.range = fmt::format("{:g} to {:g}", range->first, range->second);
  if (study_.theory != nullptr && !keys.empty())
    border.theory = study_.theory(who_ran(row), parameter_of(row, keys.front()).value_or(0));
}

std::vector<Column<StudyView::Scored>> StudyView::score_columns(Bad bad) {
  const auto count = [](int Score::*of) {
    return [of](const Scored& scored) { return std::to_string(scored.second.*of); };
  };
  std::vector<Column<Scored>> columns{{"contender", [](const Scored& scored) { return scored.first; }},
                                      {"cases", count(&Score::cases)},
                                      {"hold", count(&Score::holds)},
                                      {"through", count(&Score::through)}};
  if (bad == Bad::tunnels)
    columns.insert(columns.end(),
                   {{"rate",
                     [](const Scored& scored) -> Cell {
                       const auto& [who, score] = scored;
                       if (score.ran() == 0) return std::nullopt;
                       return fmt::format("{:.4f}", static_cast<double>(score.through) / score.ran());
                     }},
                    {"95 % from", [](const Scored& scored) { return fmt::format("{:.6f}", scored.second.rate().low); }},
                    {"to", [](const Scored& scored) { return fmt::format("{:.6f}", scored.second.rate().high); }}});
  columns.insert(columns.end(),
                 {{"other faults", count(&Score::other)},
                  {"failed", count(&Score::failed), true},
                  {"beyond limits", count(&Score::beyond)},
                  {"cannot run", count(&Score::cannot)},
                  {"predicates that fail", [](const Scored& scored) { return in_words(scored.second.fails); }},
                  {"first fault at", [](const Scored& scored) { return unless_empty(scored.second.first_bad); }}});
  return columns;
}

std::string StudyView::text() const {
  std::string text;
  for (const auto& [name, title] : titles_) {
    const std::string heading = name + (title.question.empty() ? "" : ": ") + title.question;
    text += (text.empty() ? "" : "\n") + heading + (heading.empty() ? "" : "\n\n");
    text += view(title.scores, score_columns(title.bad));
  }
  if (borders_.empty()) return text;
  return text + (text.empty() ? "" : "\n") +
         view<Border>(borders_, {{"border of", [](const Border& one) { return unless_empty(one.title); }},
                                 {"parameter", [](const Border& one) { return one.row.border; }},
                                 {"range", [](const Border& one) { return unless_empty(one.range); }},
                                 {"contender", [](const Border& one) { return who_ran(one.row); }},
                                 {"at", [](const Border& one) { return unless_empty(one.at); }},
                                 {"holds up to", [](const Border& one) { return number_or_dash(one.row.border_low); }},
                                 {"fails from", [](const Border& one) { return number_or_dash(one.row.border_high); }},
                                 {"theory", [](const Border& one) { return unless_empty(one.theory); }},
                                 {"cannot run", [](const Border& one) {
                                    return was_judged(one.row) ? std::nullopt : unless_empty(shortened(one.row.reason));
                                  }}});
}

ChartPage StudyView::page() const {
  std::vector<Line> lines;
  for (const Border& one : borders_)
    lines.push_back(
        {one.title, who_ran(one.row), one.at, "border",
         fmt::format("holds up to {}, fails from {}{}{}", number_or_dash(one.row.border_low),
                     number_or_dash(one.row.border_high), one.theory.empty() ? "" : ", theory ", one.theory),
         one.row.command});
  for (const auto& [name, title] : titles_)
    for (const auto& [who, score] : title.bad == Bad::tunnels ? title.scores : std::vector<Scored>{})
      lines.push_back({name, who, "", "rate",
                       fmt::format("{} of {} get through; 95 % from {:.6f} to {:.6f}", score.through, score.ran(),
                                   score.rate().low, score.rate().high),
                       ""});
  lines.insert(lines.end(), faults_.begin(), faults_.end());
  std::vector<Column<Line>> columns;
  for (const char* heading : {"question", "contender", "at", "verdict", "why", "command"})
    columns.push_back({heading, [i = columns.size()](const Line& line) { return unless_empty(line[i]); }});
  const Table table = table_of(lines, columns);
  ChartPage page;
  page.title = study_.title;
  for (const auto& [name, title] : titles_)
    for (ChartGrid& grid : title.grids ? title.grids->grids() : std::vector<ChartGrid>{})
      page.grids.push_back(std::move(grid));
  if (!page.grids.empty()) page.paragraphs.push_back(how_to_read_maps());
  page.paragraphs.insert(page.paragraphs.end(), study_.paragraphs.begin(), study_.paragraphs.end());
  if (!lines.empty()) page.table = {"", table.heading, table.lines};
  page.environment = environment();
  return page;
}

}  // namespace paperproof::compare
