#include "command/field_view.hpp"

#include "records/case.hpp"
#include "report/row_pictures.hpp"
#include "runs/build_info.hpp"
#include "runs/environment.hpp"
#include "runs/peers.hpp"
#include "runs/spot_check.hpp"
#include "runs/view.hpp"
#include "studies/processes.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace paperproof::compare {
namespace {

constexpr const char* ours = "octagon_sweep";
constexpr std::size_t checks_of_peer = 3;
constexpr std::chrono::seconds longest_check = longest_greeting + std::chrono::seconds(60);
constexpr double millimetres = 1e3;

double badness(const Row& row) { return row.badness.value_or(-1); }

bool is_of(const Row& row, const std::string& group) { return row.swept && row.swept->question == group; }

/// Null where nobody ran.
const Row* worst_in(const std::vector<Row>& rows, const std::string& group) {
  const Row* worst = nullptr;
  for (const Row& row : rows)
    if (is_of(row, group) && badness(row) > (worst != nullptr ? badness(*worst) : -1)) worst = &row;
  return worst;
}

template <class Counts>
int count_in(const std::vector<Row>& rows, const Counts& counts) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(), counts));
}

template <class Counts>
Column<FieldLine> count(std::string heading, Counts counts, bool trouble = false) {
  return {std::move(heading),
          [=](const FieldLine& line) -> Cell { return std::to_string(count_in(line.second, counts)); }, trouble};
}

/// The largest of a number over all rows of a contender, in another unit; rows that `of` has nothing for are left out.
template <class Of>
Column<FieldLine> largest(std::string heading, double unit, Of of) {
  return {std::move(heading), [=](const FieldLine& line) -> Cell {
            std::optional<double> most;
            for (const Row& row : line.second)
              if (const std::optional<double> value = of(row)) most = std::max(most.value_or(*value), *value);
            return most ? Cell(in_short(*most * unit)) : std::nullopt;
          }};
}

/// Everybody's hops and times are those of the walk over tiles.
bool is_on_seams(const Row& row) { return is_of(row, std::string(field_title).append(field_seams)); }

/// The mean time of a step [ns]. @param machine of a peer, by its own clock; empty: by this command's.
Column<FieldLine> mean_time(std::string heading, std::string machine) {
  return {std::move(heading), [=](const FieldLine& line) -> Cell {
            double sum = 0;
            int rows = 0;
            for (const Row& row : line.second) {
              const std::optional<double> time = row.engine.empty() ? time_per_step(row) : row.ns_per_step_own_clock;
              if (row.machine != machine || !time || !is_on_seams(row)) continue;
              sum += *time;
              ++rows;
            }
            return rows > 0 ? Cell(fmt::format("{:.0f}", sum / rows)) : std::nullopt;
          }};
}

const std::string& name_in(const FieldLine& line) { return line.first; }

std::vector<Column<FieldLine>> metric_columns() {
  const auto beyond_skin = [](const Row& row) -> std::optional<double> {
    if (!row.max_penetration_m) return std::nullopt;
    return *row.max_penetration_m > skin_of(row) ? *row.max_penetration_m : 0;
  };
  return {{"contender", name_in},
          count("runs", was_judged),
          count("cannot", [](const Row& row) { return row.verdict == Verdict::not_applicable; }),
          count(
              "failed", [](const Row& row) { return row.verdict == Verdict::failed; }, true),
          count("through", [](const Row& row) { return row.tunnels.value_or(0) > 0; }),
          count("clipped", [](const Row& row) { return row.clipped.value_or(0) > 0; }),
          largest("inside [mm]", millimetres, beyond_skin),
          largest("hanging [steps]", 1, [](const Row& row) { return std::optional<double>(hanging_of(row)); }),
          largest("restless [per 1000]", 1, [](const Row& row) { return row.contact_toggles; }),
          largest("jitter [mm]", millimetres, [](const Row& row) { return row.rest_peak_to_peak_m; }),
          largest("seam hop [mm]", millimetres,
                  [](const Row& row) { return is_on_seams(row) ? row.seam_hop_m : std::nullopt; }),
          largest("lost [%]", 100, [](const Row& row) { return row.wanted_motion_lost; }),
          largest("off the way [m]", 1, [](const Row& row) { return row.error_law_max_m; })};
}

std::vector<Column<FieldLine>> cost_columns() {
  const auto of_ours = [](std::string what) {
    return [=](const FieldLine& line) { return line.first == ours ? what : "not stated"; };
  };
  return {{"contender", name_in},
          mean_time("ns", ""),
          mean_time("ns, native, own clock", "native"),
          mean_time("ns, WebAssembly", "webassembly"),
          mean_time("ns, JavaScript", "javascript"),
          mean_time("ns, script", "script"),
          {"lines of code", of_ours(std::to_string(build_info.core_lines))},
          {"characters that it does not have", of_ours("round ones, more than 8 corners, ones that turn")}};
}

