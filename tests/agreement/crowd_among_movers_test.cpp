/// Several characters among lifts, cabins, presses and papers: judged exactly, over random rooms.
#include "agreement/recorded.hpp"
#include "agreement/run_trace.hpp"
#include "oracle/exact.hpp"
#include "oracle/pair.hpp"
#include "runs/mover_record.hpp"
#include "support/random.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/crowd.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace paperproof::test {
namespace {

using compare::ExactPair;
using compare::TraceHeader;
using compare::TraceStep;

struct Tally {
  int steps = 0;
  int moves = 0;
  int with_impact = 0;
  int riding = 0;
  int crushed = 0;
  int stuck = 0;
  int dropped = 0;
  int stayed = 0;   ///< Kept back where the step began, as no order of impacts was safe.
  int unsound = 0;  ///< Were not finite, or did not end where they said.
};

std::vector<Vec2d> box(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

class RandomCrowd {
 public:
  explicit RandomCrowd(std::uint64_t seed)
      : seed_(seed),
        random_(seed),
        dt_(random_.chance(0.8) ? 1.0 / 60 : random_.log_between(1e-3, 0.1)),
        origin_(random_.chance(0.9) ? Vec2d{0, 0} : Vec2d{far(), far()}),
        extent_(character_.shape.box().upper - character_.shape.box().lower),
        wanted_(random_.integer(2, 10)),
        room_{extent_.x() * (3 + wanted_ * random_.between(0.5, 1.2)), extent_.y() * random_.between(1.5, 5)},
        scenery_(room_with_movers()),
        crowd_(scenery_, rules()),
        report_(16),
        motions_(scenery_.mover_count()),
        velocities_(scenery_.mover_count(), Vec2d::Zero()),
        until_turn_(scenery_.mover_count(), 0),
        record_(scenery_.mover_count(), scenery_) {
    header_.contender = "octagon_sweep";
    header_.scalar = "double";
    header_.points = {character_.shape.hull().begin(), character_.shape.hull().end()};
    header_.scenery = scenery_.as_run();
    header_.dt = dt_;
    header_.character = crowd_.character();
    header_.gravity = {0, -30};
  }

  void go(Tally& tally) {
    place();
    if (states_.size() < 2) return;
    header_.characters = states_.size();
    scratch_ = crowd_.make_scratch(states_.size());
    inputs_.resize(states_.size());
    RunTrace trace(header_, "crowd_movers", std::to_string(seed_));
    trace_ = &trace;
    for (int step = 0; step < 60; ++step) {
      launched_.assign(states_.size(), false);
      for (std::size_t i = 0; i < states_.size(); ++i) {
        if (random_.chance(0.1)) inputs_[i].move = random_.integer(-1, 1);
        if (random_.chance(0.1)) inputs_[i].jump = !inputs_[i].jump;
        if (random_.chance(0.01)) launch(i);
      }
      move_bodies();
      take(tally);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }

 private:
  double far() { return random_.either_sign_log_between(1, 9.9e5); }

  /// A closed room with one to four things that move in it.
  SceneryDef room_with_movers() {
    SceneryDef def;
    const auto add = [&](std::vector<Vec2d> points, MoverIndex mover = no_mover, const Vec2d& at = Vec2d::Zero()) {
      for (Vec2d& point : points) point += origin_ + at;
      def.colliders.push_back({.points = std::move(points), .mover = mover});
    };
    const double w = room_.x();
    const double h = room_.y();
    add(box(-1, -1, w + 1, 0));
    add(box(-1, h, w + 1, h + 1));
    add(box(-1, 0, 0, h));
    add(box(w, 0, w + 1, h));
    const int movers = random_.integer(1, 4);
    for (MoverIndex mover = 0; mover < static_cast<MoverIndex>(movers); ++mover) {
      const Vec2d at{random_.between(0, w), random_.between(0, h)};
      const double width = random_.between(0.3, 5) * extent_.x();
      switch (random_.integer(0, 5)) {
        case 0:  // a lift
        case 1:
          add(box(0, 0, width, 0.2), mover, at);
          break;
        case 2: {  // a cabin: one that walks goes with it all the same
          add(box(0, 0, width, 0.2), mover, at);
          add(box(-0.1, 0, 0, 1), mover, at);
          add(box(width, 0, width + 0.1, 1), mover, at);
          break;
        }
        case 3: {  // a press
          const Vec2d size{random_.between(0.2, 1), random_.between(0.5, 2)};
          add(box(0, 0, size.x(), size.y()), mover, at);
          break;
        }
        case 4: {  // a paper
          const double thin = random_.log_between(1e-4, 0.05);
          add(random_.chance(0.5) ? box(0, 0, thin, 1.5) : box(0, 0, width, thin), mover, at);
          break;
        }
        default:
          def.colliders.push_back({.shape = ColliderDef::Shape::chain,
                                   .points = {origin_ + at, origin_ + at + Vec2d{width, random_.between(-0.2, 0.2)}},
                                   .one_way = Vec2d{0, 1},
                                   .mover = mover});
      }
      if (random_.chance(0.1)) def.colliders.back().surface_speed = random_.between(-4, 4);
    }
    return def;
  }

  CharacterDef rules() {
    if (random_.chance(0.3)) character_.snap = 0.5;
    if (random_.chance(0.2)) character_.max_climb_degrees = random_.between(0, 89);
    return character_;
  }

  /// Apart from each other, and from what stands still or moves; in some runs on whole pixels, so that neighbours
  /// touch.
  void place() {
    const compare::ExactScenery oracle(scenery_.as_run(), header_.points);
    const bool whole_pixels = random_.chance(0.2);
    for (int tries = 0; tries < 200 && static_cast<int>(states_.size()) < wanted_; ++tries) {
      Vec2d at = origin_ + Vec2d{random_.between(0, room_.x()), random_.between(0, room_.y())};
      if (whole_pixels) at = Vec2d{std::round(at.x() * 32) / 32, std::round(at.y() * 32) / 32};
      if (whole_pixels && !states_.empty() && random_.chance(0.5))
        at = states_.back().position + Vec2d{random_.chance(0.5) ? extent_.x() : -extent_.x(), 0};
      const bool free = std::none_of(states_.begin(), states_.end(), [&](const CharacterState<double>& other) {
        return pair_.overlap(at, other.position);
      });
      if (free && oracle.overlapped(at).empty()) states_.emplace_back().position = at;
    }
  }

  void launch(std::size_t i) {
    const double speed = random_.log_between(1e-3, random_.chance(0.2) ? 1e3 : 5) / dt_;
    const double angle = random_.chance(0.3) ? random_.integer(0, 7) * std::numbers::pi / 4 : random_.angle();
    launched_[i] = true;
    states_[i].velocity = {std::cos(angle) * speed, std::sin(angle) * speed};
  }

  void move_bodies() {
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      Vec2d& velocity = velocities_[k];
      if (until_turn_[k]-- <= 0) {
        until_turn_[k] = random_.integer(5, 40);
        const double speed = random_.log_between(1e-3, random_.chance(0.1) ? 3 : 0.1);
        const double angle = random_.chance(0.7) ? random_.integer(0, 3) * std::numbers::pi / 2 : random_.angle();
        velocity = Vec2d{std::cos(angle), std::sin(angle)} * speed;
        if (random_.chance(0.15)) velocity.setZero();
      }
      motions_[k].from = motions_[k].to;
      for (const Eigen::Index axis : {0, 1})
        if (std::abs(motions_[k].to[axis]) > 0.5 * room_[axis] && motions_[k].to[axis] * velocity[axis] > 0)
          velocity[axis] = -velocity[axis];
      motions_[k].to += velocity;
    }
    record_.take(motions_, dt_);
  }

  void take(Tally& tally) {
    before_ = states_;
    rides_.clear();
    for (const CharacterState<double>& state : states_) rides_.push_back(state.ride);
    const StepStatus status = crowd_.step(states_, inputs_, {{0, -30}, dt_, motions_}, scratch_, report_);
    ASSERT_EQ(status, StepStatus::moved) << where();
    ++tally.steps;
    tally.with_impact += report_.impacts > 0;
    std::vector<TraceStep> records;
    for (std::size_t i = 0; i < states_.size(); ++i) records.push_back(recorded_step(i));
    trace_->write(records, before_, inputs_, launched_);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const CrowdMember<double>& member = report_.members[i];
      ++tally.moves;
      tally.riding += states_[i].ride.ground != Ride<double>::none;
      tally.crushed += !member.step.move.crushed.empty();
      tally.stuck += member.step.status == StepStatus::stuck;
      tally.dropped += member.step.status == StepStatus::dropped;
      tally.stayed += member.stayed;
      const std::vector<PathPoint<double>>& path = records[i].path;
      const bool whole = path.size() > 1 && path.front().fraction == 0 && path.back().fraction == 1 &&
                         path.back().position == states_[i].position;
      tally.unsound += !(whole && states_[i].position.allFinite() && states_[i].velocity.allFinite());
    }
  }

  TraceStep recorded_step(std::size_t i) const {
    TraceStep record = recorded(report_.members[i], states_[i], motions_, static_cast<CharacterIndex>(i));
    record.requested += record_.carried_by(rides_[i], inputs_[i].drop);
    return record;
  }

  [[nodiscard]] std::string where() const {
    std::ostringstream text;
    text.precision(17);
    text << "\n  seed " << seed_ << ", " << states_.size() << " characters";
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const CrowdMember<double>& member = report_.members[i];
      text << "\n  " << i << (member.stayed ? " stayed" : "") << " status " << static_cast<int>(member.step.status);
      for (const PathPoint<double>& corner : member.step.move.path)
        text << " (" << corner.position.x() << ", " << corner.position.y() << " @ " << corner.fraction << ")";
      for (const ColliderIndex collider : member.step.move.crushed) text << " crushed by " << collider;
      for (const CrowdContact<double>& met : member.met) text << " met " << met.other << " @ " << met.fraction;
    }
    for (std::size_t c = 4; c < scenery_.collider_count(); ++c) {
      const ColliderDef def = scenery_.as_run(static_cast<ColliderIndex>(c));
      const MoverMotion<double>& motion = motions_[def.mover];
      text << "\n  collider " << c << " by " << (motion.to - motion.from).transpose() << ", now";
      for (const Vec2d& point : def.points) text << " (" << (point + motion.to).transpose() << ")";
    }
    return text.str();
  }

