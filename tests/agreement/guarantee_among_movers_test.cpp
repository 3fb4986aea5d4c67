/// The guarantee of octagon_sweep against the exact oracle, among up to 64 movers: boxes, papers, chains, one-way
/// chains and rows of tiles, at speeds up to 1e6 m per step, in random scenery that stands still.
#include "oracle/exact.hpp"
#include "support/random_sceneries.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace paperproof::test {
namespace {

using compare::ExactScenery;
using compare::Place;

/// Room for a crushed character is looked for no farther than this [m]: nearly all that could be within its reach.
constexpr double most_reach = 0.3;
/// Openings narrower than twice this count as closed [m].
constexpr double least_clearance = 1e-7;

struct Tally {
  int steps = 0;
  int with_contact = 0;
  int riding = 0;
  int crushed = 0;
  int dropped = 0;
  int stuck = 0;
  int violations = 0;
  int room_looked_for = 0;
  int crushed_with_room = 0;
};

/// Something that moves about in an arena of 12 m.
struct Body {
  Vec2d velocity;  ///< [m per step]
  double until_turn = 0;
};

/// @param colliders where the shapes of the movers are added.
void add_mover(std::vector<ColliderDef>& colliders, MoverIndex mover, Random& r, const Vec2d& origin) {
  const auto add = [&](std::vector<Vec2d> points, ColliderDef::Shape shape = ColliderDef::Shape::polygon) {
    ColliderDef def{.shape = shape, .points = std::move(points), .mover = mover};
    const double offset_x = r.between(-5, 5);
    const double offset_y = r.between(-4, 4);
    for (Vec2d& p : def.points) p += origin + Vec2d{offset_x, offset_y};
    if (r.chance(0.1)) def.surface_speed = r.between(-5, 5);
    colliders.push_back(def);
  };
  const double width = r.between(0.2, 3);
  const double height = r.between(0.1, 1.5);
  const double thin = r.log_between(1e-6, 0.05);
  switch (r.integer(0, 6)) {
    case 0:
    case 1:
      return add({{0, 0}, {width, 0}, {width, height}, {0, height}});
    case 2:
      return add({{0, 0}, {width, r.between(-1, 1)}, {0.5 * width, 1.5}});
    case 3:
      return add({{0, 0}, {thin, 0}, {thin, 2 * height}, {0, 2 * height}});
    case 4:
      return add({{0, 0}, {width, r.between(-1, 1)}}, ColliderDef::Shape::chain);
    case 5:
      add({{0, 0}, {width, r.between(-0.5, 0.5)}}, ColliderDef::Shape::chain);
      colliders.back().one_way = Vec2d{0, 1};
      return;
    default:
      for (int i = 0; i < 6; ++i) {
        ColliderDef tile{.points = {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}, .mover = mover};
        const Vec2d at{i * 0.5, r.chance(0.2) ? 0.5 : 0};
        for (Vec2d& p : tile.points) p += origin + at;
        colliders.push_back(tile);
      }
  }
}

template <class Scalar>
class RandomRun {
 public:
  RandomRun(Family family, std::uint64_t seed)
      : family_(family),
        seed_(seed),
        random_(seed),
        origin_(random_.chance(0.8) ? Vec2d{0, 0} : Vec2d{far(), far()}),
        scenery_(scenery()),
        controller_(scenery_, character()),
        oracle_(scenery_.as_run(), hull()),
        scratch_(controller_.make_scratch()),
        motions_(scenery_.mover_count()),
        bodies_(scenery_.mover_count()) {}

  void go(Tally& tally) {
    state_.position = (origin_ + Vec2d{random_.between(-4, 4), random_.between(-3, 5)}).cast<Scalar>();
    const double dt = random_.chance(0.7) ? 1.0 / 60 : random_.log_between(1e-3, 0.1);
    Input input;
    for (int step = 0; step < 60; ++step) {
      if (random_.chance(0.1)) input.move = random_.integer(-1, 1);
      if (random_.chance(0.1)) input.jump = !input.jump;
      if (random_.chance(0.05)) launch(dt);
      move_bodies();
      take(input, static_cast<Scalar>(dt), tally);
      const bool gone = (state_.position.template cast<double>() - origin_).cwiseAbs().maxCoeff() > 14;
      if (gone || ::testing::Test::HasFailure()) return;
    }
  }

 private:
  double far() { return (random_.chance(0.5) ? 1 : -1) * random_.log_between(1, 9.9e5); }

  SceneryDef scenery() {
    SceneryDef def = random_.chance(0.8) ? random_scenery(family_, random_, origin_) : SceneryDef{};
    const int movers = random_.chance(0.1) ? 64 : random_.integer(1, 8);
    for (int i = 0; i < movers; ++i) add_mover(def.colliders, static_cast<MoverIndex>(i), random_, origin_);
    def_ = def;
    return def;
  }

  CharacterDef character() {
    CharacterDef def;
    if (random_.chance(0.3)) def.snap = 0.5;
    if (random_.chance(0.2)) def.max_climb_degrees = random_.between(0, 89);
    return def;
  }