/// Of one peer: the worst of each group, and then others, as many as are checked.
std::vector<const Row*> claims_of(const std::vector<Row>& rows, const std::vector<std::string>& groups) {
  std::vector<const Row*> claims;
  const auto add = [&](const Row* row) {
    const bool known = std::find(claims.begin(), claims.end(), row) != claims.end();
    if (row != nullptr && !row->engine.empty() && hole_of(*row) && !known && claims.size() < checks_of_peer)
      claims.push_back(row);
  };
  for (const std::string& group : groups) add(worst_in(rows, group));
  for (const Row& row : rows) add(&row);
  return claims;
}

std::string short_name(const std::string& group) { return group.substr(std::string_view(field_title).size()); }

}  // namespace

FieldView::FieldView(const PreparedStudy& study, const std::vector<StudyPart>& parts, int jobs)
    : study_(study), jobs_(jobs) {
  for (const StudyPart& part : parts)
    if (groups_.empty() || groups_.back() != part.title) groups_.push_back(part.title);
}

void FieldView::add(const StudyPart& /*part*/, const Row& row) { entry_of(lines_, who_ran(row)).push_back(row); }

ChartGrid FieldView::grid() const {
  ChartGrid grid;
  grid.title = study_.title;
  grid.bad_words = "do anything wrong";
  grid.x_label = "trouble";
  grid.y_label = "contender";
  for (const std::string& group : groups_) grid.xs.push_back(short_name(group));
  grid.beside = ours;
  for (const auto& [who, rows] : lines_) {
    grid.ys.push_back(who);
    std::vector<ChartGrid::Cell>& cells = grid.cells.emplace_back();
    for (const std::string& group : groups_) {
      ChartGrid::Cell& cell = cells.emplace_back();
      const Row* worst = worst_in(rows, group);
      cell.label = worst != nullptr ? worst->worst : "-";
      const auto first = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return is_of(row, group); });
      if (worst == nullptr) {
        if (first != rows.end()) cell.words = first->reason;
        continue;
      }
      cell.all = count_in(rows, [&](const Row& row) { return is_of(row, group) && badness(row) >= 0; });
      cell.bad = count_in(rows, [&](const Row& row) { return is_of(row, group) && badness(row) > 0; });
      if (cell.bad > 0 && cell.all > 1) cell.label += fmt::format(" ({}/{})", cell.bad, cell.all);
      cell.words = worst->reason.empty() ? worst->worst : worst->reason;
      cell.command = worst->command;
      cell.through = worst->tunnels.value_or(0) > 0;
      cell.grave = is_unsafe(*worst);
    }
  }
  return grid;
}

std::string FieldView::text() const {
  const ChartGrid grid = this->grid();
  Table table{{"contender"}, {}};
  table.heading.insert(table.heading.end(), grid.xs.begin(), grid.xs.end());
  for (std::size_t y = 0; y < grid.ys.size(); ++y) {
    std::vector<std::string>& line = table.lines.emplace_back(1, grid.ys[y]);
    for (const ChartGrid::Cell& cell : grid.cells[y]) line.push_back(cell.label);
  }
  return text_of(table) + '\n' + view(lines_, metric_columns()) + "\nthe cost of the guarantee\n\n" +
         view(lines_, cost_columns());
}

ChartTable FieldView::spot_checks() const {
  std::vector<const Row*> claims;
  for (const auto& [who, rows] : lines_)
    for (const Row* row : claims_of(rows, groups_)) claims.push_back(row);
  ChartTable table{"What the engines' own queries say of it, at the recorded places", {}, {}};
  table.heading = {"contender", "it is", "step", "the judge", "the engine", "confirmed", "command"};
  Jobs jobs;
  jobs.count = claims.size();
  jobs.run = [&](std::size_t job) {
    const std::optional<Case> one = case_of_command(claims[job]->command);
    if (!one) return std::string();
    const SpotCheck check = spot_check(*one, *hole_of(*claims[job]));
    return nlohmann::json{check.step, check.judge, check.engine, check.confirmed}.dump();
  };
  jobs.lost = [](std::size_t, const std::string& reason) { return nlohmann::json{0, "", reason, "-"}.dump(); };
  jobs.take = [&](std::size_t job, const std::string& told) {
    if (told.empty()) return;
    const nlohmann::json check = nlohmann::json::parse(told);
    table.rows.push_back({who_ran(*claims[job]), claims[job]->worst, std::to_string(check[0].get<int>()), check[1],
                          check[2], check[3], claims[job]->command});
  };
  run_in_processes(jobs, {processes_for(jobs_), longest_check});
  return table;
}

ChartPage FieldView::page() const {
  ChartPage page;
  page.title = study_.title;
  page.paragraphs = study_.paragraphs;
  page.grids = {grid()};
  const auto titled = [&](const char* title, const std::vector<Column<FieldLine>>& columns) {
    const Table table = table_of(lines_, columns);
    page.more_tables.push_back({title, table.heading, table.lines});
  };
  titled("The largest of each metric", metric_columns());
  titled("The cost of the guarantee", cost_columns());
  if (ChartTable checks = spot_checks(); !checks.rows.empty()) page.more_tables.push_back(std::move(checks));
  page.environment = environment();
  return page;
}

}  // namespace paperproof::compare
