/// Starts inside solids under octagon_sweep against the exact oracle: each is resolved by the shortest straight way out
/// there is, or there is none. Blocks, gears, combs, tiles, stars and balls, with crates, papers and one-way chains in
/// the way, among movers too.
#include "agreement/judged_step.hpp"
#include "oracle/exact.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace paperproof::test {
namespace {

using compare::ExactScenery;
using compare::Place;
using compare::StepJudgement;

/// The oracle's way keeps a little more from what it passes, or a little less where it ends [m].
constexpr double kept = 3e-6;
/// What is asked of a way that is found by trial [m].
constexpr double roomy = 1e-4;

enum class Solids { block, gear, comb, tiles, star, many, balls };
constexpr std::array all_solids{Solids::block, Solids::gear, Solids::comb, Solids::tiles,
                                Solids::star,  Solids::many, Solids::balls};

std::string name_of(Solids solids) {
  switch (solids) {
    case Solids::block:
      return "block";
    case Solids::gear:
      return "gear";
    case Solids::comb:
      return "comb";
    case Solids::tiles:
      return "tiles";
    case Solids::star:
      return "star";
    case Solids::many:
      return "many";
    case Solids::balls:
      return "balls";
  }
  return {};
}

struct Tally {
  int cases = 0;
  int resolved = 0;
  int stuck = 0;
  int passed_beside = 0;  ///< The nearest free place was not to be reached.
  int among_movers = 0;
  int to_one_side = 0;  ///< There was a last free position.
};

ColliderDef rectangle(double left, double bottom, double right, double top) {
  return {.points = {{left, bottom}, {right, bottom}, {right, top}, {left, top}}};
}

/// One start in one scenery.
class Start {
 public:
  Start(Solids solids, std::uint64_t seed) : solids_(solids), seed_(seed), random_(seed) {}

  void go(Tally& tally) {
    build();
    const Scenery<double> scenery(SceneryDef{colliders_});
    const Controller<double> controller(scenery, {});
    const std::vector<Vec2d> hull(controller.character().shape.hull().begin(),
                                  controller.character().shape.hull().end());
    const ExactScenery oracle(scenery.as_run(), hull);
    for (MoverIndex mover = 0; mover < scenery.mover_count(); ++mover) movers_.push_back(motion());
    Scratch<double> scratch = controller.make_scratch();
    for (int start = 0; start < starts_in_each; ++start) {
      const Place from(origin_ + Vec2d{random_.between(-half_, half_), random_.between(-half_, half_)}, movers_, 0);
      const std::vector<ColliderIndex> inside = oracle.overlapped(from);
      if (inside.empty()) continue;
      CharacterState<double> state;
      state.position = from.position;
      if (random_.chance(0.3)) {
        const Place place(origin_ + Vec2d{random_.between(-9, 9), random_.between(-9, 9)}, movers_, 0);
        state.has_last_free = oracle.overlapped(place).empty();
        state.last_free = place.position;
      }
      last_free_ = state.has_last_free ? std::optional(state.last_free) : std::nullopt;
      const CharacterState<double> before = state;
      controller.step(state, {}, {Vec2d{0, 0}, 1.0 / 60, movers_}, scratch, report_);
      ++tally.cases;
      tally.among_movers += !movers_.empty();
      check(oracle, from, inside, before, tally);
      if (::testing::Test::HasFailure()) return;
    }
  }

 private:
  static constexpr int starts_in_each = 8;

  void add(ColliderDef collider, double mover_chance = 0.2) {
    const auto shift = [&](std::vector<Vec2d>& points) {
      for (Vec2d& point : points) point += origin_;
    };
    shift(collider.points);
    for (std::vector<Vec2d>& hole : collider.holes) shift(hole);
    if (with_movers_ && random_.chance(mover_chance)) collider.mover = movers_wanted_++;
    colliders_.push_back(std::move(collider));
  }

  void build() {
    if (random_.chance(0.3)) {
      const double x = random_.either_sign_log_between(1, 9e5);
      origin_ = {x, random_.either_sign_log_between(1, 9e5)};
    }
    with_movers_ = random_.chance(0.4);
    add_solids();
    for (int n = random_.integer(0, 6); n > 0; --n) add_obstacle();
    if (random_.chance(0.6)) add_frame();
  }

