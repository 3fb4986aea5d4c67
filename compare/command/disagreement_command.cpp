#include "command/progress.hpp"
#include "command/study_command.hpp"
#include "command/study_outputs.hpp"
#include "metrics/ledger.hpp"
#include "studies/disagreement.hpp"
#include "studies/processes.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

constexpr const char* about_the_ledger =
    "Every event on which octagon_sweep and Box2D differ, with one cause. In lockstep the twin is put to the "
    "controller "
    "before each step, and each event stands alone. In a free run what both are right about, once an event took them "
    "apart, is after_divergence. crush, start_inside, company, and travel_cap of a stop, are circumstances: they are "
    "the "
    "cause only where no law explains the two velocities.";
/// A real level may take this long.
constexpr std::chrono::seconds part_limit{600};
constexpr std::array kinds{EventKind::contact, EventKind::side,        EventKind::time,        EventKind::crossing,
                           EventKind::stop,    EventKind::toggle_ours, EventKind::toggle_box2d};

/// What there is of one cause and kind in one mode.
struct Total {
  int count = 0;
  std::string scene;  ///< Of the first one.
  std::string file;   ///< As it was asked for.
  int step = 0;
  std::string words;
};

/// `cause.kind`
using Totals = std::map<std::string, Total>;

class DisagreementRun {
 public:
  explicit DisagreementRun(const DisagreementArguments& arguments)
      : arguments_(arguments),
        outputs_(arguments.rows_path, arguments.report_path, arguments.log_path),
        progress_(!arguments.quiet, arguments.log_path) {
    page_.title = "the ledger of disagreement";
    page_.paragraphs = {about_the_ledger};
    page_.table.heading = {"mode", "cause", "event", "events", "first", "step", "what each side says"};
    page_.environment = environment();
  }

  int run() {
    const std::vector<DisagreementCase> cases =
        disagreement_cases(arguments_.scenes.empty() ? registered_scenes() : arguments_.scenes);
    Jobs jobs;
    jobs.count = cases.size();
    jobs.run = [&](std::size_t job) { return json_line(row_json(run_disagreement(cases[job]))); };
    jobs.lost = [&](std::size_t job, const std::string& reason) {
      return json_line(row_json(failed_row(cases[job], reason)));
    };
    jobs.take = [&](std::size_t job, const std::string& line) {
      outputs_.add(line);
      note(ordered_json::parse(line), cases[job].scene);
      progress_.show("study disagreement,", static_cast<double>(job) / static_cast<double>(cases.size()));
    };
    run_in_processes(jobs, {.workers = processes_for(arguments_.jobs), .limit = part_limit});
    progress_.clear();
    for (const char* mode : {"free", "lockstep"}) tell(mode);
    const Leftovers found{.unexplained = count_of(Cause::unexplained),
                          .remaining_lockstep = count_of(Cause::remaining_lockstep),
                          .errors_of_ours = count_of(Cause::error_of_ours),
                          .failed_runs = failed_};
    const std::string verdict = words_of(found);
    page_.paragraphs.push_back(verdict);
    outputs_.finish(page_);
    if (!arguments_.quiet) print_out(text_ + verdict + '\n');
    return found.any() ? 1 : 0;
  }

 private:
  struct Mode {
    int scenes = 0;
    int steps = 0;
    Totals totals;
  };

  void note(const ordered_json& row, const std::string& file) {
    Mode& mode = modes_[row.value("mode", "")];
    const std::string verdict = row.value("verdict", "");
    if (verdict == "failed") {
      ++failed_;
      text_ += fmt::format("{}: {}\n", row.value("scene", ""), row.value("reason", ""));
    }
    if (verdict == "failed" || verdict == "not_applicable") return;
    ++mode.scenes;
    mode.steps += row.value("steps", 0);
    if (!row.contains("disagreements")) return;
    for (const auto& [key, some] : row["disagreements"].items()) {
      Total& total = mode.totals[key];
      if (total.count == 0)
        total = {0, row.value("scene", ""), file, some["first_step"].get<int>(), some["first"].get<std::string>()};
      total.count += some["count"].get<int>();
    }
  }

  /// In both modes.
  [[nodiscard]] int count_of(Cause cause) const {
    int count = 0;
    for (const auto& [name, mode] : modes_)
      for (const EventKind kind : kinds) count += count_of(mode, cause, kind);
    return count;
  }

  static int count_of(const Mode& mode, Cause cause, EventKind kind) {
    const auto found = mode.totals.find(fmt::format("{}.{}", name_of(cause), name_of(kind)));
    return found == mode.totals.end() ? 0 : found->second.count;
  }

  void tell(const std::string& name) {
    const Mode& mode = modes_[name];
    text_ += fmt::format("{}: {}, {}\n{:<18}", name, counted(static_cast<std::size_t>(mode.scenes), "scene"),
                         counted(static_cast<std::size_t>(mode.steps), "step"), "cause");
    for (const EventKind kind : kinds) text_ += fmt::format(" {:>12}", name_of(kind));
    text_ += '\n';
    for (std::size_t i = 0; i < cause_count; ++i) {
      const auto cause = static_cast<Cause>(i);
      text_ += fmt::format("{:<18}", name_of(cause));
      for (const EventKind kind : kinds) text_ += fmt::format(" {:>12}", count_of(mode, cause, kind));
      text_ += '\n';
    }
    text_ += fmt::format("\nthe first of each, {}:\n", name);
    for (const auto& [key, total] : mode.totals) tell_first(name, key, total);
    text_ += '\n';
  }

  void tell_first(const std::string& mode, const std::string& key, const Total& total) {
    const std::size_t dot = key.find('.');
    text_ += fmt::format("  {}: {}, step {}: {}\n    {}\n", key, total.scene, total.step, total.words,
                         replay_command(total.file, mode, total.step));
    page_.table.rows.push_back({mode, key.substr(0, dot), key.substr(dot + 1), std::to_string(total.count), total.scene,
                                std::to_string(total.step), total.words});
  }

  const DisagreementArguments& arguments_;
  StudyOutputs outputs_;
  Progress progress_;
  ChartPage page_;
  std::map<std::string, Mode> modes_;
  std::string text_;
  int failed_ = 0;
};

}  // namespace

int study_disagreement_command(const DisagreementArguments& arguments) { return DisagreementRun(arguments).run(); }

}  // namespace paperproof::compare
