/// A shape may lie anywhere about its character's position: each step is that of the shape at the origin, shifted. Both
/// begin each step in the same state.
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/crowd.hpp>
#include <paperproof/level.hpp>
#include <paperproof/tolerances.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace paperproof::test {
namespace {

constexpr double equal = 1e-9;  ///< [m]

/// Rounded so that a shift by up to 1,000 m loses nothing.
double rounded(double value, double digits) { return std::round(value * digits) / digits; }
Vec2d rounded(const Vec2d& v, double digits) { return {rounded(v.x(), digits), rounded(v.y(), digits)}; }
constexpr double of_offset = 0x1p10;
constexpr double of_place = 0x1p40;

Vec2d random_offset(Random& random) {
  const double angle = random.angle();
  return rounded(Vec2d(Vec2d{std::cos(angle), std::sin(angle)} * random.log_between(1e-2, 1000)), of_offset);
}

CharacterShape shape_at(const Vec2d& offset, bool is_box) {
  std::vector<Vec2d> points;
  const CharacterShape article = CharacterShape::article();
  for (const Vec2d& point : article.hull()) points.push_back(point);
  if (is_box) points = {{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}};
  for (Vec2d& point : points) point += offset;
  return CharacterShape(points);
}

/// The same state of a character whose shape is shifted by `offset`.
CharacterState<double> shifted(CharacterState<double> state, const Vec2d& offset) {
  state.position -= offset;
  state.last_free -= offset;
  if (state.ride.ground != Ride<double>::none) state.ride.place -= offset;
  for (Crusher<double>& crusher : state.crushers) crusher.last_free -= offset;
  return state;
}

void round_places(CharacterState<double>& state) {
  state.position = rounded(state.position, of_place);
  state.last_free = rounded(state.last_free, of_place);
  state.ride.place = rounded(state.ride.place, of_place);
  for (Crusher<double>& crusher : state.crushers) crusher.last_free = rounded(crusher.last_free, of_place);
}

/// Where and how two steps differ; empty if they do not.
/// @param offset of the second shape. @param in_time how far times of impact may differ [m].
std::string difference(const StepReport<double>& a, const StepReport<double>& b, const Vec2d& offset,
                       double in_time = equal) {
  const auto off = [](const Vec2d& u, const Vec2d& v) { return (u - v).cwiseAbs().maxCoeff(); };
  if (a.status != b.status) return "status";
  if (!(off(a.move.position, b.move.position + offset) <= equal)) return "position";
  if (!(off(a.move.velocity, b.move.velocity) <= equal * 60)) return "velocity";
  if (a.move.grounded != b.move.grounded || a.move.ground.state != b.move.ground.state) return "ground";
  if (a.move.path.size() != b.move.path.size()) return "corners";
  for (std::size_t i = 0; i < a.move.path.size(); ++i) {
    if (!(off(a.move.path[i].position, b.move.path[i].position + offset) <= equal)) return "way";
    if (!(std::abs(a.move.path[i].fraction - b.move.path[i].fraction) <= equal)) return "times";
  }
  double fastest = 0;  // leg of the way, if it took the whole step [m]
  for (std::size_t i = 1; i < a.move.path.size(); ++i) {
    const double time = a.move.path[i].fraction - a.move.path[i - 1].fraction;
    const double length = (a.move.path[i].position - a.move.path[i - 1].position).norm();
    if (time > 1e-3) fastest = std::max(fastest, length / time);
  }
  if (a.move.contacts.size() != b.move.contacts.size()) return "number of contacts";
  for (std::size_t i = 0; i < a.move.contacts.size(); ++i) {
    const Contact<double>& one = a.move.contacts[i];
    const Contact<double>& other = b.move.contacts[i];
    if (one.collider != other.collider || one.side != other.side) return "contact";
    if (!(off(one.point, other.point) <= equal && off(one.normal, other.normal) <= equal)) return "place of a contact";
    if (!(std::abs(one.separation - other.separation) <= equal)) return "separation";
    const double apart = std::abs(one.fraction - other.fraction);
    if (!(apart <= equal || apart * fastest <= in_time)) return "time of impact";
  }
  if (a.move.crushed.size() != b.move.crushed.size()) return "crushed";
  return a.sensors.size() == b.sensors.size() ? "" : "sensors";
}

ColliderDef random_collider(Random& random) {
  const Vec2d middle = Vec2d{random.between(-5, 5), random.between(-1, 5)};
  const double size = random.log_between(0.1, 2);
  ColliderDef def;
  if (random.chance(0.2)) {
    def.shape = ColliderDef::Shape::circle;
    def.points = {middle};
    def.radius = size;
  } else if (random.chance(0.3)) {
    def.shape = ColliderDef::Shape::chain;
    def.points = {middle, middle + Vec2d{size, random.between(-1, 1) * size}};
    if (random.chance(0.3)) def.one_way = Vec2d(0, 1);
  } else {
    const double turn = random.angle();
    const int corners = random.integer(3, 6);
    for (int i = 0; i < corners; ++i) {
      const double angle = turn + 2 * std::numbers::pi * i / corners;
      def.points.push_back(middle + Vec2d{std::cos(angle), std::sin(angle)} * size);
    }
    def.sensor = random.chance(0.1);
  }
  return def;
}

/// Scenery, of which some moves and, in a level, turns.
struct Surroundings {
  SceneryDef def{{{.points = {{-9, -3}, {9, -3}, {9, -2}, {-9, -2}}}}};
  std::vector<Vec2d> ways;  ///< Of the movers, in each step [m].
  std::vector<double> turns;

