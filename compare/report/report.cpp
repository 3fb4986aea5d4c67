#include "report/report.hpp"

#include "embedded.hpp"
#include "records/output_file.hpp"
#include "report/chart_json.hpp"
#include "report/index_json.hpp"
#include "report/json_text.hpp"
#include "report/replay.hpp"

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare {
namespace {

/// The text of the frame before and after a marker.
std::pair<std::string_view, std::string_view> split_at(std::string_view text, std::string_view marker) {
  const std::size_t at = text.find(marker);
  if (at == std::string_view::npos) throw std::runtime_error("the report's page lacks " + std::string(marker));
  return {text.substr(0, at), text.substr(at + marker.size())};
}

std::string_view text_of(std::string_view file) {
  return std::ranges::find(page_files, file, &EmbeddedFile::name)->text;
}

std::string head_of_page() {
  const auto [head, rest] = split_at(text_of("page.html"), "/*STYLE*/");
  return std::string(head).append(text_of("style.css")).append(split_at(rest, "<!--DATA-->").first);
}

std::string data_element(const std::string& id, const std::string& json) {
  return "<script type=\"application/json\" id=\"" + id + "\">" + json + "</script>\n";
}

/// @param charts the page needs the library that draws them.
std::string tail_of_page(bool charts) {
  std::string text;
  if (charts) text.append("<script>").append(page_files.back().text).append("</script>\n");
  const auto [before, after] = split_at(split_at(text_of("page.html"), "<!--DATA-->").second, "/*SCRIPT*/");
  text += before;
  for (const EmbeddedFile& file : page_files.first(page_files.size() - 1))
    if (file.name.ends_with(".js")) text += file.text;
  return text.append(after);
}

ReportRun thinned(const ReportRun& run, int max_steps, const std::vector<Disagreement>& disagreements) {
  ReportRun copy = run;
  for (const Disagreement& disagreement : disagreements) copy.events.push_back({disagreement.step, {}, {}});
  thin_for_replay(copy, max_steps);
  copy.events = run.events;
  return copy;
}

}  // namespace

ReportWriter::ReportWriter(const std::string& path, const ReportOptions& options)
    : file_(std::make_unique<OutputFile>(path)), options_(options) {
  file_->write(head_of_page());
}

ReportWriter::~ReportWriter() = default;

void ReportWriter::add(const ReportScene& scene) {
  ReportScene copy{scene.name, scene.description, scene.sentence, scene.rows, {}, scene.disagreements, scene.dt_list};
  for (const ReportRun& run : scene.runs) {
    copy.runs.push_back(thinned(run, options_.max_replay_steps, scene.disagreements));
  }
  add_scene(scene_index_json(copy), replay_json(copy, options_.max_disagreements));
}

void ReportWriter::add_scene(std::string index, const std::string& replay) {
  file_->write(data_element("replay-" + std::to_string(index_.size()), replay));
  index_.push_back(std::move(index));
}

void ReportWriter::add_study(const ChartPage& page) { add_study(chart_page_json(page), list_of(page.replays)); }

void ReportWriter::add_study(std::string json, const std::string& replays) {
  file_->write(data_element("cells-" + std::to_string(studies_.size()), replays));
  studies_.push_back(std::move(json));
}

void ReportWriter::finish(const ReportFacts& facts) {
  file_->write(data_element("index", index_json(facts, index_, studies_)));
  file_->write(tail_of_page(!studies_.empty()));
  file_->commit();
}

std::string html_of(const ChartPage& page) {
  return head_of_page() + data_element("cells-0", list_of(page.replays)) +
         data_element("index", index_json({.environment = page.environment}, {}, {chart_page_json(page)})) +
         tail_of_page(true);
}

ReportOptions options_for(std::size_t runs) noexcept {
  constexpr std::size_t steps_in_all = 500'000;
  constexpr std::size_t fewest = 60;
  constexpr std::size_t most = 1200;
  const std::size_t share = std::clamp(steps_in_all / std::max<std::size_t>(runs, 1), fewest, most);
  return {.max_replay_steps = static_cast<int>(share)};
}

}  // namespace paperproof::compare
