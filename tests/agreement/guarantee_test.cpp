/// Each guarantee of octagon_sweep against the exact oracle, over random scenery of every family, speeds from 1e-3 to
/// 1e6 m per step, origins up to 1e6 m and paper down to zero thickness; also with an up that turns.
#include "agreement/recorded.hpp"
#include "agreement/reported.hpp"
#include "agreement/run_trace.hpp"
#include "oracle/exact.hpp"
#include "oracle/hanging.hpp"
#include "support/random_sceneries.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/tolerances.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <sstream>

namespace paperproof::test {
namespace {

using compare::ExactScenery;
using compare::Place;

/// Nearer than this is a contact [m], as the guarantee says; and the rounding of a position 1e6 m away.
constexpr double hit_distance = 1e-7 + 1e-9;

/// Narrower openings may hold a character whose sides are not along up [m]: see "Limits" in controller/README.md.
constexpr double opening_of_slanted_sides = 4e-7;
/// A shorter motion that begins near a steep slope is mostly that to the gap at which motions stop [m]: see "Found and
/// open" there.
constexpr double smallest_judged_motion = 2e-6;

struct Tally {
  int steps = 0;
  int with_contact = 0;
  int launched = 0;
  int stuck = 0;
  int dropped = 0;
  int falling = 0;  ///< Fell.
  int from_inside = 0;
  int passed_on_purpose = 0;  ///< One-way chains, with the button to drop down.
  // Contacts, by what they are for the up of their step.
  int walkable = 0;
  int steep = 0;
  int walls = 0;
  int ceilings = 0;
};

template <class Colliders>
bool contains(const Colliders& all, ColliderIndex one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// One random run: a scenery, a character, a start, and 40 steps with now and then a launch.
class RandomRun {
 public:
  RandomRun(Family family, std::uint64_t seed, bool up_turns = false)
      : family_(family),
        seed_(seed),
        random_(seed),
        origin_(random_.chance(0.7) ? Vec2d{0, 0} : Vec2d{far(), far()}),
        scenery_(random_scenery(family, random_, origin_)),
        controller_(scenery_, character()),
        hull_(controller_.character().shape.hull().begin(), controller_.character().shape.hull().end()),
        oracle_(scenery_.as_run(), hull_),
        reported_(scenery_.as_run(), hull_, Tolerances<double>{}.certain),
        scratch_(controller_.make_scratch()),
        up_turns_(up_turns) {
    header_.points = hull_;
    header_.scenery = scenery_.as_run();
    header_.character = controller_.character();
  }

  void go(Tally& tally) {
    state_.position = origin_ + Vec2d{random_.between(-4, 4), random_.between(-3, 5)};
    if (family_ == Family::shafts)
      state_.position = origin_ + Vec2d{random_.chance(0.5) ? 0 : random_.between(-1, 1), 3};
    if (family_ == Family::lattice) round_to_pixels(state_.position);
    const bool may_start_inside = random_.chance(0.1);
    if (!may_start_inside && !oracle_.overlapped(state_.position).empty()) return;
    const double gravity = random_.chance(0.9) ? 30 : random_.log_between(1, 1e6);
    if (up_turns_) turn_up();
    const double dt = random_.chance(0.7) ? 1.0 / 60 : random_.log_between(1e-4, 1);
    Input input;
    compare::TraceHeader traced = header_;
    traced.dt = dt;
    traced.gravity = -gravity * up_;
    traced.up = up_;
    trace_.emplace(traced, up_turns_ ? "any_up" : "static", name_of(family_) + "_" + std::to_string(seed_));
    for (int step = 0; step < 40; ++step) {
      if (random_.chance(0.1)) input.move = random_.integer(-1, 1);
      if (random_.chance(0.1)) input.jump = !input.jump;
      input.drop = random_.chance(input.drop ? 0.8 : 0.1);
      if (random_.chance(0.2)) launch(dt, tally);
      if (up_turns_ && random_.chance(0.1)) turn_up();
      take(input, -gravity * up_, dt, tally);
      const bool gone = (state_.position - origin_).cwiseAbs().maxCoeff() > 12;
      if (gone || ::testing::Test::HasFailure()) return;
    }
  }

 private:
  double far() { return random_.either_sign_log_between(1, 9.9e5); }
  static void round_to_pixels(Vec2d& p) { p = {std::round(p.x() * 32) / 32, std::round(p.y() * 32) / 32}; }

  CharacterDef character() {
    CharacterDef def;
    if (random_.chance(0.3)) def.snap = 0.5;
    if (random_.chance(0.2)) def.max_climb_degrees = random_.between(0, 89);
    return def;
  }

  /// Any up, or one along or across a side of the scenery: there walls are exactly upright and ground is exactly level,
  /// but for rounding.
  void turn_up() {
    const double angle = random_.angle();
    up_ = {std::cos(angle), std::sin(angle)};
    if (!random_.chance(0.4)) return;
    const int last = static_cast<int>(scenery_.pieces().size()) - 1;
    const auto vertices = scenery_.vertices_of(static_cast<PieceIndex>(random_.integer(0, last)));
    up_ = (vertices[1] - vertices[0]).normalized();
    if (random_.chance(0.5)) up_ = {-up_.y(), up_.x()};
  }

  void launch(double dt, Tally& tally) {
    ++tally.launched;
    launched_ = true;
    const double speed = random_.log_between(1e-3, random_.chance(0.3) ? 1e6 : 20) / dt;
    const double angle = random_.chance(0.3) ? random_.integer(0, 7) * std::numbers::pi / 4 : random_.angle();
    state_.velocity = {std::cos(angle) * speed, std::sin(angle) * speed};
    if (random_.chance(0.2)) state_.velocity.x() = 0;
  }

  void take(const Input& input, const Vec2d& gravity, double dt, Tally& tally) {
    const CharacterState<double> before = state_;
    const std::vector<ColliderIndex> start_overlap = oracle_.overlapped(before.position);
    const StepStatus status = controller_.step(state_, input, {gravity, dt, {}, nullptr, up_}, scratch_, report_);
    ++tally.steps;
    if (status == StepStatus::out_of_range) {
      EXPECT_TRUE(state_ == before) << where();
      state_.velocity = {0, 0};
      launched_ = true;
      return;
    }
    ASSERT_NE(status, StepStatus::invalid_input) << where();
    tally.stuck += status == StepStatus::stuck;
    tally.dropped += status == StepStatus::dropped;
    tally.from_inside += !start_overlap.empty();
    tally.with_contact += !report_.move.contacts.empty();
    for (const Contact<double>& contact : report_.move.contacts) classify(contact.normal.dot(up_), tally);
    tally.passed_on_purpose += static_cast<int>(report_.dropped_through.size());
    compare::TraceStep record = recorded<double>(report_, state_, {});
    record.up = up_;
    record.gravity = gravity;
    trace_->write(record, before, input, launched_);
    launched_ = false;
    check_path(start_overlap, status);
    check_what_is_said(input.drop);
    check_progress(tally);
    if (start_overlap.empty()) check_contacts(before);
  }

  void classify(double up_of_normal, Tally& tally) const {
    if (std::abs(up_of_normal) < 1e-12)
      ++tally.walls;
    else if (up_of_normal < 0)
      ++tally.ceilings;
    else
      ++(up_of_normal >= controller_.character().walkable_cosine<double>() ? tally.walkable : tally.steep);
  }

  void check_path(const std::vector<ColliderIndex>& start_overlap, StepStatus status) {
    const auto& path = report_.move.path;
    ASSERT_GE(path.size(), 2U) << where();
    ASSERT_EQ(path.back().fraction, 1) << where();
    ASSERT_EQ(path.back().position, state_.position) << where();
    for (std::size_t i = 1; i < path.size(); ++i) {
      ASSERT_GE(path[i].fraction, path[i - 1].fraction) << where();
      for (const ColliderIndex met : oracle_.met(path[i - 1].position, path[i].position)) {
        ASSERT_TRUE(contains(start_overlap, met) || passed_on_purpose(met))
            << "leg " << i << " meets collider " << met << where();
      }
    }
    for (const ColliderIndex inside : oracle_.overlapped(state_.position)) {
      ASSERT_TRUE(contains(start_overlap, inside)) << "ends inside collider " << inside << where();
      ASSERT_EQ(status, StepStatus::stuck) << "still inside without saying so" << where();
    }
  }

  [[nodiscard]] bool passed_on_purpose(ColliderIndex collider) const {
    return scenery_.collider(collider).one_way && contains(report_.dropped_through, collider);
  }

  void check_what_is_said(bool drops) {
    std::vector<Place> path;
    for (const PathPoint<double>& corner : report_.move.path) path.emplace_back(corner.position);
    for (const Contact<double>& contact : report_.move.contacts)
      ASSERT_TRUE(reported_.contact_holds(path, contact))
          << "contact with " << contact.collider << ": normal " << contact.normal.transpose() << ", gap "
          << contact.separation << where();
    ASSERT_TRUE(drops || report_.dropped_through.empty()) << where();
    ASSERT_FALSE(report_.dropped_through.overflowed()) << where();
    ASSERT_TRUE(reported_.drops_hold(path, report_.dropped_through)) << where();
  }

  /// Who could fall falls, and the iterations are enough for all but the longest launches.
  void check_progress(Tally& tally) {
    ASSERT_FALSE(report_.status == StepStatus::dropped && report_.requested.norm() < 1000) << where();
    const Vec2d made = report_.move.path.back().position - report_.move.path[0].position;
    tally.falling += made.dot(up_) < 0;
    const compare::TraceStep record = recorded<double>(report_, state_, {});
    const compare::Others alone;
    compare::detail::Reach reach = compare::detail::exact_reach;
    if (up_turns_) reach.opening = opening_of_slanted_sides;
    if (up_turns_ && report_.requested.norm() < smallest_judged_motion) return;
    const bool hangs = compare::detail::HangingJudge(header_, oracle_, record, alone, up_).hangs(made, reach);
    ASSERT_FALSE(hangs) << "hangs" << where();
  }

  void check_contacts(const CharacterState<double>& before) {
    if (report_.move.contacts.empty()) return;
    for (const Contact<double>& contact : report_.move.contacts) ASSERT_LE(contact.separation, 1e-6) << where();
    const Contact<double>& first = report_.move.contacts[0];
    // A way that passes a solid within the hit distance may be reported though it exactly misses.
    const auto exact = oracle_.time_of_impact(before.position, report_.requested, first.collider);
    if (!exact) return;
    const double exact_fraction = static_cast<double>(exact->fraction);
    const double off = std::abs(exact_fraction - first.fraction) * std::abs(report_.requested.dot(exact->normal));
    if (off <= 1e-6) return;
    // A rim of the same collider may be passed within the hit distance before another of its faces would be hit. The
    // character is stopped at the rim.
    const Vec2d there = before.position + report_.requested * first.fraction;
    const double gap = oracle_.separation(there, first.collider);
    ASSERT_TRUE(first.fraction < exact_fraction && gap > 0 && gap <= hit_distance)
        << where() << "\n  exact fraction " << exact_fraction << ", reported " << first.fraction << ", the gap is "
        << gap << " m there";
  }

  [[nodiscard]] std::string where() const {
    std::ostringstream text;
    text.precision(17);
    text << "\n  " << name_of(family_) << ", seed " << seed_ << ", status " << static_cast<int>(report_.status)
         << ", requested " << report_.requested.transpose() << ", up " << up_.transpose() << ", steered "
         << report_.steered << ", climbs " << header_.character.max_climb_degrees << ", way";
    for (const PathPoint<double>& corner : report_.move.path)
      text << " (" << corner.position.x() << ", " << corner.position.y() << " @ " << corner.fraction << ")";
    for (const Contact<double>& met : report_.move.contacts)
      text << "\n    met " << met.collider << ", normal " << met.normal.transpose() << ", gap " << met.separation
           << " @ " << met.fraction;
    for (const ColliderIndex chain : report_.dropped_through) text << ", drops through " << chain;
    return text.str();
  }

  Family family_;
  std::uint64_t seed_;
  Random random_;
  Vec2d origin_;
  Scenery<double> scenery_;
  Controller<double> controller_;
  std::vector<Vec2d> hull_;
  compare::TraceHeader header_;
  ExactScenery oracle_;
  Reported reported_;
  Scratch<double> scratch_;
  CharacterState<double> state_;
  StepReport<double> report_;
  bool up_turns_;  ///< Between the steps of the run, now and then.
  Vec2d up_{0, 1};
  std::optional<RunTrace> trace_;
  bool launched_ = false;
};

class Guarantee : public ::testing::TestWithParam<Family> {};

TEST_P(Guarantee, no_step_ends_inside_passes_a_solid_or_leaves_a_gap) {
  Tally tally;
  const auto family = static_cast<std::uint64_t>(GetParam());
  for (std::uint64_t run = 0; tally.steps < steps_per_family(); ++run) {
    RandomRun(GetParam(), 1000003 * (family + 1) + run).go(tally);
    if (HasFailure()) return;
  }
  RecordProperty("steps", tally.steps);
  std::printf(
      "%s: %d steps, %d with contact, %d launches, %d from inside, %d stuck, %d dropped, %d chains passed, %d fall\n",
      name_of(GetParam()).c_str(), tally.steps, tally.with_contact, tally.launched, tally.from_inside, tally.stuck,
      tally.dropped, tally.passed_on_purpose, tally.falling);
  if (tally.steps < few_steps) return;
  EXPECT_GE(tally.falling, tally.steps / 10) << "who never falls cannot hang";
  // The generators must really meet the solids, and also miss them.
  EXPECT_GE(tally.with_contact, tally.steps * 0.1);
  EXPECT_LE(tally.with_contact, tally.steps * 0.9);
  const bool has_ledges = GetParam() == Family::one_way || GetParam() == Family::one_way_solids;
  EXPECT_EQ(tally.passed_on_purpose > 0, has_ledges) << "only there are ledges to drop through";
  BrokenByRuns::all().expect_only_what_is_known(name_of(GetParam()));
}

class AnyUp : public ::testing::TestWithParam<Family> {};

TEST_P(AnyUp, no_step_ends_inside_passes_a_solid_or_leaves_a_gap) {
  Tally tally;
  const auto family = static_cast<std::uint64_t>(GetParam());
  for (std::uint64_t run = 0; tally.steps < steps_per_family(); ++run) {
    RandomRun(GetParam(), 2000003 * (family + 1) + run, true).go(tally);
    if (HasFailure()) return;
  }
  RecordProperty("steps", tally.steps);
  std::printf("%s: %d steps, contacts with %d walkable, %d steep, %d walls, %d ceilings, %d dropped, %d stuck\n",
              name_of(GetParam()).c_str(), tally.steps, tally.walkable, tally.steep, tally.walls, tally.ceilings,
              tally.dropped, tally.stuck);
  if (tally.steps < few_steps) return;
  EXPECT_GE(tally.falling, tally.steps / 10) << "who never falls cannot hang";
  EXPECT_GE(tally.with_contact, tally.steps / 15);
  EXPECT_LE(tally.with_contact, tally.steps * 0.9);
  EXPECT_GE(tally.walkable, tally.steps / 100);
  EXPECT_GE(tally.steep, tally.steps / 100);
  EXPECT_GE(tally.walls, tally.steps / 2500);
  EXPECT_GE(tally.ceilings, tally.steps / 100);
  BrokenByRuns::all().expect_only_what_is_known(name_of(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, AnyUp, ::testing::ValuesIn(all_families),
                         [](const ::testing::TestParamInfo<Family>& family) { return name_of(family.param); });

INSTANTIATE_TEST_SUITE_P(EveryFamily, Guarantee, ::testing::ValuesIn(all_families),
                         [](const ::testing::TestParamInfo<Family>& family) { return name_of(family.param); });

}  // namespace
}  // namespace paperproof::test
