#include "command/sweep_command.hpp"
#include "runs/environment.hpp"
#include "studies/bullet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

constexpr const char* about_bullets =
    "A character flies onto paper. The cases of a cell differ in angle, phase and length of a step. In numbers: the "
    "lowest speed at which each gets through head-on at 60 steps per second, found by bisection over all phases, "
    "beside what theory says.";

std::string speed_in_words(const BulletTheory& theory) {
  if (!theory.known) return "-";
  if (!theory.lowest) return "never";
  return *theory.lowest > 0 ? fmt::format("{:.4g}", *theory.lowest) : "any";
}

/// Of a row of the lowest speeds. `-`: it cannot run; `?`: the search failed.
std::string lowest_in_words(const ordered_json& row) {
  if (row.value("verdict", "") == "not_applicable") return "-";
  if (row.value("verdict", "") == "failed") return "?";
  if (!row.contains("border_high")) return "never";
  return row.contains("border_low") ? fmt::format("{:.4g}", row["border_high"].get<double>()) : "any";
}

/// One line for each contender: its rate of tunnelling, and its lowest speeds beside theory.
class BulletNumbers {
 public:
  BulletNumbers() {
    table_.heading = {"contender", "cases", "through", "rate", "95 % from", "to"};
    for (const double thickness : bullet_thicknesses()) {
      table_.heading.push_back(fmt::format("lowest at {:g} m", thickness));
      table_.heading.emplace_back("theory");
    }
  }

  void add(const StudyPart& part, const ordered_json& row) {
    const std::string verdict = row.value("verdict", "");
    const std::string who = who_ran(row);
    if (part.title == lowest_speeds_title) {
      const double thickness = row["parameters"].value("thickness_m", 0.0);
      counts_of(who).lowest[thickness] = lowest_in_words(row);
    } else if (part.title.empty()) {
      Counts& counts = counts_of(who);
      if (verdict == "not_applicable" || verdict == "failed") return;
      ++counts.cases;
      counts.through += row.value("tunnels", 0) > 0;
    }
  }

  [[nodiscard]] ChartTable table() const {
    ChartTable table = table_;
    for (const auto& [who, counts] : counts_) table.rows.push_back(line_of(who, counts));
    return table;
  }

 private:
  struct Counts {
    int cases = 0;
    int through = 0;
    std::map<double, std::string> lowest;  ///< By thickness [m].
  };

  Counts& counts_of(const std::string& who) {
    const auto found = std::find_if(counts_.begin(), counts_.end(), [&](const auto& one) { return one.first == who; });
    return found != counts_.end() ? found->second : counts_.emplace_back(who, Counts{}).second;
  }

  /// Of a contender as its rows call it; nothing for a number type of its own.
  static BulletTheory theory_of(const std::string& who, double thickness) {
    for (const NamedContender& contender : bullet_contenders())
      if (contender.called() == who) return bullet_theory(contender, thickness);
    return {};
  }

  static std::vector<std::string> line_of(const std::string& who, const Counts& counts) {
    const Interval interval = wilson(counts.through, counts.cases);
    const double rate = counts.cases > 0 ? static_cast<double>(counts.through) / counts.cases : 0;
    std::vector<std::string> line{who,
                                  std::to_string(counts.cases),
                                  std::to_string(counts.through),
                                  fmt::format("{:.4f}", rate),
                                  fmt::format("{:.6f}", interval.low),
                                  fmt::format("{:.6f}", interval.high)};
    for (const double thickness : bullet_thicknesses()) {
      const auto found = counts.lowest.find(thickness);
      line.push_back(found != counts.lowest.end() ? found->second : "-");
      line.push_back(speed_in_words(theory_of(who, thickness)));
    }
    return line;
  }

  ChartTable table_;
  std::vector<std::pair<std::string, Counts>> counts_;  ///< By who ran, in the order in which they came.
};

}  // namespace

int study_bullet_command(const PreparedArguments& arguments) {
  std::vector<StudyPart> parts = bullet_parts(grid_size(arguments.grid));
  apply(arguments.cases, parts);
  BulletNumbers numbers;
  StudyScores scores(parts);
  StudyRun study(arguments.run, parts, [&](const StudyPart& part, const ordered_json& row) {
    numbers.add(part, row);
    scores.add(part, row);
  });
  study.run();
  const auto page = [&] {
    ChartPage made;
    made.title = bullets_title;
    made.paragraphs = {how_to_read_maps, about_bullets};
    made.grids = scores.grids();
    made.table = numbers.table();
    made.environment = environment();
    return made;
  };
  return study.finish(page, text_of(numbers.table()) + "\nspeeds in m/s\n\n" + scores.tables());
}

}  // namespace paperproof::compare