  std::vector<Vec2d> hull() {
    std::vector<Vec2d> points;
    for (const Vec2d& p : controller_.character().shape.hull())
      points.push_back(p.cast<Scalar>().template cast<double>());
    return points;
  }

  void launch(double dt) {
    const double speed = random_.log_between(1e-3, random_.chance(0.2) ? 1e6 : 10) / dt;
    const double angle = random_.angle();
    state_.velocity = Vec2d{std::cos(angle) * speed, std::sin(angle) * speed}.cast<Scalar>();
  }

  void move_bodies() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      Body& body = bodies_[i];
      MoverMotion<Scalar>& motion = motions_[i];
      if (body.until_turn-- <= 0) turn(body);
      motion.from = motion.to;
      Vec2d to = motion.from.template cast<double>() + body.velocity;
      // Back to the arena.
      for (const Eigen::Index k : {0, 1})
        if (std::abs(to[k]) > 6 && to[k] * body.velocity[k] > 0) body.velocity[k] = -body.velocity[k];
      if (to.cwiseAbs().maxCoeff() > 1e6) to.setZero();
      motion.to = to.cast<Scalar>();
    }
  }

  void turn(Body& body) {
    body.until_turn = random_.integer(3, 40);
    const double speed =
        random_.chance(0.02) ? random_.log_between(1, 1e6) : random_.log_between(1e-4, random_.chance(0.3) ? 2 : 0.2);
    const double angle = random_.chance(0.5) ? random_.integer(0, 7) * std::numbers::pi / 4 : random_.angle();
    body.velocity = Vec2d{std::cos(angle), std::sin(angle)} * speed;
    if (random_.chance(0.15)) body.velocity.setZero();
    if (random_.chance(0.3)) body.velocity.x() = 0;
    if (random_.chance(0.3)) body.velocity.y() = 0;
  }

  void take(const Input& input, Scalar dt, Tally& tally) {
    const Vec2<Scalar> gravity{0, -30};
    const StepStatus status = controller_.step(state_, input, gravity, dt, motions_, scratch_, report_);
    ++tally.steps;
    ASSERT_NE(status, StepStatus::invalid_input) << where();
    if (status == StepStatus::out_of_range) {
      state_ = CharacterState<Scalar>{};
      state_.position = origin_.cast<Scalar>();
      return;
    }
    tally.with_contact += !report_.move.contacts.empty();
    tally.riding += state_.ride.ground != Ride<Scalar>::none;
    tally.crushed += !report_.move.crushed.empty();
    tally.dropped += status == StepStatus::dropped;
    tally.stuck += status == StepStatus::stuck;
    judge(status, tally);
  }

  void judge(StepStatus status, Tally& tally) {
    exact_motions_.clear();
    for (const MoverMotion<Scalar>& m : motions_)
      exact_motions_.push_back({m.from.template cast<double>(), m.to.template cast<double>()});
    std::vector<Place> path;
    for (const PathPoint<Scalar>& corner : report_.move.path)
      path.emplace_back(corner.position.template cast<double>(), exact_motions_, static_cast<double>(corner.fraction));
    const std::vector<ColliderIndex> at_start = oracle_.overlapped(path.front());
    const std::vector<ColliderIndex> at_end = oracle_.overlapped(path.back());
    const auto excused = [&](ColliderIndex c) { return contains(at_start, c) || crushes(c); };
    std::vector<ColliderIndex> broken;
    for (std::size_t i = 1; i < path.size(); ++i)
      for (const ColliderIndex c : oracle_.met(path[i - 1], path[i]))
        if (!excused(c)) broken.push_back(c);
    for (const ColliderIndex c : at_end)
      if (!excused(c) || (!crushes(c) && status != StepStatus::stuck && status != StepStatus::crushed))
        broken.push_back(c);
    const bool room = at_start.empty() && has_room(path, tally);
    tally.violations += !broken.empty();
    tally.crushed_with_room += room;
    if (std::is_same_v<Scalar, float>) return;
    ASSERT_TRUE(broken.empty()) << "meets " << names(broken) << where();
    ASSERT_FALSE(room) << "crushed beside room at " << room_.transpose() << where();
    ASSERT_TRUE(state_.position.allFinite() && state_.velocity.allFinite()) << where();
    ASSERT_FALSE(report_.move.path.overflowed() || report_.move.crushed.overflowed()) << where();
    ASSERT_EQ(report_.move.path.back().fraction, 1) << where();
    ASSERT_EQ(report_.move.path.back().position, state_.position) << where();
    for (const Contact<Scalar>& contact : report_.move.contacts) ASSERT_LE(contact.separation, 1e-6) << where();
  }

  static bool contains(const std::vector<ColliderIndex>& all, ColliderIndex one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  }

  [[nodiscard]] bool crushes(ColliderIndex collider) const {
    const auto& crushed = report_.move.crushed;
    return std::find(crushed.begin(), crushed.end(), collider) != crushed.end();
  }

  /// A place at the end of the step, no farther than the crushing movers go, that a straight motion from a corner of
  /// the way reaches without meeting anything.
  bool has_room(const std::vector<Place>& path, Tally& tally) {
    double reach = 0;
    for (const ColliderIndex c : report_.move.crushed) {
      const MoverMotion<double>& motion = exact_motions_[scenery_.as_run().colliders[c].mover];
      reach = std::max(reach, (motion.to - motion.from).norm());
    }
    if (reach == 0 || reach > most_reach) return false;
    ++tally.room_looked_for;
    const auto reached = [&](const Vec2d& q) {
      const Place there(q, exact_motions_, 1);
      return std::any_of(path.begin(), std::prev(path.end()), [&](const Place& corner) {
        return oracle_.overlapped(corner).empty() && oracle_.met(corner, there).empty();
      });
    };
    const auto room = oracle_.find_free(path.back(), reach + 1e-6, least_clearance, {}, reached);
    if (room) room_ = *room;
    return room.has_value();
  }

  static std::string names(const std::vector<ColliderIndex>& colliders) {
    std::string text;
    for (const ColliderIndex collider : colliders) text += std::to_string(collider) + " ";
    return text;
  }

  [[nodiscard]] std::string where() const {
    std::ostringstream text;
    text.precision(17);
    text << "\n  " << name_of(family_) << ", seed " << seed_ << ", status " << static_cast<int>(report_.status)
         << ", requested " << report_.requested.transpose() << ", way";
    for (const PathPoint<Scalar>& corner : report_.move.path)
      text << " (" << corner.position.x() << ", " << corner.position.y() << " @ " << corner.fraction << ")";
    text << ", contacts";
    for (const Contact<Scalar>& c : report_.move.contacts) {
      text << "\n    " << c.collider << " n " << c.normal.transpose() << " @ " << c.fraction << " gap " << c.separation;
      const MoverIndex mover = scenery_.as_run().colliders[c.collider].mover;
      if (mover != no_mover) text << " mover by " << (motions_[mover].to - motions_[mover].from).transpose();
    }
    text << "\n  crushed";
    for (const ColliderIndex c : report_.move.crushed) {
      const MoverIndex mover = scenery_.as_run().colliders[c].mover;
      text << " " << c << " by " << (motions_[mover].to - motions_[mover].from).transpose();
    }
    return text.str();
  }

  Family family_;
  std::uint64_t seed_;
  Random random_;
  Vec2d origin_;
  SceneryDef def_;
  Scenery<Scalar> scenery_;
  Controller<Scalar> controller_;
  ExactScenery oracle_;
  Scratch<Scalar> scratch_;
  CharacterState<Scalar> state_;
  StepReport<Scalar> report_;
  std::vector<MoverMotion<Scalar>> motions_;
  std::vector<Body> bodies_;
  std::vector<MoverMotion<double>> exact_motions_;
  Vec2d room_{0, 0};
};

