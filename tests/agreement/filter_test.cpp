/// Filters: a step is as if the colliders that are not there were not in the scenery.
#include "agreement/random_movers.hpp"
#include "agreement/recorded.hpp"
#include "agreement/run_trace.hpp"
#include "runs/mover_record.hpp"
#include "support/random_sceneries.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <optional>

namespace paperproof::test {
namespace {

constexpr double dt = 1.0 / 60;
/// The filter stays as it is for so many steps.
constexpr int steps_of_a_filter = 20;

/// Random scenery with movers. Each collider is of one of three categories.
class FilteredRun {
 public:
  FilteredRun(Family family, std::uint64_t seed)
      : run_(name_of(family) + "_" + std::to_string(seed)),
        random_(seed),
        def_(filtered_scenery(family)),
        wanderers_(movers_),
        motions_(movers_) {
    state_.position = {random_.between(-5, 5), random_.between(-5, 5)};
    steer();
  }

  /// Filters by categories. A twin steps in a scenery that holds only the colliders that pass the filter.
  /// @return how many steps had other bits than the twin's.
  int go_beside_twin() {
    filter_.mask = static_cast<std::uint32_t>(random_.integer(0, 7)) | frame;
    filter_.is_there = nullptr;
    const Scenery<double> few(what_is_there());
    const Controller<double> twin(few, CharacterDef{});
    Scratch<double> twin_scratch = twin.make_scratch();
    StepReport<double> twin_report;
    forget_colliders();
    CharacterState<double> twin_state = state_;
    int differences = 0;
    for (int step = 0; step < steps_of_a_filter; ++step) {
      go_on();
      if (random_.chance(0.3)) disturb();
      controller_.step(state_, input_, {{0, -30}, dt, motions_, &filter_}, scratch_, report_);
      const std::span<const MoverMotion<double>> of_few(motions_.data(), few.mover_count());
      twin.step(twin_state, input_, {{0, -30}, dt, of_few}, twin_scratch, twin_report);
      contacts += static_cast<int>(report_.move.contacts.size());
      differences += !same(state_, twin_state) || report_.move.contacts.size() != twin_report.move.contacts.size() ||
                     report_.status != twin_report.status;
      if (differences > 0) break;
    }
    return differences;
  }

  /// By a predicate, judged exactly. @return how many contacts were with what is not there.
  int go_judged() {
    there_.assign(def_.colliders.size(), true);
    for (std::size_t i = most_movers; i < there_.size(); ++i) there_[i] = random_.chance(0.6);
    filter_ = {};
    filter_.is_there = [](ColliderIndex collider, const void* user) -> bool {
      return static_cast<const FilteredRun*>(user)->there_[collider] != 0;
    };
    filter_.user = this;
    compare::TraceHeader header;
    header.dt = dt;
    header.gravity = {0, -30};
    header.character = controller_.character();
    const auto hull = controller_.character().shape.hull();
    header.points.assign(hull.begin(), hull.end());
    header.scenery = what_is_there();
    RunTrace trace(header, "filtered", run_ + "_" + std::to_string(filters_++));
    CharacterState<double> start;
    start.position = state_.position;
    start.velocity = state_.velocity;
    state_ = start;
    compare::MoverRecord<double> movers(motions_.size(), scenery_);
    int broken = 0;
    for (int step = 0; step < steps_of_a_filter; ++step) {
      go_on();
      movers.take(motions_, dt);
      const CharacterState<double> before = state_;
      controller_.step(state_, input_, {{0, -30}, dt, motions_, &filter_}, scratch_, report_);
      contacts += static_cast<int>(report_.move.contacts.size());
      for (const Contact<double>& contact : report_.move.contacts) broken += there_[contact.collider] == 0;
      compare::TraceStep record = recorded<double>(report_, state_, motions_);
      record.requested += movers.carried_by(before.ride, input_.drop);
      for (Contact<double>& contact : record.contacts) contact.collider = index_among_those_there(contact.collider);
      for (ColliderIndex& collider : record.crushed) collider = index_among_those_there(collider);
      for (ColliderIndex& collider : record.dropped_through) collider = index_among_those_there(collider);
      if (record.ride) record.ride->collider = index_among_those_there(record.ride->collider);
      trace.write(record, before, input_, false);
    }
    return broken;
  }

  /// Before the next filter: mostly another way.
  void turn() { steer(); }

  int contacts = 0;
  int asked = 0;  ///< Questions of others that found something.

 private:
  /// What is of this category is always there.
  static constexpr std::uint32_t frame = 8;
  static constexpr int most_movers = 4;

  SceneryDef filtered_scenery(Family family) {
    SceneryDef def;
    // They are far away, so that all sceneries are equally large, and enough, so that no mover has too high a number.
    for (const double x : {-40.0, -30.0, 30.0, 40.0}) {
      def.colliders.push_back({.points = {{x, -40}, {x + 1, -40}, {x + 1, 40}, {x, 40}}});
      def.colliders.back().filter.category = frame;
    }
    const SceneryDef random = random_scenery(family, random_, Vec2d::Zero());
    def.colliders.insert(def.colliders.end(), random.colliders.begin(), random.colliders.end());
    movers_ = static_cast<MoverIndex>(random_.integer(0, most_movers));
    for (MoverIndex mover = 0; mover < movers_; ++mover) add_mover(def.colliders, mover, random_, Vec2d::Zero());
    for (std::size_t i = most_movers; i < def.colliders.size(); ++i)
      def.colliders[i].filter.category = std::uint32_t{1} << random_.integer(0, 2);
    return def;
  }

