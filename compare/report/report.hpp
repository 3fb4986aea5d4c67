/// The report: one HTML file that holds tables, scenery and replays, and opens from disk without a network.
#pragma once

#include "runs/row.hpp"
#include "runs/trace.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

class OutputFile;

/// Versions, compiler, flags, processor, build: (name, value) in the order in which they are shown.
using Environment = std::vector<std::pair<std::string, std::string>>;

/// A step that a reader may want to jump to. The first contact needs none: the page finds it in the steps.
struct ReportEvent {
  enum class Kind : std::uint8_t { tunnel, corner_cut, inside, one_way, crush, drop, sensor, note };
  int step = 0;
  Kind kind = Kind::note;
  std::string words;  ///< One sentence: what happened, how fast, through what. May be empty.
  CharacterIndex character = 0;
  std::optional<ColliderIndex> collider{};  ///< What it happened with.
};

/// One run, for drawing. The page shows numbers rounded for display; the bits stand in the trace.
struct ReportRun {
  TraceHeader header;
  std::vector<TraceStep> steps;  ///< Ascending by `step`; there may be fewer than ran: see `thin_for_replay`.
  /// Characters 1, 2, ...: the same steps of theirs.
  std::vector<std::vector<TraceStep>> others{};
  std::vector<ReportEvent> events;  ///< What the judgement found.
  int every = 1;                    ///< Every how many steps one was kept, apart from those with an event.
};

/// A step on which two sides differ.
struct Disagreement {
  struct Statement {
    std::size_t run = 0;        ///< Position in `ReportScene::runs`: gives the name, the octagon and the scenery.
    Vec2d from{Vec2d::Zero()};  ///< Where the step began [m].
    Vec2d to{Vec2d::Zero()};    ///< Where it ended [m].
    std::vector<Contact<double>> contacts;
  };
  int step = 0;
  std::vector<Statement> statements;                  ///< What each side says, usually controller and Box2D.
  std::optional<std::vector<Contact<double>>> exact;  ///< What exact arithmetic says, where it was asked.
  std::string who_is_right;                           ///< In words, with the reason.
};

struct ReportScene {
  std::string name;
  std::string description;                  ///< What is measured. May be empty.
  std::string sentence;                     ///< Who is right where they differ.
  std::vector<Row> rows;                    ///< Failures included.
  std::vector<ReportRun> runs;              ///< May be fewer than rows; empty: no replay for this scene.
  std::vector<Disagreement> disagreements;  ///< In the order in which they are to be drawn.
  std::vector<double> dt_list{};  ///< Lengths of the steps [s], from the front again; empty: all of the runs' `dt`.
};

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

/// Drops steps until at most `max_steps` (at least 8) are left: every k-th stays, with the first, the last, those with
/// an event, the first contact and their neighbours. `write_report` does so by itself; here for callers that cannot
/// keep all steps in memory until then.
void thin_for_replay(ReportRun& run, int max_steps);

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
