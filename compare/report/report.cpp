#include "report/report.hpp"

#include "records/output_file.hpp"
#include "report/index_json.hpp"
#include "report/json_text.hpp"
#include "report/page_parts.hpp"
#include "report/replay_json.hpp"

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
  const auto [head, rest] = split_at(page::page_html, "/*STYLE*/");
  file_->write(head);
  file_->write(page::style_css);
  file_->write(split_at(rest, "<!--DATA-->").first);
}

ReportWriter::~ReportWriter() = default;

void ReportWriter::add(const ReportScene& scene) {
  ReportScene copy{scene.name, scene.description, scene.sentence, scene.rows, {}, scene.disagreements, scene.dt_list};
  for (const ReportRun& run : scene.runs) {
    copy.runs.push_back(thinned(run, options_.max_replay_steps, scene.disagreements));
  }
  file_->write("<script type=\"application/json\" id=\"replay-" + std::to_string(index_.size()) + "\">");
  file_->write(replay_json(copy, options_));
  file_->write("</script>\n");
  index_.push_back(scene_index_json(copy));
}

void ReportWriter::finish(const Environment& environment, const std::vector<NamedTolerance>& tolerances,
                          const std::vector<std::string>& guarantee_notes, const std::vector<ReportSection>& sections) {
  file_->write("<script type=\"application/json\" id=\"index\">");
  file_->write(index_json(environment, tolerances, guarantee_notes, sections, index_));
  file_->write("</script>\n");
  const auto [before, after] = split_at(split_at(page::page_html, "<!--DATA-->").second, "/*SCRIPT*/");
  file_->write(before);
  for (const std::string_view part :
       {page::time_js, page::decode_js, page::draw_js, page::tables_js, page::disagreements_js, page::focus_js,
        page::controls_js, page::replay_js, page::main_js}) {
    file_->write(part);
  }
  file_->write(after);
  file_->commit();
}

ReportOptions options_for(std::size_t runs) noexcept {
  constexpr std::size_t steps_in_all = 600'000;
  constexpr std::size_t fewest = 60;
  constexpr std::size_t most = 1200;
  const std::size_t share = std::clamp(steps_in_all / std::max<std::size_t>(runs, 1), fewest, most);
  return {.max_replay_steps = static_cast<int>(share)};
}

void write_report(const std::string& path, const Report& report, const ReportOptions& options) {
  ReportWriter writer(path, options);
  for (const ReportScene& scene : report.scenes) writer.add(scene);
  writer.finish(report.environment, report.tolerances, report.guarantee_notes);
}

}  // namespace paperproof::compare
