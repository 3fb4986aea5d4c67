#include "command/study_run.hpp"

#include "command/cell_replays.hpp"
#include "command/claimed_files.hpp"
#include "command/complain.hpp"
#include "command/progress.hpp"
#include "records/input_file.hpp"
#include "records/rows_json.hpp"
#include "records/rows_reader.hpp"
#include "report/report.hpp"
#include "report/row_pictures.hpp"
#include "runs/environment.hpp"
#include "runs/peers.hpp"
#include "runs/view.hpp"
#include "scenes/input_error.hpp"
#include "scenes/load.hpp"
#include "studies/processes.hpp"
#include "words.hpp"

#include <paperproof/number_in.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

namespace paperproof::compare {

using nlohmann::ordered_json;

namespace {

/// No two outputs of a command may be one file.
void claim_outputs(const RunArguments& arguments) {
  ClaimedFiles files;
  files.claim_for_option("--rows", arguments.rows_path);
  files.claim_for_option("--report", arguments.report_path);
  files.claim_for_option("--log", arguments.log_path);
}

/// With replays of its cells. @param file empty: there is no page. @param jobs processes that run their cases again; 0:
/// one for each core.
void write_page(std::optional<OutputFile>& file, ChartPage page, int jobs) {
  if (!file) return;
  add_cell_replays(page, jobs);
  file->write(html_of(page));
  file->commit();
}

}  // namespace

void Failures::add(const Row& row) {
  if (row.verdict != Verdict::failed) return;
  First& first = entry_of(all_, who_ran(row));
  if (++first.rows == 1) first.reason = row.reason;
}

std::string Failures::text() const {
  std::string text;
  for (const auto& [who, first] : all_)
    text += shortened(fmt::format("{} failed in {}: {}", who, counted(first.rows, "run"), first.reason)) + '\n';
  return text.empty() ? text : '\n' + text;
}

int measure_here(const RunArguments& arguments, const std::string& name,
                 const std::function<Measurements(const std::function<void(double)>& tell)>& measure) {
  claim_outputs(arguments);
  RowsFile rows(arguments.rows_path, rows_header(environment()));
  std::optional<OutputFile> page;
  if (!arguments.report_path.empty()) page.emplace(arguments.report_path);
  Progress progress(!arguments.quiet);
  const Measurements found = measure([&](double share) { progress.show(name + ",", share); });
  progress.clear();
  Failures failures;
  for (const Row& row : found.rows) {
    rows.add(row);
    failures.add(row);
  }
  rows.finish();
  write_page(page, found.page, 0);
  if (!arguments.quiet) print_out(found.text + failures.text());
  return std::any_of(found.rows.begin(), found.rows.end(), is_our_failure);
}

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

StudyRun::StudyRun(const RunArguments& arguments, StudyCases cases, Visit visit)
    : arguments_(arguments),
      cases_(std::move(cases)),
      visit_(std::move(visit)),
      shard_(parse_shard(arguments.shard)),
      count_(shard_.size(cases_.count)),
      header_(rows_header(environment())) {
  header_["sweep"] = {{"id", cases_.id}, {"cases", cases_.count}, {"shard", {shard_.part, shard_.of}}};
  claim_outputs(arguments);
  const bool continued = goes_on();
  rows_.emplace(arguments.rows_path, header_, continued);
  if (!arguments.report_path.empty()) page_.emplace(arguments.report_path);
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
    if (!cases_.is_of(shard_.case_of(done_), line->row))
      throw InputError(fmt::format("{}: row {} is not the case that belongs there", path, done_ + 1));
    note(line->row);
  }
  if (reader.cut_line() > 0 && !arguments_.quiet)
    complain(fmt::format("{}:{}: this last row is cut short; its case is run again", path, reader.cut_line()));
  std::filesystem::resize_file(path, reader.end(), unknown);
  if (unknown) throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, unknown.message()));
  return true;
}

void StudyRun::note(const Row& row) {
  trouble_ = trouble_ || is_our_failure(row) || breaks_guarantee(row);
  failures_.add(row);
  visit_(shard_.case_of(done_), row);
  ++done_;
}

void StudyRun::run() {
  Progress progress(!arguments_.quiet, arguments_.log_path);
  const std::size_t before = done_;
  Jobs jobs;
  jobs.count = count_ - before;
  jobs.run = [&](std::size_t job) { return json_line(row_json(cases_.run(shard_.case_of(before + job)))); };
  jobs.lost = [&](std::size_t job, const std::string& reason) {
    return json_line(row_json(cases_.lost(shard_.case_of(before + job), reason)));
  };
  progress.foretell(static_cast<double>(jobs.count), "cases");
  jobs.take = [&](std::size_t job, const std::string& line) {
    note(row_of(ordered_json::parse(line)));
    rows_->add(line);
    progress.show(fmt::format("{} of {} cases,", done_, count_),
                  static_cast<double>(job + 1) / static_cast<double>(jobs.count));
  };
  std::chrono::seconds limit(arguments_.limit_s.value_or(cases_.limit_s));
  if (!peers().empty()) limit += longest_greeting;
  run_in_processes(jobs, {processes_for(arguments_.jobs), limit});
  progress.clear();
}

int StudyRun::finish(const std::function<ChartPage()>& page, const std::string& text, bool fails) {
  rows_->finish();
  if (page_) write_page(page_, page(), arguments_.jobs);
  if (!arguments_.quiet) print_out(text + failures_.text());
  return trouble_ || fails ? 1 : 0;
}

}  // namespace paperproof::compare
