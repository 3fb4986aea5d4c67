#include "command/sweep_command.hpp"
#include "runs/environment.hpp"
#include "studies/bullet.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

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

/// Of a row of `lowest_speeds_part`.
std::string lowest_in_words(const ordered_json& row) {
  if (row.value("verdict", "") == "not_applicable") return "-";
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
    Counts& counts = counts_[row.value("contender", "") + row.value("knob", "")];
    if (part.title == lowest_speeds_title) {
      counts.lowest.push_back(lowest_in_words(row));
    } else if (part.title.empty() && row.value("verdict", "") != "not_applicable") {
      ++counts.cases;
      counts.through += row.value("tunnels", 0) > 0;
    }
  }

  [[nodiscard]] ChartTable table() const {
    ChartTable table = table_;
    for (const Contender& contender : bullet_contenders()) {
      std::string key = contender.name;
      for (std::size_t k = 0; k < contender.knobs.size(); ++k)
        key += fmt::format("{}{}={}", k > 0 ? " " : "", contender.knobs[k].key, contender.knobs[k].value);
      const auto found = counts_.find(key);
      if (found != counts_.end()) table.rows.push_back(line_of(contender, found->second));
    }
    return table;
  }

 private:
  struct Counts {
    int cases = 0;
    int through = 0;
    std::vector<std::string> lowest;  ///< By thickness.
  };

  static std::vector<std::string> line_of(const Contender& contender, const Counts& counts) {
    const Interval interval = wilson(counts.through, counts.cases);
    const double rate = counts.cases > 0 ? static_cast<double>(counts.through) / counts.cases : 0;
    std::vector<std::string> line{
        contender.called(),          std::to_string(counts.cases),        std::to_string(counts.through),
        fmt::format("{:.4f}", rate), fmt::format("{:.6f}", interval.low), fmt::format("{:.6f}", interval.high)};
    const std::vector<double> thicknesses = bullet_thicknesses();
    for (std::size_t k = 0; k < thicknesses.size(); ++k) {
      line.push_back(k < counts.lowest.size() ? counts.lowest[k] : "-");
      line.push_back(speed_in_words(bullet_theory(contender, thicknesses[k])));
    }
    return line;
  }

  ChartTable table_;
  std::map<std::string, Counts> counts_;  ///< By contender with its knobs.
};

}  // namespace

int study_bullet_command(const PreparedArguments& arguments) {
  std::vector<StudyPart> parts = bullet_parts(grid_size(arguments.grid));
  apply(arguments.cases, parts);
  BulletNumbers numbers;
  StudyScores scores(parts, Bad::tunnels);
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
