#include "runs/run.hpp"

#include "contains.hpp"
#include "metrics/agreement.hpp"
#include "metrics/ledger.hpp"
#include "runs/continuous_error.hpp"
#include "runs/cost.hpp"
#include "runs/input_cursor.hpp"
#include "runs/lane.hpp"
#include "runs/lockstep.hpp"
#include "runs/peers.hpp"
#include "runs/row_views.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>

namespace paperproof::compare {
namespace {

constexpr std::string_view default_lockstep = "octagon_sweep";
constexpr std::string_view twin_name = "box2d";
/// A character this far outside of its map has left it [m].
constexpr double lost = 10;
/// Time between two calls of the progress callback. Small: the terminal is busy. Large: slow steps seem to hang.
constexpr std::chrono::milliseconds progress_every{100};
/// Disagreements kept per scene for the report.
constexpr std::size_t most_disagreements = 24;

class SceneRun {
 public:
  SceneRun(const Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        steps_(options.steps.value_or(scene.steps)),
        script_(options.random_input ? random_script(scene, *options.random_input, steps_) : script_of(scene, steps_)),
        scenery_(scene.scenery),
        planning_{.full = options.full_plan, .knobs = options.knobs} {
    const std::string mode = options.mode == Mode::lockstep ? "lockstep" : "free";
    const ReplayLimit replay{.steps = steps_, .most = options.max_replay_steps};
    for (const std::string& name : contenders_of(options))
      for (const ScalarKind scalar : options.scalars) {
        if (computes_in_one(name) && scalar != options.scalars.front()) continue;
        lanes_.push_back(
            std::make_unique<Lane>(name, scalar, scene, scenery_, planning_, mode, options.trace_stem, replay));
        if (options.mode != Mode::lockstep) continue;
        const std::string stem = options.trace_stem.empty() ? "" : twin_stem(options.trace_stem, name);
        twins_.push_back(
            std::make_unique<Lane>(std::string(twin_name), scalar, scene, scenery_, planning_, mode, stem, replay));
        twins_.back()->row().findings.push_back("twin of " + name);
      }
    for (const auto& lane : lanes_) lane->expect(answers(*lane));
    try {
      cursor_.emplace(scene_, script_);
    } catch (const NotApplicable& reason) {
      for (const auto& lane : lanes_) lane->give_up(reason.what());
      for (const auto& lane : twins_) lane->give_up(reason.what());
    }
    begin_agreements();
    begin_errors();
  }

  ReportScene go() {
    tell_progress(0);
    for (int step = 0; cursor_ && step < steps_; ++step) {
      const StepInput input = cursor_->at(step);
      if (options_.mode == Mode::lockstep)
        step_in_lockstep(step, input);
      else
        step_freely(step, input);
      tell_progress(step + 1);
    }
    return collect();
  }

 private:
  /// A lane beside the reference, and how far they agree.
  struct Pair {
    Lane* mine;
    Lane* reference;
    std::vector<Agreement> agreements;  ///< By character.
    int not_compared = 0;               ///< Lockstep: steps without room for Box2D's skin.
    std::vector<Ledger> ledgers{};      ///< By character; empty where none is kept.
  };

  void tell_progress(int done) {
    const auto now = std::chrono::steady_clock::now();
    if (!options_.progress || (done > 0 && now - told_ < progress_every)) return;
    told_ = now;
    options_.progress(static_cast<double>(done) / static_cast<double>(steps_));
  }

  [[nodiscard]] bool has_shape_of_scene(const Lane& lane) const {
    const std::span<const Vec2d> hull = scene_.character.shape.hull();
    const std::vector<Vec2d>& points = lane.header().points;
    const double rounding = 1e-5 * scene_.character.shape.box().upper.norm();  // of shapes in float
    return std::equal(hull.begin(), hull.end(), points.begin(), points.end(),
                      [&](const Vec2d& a, const Vec2d& b) { return (a - b).norm() <= rounding; });
  }

  /// The scene's, where it is run as it is, with its own character: a peer may say that it has another shape. What it
  /// enters and leaves a peer does not say.
  [[nodiscard]] std::vector<Answer> answers(const Lane& lane) const {
    if (!lane.running()) return {};
    const bool as_it_is =
        steps_ == scene_.steps && !options_.random_input && options_.mode == Mode::free && has_shape_of_scene(lane);
    std::vector<Answer> asked = as_it_is ? scene_.answers : std::vector<Answer>{};
    const auto is_sensed = [](const Answer& one) { return one.of == Answer::Of::enter || one.of == Answer::Of::leave; };
    if (find_peer(lane.contender_name()) != nullptr) std::erase_if(asked, is_sensed);
    return asked;
  }

  void begin_agreements() {
    const auto pair_up = [this](Lane& mine, Lane& reference) {
      if (!mine.running() || !reference.running()) return;
      pairs_.push_back(
          {&mine, &reference, std::vector(mine.characters(), Agreement(mine.header(), reference.header())), 0});
      if (options_.ledger)
        pairs_.back().ledgers.assign(
            mine.characters(), Ledger({&mine.header(), &mine.solids()}, {&reference.header(), &reference.solids()},
                                      options_.mode == Mode::lockstep));
    };
    if (options_.mode == Mode::lockstep) {
      for (std::size_t i = 0; i < lanes_.size(); ++i) pair_up(*lanes_[i], *twins_[i]);
      return;
    }
    const auto reference =
        std::ranges::find_if(lanes_, [](const auto& lane) { return lane->contender_name() == twin_name; });
    if (reference == lanes_.end()) return;
    for (const auto& lane : lanes_)
      if (lane != *reference) pair_up(*lane, **reference);
  }

  /// Lockstep has no course of its own, nor have several characters.
  void begin_errors() {
    errors_.resize(lanes_.size());
    if (!options_.continuous || options_.mode == Mode::lockstep || script_.size() != 1) return;
    courses_.emplace_back(scene_, script_.front(), steps_);
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      const bool is_peer = find_peer(lanes_[i]->contender_name()) != nullptr;
      const bool has_own = is_peer && lanes_[i]->running() && !has_shape_of_scene(*lanes_[i]);
      if (has_own) {
        Scene own = scene_;
        own.character.shape = CharacterShape(lanes_[i]->header().points);
        courses_.emplace_back(own, script_.front(), steps_);
      }
      errors_[i] = ContinuousError((has_own ? courses_.back() : courses_.front()).of(lanes_[i]->contender_name()));
    }
  }

