#include "command/judge_command.hpp"

#include "contains.hpp"
#include "records/trace_reader.hpp"
#include "runs/run_judge.hpp"
#include "runs/technique_parts.hpp"
#include "scenes/load.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace paperproof::compare {
namespace {

/// The header with what the scene says in place of what it says itself.
TraceHeader as_scene_says(TraceHeader header, const Scene& scene, const std::string& path) {
  if (header.ids != scene.ids) throw InputError(path + ": expected the colliders of the scene, in its order");
  const CharacterDef rules = header.character;
  header.points.assign(scene.character.shape.hull().begin(), scene.character.shape.hull().end());
  header.scenery = scene.scenery;
  header.up = Vec2d::UnitY();
  header.starts.clear();
  header.scripts.clear();
  const std::vector<Clause> promised = header.guarantees;
  add_terms(scene, scene.character, header);
  header.character.no_jump_toward_wall = rules.no_jump_toward_wall;  // knobs decide these
  header.character.side_hit_ends_rise = rules.side_hit_ends_rise;
  header.guarantees = promised;
  return header;
}

/// The records of one step, one of each character; empty behind the last.
class Steps {
 public:
  explicit Steps(const std::string& path) : path_(path), reader_(path), next_(reader_.next()) {}

  /// After the first record is known whether positions are exact.
  [[nodiscard]] const TraceHeader& header() const { return reader_.header(); }
  [[nodiscard]] std::vector<TraceStep> next() {
    std::vector<TraceStep> records;
    while (next_ && records.size() < header().characters) {
      if (!next_->refused.empty() && records.empty()) {
        records.push_back(std::move(*next_));
        next_ = reader_.next();
        return records;
      }
      const bool fits = next_->character == records.size() && (records.empty() || records[0].step == next_->step);
      if (!fits || !next_->refused.empty())
        throw InputError(fmt::format("{}: expected a record of character {} in step {}", path_, records.size(),
                                     records.empty() ? next_->step : records[0].step));
      records.push_back(std::move(*next_));
      next_ = reader_.next();
    }
    if (!records.empty() && records.size() < header().characters)
      throw InputError(fmt::format("{}: expected {} records in step {}", path_, header().characters, records[0].step));
    return records;
  }

 private:
  std::string path_;
  TraceReader reader_;
  std::optional<TraceStep> next_;
};

bool judge_trace(const std::string& path, const JudgeOptions& options, const std::optional<Scene>& scene) {
  Steps steps(path);
  TraceHeader header = scene ? as_scene_says(steps.header(), *scene, path) : steps.header();
  if (options.all_clauses) header.guarantees = every_clause();
  if (!header.guarantees.empty()) header.path_exact = true;  // a promise is about the way that was travelled
  RunJudge judge(header, {.gravity = header.gravity});
  int judged = 0;
  for (std::vector<TraceStep> records = steps.next(); !records.empty(); records = steps.next()) {
    if (!records.front().refused.empty()) {
      judge.add_refused(records.front());
      continue;
    }
    const std::vector<TraceStep> claimed = records;
    judge.add(records);
    for (std::size_t k = 0; k < records.size(); ++k) judge.check_start(claimed[k], records[k]);
    ++judged;
  }
  const Breaches breaches = judge.breaches();
  int broken = 0;
  for (const auto& [clause, breach] : breaches) broken += contains(header.guarantees, clause);
  fmt::print("{}: {} in {}, {}: {} judged, {} broken of {} guaranteed\n", path, header.contender, header.scalar,
             header.scene, counted(judged, "step"), broken, counted(header.guarantees.size(), "clause"));
  for (const auto& [clause, breach] : breaches)
    fmt::print("  {}{} on {}, first in step {}: {}\n", name_of(clause),
               contains(header.guarantees, clause) ? "" : " (not guaranteed)", counted(breach.steps, "step"),
               breach.first_step, breach.first);
  Row row;
  judge.write(row);
  if (row.arc_error_max_m) fmt::print("  what turns leaves its arc by at most {:.3g} m\n", *row.arc_error_max_m);
  for (const auto& [which, often] : row.exempted) fmt::print("  exempted: {} on {}\n", which, counted(often, "step"));
  return broken > 0;
}

}  // namespace

int judge_command(const JudgeOptions& options) {
  std::optional<Scene> scene;
  if (!options.scene.empty()) scene = load_scene(options.scene, {});
  bool any = false;
  try {
    for (const std::string& path : options.traces) any = judge_trace(path, options, scene) || any;
  } catch (const InvalidTrace& invalid) {
    throw InputError(invalid.what());
  }
  return any ? 1 : 0;
}

}  // namespace paperproof::compare
