/// Characters that were apart stay apart, from each other and from every solid: judged exactly, over random crowds in
/// tight rooms.
#include "agreement/recorded.hpp"
#include "agreement/run_trace.hpp"
#include "oracle/exact.hpp"
#include "oracle/pair.hpp"
#include "support/random.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/crowd.hpp>

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <vector>

namespace paperproof::test {
namespace {

using compare::ExactPair;
using compare::ExactScenery;
using compare::TraceStep;

ColliderDef polygon(std::vector<Vec2d> points) { return {.points = std::move(points)}; }
ColliderDef box(double left, double bottom, double right, double top) {
  return polygon({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

/// A closed room, in sizes of the character, with a few things in it.
SceneryDef tight_room(Random& random, const Vec2d& extent, const Vec2d& room) {
  SceneryDef def;
  def.colliders = {box(-1, -1, room.x() + 1, 0), box(-1, room.y(), room.x() + 1, room.y() + 1), box(-1, 0, 0, room.y()),
                   box(room.x(), 0, room.x() + 1, room.y())};
  const int things = random.integer(0, 4);
  for (int i = 0; i < things; ++i) {
    const Vec2d at{random.between(0, room.x()), random.between(0, room.y())};
    const double w = random.between(0.1, 1.5) * extent.x();
    const double h = random.chance(0.4) ? random.log_between(1e-4, 0.1) : random.between(0.1, 0.6) * extent.y();
    if (random.chance(0.4))
      def.colliders.push_back(polygon({at, at + Vec2d{w, 0}, at + Vec2d{random.chance(0.5) ? w : 0, h}}));
    else if (random.chance(0.3))
      def.colliders.push_back(
          {.shape = ColliderDef::Shape::chain, .points = {at, at + Vec2d{w, random.between(-h, h)}}});
    else
      def.colliders.push_back(box(at.x(), at.y(), at.x() + w, at.y() + h));
  }
  return def;
}

struct Tally {
  int steps = 0;
  int launches = 0;
  std::size_t with_impact = 0;
  std::size_t impacts = 0;
  std::size_t stayed = 0;
  std::size_t stayed_touching = 0;  ///< In runs where neighbours may start without a gap.
  std::size_t dropped = 0;
  std::size_t stuck = 0;
  std::size_t moves = 0;
  std::size_t grounded = 0;
};

class RandomCrowd {
 public:
  explicit RandomCrowd(std::uint64_t seed)
      : seed_(seed),
        random_(seed),
        extent_(character_.shape.box().upper - character_.shape.box().lower),
        wanted_(random_.integer(2, 16)),
        room_{extent_.x() * (1.5 + wanted_ * random_.between(0.3, 0.8)), extent_.y() * random_.between(1.3, 4)},
        scenery_(tight_room(random_, extent_, room_)),
        crowd_(scenery_, with_snap(character_)),
        oracle_(scenery_.as_run(), {character_.shape.hull().begin(), character_.shape.hull().end()}),
        judge_(character_.shape.hull()),
        report_(16) {
    header_.contender = "octagon_sweep";
    header_.scalar = "double";
    header_.points = {character_.shape.hull().begin(), character_.shape.hull().end()};
    header_.scenery = scenery_.as_run();
    header_.character = crowd_.character();
  }

  void go(Tally& tally) {
    place();
    if (states_.size() < 2) return;
    header_.characters = states_.size();
    scratch_ = crowd_.make_scratch(states_.size());
    inputs_.resize(states_.size());
    const Vec2d gravity{0, random_.chance(0.85) ? -30.0 : random_.between(-5, 5)};
    const double dt = random_.chance(0.8) ? 1.0 / 60 : random_.log_between(1e-3, 0.2);
    header_.dt = dt;
    header_.gravity = gravity;
    RunTrace trace(header_, "crowd", std::to_string(seed_));
    trace_ = &trace;
    for (int step = 0; step < 60; ++step) {
      launched_.assign(states_.size(), false);
      for (std::size_t i = 0; i < states_.size(); ++i) {
        if (random_.chance(0.1)) inputs_[i].move = random_.integer(-1, 1);
        if (random_.chance(0.1)) inputs_[i].jump = !inputs_[i].jump;
        if (random_.chance(0.03)) launch(i, dt, tally);
      }
      take(gravity, dt, tally);
      if (::testing::Test::HasFatalFailure()) break;
    }
  }

 private:
  CharacterDef with_snap(CharacterDef def) {
    if (random_.chance(0.3)) def.snap = 0.5;
    if (random_.chance(0.2)) def.max_climb_degrees = random_.between(0, 89);
    return def;
  }

  /// Apart from each other and from the room; in some runs on whole pixels, so that neighbours touch exactly.
  void place() {
    const bool whole_pixels = random_.chance(0.3);
    may_touch_ = whole_pixels;
    for (int tries = 0; tries < 200 && static_cast<int>(states_.size()) < wanted_; ++tries) {
      Vec2d at{random_.between(0, room_.x()), random_.between(0, room_.y())};
      if (whole_pixels) at = Vec2d{std::round(at.x() * 32) / 32, std::round(at.y() * 32) / 32};
      if (whole_pixels && !states_.empty() && random_.chance(0.5))
        at = states_.back().position + Vec2d{random_.chance(0.5) ? extent_.x() : -extent_.x(), 0};
      const bool free = std::none_of(states_.begin(), states_.end(), [&](const CharacterState<double>& other) {
        return judge_.overlap(at, other.position);
      });
      if (!free || !oracle_.overlapped(at).empty()) continue;
      states_.emplace_back().position = at;
    }
  }

  void launch(std::size_t i, double dt, Tally& tally) {
    ++tally.launches;
    launched_[i] = true;
    const double speed = random_.log_between(1e-3, random_.chance(0.3) ? 1e3 : 5) / dt;
    const double angle = random_.chance(0.3) ? random_.integer(0, 7) * std::numbers::pi / 4 : random_.angle();
    states_[i].velocity = {std::cos(angle) * speed, std::sin(angle) * speed};
  }

  void take(const Vec2d& gravity, double dt, Tally& tally) {
    before_ = states_;
    ASSERT_EQ(crowd_.step(states_, inputs_, {gravity, dt}, scratch_, report_), StepStatus::moved) << where();
    ++tally.steps;
    tally.with_impact += report_.impacts > 0;
    tally.impacts += report_.impacts;
    const std::vector<TraceStep> records = recorded_steps();
    trace_->write(records, before_, inputs_, launched_);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const CrowdMember<double>& member = report_.members[i];
      ++tally.moves;
      tally.grounded += states_[i].grounded;
      (may_touch_ ? tally.stayed_touching : tally.stayed) += member.stayed;
      tally.dropped += member.step.status == StepStatus::dropped;
      tally.stuck += member.step.status == StepStatus::stuck;
      ASSERT_EQ(records[i].path.back().position, states_[i].position) << i << where();
      ASSERT_TRUE(states_[i].velocity.allFinite()) << where();
    }
  }

  std::vector<TraceStep> recorded_steps() const {
    std::vector<TraceStep> records;
    for (std::size_t i = 0; i < states_.size(); ++i)
      records.push_back(recorded(report_.members[i], states_[i], {}, static_cast<CharacterIndex>(i)));
    return records;
  }

  [[nodiscard]] std::string where() const {
    std::ostringstream text;
    text.precision(17);
    text << "\n  seed " << seed_ << ", " << states_.size() << " characters";
    for (std::size_t i = 0; i < states_.size(); ++i) {
      text << "\n  " << i << (report_.members[i].stayed ? " stayed" : "");
      for (const PathPoint<double>& corner : report_.members[i].step.move.path)
        text << " (" << corner.position.x() << ", " << corner.position.y() << " @ " << corner.fraction << ")";
    }
    return text.str();
  }

  std::uint64_t seed_;
  Random random_;
  CharacterDef character_;
  Vec2d extent_;
  int wanted_;
  bool may_touch_ = false;
  Vec2d room_;
  Scenery<double> scenery_;
  Crowd<double> crowd_;
  ExactScenery oracle_;
  ExactPair judge_;
  CrowdReport<double> report_;
  CrowdScratch scratch_;
  std::vector<CharacterState<double>> states_;
  std::vector<CharacterState<double>> before_;
  std::vector<Input> inputs_;
  compare::TraceHeader header_;
  RunTrace* trace_ = nullptr;   ///< Of the run that goes.
  std::vector<bool> launched_;  ///< Before the present step.
};

/// Runs that are short, and in which one character turns another aside.
TEST(CrowdGuarantee, who_is_turned_aside_by_another_is_not_accused_of_what_it_would_have_met_or_fallen) {
  using compare::Clause;
  const std::map<Clause, std::vector<std::uint64_t>> honest{
      // It met another before, or another leaves nothing of its motion that leads there.
      {Clause::contact_missed, {17, 41, 48, 88, 92}},
      // It went on from there another way; or stood still, held by another; or came down at once as the step ended; or
      // went more slowly, as others left it.
      {Clause::time_of_impact, {1, 42, 54, 75, 78, 81, 624, 875, 916}},
      // Two others held it between them for a part of the step.
      {Clause::hanging, {61, 62, 66, 91}}};
  for (const auto& [clause, seeds] : honest)
    for (const std::uint64_t seed : seeds) {
      Tally tally;
      const int before = BrokenByRuns::all().steps("crowd", clause);
      RandomCrowd(seed).go(tally);
      EXPECT_EQ(BrokenByRuns::all().steps("crowd", clause), before) << name_of(clause) << ", seed " << seed;
    }
  BrokenByRuns::all().expect_only_what_is_known();
}

TEST(CrowdGuarantee, those_who_were_apart_never_overlap_or_pass_through_each_other_or_a_solid) {
  Tally tally;
  const int wanted = steps_wanted("PAPERPROOF_CROWD_STEPS", sanitized ? 2000 : 20000);
  const auto first = static_cast<std::uint64_t>(steps_wanted("PAPERPROOF_CROWD_FIRST_RUN", 1));
  for (std::uint64_t seed = first; tally.steps < wanted && !HasFatalFailure(); ++seed) RandomCrowd(seed).go(tally);
  BrokenByRuns::all().expect_only_what_is_known();
  std::printf(
      "%d steps, %zu moves, %zu steps with impacts, %zu impacts, %d launches; %zu kept back, %zu "
      "more from no gap, %zu dropped, %zu stuck, %zu grounded\n",
      tally.steps, tally.moves, tally.with_impact, tally.impacts, tally.launches, tally.stayed, tally.stayed_touching,
      tally.dropped, tally.stuck, tally.grounded);
  const double share = static_cast<double>(tally.with_impact) / tally.steps;
  EXPECT_GE(share, 0.3);
  EXPECT_LE(share, 0.95);
  EXPECT_EQ(tally.stuck, 0U) << "who is inside of nothing is not stuck";
  EXPECT_GE(tally.grounded, tally.moves / 20);
  // The last resort is one.
  EXPECT_LE(static_cast<double>(tally.stayed), 1e-4 * static_cast<double>(tally.moves));
}

}  // namespace
}  // namespace paperproof::test