  void add_solids() {
    switch (solids_) {
      case Solids::block:
        half_ = 2;
        return add(rectangle(-random_.between(0.1, 5), -random_.between(0.1, 5), 2, random_.between(0.1, 3)));
      case Solids::gear:
        return add_gear();
      case Solids::comb:
        return add_comb();
      case Solids::tiles:
        half_ = 1.5;
        for (int i = -2; i < 2; ++i)
          for (int j = -2; j < 2; ++j)
            if (random_.chance(0.7)) add(rectangle(i, j, i + 1, j + 1), 0);
        return;
      case Solids::star:
        half_ = 2;
        return add({.points = ring(random_.integer(3, 30), 0.5, 4)});
      case Solids::many:
        half_ = 0.8;
        for (int n = random_.integer(2, 30); n > 0; --n) add_obstacle();
        return;
      case Solids::balls:
        half_ = random_.between(0.8, 2);
        for (int n = random_.integer(1, 12); n > 0; --n) add_ball();
        return;
    }
  }

  void add_gear() {
    const int teeth = static_cast<int>(random_.log_between(10, random_.chance(0.02) ? 500 : 60));
    const double outer = random_.between(1, 5);
    half_ = outer * 0.7;
    const double inner = outer * random_.between(0.6, 0.95);
    ColliderDef gear;
    for (int i = 0; i < 2 * teeth; ++i) {
      const double angle = std::numbers::pi * i / teeth;
      const double r = i % 2 == 0 ? inner : outer;
      gear.points.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    add(std::move(gear));
  }

  void add_comb() {
    half_ = 3;
    const int teeth = random_.integer(2, 30);
    const double pitch = 7.0 / teeth;
    const double width = pitch * random_.between(0.1, 0.8);
    const double length = random_.between(0.5, 4);
    ColliderDef comb{.points = {{3.5, 0}, {3.5, 1}, {-3.5, 1}, {-3.5, 0}}};
    for (int k = 0; k < teeth; ++k) {
      const double left = -3.5 + k * pitch + 0.1 * (pitch - width);
      for (const Vec2d& v :
           {Vec2d{left, 0}, Vec2d{left, -length}, Vec2d{left + width, -length}, Vec2d{left + width, 0}})
        comb.points.push_back(v);
    }
    add(std::move(comb));
  }

  std::vector<Vec2d> ring(int corners, double least, double most) {
    std::vector<Vec2d> points;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + random_.between(0, 0.8)) / corners;
      const double r = random_.between(least, most);
      points.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    return points;
  }

  void add_obstacle() {
    const double x = random_.between(-2, 2) * half_;
    const double y = random_.between(-2, 2) * half_;
    const double width = random_.log_between(0.01, 2);
    if (solids_ == Solids::balls && random_.chance(0.5)) return add_ball();
    const int kind = random_.integer(0, 3);
    if (kind == 0) return add(rectangle(x, y, x + width, y + random_.log_between(0.01, 2)));
    const double dx = random_.between(-1, 1);
    const Vec2d to{x + 2 * dx, y + random_.between(-1, 1)};
    ColliderDef other;
    if (kind == 1) {
      other.points = ring(3, 0.2, 1);
      for (Vec2d& point : other.points) point += Vec2d{x, y};
    } else {
      other = {.shape = ColliderDef::Shape::chain, .points = {{x, y}, to}};
      if (kind == 3) other.one_way = Vec2d{(y - to.y()) * 0.3, 2 * dx * 0.3};
    }
    add(std::move(other));
  }

  void add_ball() {
    const double x = random_.between(-1.5, 1.5) * half_;
    const double y = random_.between(-1.5, 1.5) * half_;
    add({.shape = ColliderDef::Shape::circle, .points = {{x, y}}, .radius = random_.log_between(0.05, 3)});
  }

  /// Around all, so that there may be no way out.
  void add_frame() {
    const double r = random_.between(0.7, 0.7 + 1.5 * half_);
    const double opening = random_.chance(0.3) ? random_.between(0.1, 1.5) : 0;
    add({.shape = ColliderDef::Shape::chain, .points = {{-r + opening, -r}, {r, -r}, {r, r}, {-r, r}, {-r, -r}}});
  }

  MoverMotion<double> motion() {
    const double x = random_.between(-0.5, 0.5);
    const Vec2d from{x, random_.between(-0.5, 0.5)};
    return {from, random_.chance(0.5) ? from : Vec2d(from + Vec2d{0.1, 0.05})};
  }

