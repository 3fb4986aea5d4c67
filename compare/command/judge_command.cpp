#include "command/judge_command.hpp"

#include "contains.hpp"
#include "records/output_file.hpp"
#include "records/trace_reader.hpp"
#include "runs/run_judge.hpp"
#include "runs/technique_parts.hpp"
#include "scenes/load.hpp"
#include "scenes/step_times.hpp"
#include "words.hpp"

#include <paperproof/scenery.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace paperproof::compare {
namespace {

/// The header with what the scene says in place of what it says itself.
TraceHeader as_scene_says(TraceHeader header, const Scene& scene, const std::string& path) {
  if (header.ids != scene.ids) throw InputError(path + ": expected the colliders of the scene, in its order");
  if (header.characters != character_count(scene))
    throw InputError(fmt::format("{}: expected {}", path, counted(character_count(scene), "character")));
  for (std::size_t i = 0; i < scene.movers.size(); ++i)
    if ((i < header.turning.size() && header.turning[i]) == scene.movers[i].turns.empty())
      throw InputError(path + ": expected the movers to turn that turn in the scene");
  const CharacterDef rules = header.character;
  header.points.assign(scene.character.shape.hull().begin(), scene.character.shape.hull().end());
  header.scenery = scene.scenery;
  header.up = Vec2d::UnitY();
  // Box2D's twin in lockstep ends with the run that it is the twin of.
  if (header.mode != "lockstep" || !header.guarantees.empty()) header.steps = header.steps.value_or(scene.steps);
  header.starts.clear();
  header.scripts.clear();
  const std::vector<Clause> promised = header.guarantees;
  add_terms(scene, scene.character, header);
  header.character.no_jump_toward_wall = rules.no_jump_toward_wall;  // knobs decide these
  header.character.side_hit_ends_rise = rules.side_hit_ends_rise;
  header.guarantees = promised;
  return header;
}

/// What a scene asks for in each step.
class AskedByScene {
 public:
  AskedByScene(const Scene& scene, const TraceHeader& header)
      : header_(header), script_(script_of(scene)), times_(scene) {}

  /// @throws InputError where a record is of another step, gravity or input.
  void check(const TraceStep& record, const std::string& path) const {
    const auto expect = [&](bool is_so, const char* what) {
      if (!is_so) throw InputError(fmt::format("{}: step {}: expected {} of the scene", path, record.step, what));
    };
    const double length = times_.vary() ? times_.length(record.step) : header_.dt;
    expect(length_of(record, header_) == length, "the length");
    expect(!record.up || *record.up == header_.up, "the up");
    expect(!record.gravity || *record.gravity == header_.gravity, "the gravity");
    const Input input = input_at(script_[record.character], record.step);
    expect(record.input.move == input.move && record.input.jump == input.jump && record.input.drop == input.drop,
           "the input");
  }

 private:
  const TraceHeader& header_;
  Script script_;
  StepTimes times_;
};

/// Whether two records say the same of the world, which has one state in a step.
bool is_one_world(const TraceStep& a, const TraceStep& b) {
  const auto same_way = [](const VertexWay& one, const VertexWay& other) {
    return one.collider == other.collider && one.instants == other.instants && one.vertices == other.vertices;
  };
  return a.dt == b.dt && a.up == b.up && a.gravity == b.gravity &&
         std::equal(a.movers.begin(), a.movers.end(), b.movers.begin(), b.movers.end(), same_motion) &&
         std::equal(a.vertex_ways.begin(), a.vertex_ways.end(), b.vertex_ways.begin(), b.vertex_ways.end(), same_way);
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
      if (!records.empty() && !is_one_world(records[0], *next_))
        throw InputError(fmt::format("{}: step {}: character {} has another world than character 0", path_, next_->step,
                                     next_->character));
      records.push_back(std::move(*next_));
      next_ = reader_.next();
    }
    if (!records.empty() && records.size() < header().characters)
      throw InputError(fmt::format("{}: expected {} records in step {}", path_, header().characters, records[0].step));
    check_turns(records);
    return records;
  }

 private:
  /// All have a turn, each another one, or none has.
  void check_turns(std::span<const TraceStep> records) const {
    std::vector<bool> taken(records.size());
    for (const TraceStep& record : records) {
      const auto refuse = [&](const char* what) {
        throw InputError(
            fmt::format("{}: step {}: character {}: expected {}", path_, record.step, record.character, what));
      };
      if (record.turn.has_value() != records.front().turn.has_value()) refuse("a turn of all characters or of none");
      if (!record.turn) continue;
      if (taken[*record.turn]) refuse("a turn that no other one has");
      taken[*record.turn] = true;
    }
  }

  std::string path_;
  TraceReader reader_;
  std::optional<TraceStep> next_;
};

