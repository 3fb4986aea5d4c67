/// The guarantee of octagon_sweep among what turns: planks, see-saws, wheels, presses and papers, in random play over
/// ground that stands, judged exactly by the ways of their vertices.
#include "agreement/recorded.hpp"
#include "agreement/run_trace.hpp"
#include "oracle/judge.hpp"
#include "runs/level_ways.hpp"
#include "support/random.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/level.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <sstream>
#include <vector>

namespace paperproof::test {
namespace {

using compare::Judge;
using compare::StepJudgement;
using compare::TraceHeader;
using compare::TraceStep;

enum class Turning {
  planks,    ///< Turn about their middle, evenly, at up to 30 rad/s.
  see_saws,  ///< Turn to and fro about a point on them.
  wheels,    ///< Polygons of 5 to 12 corners, some with notches, that turn and go along.
  presses,   ///< Boxes that come down, turning, onto the floor, the walls and each other.
  papers,    ///< From a line to 5 cm thick, about any point, turning and going along.
  balls,     ///< One or two circles, about any point, turning and going along.
};
constexpr std::array all_turning{Turning::planks,  Turning::see_saws, Turning::wheels,
                                 Turning::presses, Turning::papers,   Turning::balls};

std::string name_of(Turning family) {
  switch (family) {
    case Turning::planks:
      return "planks";
    case Turning::see_saws:
      return "see_saws";
    case Turning::wheels:
      return "wheels";
    case Turning::presses:
      return "presses";
    case Turning::papers:
      return "papers";
    case Turning::balls:
      return "balls";
  }
  return "";
}

/// Of the sum over families.
int steps_per_turning_family() { return steps_wanted("PAPERPROOF_TURNING_STEPS", sampled(3000)); }
std::uint64_t first_turning_run() {
  return static_cast<std::uint64_t>(steps_wanted("PAPERPROOF_TURNING_FIRST_RUN", 0));
}

/// So many steps of a family that break it are described.
constexpr int most_described = 4;
constexpr double contact_reach = 1e-6;

struct Tally {
  int steps = 0;
  int with_contact = 0;  ///< With something that moves.
  int riding = 0;
  int crushed = 0;
  int stuck = 0;
  int dropped = 0;
  int near = 0;       ///< With ways of more than one chord: something near turned.
  int overlaps = 0;   ///< Ended inside what they did not begin in, and what did not crush.
  int passages = 0;   ///< Passed a solid.
  int undecided = 0;  ///< Came too near to tell.
  int gaps = 0;       ///< Left more than the guaranteed gap at a contact.
  int room = 0;       ///< Were crushed where there was room.
  /// Were not finite, or did not end where they said, or inside what they did not name, or stuck and free.
  int unsound = 0;
  int stuck_refuted = 0;  ///< Said that they are stuck, and there was a straight way out.
  int described = 0;
  double worst_fraction = 0;  ///< Of a contact that begins: error of its time of impact [steps].

  [[nodiscard]] int broken() const { return overlaps + passages + undecided + gaps + room + unsound + stuck_refuted; }
};

ColliderDef boxed(double left, double bottom, double right, double top, MoverIndex mover = no_mover) {
  return {.points = {{left, bottom}, {right, bottom}, {right, top}, {left, top}}, .mover = mover};
}

/// How one mover goes: evenly, or to and fro, in position and angle.
struct Course {
  Vec2d middle{0, 0};
  Vec2d reach{0, 0};  ///< To and fro by so much [m],
  double pace = 0;    ///< at so many radians of a sine per second.
  double angle = 0;   ///< At first [rad].
  double spin = 0;    ///< [rad/s]
  double swing = 0;   ///< To and fro by so much [rad], at the same pace.

  [[nodiscard]] Pose at(double time) const {
    const double share = std::sin(pace * time);
    return {middle + share * reach, angle + spin * time + swing * share};
  }
};

class RandomRun {
 public:
  RandomRun(Turning family, std::uint64_t seed)
      : family_(family),
        seed_(seed),
        random_(seed),
        scenery_(scenery()),
        level_(scenery_),
        controller_(level_, character()),
        judge_(header()),
        trace_(header(), "turning", name_of(family) + "_" + std::to_string(seed)) {}