  void check(const ExactScenery& oracle, const Place& from, const std::vector<ColliderIndex>& inside,
             const CharacterState<double>& before, Tally& tally) {
    const std::optional<Vec2d> shortest = oracle.way_out(from, 1000);
    const auto& path = report_.move.path;
    const bool left =
        path.size() > 1 && path[1].fraction == 0 && oracle.overlapped(Place(path[1].position, movers_, 0)).empty();
    if (!left) {
      // What is still in something else may be crushed in the same step.
      ASSERT_TRUE(report_.status == StepStatus::stuck || report_.status == StepStatus::crushed) << where(from);
      ASSERT_FALSE(shortest) << "there is a way to " << shortest->transpose() << where(from);
      ++tally.stuck;
      return;
    }
    ++tally.resolved;
    const Place out(path[1].position, movers_, 0);
    const double length = (out.position - from.position).norm();
    const std::vector<ColliderIndex> met = oracle.met(from, out);
    ASSERT_TRUE(std::includes(inside.begin(), inside.end(), met.begin(), met.end())) << where(from);
    if (before.has_last_free && check_side(oracle, from, inside, out, before.last_free)) {
      ++tally.to_one_side;
      return;
    }
    if (!shortest) return;  // the opening is too narrow for the oracle
    const double expected = (*shortest - from.position).norm();
    // What is kept from a corner near the start turns the way, and so is more where it ends.
    const double turned = 4e-7 * expected / std::max(clearance(oracle, from, inside), 1e-7);
    ASSERT_LE(length, expected * (1 + 1e-6) + kept + turned)
        << "there is a way to " << shortest->transpose() << where(from);
    std::vector<ColliderIndex> all(oracle.scenery().colliders.size());
    std::iota(all.begin(), all.end(), ColliderIndex{0});
    const std::optional<Vec2d> free = oracle.find_free({.from = from, .end = from, .may_pass = all}, expected, 1e-7,
                                                       [](const Vec2d&) { return true; });
    tally.passed_beside += free && (*free - from.position).norm() < expected - kept;
  }

  /// @return whether it came out on the side of the last free position. It does if trial finds a way there.
  bool check_side(const ExactScenery& oracle, const Place& from, const std::vector<ColliderIndex>& inside,
                  const Place& out, const Vec2d& last_free) {
    const Place side(last_free, movers_, 0);
    const double length = (out.position - from.position).norm();
    const bool on_its_side = oracle.met(side, out).empty();
    constexpr int directions = 48;
    constexpr double stride = 0.05;
    // Nothing is said about a way that ends further away than the solids reach.
    const double reach = on_its_side ? length - roomy : 2;
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * std::numbers::pi * k / directions;
      const Vec2d way{std::cos(angle), std::sin(angle)};
      for (double distance = stride; distance < reach; distance += stride) {
        const Place end(from.position + way * distance, movers_, 0);
        const std::vector<ColliderIndex> met = oracle.met(from, end);
        if (!std::includes(inside.begin(), inside.end(), met.begin(), met.end())) break;
        const bool shorter = oracle.overlapped(end).empty() && oracle.met(side, end).empty() &&
                             clearance(oracle, end, {}) > roomy && open(oracle, from, end, inside) &&
                             open(oracle, side, end, {});
        EXPECT_FALSE(shorter) << "there is a way on the side of " << last_free.transpose() << " to "
                              << end.position.transpose() << where(from);
        if (shorter) return true;
      }
    }
    return on_its_side;
  }

  /// Whether the way is not the only one.
  bool open(const ExactScenery& oracle, const Place& from, const Place& end, const std::vector<ColliderIndex>& inside) {
    const Vec2d way = (end.position - from.position).normalized();
    for (const double side : {-roomy, roomy}) {
      const std::vector<ColliderIndex> met =
          oracle.met(from, Place(end.position + side * Vec2d{-way.y(), way.x()}, movers_, 0));
      if (!std::includes(inside.begin(), inside.end(), met.begin(), met.end())) return false;
    }
    return true;
  }

  /// Of all but some [m], as far as it is less than 1 m.
  double clearance(const ExactScenery& oracle, const Place& at, const std::vector<ColliderIndex>& except) const {
    double least = 1;
    for (const ColliderIndex collider : oracle.near(at, at, 1)) {
      const bool counts = !colliders_[collider].one_way && !std::binary_search(except.begin(), except.end(), collider);
      if (counts) least = std::min(least, oracle.separation(at, collider));
    }
    return least;
  }