/// What no trace can stand for.
void check_header(const TraceHeader& header, const std::string& path) {
  if (header.substeps > 1 && !header.guarantees.empty())
    throw InputError(path + ": /substeps: expected 1 of who guarantees something");
  try {
    const Scenery scenery(header.scenery);
  } catch (const std::invalid_argument& reason) {
    throw InputError(fmt::format("{}: /colliders: {}", path, reason.what()));
  }
}

/// The run must have all the steps that it was to have, where that is known, unless the last was refused.
void judge_end(const TraceHeader& header, const TraceStep& last, Breaches& breaches) {
  if (!header.steps) return;
  const int final_step = *header.steps - 1;
  if (last.step == final_step || (!last.refused.empty() && last.step < final_step)) return;
  breaches[Clause::continuity].add(last.step, [&] {
    const char* ends = last.step < final_step ? "ends with" : "goes on to";
    return fmt::format("the trace {} this step, and the run has {}", ends, counted(*header.steps, "step"));
  });
}

bool judge_trace(const std::string& path, const JudgeOptions& options, const std::optional<Scene>& scene) {
  Steps steps(path);
  TraceHeader header = scene ? as_scene_says(steps.header(), *scene, path) : steps.header();
  if (options.steps) header.steps = options.steps;
  check_header(header, path);
  const std::optional<AskedByScene> asked =
      scene ? std::optional<AskedByScene>(std::in_place, *scene, header) : std::nullopt;
  if (options.all_clauses) header.guarantees = every_clause();
  if (!header.guarantees.empty()) header.path_exact = true;  // a promise is about the way that was travelled
  RunJudge judge(header, {.gravity = header.gravity});
  int judged = 0;
  int refused = 0;
  TraceStep last;
  for (std::vector<TraceStep> records = steps.next(); !records.empty(); records = steps.next()) {
    last = records.front();
    if (!records.front().refused.empty()) {
      judge.add_refused(records.front());
      ++refused;
      continue;
    }
    if (asked)
      for (const TraceStep& record : records) asked->check(record, path);
    const std::vector<TraceStep> claimed = records;
    judge.add(records);
    for (std::size_t k = 0; k < records.size(); ++k) judge.check_start(claimed[k], records[k]);
    ++judged;
  }
  if (judged + refused == 0) throw InputError(path + ": expected a step");
  Breaches breaches = judge.breaches();
  judge_end(header, last, breaches);
  int broken = 0;
  for (const auto& [clause, breach] : breaches) broken += contains(header.guarantees, clause);
  std::string said =
      fmt::format("{}: {} in {}, {}: {} judged, {} broken of {} {}\n", path, header.contender, header.scalar,
                  header.scene, counted(judged, "step"), broken, counted(header.guarantees.size(), "clause"),
                  options.all_clauses ? "asked" : "guaranteed");
  if (scene && header.steps && *header.steps != scene->steps)
    said += fmt::format("  the scene has {}\n", counted(scene->steps, "step"));
  for (const auto& [clause, breach] : breaches)
    said += fmt::format("  {}{} on {}, first in step {}: {}\n", name_of(clause),
                        contains(header.guarantees, clause) ? "" : " (not guaranteed)", counted(breach.steps, "step"),
                        breach.first_step, breach.first);
  Row row;
  judge.write(row);
  if (row.arc_error_max_m)
    said += fmt::format("  what turns leaves its arc by at most {:.3g} m\n", *row.arc_error_max_m);
  if (refused > 0) said += fmt::format("  {} refused\n", counted(refused, "step"));
  const auto bodies = std::count_if(header.scripts.begin(), header.scripts.end(),
                                    [](const MoverScript& script) { return script.body; });
  if (bodies > 0) said += fmt::format("  {} held against no script\n", counted(bodies, "body"));
  for (const auto& [which, often] : row.exempted)
    said += fmt::format("  exempted: {} on {}\n", which, counted(often, "step"));
  print_out(said);
  return broken > 0;
}

}  // namespace

int judge_command(const JudgeOptions& options) {
  std::optional<Scene> scene;
  if (!options.scene.empty()) scene = load_scene(options.scene, options.settings);
  bool any = false;
  try {
    for (const std::string& path : options.traces) any = judge_trace(path, options, scene) || any;
  } catch (const InvalidTrace& invalid) {
    throw InputError(invalid.what());
  }
  return any ? 1 : 0;
}

}  // namespace paperproof::compare