  void respawn_if_lost(Lane& lane, int step) const {
    if (!scene_.respawn_box) return;
    for (std::size_t k = 0; k < lane.characters(); ++k) {
      const Vec2d position = lane.contender().pose(k).position;
      if (scene_.respawn_box->inflated(lost).contains({position, position})) continue;
      const Start& start = start_of(scene_, k);
      if (lane.is_free(start.position, k)) lane.respawn(start, {step, k});
    }
  }

  void step_freely(int step, const StepInput& input) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      Lane& lane = *lanes_[i];
      if (!lane.running()) continue;
      respawn_if_lost(lane, step);
      lane.step(step, input);
      if (courses_.empty() || !lane.running()) continue;
      const TraceStep& record = lane.record();
      const double end = courses_.front().end(step);
      errors_[i].add(record.path.back().position + record.remainder, end);
      if (lane.judgement().hangs)
        errors_[i].add_hanging(record.path.front().position, -record.requested.y(), courses_.front().end(step - 1),
                               end);
    }
    for (Pair& pair : pairs_)
      if (pair.mine->running() && pair.reference->running())
        for (std::size_t k = 0; k < pair.agreements.size(); ++k) compare(pair, k, pair.reference->record(k));
  }

  void step_in_lockstep(int step, const StepInput& input) {
    for (Pair& pair : pairs_) {
      if (!pair.mine->running() || !pair.reference->running()) continue;
      respawn_if_lost(*pair.mine, step);
      const TwinStart start = twin_start(*pair.mine, input);
      pair.mine->step(step, input);
      pair.reference->place(start.pose);
      pair.reference->step(step, input);
      if (!pair.mine->running() || !pair.reference->running()) continue;
      if (!start.room) {
        ++pair.not_compared;
        continue;
      }
      TraceStep unshifted = pair.reference->record();
      for (PathPoint& corner : unshifted.path) corner.position -= start.shift;
      compare(pair, 0, unshifted);
    }
  }

