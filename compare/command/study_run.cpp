#include "command/study_run.hpp"

#include "command/complain.hpp"
#include "command/forecast.hpp"
#include "command/study_outputs.hpp"
#include "records/input_file.hpp"
#include "records/rows_reader.hpp"
#include "runs/environment.hpp"
#include "runs/text_columns.hpp"
#include "scenes/input_error.hpp"
#include "scenes/load.hpp"
#include "scenes/parameters.hpp"
#include "words.hpp"

#include <paperproof/number_in.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace paperproof::compare {

using nlohmann::ordered_json;

namespace {

/// Whether it is flagged for nothing but its validity: Box2D's travel cap, for example.
bool is_beyond_limits(const ordered_json& row) {
  const std::string reason = row.value("reason", "");
  if (row.value("verdict", "") != "flagged" || !reason.starts_with("validity: ")) return false;
  for (const char* axis : {"safety: ", "progress: ", "answer: "})
    if (reason.find(axis) != std::string::npos) return false;
  return true;
}

std::size_t cases_in(const std::vector<StudyPart>& parts) {
  std::size_t cases = 0;
  for (const StudyPart& part : parts) cases += part.sweep.size();
  return cases;
}

}  // namespace

StudyRun::Shard StudyRun::parse_shard(const std::optional<std::string>& typed) {
  Shard shard;
  if (!typed) return shard;
  const std::string& text = *typed;
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    shard.part = number_in<std::size_t>(std::string_view(text).substr(0, slash)).value_or(0);
    shard.of = number_in<std::size_t>(std::string_view(text).substr(slash + 1)).value_or(0);
    if (shard.part >= 1 && shard.part <= shard.of) return shard;
  }
  refuse("--shard " + shown(text), "expected K/N with K from 1 to N");
}

StudyRun::StudyRun(const RunArguments& arguments, const std::vector<StudyPart>& parts, Visit visit)
    : arguments_(arguments),
      parts_(parts),
      visit_(std::move(visit)),
      shard_(parse_shard(arguments.shard)),
      count_(shard_.size(cases_in(parts))),
      header_(rows_header(environment())) {
  header_["sweep"] = {{"id", id_of(parts)}, {"cases", cases_in(parts)}, {"shard", {shard_.part, shard_.of}}};
  claim_outputs(arguments.rows_path, arguments.report_path, arguments.log_path);
  const bool continued = goes_on();
  rows_.emplace(arguments.rows_path, header_, continued);
  page_.emplace(arguments.report_path);
}

bool StudyRun::goes_on() {
  const std::string& path = arguments_.rows_path;
  if (!arguments_.resume) return false;
  if (!path.ends_with(".jsonl")) throw InputError("--resume: expected --rows FILE.jsonl to go on with");
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) return false;
  if (const std::string why = why_not_regular(path); !why.empty())
    throw InputError(fmt::format("--resume: {}: {}", path, why));
  if (std::filesystem::is_empty(path, unknown)) return false;
  RowsReader reader(path, RowsReader::LastLine::may_be_cut);
  if (reader.header().value("sweep", ordered_json{}) != header_["sweep"])
    throw InputError("--resume: " + path + " has rows of another sweep or shard");
  const ordered_json built = reader.header().value("environment", ordered_json::object());
  for (const char* key : {"paperproof", "box2d", "compiler", "flags", "build"})
    if (built.value(key, "") != header_["environment"].value(key, ""))
      throw InputError(fmt::format("--resume: {} has rows of another build: {} differs", path, key));
  while (const std::optional<RowLine> line = reader.next()) {
    if (done_ == count_) throw InputError("--resume: " + path + " has more rows than there are cases");
    const ordered_json& row = line->row;
    const PartCase place = part_case(parts_, shard_.case_of(done_));
    const Sweep& sweep = parts_[place.part].sweep;
    if (!sweep.border && row.value("case", "") != id_of(sweep.at(place.index)))
      throw InputError(fmt::format("{}: row {} is not the case that belongs there", path, done_ + 1));
    note(row);
  }
  if (reader.cut_line() > 0 && !arguments_.quiet)
    complain(fmt::format("{}:{}: this last row is cut short; its case is run again", path, reader.cut_line()));
  std::filesystem::resize_file(path, reader.end(), unknown);
  if (unknown) throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, unknown.message()));
  return true;
}

void StudyRun::note(const ordered_json& row) {
  trouble_ = trouble_ || row.value("verdict", "") == "failed" || breaks_guarantee(row);
  visit_(parts_[part_case(parts_, shard_.case_of(done_)).part], row);
  ++done_;
}

