/// The report: one HTML file that holds tables, scenery and replays, and opens from disk without a network.
#pragma once

#include "records/rows_json.hpp"
#include "records/scene_result.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

class OutputFile;

struct Report {
  Environment environment;
  std::vector<NamedTolerance> tolerances;
  std::vector<ReportScene> scenes;
  std::vector<std::string> guarantee_notes;  ///< What is guaranteed, and the counts of violations, zero included.
};

/// Lines under a heading of their own in the summary.
struct ReportSection {
  std::string title;
  std::vector<std::string> lines;
};

/// How much of the runs goes into the file. A stored step takes about 30 bytes.
struct ReportOptions {
  int max_replay_steps = 1200;  ///< Per run [steps]. Small: jumps in the replay. Large: a file of hundreds of MB.
  int max_disagreements = 24;   ///< Drawn per scene; the page says how many there were.
};

/// Options for a report with many runs: shares about 600,000 steps (some 20 MB) among them, 60 to 1,200 each.
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
  /// To be called once, last.
  void finish(const Environment& environment, const std::vector<NamedTolerance>& tolerances,
              const std::vector<std::string>& guarantee_notes, const std::vector<ReportSection>& sections = {});

 private:
  std::unique_ptr<OutputFile> file_;
  ReportOptions options_;
  std::vector<std::string> index_;  ///< One JSON object per scene: what the summary and the tables need.
};

/// The whole report at once.
/// @throws std::runtime_error that says in words which file could not be written and why.
void write_report(const std::string& path, const Report& report, const ReportOptions& options = {});

}  // namespace paperproof::compare
