/// Walks that leave ground which they follow, and kerbs that stop who climbs them.
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace paperproof::compare::test {
namespace {

constexpr double hardly = 1e-5;   // [m]
constexpr double walk = 0.09375;  // in one step [m]

Wanted to_the_right(void (*change)(Wanted&) = [](Wanted&) {}) {
  Wanted wanted = wanting({walk, -1e-3});
  wanted.from_ground = true;
  change(wanted);
  return wanted;
}
Wanted jump() {
  return to_the_right([](Wanted& w) { w.jumped = true; });
}
Wanted in_the_air() {
  return to_the_right([](Wanted& w) { w.from_ground = false; });
}

/// @param turned everything, and up with it [rad].
StepJudgement judged(TraceHeader header, TraceStep step, Wanted wanted, double turned) {
  const Eigen::Rotation2D<double> by(turned);
  const auto turn = [&by](Vec2d& v) { v = by * v; };
  if (turned != 0) {
    turn(header.up);
    for (Vec2d& point : header.points) turn(point);
    for (ColliderDef& collider : header.scenery.colliders)
      for (Vec2d& point : collider.points) turn(point);
    for (PathPoint& corner : step.path) turn(corner.position);
    for (Vec2d* v : {&step.velocity, &wanted.displacement, &wanted.velocity}) turn(*v);
  }
  step.requested = wanted.displacement;
  return Judge(header).judge(step, &wanted);
}

/// A walk off a ledge: where it ends, `drop` is between its foot and the lower floor.
struct OffALedge {
  double drop = 0.25;
  double snap = 0.25;
  Wanted wanted = to_the_right();
  std::vector<ColliderDef> more{};
  Vec2d ends_with{6, -0.064};
  double goes = 0;                ///< The lower floor, up in the step [m].
  bool drops = false;             ///< The input asks for it.
  double turned = 0;              ///< [rad]
  std::optional<double> falls{};  ///< As fast as it may [m/s].

  [[nodiscard]] bool is_left() const {
    const double level = -1e-3 + gap - drop;
    std::vector<ColliderDef> colliders{box(-9, -1, 0, 0), box(0, -9, 9, level - goes)};
    colliders[1].mover = 0;
    colliders.insert(colliders.end(), more.begin(), more.end());
    TraceHeader all = promising(colliders);
    all.character.snap = snap;
    all.character.max_fall_speed = falls;
    TraceStep off = step({{0.2, half_height + gap}, {0.2 + walk, half_height + gap - 1e-3}});
    off.movers = {{.from = {0, 0}, .to = {0, goes}}};
    off.velocity = ends_with;
    off.input.drop = drops;
    return judged(all, off, wanted, turned).ground_left;
  }
};

TEST(GroundThatIsLeft, is_walkable_and_less_than_the_snap_below) {
  EXPECT_TRUE((OffALedge{.drop = 0.001}.is_left()));
  EXPECT_TRUE((OffALedge{.drop = 0.25 - hardly}.is_left()));
  EXPECT_FALSE((OffALedge{.drop = 0.25 + hardly}.is_left()));
  EXPECT_FALSE((OffALedge{.drop = 0.001, .snap = 0}.is_left()));
  // A slope of 60 degrees stands on it and is met first.
  EXPECT_FALSE((OffALedge{.drop = 0.2, .more = {polygon({{0, -1}, {0.8, -1}, {0, 0.386}})}}.is_left()));
}

TEST(GroundThatIsLeft, is_left_on_purpose_by_who_jumps_or_rises) {
  EXPECT_FALSE((OffALedge{.wanted = jump()}.is_left()));
  EXPECT_FALSE((OffALedge{.drop = 0.1, .wanted = in_the_air()}.is_left()));
  // Faster up than a climb of 50 degrees would be.
  const Wanted rises = to_the_right([](Wanted& w) { w.velocity = {6, 8}; });
  EXPECT_FALSE((OffALedge{.drop = 0.1, .wanted = rises, .ends_with = {6, 8}}.is_left()));
  EXPECT_FALSE((OffALedge{.drop = 0.1, .wanted = rises}.is_left())) << "a ceiling may have stopped it";
}

TEST(GroundThatIsLeft, falls_no_faster_than_the_walk_and_may_carry_it) {
  EXPECT_TRUE((OffALedge{.drop = 0.1, .goes = 0.001}.is_left()));
  EXPECT_TRUE((OffALedge{.drop = 0.1, .goes = -0.1}.is_left()));
  EXPECT_FALSE((OffALedge{.drop = 0.1, .goes = -0.1, .falls = 6}.is_left()));
  // The lift that it stands on rises at 1 m/s, and it walks no steeper than 50 degrees on that.
  const auto rides = [](double rise) {
    Wanted wanted = to_the_right();
    wanted.ridden = 0;
    wanted.carried = {0, dt};
    wanted.velocity = {0.1, 1 + rise};
    return wanted;
  };
  EXPECT_TRUE((OffALedge{.drop = 0.1, .wanted = rides(0.1), .ends_with = {0.1, 1}}.is_left()));
  EXPECT_FALSE((OffALedge{.drop = 0.1, .wanted = rides(0.2), .ends_with = {0.1, 1}}.is_left()));
  EXPECT_FALSE((OffALedge{.drop = 0.1, .drops = true}.is_left()));
}

/// A walk that a kerb stops.
struct AtAKerb {
  double height = 0.25;
  double step_height = 0.5;
  Wanted wanted = to_the_right();
  std::vector<ColliderDef> more{};
  double deep = 8;  ///< So long is its top [m].
  double turned = 0;

  [[nodiscard]] bool is_missed() const {
    std::vector<ColliderDef> colliders{box(-9, -1, 9, 0), box(1, -1, 1 + deep, height)};
    colliders.insert(colliders.end(), more.begin(), more.end());
    TraceHeader all = promising(colliders);
    all.character.step_height = step_height;
    // The corner touches the slanted side at its height: 2 up for 1 aside, from the foot, which is half as wide, on.
    const double touched = std::min(half_width, half_width / 2 + height / 2);
    TraceStep stopped = step({{1 - touched - 0.01, half_height + gap}, {1 - touched - gap * 1.2, half_height + gap}});
    stopped.grounded = true;
    stopped.velocity = {0, 0};
    return judged(all, stopped, wanted, turned).kerb_missed;
  }
};

TEST(KerbThatIsMissed, is_no_higher_than_the_character_climbs) {
  for (const double height : {0.02, 0.1, 0.25, 0.4}) {
    EXPECT_TRUE((AtAKerb{.height = height}.is_missed())) << height;
    EXPECT_TRUE((AtAKerb{.height = height, .step_height = height + hardly}.is_missed())) << height;
    EXPECT_FALSE((AtAKerb{.height = height, .step_height = height - hardly}.is_missed())) << height;
    EXPECT_FALSE((AtAKerb{.height = height, .step_height = 0}.is_missed())) << height;
  }
}

TEST(KerbThatIsMissed, has_room_above_it) {
  const auto lintel = [](double height) { return std::vector{box(-9, height, 9, 9)}; };
  const double head = 2 * half_height;
  EXPECT_FALSE((AtAKerb{.height = 0.25, .more = lintel(head + 0.25)}.is_missed()));
  EXPECT_TRUE((AtAKerb{.height = 0.2, .more = lintel(head + 0.26)}.is_missed()));
  EXPECT_TRUE((AtAKerb{.height = 0.3, .more = lintel(head + 0.45)}.is_missed()));
  // Above the kerb alone: the half of the height leads below the lintel.
  const std::vector<ColliderDef> ahead{box(0.95, head + 0.26, 9, 9)};
  EXPECT_TRUE((AtAKerb{.height = 0.2, .more = ahead}.is_missed()));
  EXPECT_TRUE((AtAKerb{.height = 0.25 + hardly, .more = ahead}.is_missed())) << "it stands on the corner on the way";
  EXPECT_FALSE((AtAKerb{.height = 0.26 + hardly, .more = ahead}.is_missed()));
}

TEST(KerbThatIsMissed, has_ground_behind_its_edge) {
  EXPECT_TRUE((AtAKerb{.height = 0.3, .deep = 0.01}.is_missed())) << "a thin wall, on which a flat foot stands";
  const std::vector<ColliderDef> steep{polygon({{1, -1}, {1.4, -1}, {1.4, 1}, {1, 0.3}})};
  EXPECT_FALSE((AtAKerb{.height = 0.3, .more = steep}.is_missed()));
}

TEST(GroundAndKerbs, are_judged_alike_whatever_is_up) {
  for (const double turned : {0.5, 1.5, 3.0, -2.0}) {
    for (const double drop : {0.1, 0.26}) EXPECT_EQ((OffALedge{.drop = drop, .turned = turned}.is_left()), drop < 0.25);
    for (const double height : {0.2, 0.4, 0.51})
      EXPECT_EQ((AtAKerb{.height = height, .turned = turned}.is_missed()), height < 0.5) << height;
  }
}

TEST(KerbThatIsMissed, stops_a_walk) {
  EXPECT_FALSE((AtAKerb{.wanted = jump()}.is_missed()));
  EXPECT_FALSE(
      (AtAKerb{.wanted = to_the_right([](Wanted& w) { w.displacement.x() = w.velocity.x() = -walk; })}.is_missed()));
  EXPECT_FALSE((AtAKerb{.wanted = in_the_air()}.is_missed()));
}

/// Who rests with a slanted side on the corner of a kerb, and says that it stands.
struct OnACorner {
  double foot = 0.1;  ///< So high its foot is, half as high as the kerb [m].
  double step_height = 0.25;
  double snap = 0;
  bool walks = true;
  std::vector<ColliderDef> more{};

  [[nodiscard]] bool is_refuted() const {
    std::vector<ColliderDef> colliders{box(-9, -1, 9, 0), box(1, -1, 9, 2 * foot)};
    colliders.insert(colliders.end(), more.begin(), more.end());
    TraceHeader all = promising(colliders);
    all.character.step_height = step_height;
    all.character.snap = snap;
    const Vec2d at(1 - half_width / 2 - foot / 2 - gap * 1.2, half_height + foot);
    TraceStep rests = step({at, at});
    rests.grounded = true;
    rests.velocity = {0, 0};
    Wanted wanted = wanting({0, -1e-3});
    wanted.from_ground = walks;
    return judged(all, rests, wanted, 0).ground_refuted;
  }
};

TEST(StairThatIsStoodOn, is_climbed_no_higher_than_a_step) {
  EXPECT_FALSE((OnACorner{}.is_refuted()));
  EXPECT_FALSE((OnACorner{.step_height = 0.1 + hardly}.is_refuted()));
  EXPECT_TRUE((OnACorner{.step_height = 0.1 - hardly}.is_refuted()));
  EXPECT_TRUE((OnACorner{.more = {box(-9, 0.15 + 2 * half_height, 9, 9)}}.is_refuted())) << "there is no room";
  EXPECT_TRUE((OnACorner{.walks = false}.is_refuted())) << "a fall slides off";
}

TEST(StairThatIsStoodOn, is_gone_down_no_farther_than_a_snap) {
  EXPECT_FALSE((OnACorner{.step_height = 0, .snap = 0.1 + hardly}.is_refuted()));
  EXPECT_TRUE((OnACorner{.step_height = 0, .snap = 0.1 - hardly}.is_refuted()));
}

}  // namespace
}  // namespace paperproof::compare::test
