#include "campaign/campaign.hpp"

#include "runs/input_cursor.hpp"
#include "runs/lane.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace paperproof::compare {
namespace {

/// What crushes and goes farther than this in the step ends a run [m]: what follows is mostly the same again, and in it
/// room is looked for within reach of what crushes, for seconds.
constexpr double far_crush = 3;

class JudgedRun {
 public:
  JudgedRun(const RandomRun& run, const std::string& name, const RunSettings& settings)
      : run_(run),
        scene_(with_names(run.scene, name)),
        scenery_(scene_.scenery),
        script_(script_of(scene_)),
        lane_(settings.contender, settings.scalar, scene_, scenery_, {}, "free", settings.trace_stem,
              {.steps = scene_.steps}),
        cursor_(scene_, script_) {}

  Findings go() {
    if (!lane_.running()) return ended();
    if (!run_.may_begin_inside && begins_inside()) return {};
    grounded_.resize(lane_.characters());
    for (int step = 0; step < scene_.steps && lane_.running() && !ends_ && is_within_reach(); ++step) take(step);
    lane_.finish();
    return ended();
  }

 private:
  [[nodiscard]] Findings ended() {
    if (lane_.row().verdict == Verdict::failed || lane_.row().verdict == Verdict::not_applicable)
      findings_.failed = lane_.row().reason;
    findings_.breaches = lane_.breaches();
    findings_.breaches.erase(Clause::continuity);
    return std::move(findings_);
  }

  [[nodiscard]] bool begins_inside() {
    const ExactScenery there(scenery_at(scene_, 0), lane_.header().points);
    return !there.overlapped(scene_.start.position).empty();
  }

  [[nodiscard]] bool is_within_reach() {
    for (std::size_t k = 0; k < lane_.characters(); ++k)
      if ((lane_.contender().pose(k).position - run_.centre).cwiseAbs().maxCoeff() > run_.reach) return false;
    return true;
  }

  void take(int step) {
    const StepInput input = with_up(run_, step, cursor_.at(step));
    std::vector<bool> launched(lane_.characters());
    for (const Launch& launch : run_.launches_before(step)) {
      lane_.launch(launch.velocity, launch.character);
      launched[launch.character] = true;
    }
    lane_.step(step, input);
    if (!lane_.running()) return;
    ++findings_.steps;
    for (std::size_t k = 0; k < lane_.characters(); ++k) count(k, launched[k]);
  }

  void count(std::size_t character, bool launched) {
    const TraceStep& record = lane_.record(character);
    const Moment moment{lane_.header(), record, lane_.judgement(character), grounded_[character], launched};
    ++findings_.records;
    for (std::size_t i = 0; i < happenings().size(); ++i) findings_.happened[i] += happenings()[i].is_so(moment);
    grounded_[character] = record.grounded;
    ends_ = ends_ || is_crushed_from_afar(record);
  }

  [[nodiscard]] bool is_crushed_from_afar(const TraceStep& record) const {
    return std::any_of(record.crushed.begin(), record.crushed.end(), [&](ColliderIndex collider) {
      const MoverMotion& motion = record.movers[scene_.scenery.colliders[collider].mover];
      return (motion.to - motion.from).norm() > far_crush;
    });
  }

  const RandomRun& run_;
  Scene scene_;
  Scenery scenery_;
  Script script_;
  Lane lane_;
  InputCursor cursor_;
  std::vector<bool> grounded_;  ///< By character, after the last step.
  Findings findings_;
  bool ends_ = false;
};

}  // namespace

void Findings::add(const Findings& other) {
  steps += other.steps;
  records += other.records;
  for (const auto& [clause, breach] : other.breaches) {
    Breach& mine = breaches[clause];
    if (mine.steps == 0)
      mine = breach;
    else
      mine.steps += breach.steps;
  }
  std::transform(happened.begin(), happened.end(), other.happened.begin(), happened.begin(), std::plus<>());
  if (failed.empty()) failed = other.failed;
}

Scene with_names(Scene scene, const std::string& name) {
  scene.name = name;
  for (std::size_t i = 0; i < scene.scenery.colliders.size(); ++i) scene.ids.push_back(std::to_string(i));
  return scene;
}

StepInput with_up(const RandomRun& run, int step, StepInput input) {
  if (run.ups.empty()) return input;
  input.up = run.ups[static_cast<std::size_t>(step)];
  input.gravity = run.scene.gravity.norm() * -input.up;
  return input;
}

Findings run_and_judge(const RandomRun& run, const std::string& name, const RunSettings& settings) {
  if (run.scene.steps == 0) return {};
  return JudgedRun(run, name, settings).go();
}

Findings run_family(const Family& family, int steps, const RunSettings& settings,
                    const std::function<void(std::uint64_t, const Findings&)>& each) {
  const int wanted = std::max(1, static_cast<int>(family.share * steps));
  Findings all;
  constexpr std::uint64_t tries = 200;  // runs, of which one must have a step: others begin inside something
  for (std::uint64_t seed = family.first_seed; all.steps < wanted && all.failed.empty(); ++seed) {
    if (all.steps == 0 && seed == family.first_seed + tries) all.failed = "no run has a step";
    const Findings one = run_and_judge(family.draw(seed), family.name_of_run(seed), settings);
    if (each) each(seed, one);
    all.add(one);
    ++all.runs;
    if (one.steps == 0 && one.failed.empty()) ++all.left_out;
  }
  return all;
}

std::string describe(const Breaches& breaches, const std::string& begin) {
  std::string lines;
  for (const auto& [clause, breach] : breaches)
    lines += fmt::format("{}{} on {}, first in step {}: {}\n", begin, name_of(clause), counted(breach.steps, "step"),
                         breach.first_step, breach.first);
  return lines;
}

namespace {

/// A few runs are a small sample: a family may have half of what is expected, and three fewer. With fewer records than
/// this nothing is too rare.
constexpr int enough_records = 400;
/// With so many records a family must have each expected happening once. A slow family has them at 2,000 steps, of
/// which it takes a third.
constexpr int enough_for_rare = 600;
double fewest(double expected) { return expected / 2 - 3; }
double most_by_chance(double expected) { return expected + 3 + 4 * std::sqrt(expected); }

}  // namespace

std::vector<std::string> uncovered(const Family& family, const Findings& findings) {
  std::vector<std::string> said;
  for (const Coverage& part : family.covers) {
    const std::size_t which = happening_named(part.happening);
    const int found = findings.happened[which];
    const double least = part.least * findings.records;
    const bool is_rarer = findings.records >= enough_records && found < fewest(least);
    const bool never = findings.records >= enough_for_rare && found == 0 && least > 0;
    if (is_rarer || never || found > most_by_chance(part.most * findings.records))
      said.push_back(fmt::format("{}: {:.3g} % of {} steps {}: expected {:g} % to {:g} %", family.title(),
                                 100.0 * found / findings.records, findings.records, happenings()[which].meaning,
                                 100 * part.least, 100 * part.most));
  }
  return said;
}

}  // namespace paperproof::compare