  std::uint64_t seed_;
  Random random_;
  double dt_;
  Vec2d origin_;  ///< Of the room.
  CharacterDef character_;
  Vec2d extent_;
  int wanted_;
  Vec2d room_;
  Scenery<double> scenery_;
  Crowd<double> crowd_;
  TraceHeader header_;
  ExactPair pair_{character_.shape.hull()};
  CrowdReport<double> report_;
  CrowdScratch scratch_;
  std::vector<CharacterState<double>> states_;
  std::vector<Input> inputs_;
  std::vector<MoverMotion<double>> motions_;
  std::vector<Vec2d> velocities_;
  std::vector<int> until_turn_;
  compare::MoverRecord<double> record_;
  std::vector<CharacterState<double>> before_;  ///< As the step began,
  std::vector<Ride<double>> rides_;             ///< the same.
  RunTrace* trace_ = nullptr;                   ///< Of the run that goes.
  std::vector<bool> launched_;                  ///< Before the present step.
};

TEST(CrowdAmongMovers, nobody_gets_into_or_through_another_or_a_solid_unless_it_is_crushed) {
  Tally tally;
  const int wanted = steps_wanted("PAPERPROOF_CROWD_STEPS", 2400);
  const auto first = static_cast<std::uint64_t>(steps_wanted("PAPERPROOF_CROWD_FIRST_RUN", 1));
  for (std::uint64_t seed = first; tally.steps < wanted && !HasFatalFailure(); ++seed) RandomCrowd(seed).go(tally);
  BrokenByRuns::all().expect_only_what_is_known();
  std::printf(
      "%d steps, %d moves, %d steps with impacts, %d riding, %d crushed, %d stuck, %d dropped, %d kept back, %d "
      "unsound\n",
      tally.steps, tally.moves, tally.with_impact, tally.riding, tally.crushed, tally.stuck, tally.dropped,
      tally.stayed, tally.unsound);
  EXPECT_EQ(tally.unsound, 0);
  EXPECT_LE(tally.dropped, 2e-4 * tally.moves);
  // The last resort is one.
  EXPECT_LE(tally.stayed, 5e-4 * tally.moves);
  // Much must have happened.
  EXPECT_GE(tally.with_impact, 0.3 * tally.steps);
  EXPECT_GE(tally.riding, 0.02 * tally.moves);
  EXPECT_GE(tally.crushed, 5e-4 * tally.moves);  // a fifth of what a hundred times as many moves have
  EXPECT_LE(tally.crushed, 0.02 * tally.moves);
}

}  // namespace
}  // namespace paperproof::test