  Surroundings(Random& random, bool may_turn) {
    const int count = random.integer(2, 10);
    for (int i = 0; i < count; ++i) {
      def.colliders.push_back(random_collider(random));
      if (def.colliders.back().one_way || !random.chance(0.5)) continue;
      def.colliders.back().mover = static_cast<MoverIndex>(ways.size());
      ways.emplace_back(random.either_sign_log_between(1e-3, 1), 0);
      ways.back().y() = random.either_sign_log_between(1e-3, 1);
      turns.push_back(may_turn && random.chance(0.5) ? random.either_sign_log_between(1e-3, 0.3) : 0);
    }
  }
  [[nodiscard]] PoseMotion pose(std::size_t mover, int step) const {
    const auto at = [&](int when) { return Pose{ways[mover] * (when % 4 - 2), turns[mover] * when}; };
    return {at(step), at(step + 1)};
  }
};

CharacterState<double> thrown(Random& random) {
  CharacterState<double> state;
  state.position = rounded(Vec2d{random.between(-5, 5), random.between(-2, 5)}, of_place);
  state.velocity.x() = random.either_sign_log_between(1e-3, 100);
  state.velocity.y() = random.either_sign_log_between(1e-3, 100);
  return state;
}

bool is_away(const CharacterState<double>& state) { return state.position.cwiseAbs().maxCoeff() > 8; }

struct Tally {
  int steps = 0;
  int contacts = 0;
  int crushes = 0;
  int stuck = 0;
  int far = 0;
  int ties = 0;  ///< Steps that differ.

