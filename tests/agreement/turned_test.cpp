/// A scene that is turned by a quarter, a half or three quarters about the origin, together with up, gravity, movers
/// and shape, gives the turned steps.
#include "agreement/random_movers.hpp"
#include "support/play_levels.hpp"
#include "support/random_sceneries.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace paperproof::test {
namespace {

/// By quarters, counter-clockwise. Exact, but for the sign of a zero.
Vec2d turned(Vec2d v, int quarters) {
  for (int i = 0; i < quarters; ++i) v = {-v.y(), v.x()};
  return v;
}

SceneryDef turned(SceneryDef def, int quarters) {
  for (ColliderDef& collider : def.colliders) {
    for (Vec2d& p : collider.points) p = turned(p, quarters);
    for (std::vector<Vec2d>& hole : collider.holes)
      for (Vec2d& p : hole) p = turned(p, quarters);
    if (collider.one_way) collider.one_way = turned(*collider.one_way, quarters);
  }
  return def;
}

CharacterDef turned(CharacterDef def, int quarters) {
  std::vector<Vec2d> points;
  for (const Vec2d& p : def.shape.points()) points.push_back(turned(p, quarters));
  def.shape = CharacterShape(points);
  return def;
}

CharacterState<double> turned(CharacterState<double> state, int quarters) {
  for (Vec2d* v : {&state.position, &state.velocity, &state.last_free, &state.ride.place, &state.ride.velocity,
                   &state.ground.normal, &state.ground.velocity})
    *v = turned(*v, quarters);
  for (Crusher<double>& crusher : state.crushers) {
    crusher.last_free = turned(crusher.last_free, quarters);
    crusher.displacement = turned(crusher.displacement, quarters);
  }
  return state;
}

/// What differs between a step and the turned one; empty where nothing does.
std::string difference(const MoveResult<double>& move, const MoveResult<double>& other, int quarters) {
  if (move.status != other.status) return "status";
  if (move.path.size() != other.path.size()) return "number of corners";
  for (std::size_t i = 0; i < move.path.size(); ++i)
    if (turned(move.path[i].position, quarters) != other.path[i].position ||
        move.path[i].fraction != other.path[i].fraction)
      return "path";
  if (turned(move.velocity, quarters) != other.velocity) return "velocity";
  if (move.grounded != other.grounded || move.ground.state != other.ground.state) return "grounded";
  if (move.ground.state != GroundState::air &&
      (move.ground.collider != other.ground.collider || turned(move.ground.normal, quarters) != other.ground.normal ||
       turned(move.ground.velocity, quarters) != other.ground.velocity))
    return "ground";
  if (!std::equal(move.crushed.begin(), move.crushed.end(), other.crushed.begin(), other.crushed.end()))
    return "crushed";
  if (!std::equal(move.contacts.begin(), move.contacts.end(), other.contacts.begin(), other.contacts.end(),
                  [&](const Contact<double>& a, const Contact<double>& b) {
                    return a.collider == b.collider && turned(a.normal, quarters) == b.normal && a.side == b.side &&
                           a.fraction == b.fraction;
                  }))
    return "contacts";
  return "";
}

struct TurnedTally {
  int steps = 0;
  int grounded = 0;
  int riding = 0;
  int rising = 0;
  int crushed = 0;
  int dropped_through = 0;
  int ties = 0;  ///< Turned steps that are not the same: see `is_tie`.
};

/// One character in a scene and in the three turned ones.
class TurnedRun {
 public:
  TurnedRun(Family family, std::uint64_t seed) : seed_(seed), random_(seed) {
    SceneryDef def = random_scenery(family, random_, {0, 0});
    if (random_.chance(0.5)) {
      const int movers = random_.integer(1, 4);
      for (int i = 0; i < movers; ++i) add_mover(def.colliders, static_cast<MoverIndex>(i), random_, {0, 0});
    }
    for (ColliderDef& collider : def.colliders)
      if (random_.chance(0.1)) collider.surface_speed = random_.between(-3, 3);
    CharacterDef character;
    character.shape = play_shape(random_.integer(0, 2));
    if (random_.chance(0.5)) character.snap = 0.5;
    if (random_.chance(0.3)) character.max_fall_speed = 10;
    character.coyote_time = 0.1;
    character.jump_cut = 0.5;
    character.no_jump_toward_wall = random_.chance(0.3);
    character.side_hit_ends_rise = random_.chance(0.3);
    for (int quarters = 0; quarters < 4; ++quarters) {
      sceneries_.push_back(std::make_unique<const Scenery<double>>(turned(def, quarters)));
      controllers_.emplace_back(*sceneries_.back(), turned(character, quarters));
      scratches_.push_back(controllers_.back().make_scratch());
    }
    motions_.resize(sceneries_[0]->mover_count());
    wanderers_.resize(motions_.size());
  }

  void go(TurnedTally& tally) {
    states_[0].position = {random_.between(-4, 4), random_.between(-3, 5)};
    const Vec2d gravity{random_.chance(0.1) ? random_.between(-5, 5) : 0, -30};
    Input input;
    for (int step = 0; step < 60; ++step) {
      if (random_.chance(0.1)) input.move = random_.integer(-1, 1);
      if (random_.chance(0.1)) input.jump = !input.jump;
      input.drop = random_.chance(0.1);
      if (random_.chance(0.05)) states_[0].velocity = {random_.between(-30, 30), random_.between(-30, 30)};
      for (std::size_t i = 0; i < motions_.size(); ++i)
        motions_[i] = {motions_[i].to, next_offset(wanderers_[i], motions_[i].to, random_)};
      take(input, gravity, tally);
      if (states_[0].position.cwiseAbs().maxCoeff() > 12 || ::testing::Test::HasFailure()) return;
    }
  }