  /// @param reference its step, as far as the agreement of positions goes.
  static void compare(Pair& pair, std::size_t k, const TraceStep& reference) {
    pair.agreements[k].add(pair.mine->record(k), pair.mine->judgement(k), reference, pair.reference->judgement(k));
    if (!pair.ledgers.empty())
      pair.ledgers[k].add(pair.mine->record(k), pair.mine->judgement(k), pair.reference->record(k),
                          pair.reference->judgement(k),
                          is_beside_another(*pair.mine, k) || is_beside_another(*pair.reference, k));
  }

  /// Whether the boxes of two characters come within Box2D's skin of each other, where the step begins or ends.
  static bool is_beside_another(const Lane& lane, std::size_t k) {
    const Vec2d reach = Box2::around(lane.header().points).size() + Vec2d::Constant(beyond_box2d_skin);
    for (std::size_t other = 0; other < lane.characters(); ++other)
      for (const bool end : {false, true}) {
        const auto place = [end](const TraceStep& step) {
          return end ? step.path.back().position : step.path.front().position;
        };
        const Vec2d apart = (place(lane.record(k)) - place(lane.record(other))).cwiseAbs();
        if (other != k && (apart.array() <= reach.array()).all()) return true;
      }
    return false;
  }

  ReportScene collect() {
    for (const auto& lane : lanes_) lane->finish();
    for (const auto& lane : twins_) lane->finish();
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      if (was_judged(lanes_[i]->row())) errors_[i].write(lanes_[i]->row());
    for (Pair& pair : pairs_) {
      write_agreement(pair.agreements, pair.mine->row());
      for (Ledger& ledger : pair.ledgers) {
        ledger.finish();
        ledger.write(pair.mine->row());
      }
      if (options_.mode == Mode::lockstep) {  // every step is compared by itself there: none is the first
        pair.mine->row().first_difference_box2d_step.reset();
        pair.mine->row().first_difference_box2d.clear();
      }
      if (pair.not_compared > 0)
        pair.mine->row().findings.push_back(
            fmt::format("{} not compared: no room for Box2D's skin", counted(pair.not_compared, "step")));
    }
    for (const auto& lane : twins_) lane->row().respawns.reset();  // it was placed anew before every step

    if (options_.measure_cost) measure();

    ReportScene result;
    result.name = scene_.name;
    result.description = scene_.description;
    if (scene_.moves_at_random && !options_.random_input)
      result.description += fmt::format("{}a map without a script, so it moves by random:{}",
                                        result.description.empty() ? "" : "; ", *scene_.moves_at_random);
    result.dt_list = scene_.dt_list;
    for (const auto& lane : lanes_) add(*lane, result);
    for (const auto& lane : twins_) add(*lane, result);
    result.sentence = who_is_right(result.rows);
    const auto inside = std::ranges::find_if(lanes_, [](const auto& lane) { return !lane->begins_inside().empty(); });
    if (inside != lanes_.end()) result.sentence += fmt::format(" Mind that {}.", (*inside)->begins_inside());
    if (options_.mode == Mode::lockstep)
      for (const Pair& pair : pairs_) result.sentence += in_lockstep(pair);
    for (const Pair& pair : pairs_) describe_disagreements(pair, result);
    return result;
  }

  /// How often the two agree on one step from the same start, and who is right where they do not.
  static std::string in_lockstep(const Pair& pair) {
    const std::optional<double> share = pair.mine->row().contact_agreement_box2d;
    if (!share) return "";
    using Right = SideDisagreement::Right;
    const auto count = [&pair](Right right) { return pair.agreements.front().count(right); };
    const int differ = count(Right::mine) + count(Right::reference) + count(Right::both) + count(Right::neither);
    std::string text = fmt::format(
        " From the same start {} and Box2D report the same sides of contact on {:.2f} % of {}",
        pair.mine->contender_name(), 100 * *share, counted(pair.mine->row().steps - pair.not_compared, "step"));
    if (differ == 0) return text + ".";
    return text +
           fmt::format(
               "; where they differ ({}) exact arithmetic is with {} on {}, with Box2D on {}, with both on {}, with "
               "neither on {}.",
               counted(differ, "step"), pair.mine->contender_name(), count(Right::mine), count(Right::reference),
               count(Right::both), count(Right::neither));
  }