  void go(Tally& tally) {
    const double dt = random_.chance(0.8) ? 1.0 / 60 : random_.log_between(1e-3, 0.05);
    move_on(0, dt);
    do {
      state_.position.x() = random_.between(-5, 5);
      state_.position.y() = random_.between(0.7, 6);
    } while (controller_.overlaps(state_.position, {.dt = dt, .movers = motions_}) != std::size_t{0});
    Input input;
    for (int step = 0; step < 80; ++step) {
      if (random_.chance(0.1)) input.move = random_.integer(-1, 1);
      if (random_.chance(0.1)) input.jump = !input.jump;
      if (random_.chance(0.02)) launch(dt);
      move_on(step, dt);
      take(step, input, dt, tally);
      if (state_.position.cwiseAbs().maxCoeff() > 14 || ::testing::Test::HasFatalFailure()) return;
    }
  }

 private:
  SceneryDef scenery() {
    SceneryDef def;
    def.colliders = {boxed(-8, -1, 8, 0), boxed(-9, -1, -8, 9), boxed(8, -1, 9, 9)};
    if (random_.chance(0.3)) {
      const double left = random_.between(-6, 4);
      def.colliders.push_back(boxed(left, 0, left + random_.between(0.3, 2), random_.between(0.1, 1)));
    }
    const int movers = random_.integer(1, 6);
    for (int i = 0; i < movers; ++i) add_mover(static_cast<MoverIndex>(i), def.colliders);
    return def;
  }

  void add_mover(MoverIndex mover, std::vector<ColliderDef>& colliders) {
    Course course;
    course.middle = {random_.between(-5, 5), 0};
    course.middle.y() = random_.between(0.2, 4);
    course.angle = random_.angle();
    course.pace = random_.between(0.5, 4);
    const double half = random_.between(0.5, 2);
    const double thin = random_.between(0.05, 0.3);
    switch (family_) {
      case Turning::planks:
        course.spin = random_.either_sign_log_between(0.05, random_.chance(0.2) ? 30 : 4);
        colliders.push_back(boxed(-half, -thin, half, thin, mover));
        break;
      case Turning::see_saws: {
        const double about = random_.between(-0.5, 0.5) * half;
        course.angle = random_.chance(0.5) ? 0 : random_.between(-0.5, 0.5);
        course.swing = random_.between(0.05, 1);
        colliders.push_back(boxed(-half + about, -thin, half + about, thin, mover));
        break;
      }
      case Turning::wheels:
        course.spin = random_.either_sign_log_between(0.05, 6);
        course.reach = {random_.between(-2, 2), 0};
        course.reach.y() = random_.between(-1, 1);
        add_wheel(mover, half / 1.5, colliders);
        break;
      case Turning::presses:
        course.reach = {random_.between(-1, 1), 0};
        course.middle.y() = random_.between(2, 4);
        course.reach.y() = -random_.between(1, 4);
        course.pace = random_.between(2, 6);
        course.angle = random_.between(-0.3, 0.3);
        course.swing = random_.between(-0.5, 0.5);
        colliders.push_back(boxed(-2 * half, -3 * thin, 2 * half, 3 * thin, mover));
        break;
      case Turning::balls: {
        course.spin = random_.either_sign_log_between(0.05, random_.chance(0.2) ? 30 : 6);
        course.reach = {random_.between(-2, 2), 0};
        course.reach.y() = random_.between(-1, 1);
        const double off = random_.chance(0.5) ? 0 : random_.between(-1.5, 1.5);
        ColliderDef ball{.shape = ColliderDef::Shape::circle, .points = {{off, 0}}, .mover = mover};
        ball.radius = random_.chance(0.2) ? random_.log_between(1e-3, 0.1) : random_.between(0.1, 1.2);
        if (random_.chance(0.3)) ball.surface_speed = random_.between(-3, 3);
        colliders.push_back(ball);
        if (random_.chance(0.5)) colliders.push_back(boxed(-half, off - thin, half, off + thin, mover));
        if (random_.chance(0.5)) {
          ball.points = {{-off, random_.between(-1, 1)}};
          colliders.push_back(ball);
        }
        break;
      }
      case Turning::papers: {
        course.spin = random_.either_sign_log_between(0.05, random_.chance(0.2) ? 30 : 4);
        course.reach = {random_.between(-3, 3), 0};
        course.reach.y() = random_.between(-3, 3);
        const double off = random_.between(-1, 1);
        const double paper = random_.log_between(1e-6, 0.05);
        if (random_.chance(0.4))
          colliders.push_back(
              {.shape = ColliderDef::Shape::chain, .points = {{-half, off}, {half, off}}, .mover = mover});
        else
          colliders.push_back(boxed(-half, off, half, off + paper, mover));
        break;
      }
    }
    courses_.push_back(course);
  }