  void add(const StepReport<double>& report, const Vec2d& offset) {
    ++steps;
    contacts += !report.move.contacts.empty();
    crushes += report.status == StepStatus::crushed;
    stuck += report.status == StepStatus::stuck;
    far += offset.norm() > 3;
  }
  void check(const char* name, int wanted, int share) const {
    std::printf("%s: %d steps, %d with contacts, %d crushed, %d stuck, %d of shapes over 3 m away, %d ties\n", name,
                steps, contacts, crushes, stuck, far, ties);
    if (sanitized || wanted < few_steps) return;
    EXPECT_GT(contacts, steps / share);
    EXPECT_GT(crushes + stuck, 0);
    EXPECT_GT(far, steps / 4);
    // A rounding may decide which of two surfaces counts that press the character, and where a search by halving ends.
    EXPECT_LE(ties, 2 + steps / 5000);
  }
};

TEST(ShapeOrigin, changes_no_step_of_a_controller_or_a_level) {
  const int wanted = 2 * steps_per_family();
  for (const bool in_level : {false, true}) {
    Tally tally;
    for (std::uint64_t seed = 1; tally.steps < wanted; ++seed) {
      Random random(seed);
      const Surroundings around(random, in_level);
      const Vec2d offset = random_offset(random);
      const bool is_box = random.chance(0.5);
      CharacterDef here{.shape = shape_at({0, 0}, is_box)};
      here.acceleration = random.between(30, 90);  // else it walks back to where it was, and a tie decides
      here.step_height = here.snap = random.chance(0.5) ? 0.3 : 0;
      CharacterDef away = here;
      away.shape = shape_at(offset, is_box);
      const Scenery<double> scenery(around.def);
      const Level level(around.def);
      const Controller<double> one(scenery, here);
      const Controller<double> other(scenery, away);
      Scratch<double> scratch = one.make_scratch();
      Scratch<double> scratch_away = other.make_scratch();
      LevelController one_in_level(level, here);
      LevelController other_in_level(level, away);
      StepReport<double> report;
      StepReport<double> report_away;
      CharacterState<double> state = thrown(random);
      for (int step = 0; step < 60; ++step) {
        if (is_away(state) || random.chance(0.05)) state = thrown(random);
        round_places(state);
        CharacterState<double> state_away = shifted(state, offset);
        const Input input{.move = random.between(-1, 1), .jump = random.chance(0.3)};
        const Vec2d displacement{random.between(-3, 3), random.chance(0.5) ? -2.0 : 2.0};
        const bool by_move = random.chance(0.2);
        std::vector<PoseMotion> poses;
        std::vector<MoverMotion<double>> motions;
        for (std::size_t i = 0; i < around.ways.size(); ++i) {
          poses.push_back(around.pose(i, step));
          motions.push_back({poses.back().from.position, poses.back().to.position});
        }
        const auto go = [&](CharacterState<double>& of, bool shifts, StepReport<double>& to) {
          if (in_level) {
            LevelController& controller = shifts ? other_in_level : one_in_level;
            const LevelContext context{.gravity = {0, -30}, .dt = 1.0 / 60, .movers = poses};
            return by_move ? controller.move(of, displacement, context, to) : controller.step(of, input, context, to);
          }
          const Controller<double>& controller = shifts ? other : one;
          Scratch<double>& own = shifts ? scratch_away : scratch;
          const StepContext<double> context{.gravity = {0, -30}, .dt = 1.0 / 60, .movers = motions};
          return by_move ? controller.move(of, displacement, context, own, to)
                         : controller.step(of, input, context, own, to);
        };
        go(state, false, report);
        go(state_away, true, report_away);
        const std::string differs = difference(report, report_away, offset);
        tally.ties += !differs.empty();
        ASSERT_EQ(report.status, report_away.status)
            << differs << ", seed " << seed << ", step " << step << ", shape at (" << offset.x() << ", " << offset.y()
            << ")" << (in_level ? " in a level" : "");
        tally.add(report, offset);
      }
    }
    tally.check(in_level ? "level" : "controller", wanted, 5);
  }
}

/// Where another character cuts a path into parts, a part may begin where it grazes something: then its rounding
/// decides from which of the two parts the time of impact is. What is promised of that time is 1e-6 m.
TEST(ShapeOrigin, changes_no_step_of_a_crowd) {
  constexpr double of_graze = 1e-6;
  constexpr std::size_t members = 4;
  const int wanted = 2 * steps_per_family();
  Tally tally;
  for (std::uint64_t seed = 1; tally.steps < wanted; ++seed) {
    Random random(seed);
    const Surroundings around(random, false);
    const Vec2d offset = random_offset(random);
    const bool is_box = random.chance(0.5);
    const Scenery<double> scenery(around.def);
    const Crowd<double> one(scenery, {.shape = shape_at({0, 0}, is_box)});
    const Crowd<double> other(scenery, {.shape = shape_at(offset, is_box)});
    CrowdScratch scratch = one.make_scratch(members);
    CrowdScratch scratch_away = other.make_scratch(members);
    CrowdReport<double> report(members);
    CrowdReport<double> report_away(members);
    std::vector<CharacterState<double>> states(members);
    for (CharacterState<double>& state : states) state = thrown(random);
    for (int step = 0; step < 40; ++step) {
      std::vector<CharacterState<double>> states_away;
      std::vector<Input> inputs;
      for (CharacterState<double>& state : states) {
        if (is_away(state)) state = thrown(random);
        round_places(state);
        states_away.push_back(shifted(state, offset));
        inputs.push_back({.move = random.between(-1, 1), .jump = random.chance(0.3)});
      }
      std::vector<MoverMotion<double>> motions;
      for (std::size_t i = 0; i < around.ways.size(); ++i)
        motions.push_back({around.pose(i, step).from.position, around.pose(i, step).to.position});
      const StepContext<double> context{.gravity = {0, -30}, .dt = 1.0 / 60, .movers = motions};
      one.step(states, inputs, context, scratch, report);
      other.step(states_away, inputs, context, scratch_away, report_away);
      for (std::size_t i = 0; i < members; ++i) {
        const StepReport<double>& of = report.members[i].step;
        const std::string differs = difference(of, report_away.members[i].step, offset, of_graze);
        tally.ties += !differs.empty();
        ASSERT_EQ(of.status, report_away.members[i].step.status)
            << differs << ", seed " << seed << ", step " << step << ", character " << i;
        tally.add(report.members[i].step, offset);
      }
    }
  }
  tally.check("crowd", wanted, 12);
}

}  // namespace
}  // namespace paperproof::test