  /// Twins in lockstep are placed before every step, and not timed; a peer times itself.
  void measure() {
    std::vector<Lane*> timed;
    std::vector<TimedRun> runs;
    for (const auto& lane : lanes_) {
      if (!lane->running() || find_peer(lane->contender_name()) != nullptr) continue;
      timed.push_back(lane.get());
      runs.push_back({&lane->contender(), lane->respawns(), lane->row().exact_first_impact_step});
    }
    if (runs.empty()) return;
    const std::vector<Costs> costs = measure_costs(runs, scene_, script_, steps_);
    for (std::size_t i = 0; i < timed.size(); ++i) {
      Row& row = timed[i]->row();
      row.ns_per_step = costs[i].full.ns_per_step_min;
      row.ns_per_step_median = costs[i].full.ns_per_step_median;
      row.ns_per_step_max = costs[i].full.ns_per_step_max;
      if (costs[i].bare) row.ns_per_step_bare = costs[i].bare->ns_per_step_min;
      if (costs[i].step) row.impact_step_ns = costs[i].step->warm;
      if (costs[i].step) row.impact_step_cold_ns = costs[i].step->cold;
    }
  }

  void add(Lane& lane, ReportScene& result) {
    result.rows.push_back(lane.row());
    if (options_.max_replay_steps > 0 && lane.running()) result.runs.push_back(std::move(lane.replay()));
  }

  void describe_disagreements(const Pair& pair, ReportScene& result) const {
    const bool told = pair.mine->contender_name() == default_lockstep;
    if (!told || options_.max_replay_steps == 0) return;
    const auto run_of = [&](const Lane& lane) {
      const auto found = std::ranges::find(result.runs, lane.contender_name(),
                                           [](const ReportRun& run) { return run.header.contender; });
      return static_cast<std::size_t>(found - result.runs.begin());
    };
    for (std::size_t k = 0; k < pair.agreements.size(); ++k) {
      const std::string who = pair.agreements.size() > 1 ? fmt::format("character {}: ", k) : "";
      for (const SideDisagreement& one : pair.agreements[k].disagreements()) {
        if (result.disagreements.size() == most_disagreements) return;
        result.disagreements.push_back({one.step,
                                        {{run_of(*pair.mine), one.mine}, {run_of(*pair.reference), one.reference}},
                                        who + one.who_is_right});
      }
    }
  }

  const Scene& scene_;
  const RunOptions& options_;
  int steps_;
  Script script_;
  Scenery scenery_;
  Planning planning_;
  std::optional<InputCursor> cursor_;  ///< None where the scene cannot be run at all.
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::vector<std::unique_ptr<Lane>> twins_;
  std::vector<Pair> pairs_;
  std::deque<ContinuousCourses> courses_;       ///< Of the scene's shape, then of others; none: not asked for.
  std::vector<ContinuousError> errors_;         ///< By lane.
  std::chrono::steady_clock::time_point told_;  ///< Of the last call of the progress callback.
};

}  // namespace

std::vector<std::string> contenders_of(const RunOptions& options) {
  std::vector<std::string> chosen = options.contenders;
  const bool lockstep = options.mode == Mode::lockstep;
  if (chosen.empty() && lockstep) {
    chosen.emplace_back(default_lockstep);
    for (const Peer& peer : peers()) chosen.push_back(peer.name);
  }
  if (chosen.empty())
    for (const std::string_view name : contender_names())
      if (!is_reference(name) || options.reference) chosen.emplace_back(name);
  if (!options.contenders.empty() && options.reference && !lockstep && !contains(chosen, twin_name))
    chosen.emplace_back(twin_name);
  if (lockstep) std::erase_if(chosen, [](const std::string& name) { return is_reference(name); });
  return chosen;
}

ReportScene run_scene(const Scene& scene, const RunOptions& options) { return SceneRun(scene, options).go(); }

}  // namespace paperproof::compare