class AmongMovers : public ::testing::TestWithParam<Family> {};

template <class Scalar>
Tally run_family(Family family, int steps) {
  Tally tally;
  for (std::uint64_t run = 0; tally.steps < steps; ++run) {
    try {
      RandomRun<Scalar>(family, 2000003 * (static_cast<std::uint64_t>(family) + 1) + run).go(tally);
    } catch (const InvalidScenery&) {
      // Far from the origin neighbouring vertices become one in float.
      EXPECT_EQ(sizeof(Scalar), sizeof(float));
    }
    if (::testing::Test::HasFailure()) break;
  }
  std::printf(
      "%s in %s: %d steps, %d with contact, %d riding, %d crushed, %d stuck, %d dropped; %d violations, %d of "
      "%d crushes with room\n",
      name_of(family).c_str(), sizeof(Scalar) == 8 ? "double" : "float", tally.steps, tally.with_contact, tally.riding,
      tally.crushed, tally.stuck, tally.dropped, tally.violations, tally.crushed_with_room, tally.room_looked_for);
  return tally;
}

TEST_P(AmongMovers, no_step_passes_a_solid_or_ends_inside_one_that_does_not_crush) {
  const Tally tally = run_family<double>(GetParam(), steps_per_family());
  // The generators must really meet the solids, and also miss them.
  EXPECT_GE(tally.with_contact, tally.steps * 0.1);
  EXPECT_LE(tally.with_contact, tally.steps * 0.9);
  EXPECT_GT(tally.riding, 0);
  EXPECT_GT(tally.crushed, 0);
  EXPECT_LT(tally.crushed, tally.steps / 5);
}

TEST_P(AmongMovers, in_float_what_breaks_is_counted) {
  const Tally tally = run_family<float>(GetParam(), steps_per_family() / 9);
  EXPECT_GE(tally.steps, steps_per_family() / 9);
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, AmongMovers, ::testing::ValuesIn(all_families),
                         [](const ::testing::TestParamInfo<Family>& family) { return name_of(family.param); });

}  // namespace
}  // namespace paperproof::test