  void add_wheel(MoverIndex mover, double radius, std::vector<ColliderDef>& colliders) {
    const int corners = random_.integer(5, 12);
    const bool notched = random_.chance(0.3);
    ColliderDef wheel{.points = {}, .mover = mover};
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      const double r = notched && k % 2 == 1 ? 0.6 * radius : radius;
      wheel.points.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    if (random_.chance(0.3)) wheel.surface_speed = random_.between(-3, 3);
    colliders.push_back(std::move(wheel));
  }

  CharacterDef character() {
    CharacterDef def;
    if (random_.chance(0.3)) def.snap = 0.5;
    if (random_.chance(0.2)) def.max_climb_degrees = random_.between(0, 89);
    return def;
  }

  [[nodiscard]] TraceHeader header() const {
    TraceHeader header;
    header.contender = "octagon_sweep";
    header.scalar = "double";
    header.points.assign(controller_.character().shape.hull().begin(), controller_.character().shape.hull().end());
    header.scenery = scenery_;
    header.dt = 1.0 / 60;
    header.character = controller_.character();
    header.gravity = {0, -20};
    header.turning.assign(courses_.size(), true);
    header.guarantees = compare::every_clause();
    return header;
  }

  void move_on(int step, double dt) {
    motions_.clear();
    for (const Course& course : courses_) motions_.push_back({course.at(step * dt), course.at((step + 1) * dt)});
  }

  void launch(double dt) {
    const double angle = random_.angle();
    state_.velocity = random_.log_between(0.1, 10) / (60 * dt) * Vec2d(std::cos(angle), std::sin(angle));
    launched_ = true;
  }

  void take(int step, const Input& input, double dt, Tally& tally) {
    const CharacterState<double> before = state_;
    controller_.step(state_, input, {.gravity = {0, -20}, .dt = dt, .movers = motions_}, report_);
    std::vector<MoverMotion<double>> offsets;
    for (const PoseMotion& motion : motions_) offsets.push_back({motion.from.position, motion.to.position});
    TraceStep record = recorded<double>(report_, state_, offsets);
    record.step = step;
    record.dt = dt;
    record.vertex_ways = compare::ways_in_level(scenery_, controller_.turned(), motions_);
    ASSERT_NE(report_.status, StepStatus::invalid_input);
    if (step_refused()) return;
    const StepJudgement judgement = judge_.judge(record);
    if (before.ride.ground != Ride<double>::none) {
      const compare::VertexWay* ground = compare::find_way(record.vertex_ways, before.ride.ground);
      const bool is_circle = scenery_.colliders[before.ride.ground].shape == ColliderDef::Shape::circle;
      record.requested += is_circle ? Vec2d(before.ride.velocity * dt) : compare::carried_along(*ground);
    }
    trace_.write(record, before, input, launched_);
    launched_ = false;
    const int broken = tally.broken();
    count(record, judgement, tally);
    const bool is_late = judgement.turning_toi_error.value_or(0) > 0 && record.crushed.empty();
    if ((tally.broken() > broken || is_late) && tally.described++ < most_described)
      std::printf("breaks: %s\n", describe(record, judgement, before).c_str());
  }