void StudyRun::run() {
  const Progress progress(!arguments_.quiet, arguments_.log_path);
  const std::size_t before = done_;
  Jobs jobs = jobs_of(parts_, count_ - before, [&](std::size_t job) { return shard_.case_of(before + job); });
  Forecast forecast(!arguments_.quiet, static_cast<double>(jobs.count), "cases");
  forecast.begin_scene(static_cast<double>(jobs.count));
  forecast.done(0);
  jobs.take = [&](std::size_t job, const std::string& line) {
    note(ordered_json::parse(line));
    rows_->add(line);
    const double share = static_cast<double>(job + 1) / static_cast<double>(jobs.count);
    forecast.done(share);
    progress.show(fmt::format("{} of {} cases,", done_, count_), share);
  };
  run_in_processes(jobs, {processes_for(arguments_.jobs), std::chrono::seconds(arguments_.limit_s)});
  progress.clear();
}

int StudyRun::finish(const std::function<ChartPage()>& page, const std::string& text) {
  rows_->finish();
  if (!arguments_.report_path.empty()) page_->finish(page(), arguments_.jobs);
  if (!arguments_.quiet) print_out(text);
  return trouble_ ? 1 : 0;
}

StudyScores::StudyScores(const std::vector<StudyPart>& parts) {
  for (const StudyPart& part : parts) {
    if (part.sweep.border) continue;
    const auto known =
        std::find_if(titles_.begin(), titles_.end(), [&](const Title& one) { return one.title == part.title; });
    Title& title = known != titles_.end() ? *known : titles_.emplace_back();
    title.title = part.title;
    title.keys = axis_keys_of(part.sweep);
    if (!title.keys.empty() && !title.grids)
      title.grids.emplace(part.title, title.keys.front(), title.keys.size() > 1 ? title.keys[1] : "", part.bad);
  }
}

void StudyScores::add(const StudyPart& part, const ordered_json& row) {
  const auto title =
      std::find_if(titles_.begin(), titles_.end(), [&](const Title& one) { return one.title == part.title; });
  if (title == titles_.end()) return;
  if (title->grids) title->grids->add(row);
  const std::string who = who_ran(row, title->keys);
  auto found =
      std::find_if(title->scores.begin(), title->scores.end(), [&](const auto& one) { return one.first == who; });
  if (found == title->scores.end()) found = title->scores.insert(found, {who, {}});
  Score& score = found->second;
  ++score.cases;
  const std::string verdict = row.value("verdict", "");
  if (verdict == "holds") {
    ++score.holds;
    return;
  }
  if (verdict == "not_applicable") {
    ++score.cannot;
    return;
  }
  if (is_beyond_limits(row)) {
    ++score.beyond;
    return;
  }
  ++(row.value("tunnels", 0) > 0 ? score.through : score.other);
  if (score.first_bad.empty()) score.first_bad = values_of(row, title->keys);
}

std::string StudyScores::tables() const {
  std::string text;
  for (const Title& title : titles_) {
    ChartTable table{
        {"contender", "cases", "hold", "through", "other faults", "beyond limits", "cannot run", "first fault at"}, {}};
    for (const auto& [who, score] : title.scores)
      table.rows.push_back({who, std::to_string(score.cases), std::to_string(score.holds),
                            std::to_string(score.through), std::to_string(score.other), std::to_string(score.beyond),
                            std::to_string(score.cannot), score.first_bad});
    if (!title.title.empty()) text += fmt::format("{}{}\n\n", text.empty() ? "" : "\n", title.title);
    text += text_of(table);
  }
  return text;
}

std::vector<ChartGrid> StudyScores::grids() const {
  std::vector<ChartGrid> all;
  for (const Title& title : titles_)
    if (title.grids)
      for (ChartGrid& grid : title.grids->grids()) all.push_back(std::move(grid));
  return all;
}

std::string text_of(const ChartTable& table) {
  std::vector<TextColumn> columns;
  for (std::size_t k = 0; k < table.heading.size(); ++k) {
    constexpr std::string_view begins_a_number = "0123456789-+.";
    const auto is_number = [&](const std::vector<std::string>& line) {
      return line[k].find_first_of(begins_a_number) == 0;
    };
    TextColumn column{table.heading[k], {}, std::none_of(table.rows.begin(), table.rows.end(), is_number)};
    for (const std::vector<std::string>& line : table.rows) column.cells.emplace_back(line[k]);
    columns.push_back(std::move(column));
  }
  return aligned(columns);
}

std::string values_of(const ordered_json& row, const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys)
    if (row.contains("parameters") && row["parameters"].contains(key))
      text += fmt::format("{}{}={:.4g}", text.empty() ? "" : " ", key, row["parameters"][key].get<double>());
  return text;
}

}  // namespace paperproof::compare
