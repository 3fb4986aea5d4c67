#include "command/study_command.hpp"
#include "metrics/ledger.hpp"
#include "runs/environment.hpp"
#include "runs/view.hpp"
#include "studies/disagreement.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

namespace paperproof::compare {
namespace {

constexpr const char* about_the_ledger =
    "Every event on which octagon_sweep and Box2D differ, with one cause. In lockstep the twin is put to the "
    "controller "
    "before each step, and each event stands alone. In a free run what both are right about, once an event took them "
    "apart, is after_divergence. crush, start_inside, company, and travel_cap of a stop, are circumstances: they are "
    "the "
    "cause only where no law explains the two velocities.";
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

/// The events of all rows, by mode.
class Ledgers {
 public:
  void add(const DisagreementCase& one, const Row& row) {
    Mode& mode = modes_[row.mode];
    if (row.verdict == Verdict::failed) {
      ++failed_;
      text_ += fmt::format("{}: {}\n", row.scene, row.reason);
    }
    if (!was_judged(row)) return;
    ++mode.scenes;
    mode.steps += row.steps;
    for (const auto& [key, some] : row.disagreements) {
      Total& total = mode.totals[key];
      if (total.count == 0) total = {0, row.scene, one.scene, some.first_step, some.first};
      total.count += some.count;
    }
  }

  [[nodiscard]] Leftovers leftovers() const {
    const auto count = [this](Cause cause) {
      int all = 0;
      for (const auto& [name, mode] : modes_)
        for (const EventKind kind : kinds) all += count_of(mode, cause, kind);
      return all;
    };
    return {.unexplained = count(Cause::unexplained),
            .remaining_lockstep = count(Cause::remaining_lockstep),
            .errors_of_ours = count(Cause::error_of_ours),
            .failed_runs = failed_};
  }

  /// What failed; then each mode: how many events of which cause and kind, and the first of each.
  [[nodiscard]] std::string text() const {
    std::string text = text_;
    for (const auto& [name, mode] : modes_) {
      text += fmt::format("{}: {}, {}\n{}\nthe first of each, {}:\n", name, counted(mode.scenes, "scene"),
                          counted(mode.steps, "step"), table_of_causes(mode), name);
      for (const auto& [key, total] : mode.totals)
        text += fmt::format("  {}: {}, step {}: {}\n    {}\n", key, total.scene, total.step, total.words,
                            replay_command(total.file, name, total.step));
      text += '\n';
    }
    return text;
  }

  [[nodiscard]] ChartPage page() const {
    ChartPage page;
    page.title = "the ledger of disagreement";
    page.paragraphs = {about_the_ledger, words_of(leftovers())};
    page.table.heading = {"mode", "cause", "event", "events", "first", "step", "what each side says"};
    for (const auto& [name, mode] : modes_)
      for (const auto& [key, total] : mode.totals) {
        const std::size_t dot = key.find('.');
        page.table.rows.push_back({name, key.substr(0, dot), key.substr(dot + 1), std::to_string(total.count),
                                   total.scene, std::to_string(total.step), total.words});
      }
    page.environment = environment();
    return page;
  }

 private:
  struct Mode {
    int scenes = 0;
    int steps = 0;
    std::map<std::string, Total> totals;  ///< By `cause.kind`.
  };

  static int count_of(const Mode& mode, Cause cause, EventKind kind) {
    const auto found = mode.totals.find(fmt::format("{}.{}", name_of(cause), name_of(kind)));
    return found == mode.totals.end() ? 0 : found->second.count;
  }

  static std::string table_of_causes(const Mode& mode) {
    std::vector<Cause> causes;
    for (std::size_t i = 0; i < cause_count; ++i) causes.push_back(static_cast<Cause>(i));
    std::vector<Column<Cause>> columns{{"cause", [](Cause cause) { return std::string(name_of(cause)); }}};
    for (const EventKind kind : kinds)
      columns.push_back({std::string(name_of(kind)),
                         [&mode, kind](Cause cause) { return std::to_string(count_of(mode, cause, kind)); }});
    return view(causes, columns);
  }

  std::map<std::string, Mode> modes_{{"free", {}}, {"lockstep", {}}};
  std::string text_;  ///< What failed.
  int failed_ = 0;
};

}  // namespace

int study_disagreement_command(const DisagreementArguments& arguments) {
  const std::vector<DisagreementCase> all =
      disagreement_cases(arguments.scenes.empty() ? registered_scenes() : arguments.scenes);
  Ledgers ledgers;
  StudyRun study(arguments.run, cases_of(all),
                 [&](std::size_t index, const Row& row) { ledgers.add(all[index], row); });
  study.run();
  const Leftovers found = ledgers.leftovers();
  return study.finish([&] { return ledgers.page(); }, ledgers.text() + words_of(found) + '\n', found.any());
}

}  // namespace paperproof::compare