  [[nodiscard]] bool step_refused() const { return report_.status == StepStatus::out_of_range; }

  void count(const TraceStep& record, const StepJudgement& judgement, Tally& tally) const {
    ++tally.steps;
    const auto moves = [&](ColliderIndex collider) { return scenery_.colliders[collider].mover != no_mover; };
    tally.with_contact += std::any_of(record.contacts.begin(), record.contacts.end(),
                                      [&](const Contact<double>& contact) { return moves(contact.collider); });
    tally.riding += state_.ride.ground != Ride<double>::none;
    tally.crushed += !record.crushed.empty();
    tally.stuck += record.stuck;
    tally.dropped += record.dropped;
    tally.near += std::any_of(record.vertex_ways.begin(), record.vertex_ways.end(),
                              [](const compare::VertexWay& way) { return way.instants.size() > 2; });
    tally.overlaps += !judgement.entered.empty();
    tally.room += !judgement.crushed_with_room.empty();
    tally.passages += !judgement.tunnelled.empty() || !judgement.corner_cut.empty();
    tally.undecided += !judgement.undecided.empty();
    tally.stuck_refuted += judgement.stuck_refuted;
    const bool named =
        judgement.end_overlap.empty() || report_.status == StepStatus::stuck || report_.status == StepStatus::crushed;
    const bool ends = record.path.back().fraction == 1 && record.path.back().position == state_.position;
    const bool kept = !report_.move.path.overflowed() && !report_.move.crushed.overflowed();
    const bool is_inside = !record.stuck || !judgement.end_overlap.empty();
    tally.unsound +=
        !(named && is_inside && ends && kept && state_.position.allFinite() && state_.velocity.allFinite());
    const bool near = std::all_of(record.contacts.begin(), record.contacts.end(),
                                  [](const Contact<double>& contact) { return contact.separation <= contact_reach; });
    const bool free = record.crushed.empty() && judgement.end_overlap.empty();
    tally.gaps += free && !(near && judgement.max_contact_gap <= contact_reach);
    if (judgement.turning_toi_error && record.crushed.empty())
      tally.worst_fraction = std::max(tally.worst_fraction, *judgement.turning_toi_error);
  }

  [[nodiscard]] std::string describe(const TraceStep& record, const StepJudgement& judgement,
                                     const CharacterState<double>& before) const {
    std::ostringstream text;
    text.precision(17);
    const auto list = [&](const char* what, const std::vector<ColliderIndex>& colliders) {
      if (colliders.empty()) return;
      text << what;
      for (const ColliderIndex collider : colliders) text << " " << collider;
      text << "; ";
    };
    text << name_of(family_) << ", seed " << seed_ << ", step " << record.step << ", dt " << *record.dt << ": ";
    list("begins in", judge_.overlapped(record));
    list("enters", judgement.entered);
    list("passes", judgement.tunnelled);
    list("too near to", judgement.undecided);
    list("crushed with room", judgement.crushed_with_room);
    list("says crushed", record.crushed);
    list("ends in", judgement.end_overlap);
    if (report_.move.path.overflowed()) text << "way too long; ";
    if (judgement.room) text << "room at " << judgement.room->transpose() << "; ";
    if (judgement.turning_toi_error.value_or(0) > 0) text << "fraction off by " << *judgement.turning_toi_error << "; ";
    text << "gap " << judgement.max_contact_gap << ", status " << static_cast<int>(report_.status) << ", from "
         << before.position.transpose() << " at " << before.velocity.transpose() << "\n  way";
    for (const PathPoint<double>& corner : record.path)
      text << " (" << corner.position.x() << ", " << corner.position.y() << " @ " << corner.fraction << ")";
    for (const Contact<double>& c : record.contacts)
      text << "\n    " << c.collider << " n " << c.normal.transpose() << " @ " << c.fraction << " gap " << c.separation;
    return text.str();
  }