 private:
  void take(const Input& input, const Vec2d& gravity, TurnedTally& tally) {
    const CharacterState<double> before = states_[0];
    std::vector<MoverMotion<double>> motions(motions_.size());
    for (std::size_t k = 0; k < 4; ++k) {
      const int quarters = static_cast<int>(k);
      for (std::size_t i = 0; i < motions.size(); ++i)
        motions[i] = {turned(motions_[i].from, quarters), turned(motions_[i].to, quarters)};
      states_[k] = turned(before, quarters);
      const Vec2d up = turned(Vec2d{0, 1}, quarters);
      controllers_[k].step(states_[k], input, {turned(gravity, quarters), 1.0 / 60, motions, nullptr, up},
                           scratches_[k], reports_[k]);
    }
    const StepReport<double>& report = reports_[0];
    ++tally.steps;
    tally.grounded += states_[0].grounded;
    tally.riding += states_[0].ride.ground != no_collider;
    tally.rising += states_[0].jumping;
    tally.crushed += states_[0].crushed;
    tally.dropped_through += static_cast<int>(report.dropped_through.size());
    for (std::size_t k = 1; k < 4; ++k) {
      const int quarters = static_cast<int>(k);
      const StepReport<double>& other = reports_[k];
      std::string what = report.status != other.status ? "status" : difference(report.move, other.move, quarters);
      if (what.empty() && turned(states_[0], quarters) != states_[k]) what = "state";
      if (what.empty()) continue;
      ++tally.ties;
      ASSERT_TRUE(is_tie(report.move, other.move, quarters)) << text_of(before, what, quarters);
    }
  }

  /// The axes of a configuration space have an order, which does not turn with it. It decides in two cases. (1) Two
  /// facets are equally near, because the character touches a corner with the same gap to both: it stands on the
  /// corner, or beside it and then a `snap` may take it further down. (2) The way out of a solid ends where two facets
  /// cross, which is calculated on the line of the first: the last bit depends on which it is.
  [[nodiscard]] bool is_tie(const MoveResult<double>& move, const MoveResult<double>& other, int quarters) const {
    constexpr double last_bit = 1e-14;
    const auto same = [&](const PathPoint<double>& a, const PathPoint<double>& b) {
      return (turned(a.position, quarters) - b.position).cwiseAbs().maxCoeff() <= last_bit && a.fraction == b.fraction;
    };
    const std::size_t common = std::min(move.path.size(), other.path.size());
    const bool snaps = controllers_[0].character().snap > 0 && move.path.size() + other.path.size() == 2 * common + 1;
    return move.status == other.status && (move.path.size() == other.path.size() || snaps) &&
           std::equal(move.path.begin(), move.path.begin() + static_cast<std::ptrdiff_t>(common), other.path.begin(),
                      same);
  }

  [[nodiscard]] std::string text_of(const CharacterState<double>& before, const std::string& what, int quarters) const {
    std::ostringstream text;
    text.precision(17);
    text << "seed " << seed_ << ", quarters " << quarters << ": " << what << "; from " << before.position.transpose()
         << " v " << before.velocity.transpose();
    for (const int k : {0, quarters}) {
      const MoveResult<double>& move = reports_[static_cast<std::size_t>(k)].move;
      text << "\n  turned by " << k << ", status " << static_cast<int>(move.status) << ", way";
      for (const PathPoint<double>& corner : move.path)
        text << " (" << turned(corner.position, 4 - k).transpose() << " @ " << corner.fraction << ")";
      for (const Contact<double>& met : move.contacts)
        text << "\n    met " << met.collider << ", normal " << turned(met.normal, 4 - k).transpose() << " @ "
             << met.fraction;
    }
    return text.str();
  }

  std::uint64_t seed_;
  Random random_;
  std::vector<std::unique_ptr<const Scenery<double>>> sceneries_;
  std::vector<Controller<double>> controllers_;
  std::vector<Scratch<double>> scratches_;
  std::array<CharacterState<double>, 4> states_;
  std::array<StepReport<double>, 4> reports_;
  std::vector<MoverMotion<double>> motions_;
  std::vector<Wanderer> wanderers_;
};

class Turned : public ::testing::TestWithParam<Family> {};

TEST_P(Turned, scene_gives_the_turned_steps) {
  TurnedTally tally;
  const auto family = static_cast<std::uint64_t>(GetParam());
  const int steps = steps_wanted("PAPERPROOF_TURNED_STEPS", 9000);
  for (std::uint64_t run = 0; tally.steps < steps; ++run) {
    TurnedRun(GetParam(), 3000017 * (family + 1) + run).go(tally);
    if (HasFailure()) return;
  }
  std::printf("%s: %d steps, %d grounded, %d riding, %d rising, %d crushed, %d chains passed, %d ties\n",
              name_of(GetParam()).c_str(), tally.steps, tally.grounded, tally.riding, tally.rising, tally.crushed,
              tally.dropped_through, tally.ties);
  EXPECT_GT(tally.grounded, tally.steps / 50);
  EXPECT_GT(tally.riding, 0);
  EXPECT_GT(tally.rising, 0);
  EXPECT_LE(tally.ties, tally.steps / 1000);
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, Turned, ::testing::ValuesIn(all_families),
                         [](const ::testing::TestParamInfo<Family>& family) { return name_of(family.param); });

}  // namespace
}  // namespace paperproof::test