  bool is_there(ColliderIndex collider) const { return filter_(scenery_, collider); }
  SceneryDef what_is_there() const {
    SceneryDef def;
    for (ColliderIndex i = 0; i < def_.colliders.size(); ++i)
      if (is_there(i)) def.colliders.push_back(def_.colliders[i]);
    return def;
  }
  ColliderIndex index_among_those_there(ColliderIndex collider) const {
    ColliderIndex index = 0;
    for (ColliderIndex i = 0; i < collider; ++i) index += is_there(i);
    return index;
  }
  /// Another character uses the same scratch, with a predicate of its own or without a filter; or something is asked.
  void disturb() {
    ColliderFilter ghost;
    ghost.mask = static_cast<std::uint32_t>(random_.integer(0, 15));
    if (random_.chance(0.5))
      ghost.is_there = [](ColliderIndex collider, const void* /*user*/) { return collider % 2 == 0; };
    const StepContext<double> context{{0, -30}, dt, motions_, random_.chance(0.7) ? &ghost : nullptr};
    CharacterState<double> other;
    other.position = state_.position;
    StepReport<double> report;
    if (random_.chance(0.5)) {
      controller_.step(other, {}, context, scratch_, report);
    } else {
      asked += controller_.overlaps(other.position, context, scratch_).value() > 0;
      asked += controller_.cast(other.position, {1, -1}, context, scratch_).has_value();
    }
  }
  /// Indices are others in the twin.
  void forget_colliders() {
    state_.ride = {};
    state_.crushed = state_.has_last_free = false;
    state_.crushers.clear();
  }
  void steer() {
    input_.move = random_.integer(-1, 1);
    input_.jump = random_.chance(0.3);
    if (random_.chance(0.2)) {
      const double speed = random_.log_between(1e-3, 20) / dt;
      const double angle = random_.angle();
      state_.velocity = {speed * std::cos(angle), speed * std::sin(angle)};
    }
    if (state_.position.cwiseAbs().maxCoeff() > 12) state_.position = {random_.between(-5, 5), random_.between(-5, 5)};
  }
  void go_on() {
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      motions_[k].from = motions_[k].to;
      motions_[k].to = next_offset(wanderers_[k], motions_[k].to, random_);
    }
  }
  static bool same(const CharacterState<double>& a, const CharacterState<double>& b) {
    return a.position == b.position && a.velocity == b.velocity && a.grounded == b.grounded && a.crushed == b.crushed &&
           a.has_last_free == b.has_last_free;
  }

  std::string run_;
  int filters_ = 0;  ///< So many were tried.
  Random random_;
  MoverIndex movers_ = 0;
  SceneryDef def_;
  Scenery<double> scenery_{def_};
  Controller<double> controller_{scenery_, CharacterDef{}};
  Scratch<double> scratch_ = controller_.make_scratch();
  StepReport<double> report_;
  CharacterState<double> state_;
  Input input_;
  ColliderFilter filter_;
  std::vector<char> there_;
  std::vector<Wanderer> wanderers_;
  std::vector<MoverMotion<double>> motions_;
};

class Filtered : public ::testing::TestWithParam<Family> {};

/// What the steps of all runs of a test met.
struct Coverage {
  int steps = 0;
  int contacts = 0;
  int asked = 0;
};

/// Makes runs until there are enough steps. `go` is a call of a run that returns its number of faults.
Coverage run_all(Family family, int (FilteredRun::*go)()) {
  const int wanted = steps_wanted("PAPERPROOF_FILTER_STEPS", 2000);
  Coverage all;
  for (std::uint64_t seed = 1; all.steps < wanted; ++seed) {
    FilteredRun run(family, seed);
    for (int turn = 0; turn < 5; ++turn, run.turn(), all.steps += steps_of_a_filter)
      EXPECT_EQ((run.*go)(), 0) << "seed " << seed << ", turn " << turn;
    all.contacts += run.contacts;
    all.asked += run.asked;
  }
  EXPECT_GE(all.contacts, all.steps / 20);
  return all;
}

TEST_P(Filtered, steps_have_the_bits_of_a_scenery_without_the_colliders_that_are_left_out) {
  const Coverage all = run_all(GetParam(), &FilteredRun::go_beside_twin);
  EXPECT_GE(all.asked, all.steps / 100);
}

TEST_P(Filtered, steps_by_a_predicate_hold_the_guarantee) {
  run_all(GetParam(), &FilteredRun::go_judged);
  BrokenByRuns::all().expect_only_what_is_known(name_of(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, Filtered, ::testing::ValuesIn(all_families),
                         [](const ::testing::TestParamInfo<Family>& family) { return name_of(family.param); });

}  // namespace
}  // namespace paperproof::test