  Turning family_;
  std::uint64_t seed_;
  Random random_;
  std::vector<Course> courses_;
  SceneryDef scenery_;
  Level level_;
  LevelController controller_;
  Judge judge_;
  RunTrace trace_;
  bool launched_ = false;
  CharacterState<double> state_;
  StepReport<double> report_;
  std::vector<PoseMotion> motions_;
};

class AmongTurning : public ::testing::TestWithParam<Turning> {};

Tally run_family(Turning family, int steps) {
  Tally tally;
  for (std::uint64_t run = first_turning_run(); tally.steps < steps; ++run) {
    RandomRun(family, 3000017 * (static_cast<std::uint64_t>(family) + 1) + run).go(tally);
    if (::testing::Test::HasFatalFailure()) break;
  }
  std::printf(
      "%s: %d steps, %d near what turns, %d with contact, %d riding, %d crushed, %d stuck, %d dropped; %d overlaps, %d "
      "passages, %d undecided, %d gaps, %d crushes with room, %d unsound, %d not stuck; time of "
      "impact "
      "off by %.3g\n",
      name_of(family).c_str(), tally.steps, tally.near, tally.with_contact, tally.riding, tally.crushed, tally.stuck,
      tally.dropped, tally.overlaps, tally.passages, tally.undecided, tally.gaps, tally.room, tally.unsound,
      tally.stuck_refuted, tally.worst_fraction);
  return tally;
}

TEST_P(AmongTurning, no_step_breaks_the_guarantee) {
  const Tally tally = run_family(GetParam(), steps_per_turning_family());
  const std::string family = name_of(GetParam());
  BrokenByRuns::all().expect_only_what_is_known(family);
  EXPECT_EQ(tally.overlaps, 0);
  EXPECT_EQ(tally.passages, 0);
  EXPECT_EQ(tally.undecided, 0);
  EXPECT_EQ(tally.gaps, 0);
  EXPECT_LE(tally.room, most_broken("turning", compare::Clause::crush, tally.steps, family));
  EXPECT_EQ(tally.unsound, 0);
  EXPECT_LE(tally.stuck_refuted, most_broken("turning", compare::Clause::start_inside, tally.steps, family));
  EXPECT_EQ(tally.worst_fraction, 0);
  if (tally.steps < 1000) return;
  // The generators must really meet what turns, and also miss it.
  EXPECT_GE(tally.near, tally.steps * 0.2);
  EXPECT_LE(tally.with_contact, tally.steps * 0.9);
  EXPECT_GE(tally.with_contact, tally.steps * 0.02);
  EXPECT_GT(tally.riding, 0);
  if (GetParam() == Turning::presses) {
    EXPECT_GT(tally.crushed, 0);
  }
  EXPECT_LT(tally.crushed, tally.steps / 5);
}

/// What the judge accused each of once, and it did not do.
TEST(AmongTurningFound, is_accused_of_nothing_that_it_did_not_do) {
  struct Found {
    Turning family;
    std::uint64_t seed;
    compare::Clause clause;
  };
  const std::vector<Found> all{{Turning::planks, 3000087, compare::Clause::overlap},
                               {Turning::planks, 3000030, compare::Clause::velocity},
                               {Turning::see_saws, 6000194, compare::Clause::wanted},
                               {Turning::balls, 18000119, compare::Clause::velocity}};
  for (const Found& found : all) {
    Tally tally;
    RandomRun(found.family, found.seed).go(tally);
    EXPECT_EQ(BrokenByRuns::all().take("turning", found.clause), 0) << name_of(found.clause) << ", seed " << found.seed;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, AmongTurning, ::testing::ValuesIn(all_turning),
                         [](const ::testing::TestParamInfo<Turning>& family) { return name_of(family.param); });

}  // namespace
}  // namespace paperproof::test