  [[nodiscard]] std::string where(const Place& from) const {
    std::ostringstream text;
    text.precision(17);
    text << "\n  " << name_of(solids_) << ", seed " << seed_ << ", from " << from.position.transpose() << ", origin "
         << origin_.transpose() << ", status " << static_cast<int>(report_.status) << ", way";
    for (const PathPoint<double>& corner : report_.move.path)
      text << " (" << corner.position.x() << ", " << corner.position.y() << " @ " << corner.fraction << ")";
    if (last_free_) text << ", last free " << last_free_->transpose();
    for (const ColliderDef& collider : colliders_) {
      text << "\n  "
           << (collider.shape == ColliderDef::Shape::chain    ? "chain"
               : collider.shape == ColliderDef::Shape::circle ? "circle"
                                                              : "polygon");
      if (collider.shape == ColliderDef::Shape::circle) text << " r " << collider.radius;
      if (collider.one_way) text << " one way " << collider.one_way->transpose();
      if (collider.mover != no_mover) text << " at " << movers_[collider.mover].from.transpose();
      text << ":";
      if (collider.points.size() > 40)
        text << " " << collider.points.size() << " corners";
      else
        for (const Vec2d& v : collider.points) text << " (" << v.x() << ", " << v.y() << ")";
    }
    return text.str();
  }

  Solids solids_;
  std::uint64_t seed_;
  Random random_;
  Vec2d origin_{0, 0};
  double half_ = 1;  ///< Starts are this near the middle [m].
  bool with_movers_ = false;
  MoverIndex movers_wanted_ = 0;
  std::vector<ColliderDef> colliders_;
  std::vector<MoverMotion<double>> movers_;
  StepReport<double> report_;
  std::optional<Vec2d> last_free_;
};

class WayOut : public ::testing::TestWithParam<Solids> {};

TEST_P(WayOut, is_the_shortest_straight_one_or_there_is_none) {
  const int cases = std::max(200, sampled(steps_per_family() / 20));  // fewer cover too little
  Tally tally;
  for (std::uint64_t run = 0; tally.cases < cases; ++run) {
    Start(GetParam(), 7000003 * (static_cast<std::uint64_t>(GetParam()) + 1) + run).go(tally);
    if (HasFailure()) return;
  }
  std::printf("%s: %d starts, %d resolved, %d stuck, %d beside something, %d among movers, %d to one side\n",
              name_of(GetParam()).c_str(), tally.cases, tally.resolved, tally.stuck, tally.passed_beside,
              tally.among_movers, tally.to_one_side);
  EXPECT_GE(tally.resolved, cases * 0.3);
  EXPECT_GE(tally.stuck, cases * 0.005);
  EXPECT_GE(tally.passed_beside, cases * 0.02);
  EXPECT_GE(tally.among_movers, cases * 0.05);
  EXPECT_GE(tally.to_one_side, cases * 0.02);
}

TEST(WayOutOfWhatCrushed, is_taken_to_the_side_it_came_from_once_there_is_one) {
  // Pressed from the left by 0.2 m more than there is room up to a wall at the right, which then goes away.
  const double gap = 0.05;
  Judged run({box(-4, -4, -half_width - gap, 4, 0), box(half_width + gap, -4, 4, 4, 1)}, {0, 0}, 1);
  run.motions[0] = {{0, 0}, {0.3, 0}};
  EXPECT_TRUE(holds(run.step()));
  EXPECT_EQ(run.report.status, StepStatus::crushed);
  run.motions = {{{0.3, 0}, {0.3, 0}}, {{0, 0}, {9, 0}}};
  const StepJudgement still = run.step();
  EXPECT_EQ(run.report.status, StepStatus::stuck);
  EXPECT_FALSE(still.stuck_refuted);
  run.motions[1].from = run.motions[1].to;
  EXPECT_TRUE(holds(run.step()));
  EXPECT_EQ(run.report.status, StepStatus::moved);
  EXPECT_NEAR(run.state.position.x(), 0.3 - gap, 1e-6) << "beside what pressed it";
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, WayOut, ::testing::ValuesIn(all_solids),
                         [](const ::testing::TestParamInfo<Solids>& solids) { return name_of(solids.param); });

}  // namespace
}  // namespace paperproof::test
