#include "command/compare_command.hpp"

#include "runs/output_file.hpp"
#include "runs/rows_json.hpp"
#include "runs/table.hpp"
#include "scenes/load.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <set>

namespace paperproof::compare {
namespace {

/// Up to this many arguments their scenes are kept in memory; more are read once to be checked and again to be run.
constexpr std::size_t kept_in_memory = 16;

/// One line on a terminal's stderr that says how far the work is.
class Progress {
 public:
  explicit Progress(bool wanted) : shown_(wanted && isatty(STDERR_FILENO) != 0) {}
  ~Progress() {
    if (shown_) std::fputs("\r\x1b[K", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& what, double share) const {
    if (shown_) std::fputs(fmt::format("\r\x1b[K{} {:.0f} %", what, 100 * share).c_str(), stderr);
  }
  void clear() const {
    if (shown_) std::fputs("\r\x1b[K", stderr);
  }

 private:
  bool shown_;
};

/// What was found over all scenes, for the closing line and the exit status.
struct Totals {
  long long guaranteed_steps = 0;
  int guaranteed_rows = 0;
  int violations = 0;
  int failed = 0;

  void add(const Row& row) {
    failed += row.verdict == Verdict::failed;
    if (row.contender != paperproof::name_of(TechniqueKind::octagon_sweep) || row.scalar != "double") return;
    guaranteed_steps += row.steps;
    ++guaranteed_rows;
    violations += row.verdict == Verdict::violates;
  }
  [[nodiscard]] std::string words() const {
    return fmt::format("octagon_sweep in double: {} steps in {} runs, {} runs with a violation of the guarantee",
                       guaranteed_steps, guaranteed_rows, violations);
  }
};

std::vector<NamedTolerance> tolerances_of(const ReportScene& scene) {
  for (const ReportRun& run : scene.runs)
    if (run.header.contender == paperproof::name_of(TechniqueKind::octagon_sweep)) return run.header.tolerances;
  return {};
}

class Comparison {
 public:
  explicit Comparison(CompareArguments& arguments) : arguments_(arguments), progress_(!arguments.quiet) {
    check_contenders(arguments.run.contenders);
    check_lockstep();
    const bool keep = arguments.scenes.size() <= kept_in_memory;
    for (std::size_t i = 0; i < arguments.scenes.size(); ++i) {
      progress_.show("checking " + arguments.scenes[i],
                     static_cast<double>(i) / static_cast<double>(arguments.scenes.size()));
      std::vector<Scene> scenes = load_scenes(arguments.scenes[i]);
      for (const Scene& scene : scenes) check_name(arguments.scenes[i], scene.name);
      if (keep) kept_.push_back(std::move(scenes));
    }
  }

  int run() {
    if (!arguments_.report_path.empty()) open_report();
    for (std::size_t i = 0; i < arguments_.scenes.size(); ++i) {
      const std::vector<Scene> scenes = kept_.empty() ? load_scenes(arguments_.scenes[i]) : std::move(kept_[i]);
      for (const Scene& scene : scenes)
        run_one(scene, static_cast<double>(i) / static_cast<double>(arguments_.scenes.size()));
    }
    progress_.clear();
    finish();
    return totals_.violations > 0 || totals_.failed > 0 ? 1 : 0;
  }

 private:
  void check_lockstep() const {
    if (arguments_.run.mode != Mode::lockstep) return;
    if (!arguments_.run.reference)
      throw InputError("--no-reference: expected to be left out, as lockstep compares with the reference");
    for (const std::string& name : arguments_.run.contenders)
      if (is_reference(name))
        throw InputError(fmt::format("--contender {}: expected a technique, as lockstep runs Box2D beside each", name));
  }

  /// Two scenes of one name would write to the same trace.
  void check_name(const std::string& given, const std::string& name) {
    if (!names_.insert(name).second && !arguments_.run.trace_stem.empty())
      throw InputError(
          fmt::format("{}: expected another name than {}, which another scene has: their traces would "
                      "overwrite each other",
                      given, name));
  }

  void open_report() {
    const std::size_t contenders =
        arguments_.run.contenders.empty() ? contender_names().size() : arguments_.run.contenders.size() + 1;
    report_options_ = options_for(arguments_.scenes.size() * contenders);
    arguments_.run.max_replay_steps = report_options_.max_replay_steps;
    report_.emplace(arguments_.report_path, report_options_);
  }

  void run_one(const Scene& scene, double share) {
    arguments_.run.progress = [&](double of_scene) {
      progress_.show(fmt::format("{} ({:.0f} %),", scene.name, 100 * of_scene), share);
    };
    const ReportScene result = run_scene(scene, arguments_.run);
    progress_.clear();
    for (const Row& row : result.rows) {
      totals_.add(row);
      rows_.push_back(row);
    }
    if (tolerances_.empty()) tolerances_ = tolerances_of(result);
    if (report_) report_->add(result);
    if (!arguments_.quiet && !arguments_.json) print(result);
  }

  static void print(const ReportScene& result) {
    fmt::print("{}", result.name);
    if (!result.description.empty()) fmt::print(": {}", result.description);
    fmt::print("\n\n{}\n{}\n\n", table(result.rows), result.sentence);
    std::fflush(stdout);
  }

  void finish() {
    const nlohmann::ordered_json rows = rows_json(rows_);
    const auto text = [&rows] { return rows.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace); };
    if (!arguments_.rows_path.empty()) {
      OutputFile file(arguments_.rows_path);
      file.stream() << text() << '\n';
      file.commit();
    }
    if (report_) report_->finish(environment(), tolerances_, {totals_.words()});
    if (arguments_.json)
      fmt::print("{}\n", text());
    else if (!arguments_.quiet)
      fmt::print("{}\n", totals_.words());
    if (report_ && !arguments_.quiet && !arguments_.json) fmt::print("report: {}\n", arguments_.report_path);
  }

  CompareArguments& arguments_;
  Progress progress_;
  std::vector<std::vector<Scene>> kept_;
  std::set<std::string> names_;
  std::vector<Row> rows_;
  Totals totals_;
  ReportOptions report_options_;
  std::optional<ReportWriter> report_;
  std::vector<NamedTolerance> tolerances_;
};

}  // namespace

std::uint64_t parse_random_input(const std::string& text) {
  constexpr std::string_view prefix = "random:";
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  if (text.starts_with(prefix)) {
    const auto [last, error] = std::from_chars(text.data() + prefix.size(), end, seed);
    if (error == std::errc{} && last == end) return seed;
  }
  throw InputError("--input " + text + ": expected random:SEED with a whole number, such as random:1");
}

void check_contenders(const std::vector<std::string>& names) {
  const auto known = contender_names();
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("--contender {}: expected one of {}", name, fmt::join(known, ", ")));
}

int compare_scenes(CompareArguments arguments) { return Comparison(arguments).run(); }

}  // namespace paperproof::compare
