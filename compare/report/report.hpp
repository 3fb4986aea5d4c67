/// The report: one HTML file that holds tables, scenery and replays, and opens from disk without a network.
#pragma once

#include "records/rows_json.hpp"
#include "records/scene_result.hpp"
#include "report/chart_page.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

class OutputFile;

/// Under a heading of its own in the summary, opened by a click.
struct ReportSection {
  std::string title;
  std::vector<std::string> lines;
  std::vector<std::vector<std::string>> table{};  ///< The first row is the heading; may be empty.
};

/// What stands beside the scenes and studies.
struct ReportFacts {
  Environment environment{};
  std::vector<NamedTolerance> tolerances{};
  std::vector<std::string> guarantee_notes{};  ///< What is guaranteed, and the counts of violations, zero included.
  std::vector<ReportSection> sections{};
};

/// How much of the runs goes into the file. A stored step takes about 40 bytes.
struct ReportOptions {
  int max_replay_steps = 1200;  ///< Per run [steps]. Small: jumps in the replay. Large: a file of hundreds of MB.
  std::size_t max_disagreements = 24;  ///< Drawn per scene; the page says how many there were.
};

/// Options for a report with many runs: shares about 500,000 steps (some 20 MB) among them, 60 to 1,200 each.
[[nodiscard]] ReportOptions options_for(std::size_t runs) noexcept;

/// Writes a report scene by scene, so that no more than one has to be in memory. The page is written beside `path` and
/// renamed by `finish`: a reader never sees half of it, and a writer that is dropped before leaves nothing behind.
/// Not thread-safe. Every member function throws std::runtime_error with the file and the reason in words.
class ReportWriter {
 public:
  explicit ReportWriter(const std::string& path, const ReportOptions& options = {});
  ~ReportWriter();
  ReportWriter(const ReportWriter&) = delete;
  ReportWriter& operator=(const ReportWriter&) = delete;

  /// Scenes appear in the page in the order in which they are added.
  void add(const ReportScene& scene);
  /// A scene as a page has it. @param index its object in `scenes` of the index; @param replay see `replay_json`;
  /// `null` for none.
  void add_scene(std::string index, const std::string& replay);
  /// A study, in the order in which they are added.
  void add_study(const ChartPage& page);
  /// A study as a page has it. @param json see `chart_page_json`; @param replays its
  /// cells', as a JSON array.
  void add_study(std::string json, const std::string& replays);
  /// To be called once, last.
  void finish(const ReportFacts& facts);

 private:
  std::unique_ptr<OutputFile> file_;
  ReportOptions options_;
  std::vector<std::string> index_;  ///< One JSON object per scene: what the summary and the tables need.
  std::vector<std::string> studies_;
};

/// The page of a study alone.
[[nodiscard]] std::string html_of(const ChartPage& page);

}  // namespace paperproof::compare
