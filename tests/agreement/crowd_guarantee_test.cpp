/// Characters that were apart stay apart, from each other and from every solid: judged exactly, over random crowds in
/// tight rooms.
#include "oracle/exact.hpp"
#include "support/random.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/crowd.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace paperproof::test {
namespace {

using compare::ExactScenery;
using compare::Rational;

struct RationalPoint {
  Rational x;
  Rational y;
};

RationalPoint operator-(const RationalPoint& a, const RationalPoint& b) { return {a.x - b.x, a.y - b.y}; }
Rational cross(const RationalPoint& a, const RationalPoint& b) { return a.x * b.y - a.y * b.x; }
RationalPoint rational(const Vec2d& v) { return {Rational(v.x()), Rational(v.y())}; }

/// A straight part of a way between two fractions of the step.
struct Part {
  PathPoint<double> from;
  PathPoint<double> to;

  [[nodiscard]] RationalPoint at(const Rational& time) const {
    if (from.fraction == to.fraction) return rational(to.position);
    const Rational start(from.fraction);
    const Rational share = (time - start) / (Rational(to.fraction) - start);
    const RationalPoint a = rational(from.position);
    const RationalPoint way = rational(to.position) - a;
    return {a.x + way.x * share, a.y + way.y * share};
  }
};

/// Two characters of one convex shape, judged without the controller's geometry: each corner difference of the two is a
/// point of their Minkowski difference, and they overlap where no edge of either has the other wholly outside.
class PairJudge {
 public:
  explicit PairJudge(std::span<const Vec2d> hull) : hull_(hull.begin(), hull.end()) {}

  /// Whether the open shapes overlap at some moment of two straight motions that begin and end together. The relative
  /// motion is straight; for each edge line the largest "inside" over the corners is linear in time.
  [[nodiscard]] bool meet(const Part& one, const Part& other, double begin, double end) const {
    if (surely_apart(one, other)) return false;
    ++exact_decisions;
    const RationalPoint start = one.at(Rational(begin)) - other.at(Rational(begin));
    const RationalPoint finish = one.at(Rational(end)) - other.at(Rational(end));
    return met_on_segment(start, finish);
  }
  /// A jump of one of them, the other at a moment of its part.
  [[nodiscard]] bool meet_jump(const Part& jump, const Part& other, double time) const {
    const RationalPoint there = other.at(Rational(time));
    return met_on_segment(rational(jump.from.position) - there, rational(jump.to.position) - there);
  }
  [[nodiscard]] bool overlap(const Vec2d& one, const Vec2d& other) const {
    const Part first{{one, 0}, {one, 1}};
    const Part second{{other, 0}, {other, 1}};
    if (surely_apart(first, second)) return false;
    const RationalPoint difference = rational(one) - rational(other);
    return met_on_segment(difference, difference);
  }

  mutable std::size_t exact_decisions = 0;

 private:
  /// By boxes, or by one edge normal, with a margin that is far above the rounding of coordinates below 100 m.
  [[nodiscard]] bool surely_apart(const Part& one, const Part& other) const {
    constexpr double margin = 1e-9;
    const auto separated = [&](const Vec2d& normal, double width) {
      const auto along = [&](const Vec2d& p) { return normal.dot(p); };
      const double low = std::min(along(one.from.position), along(one.to.position));
      const double high = std::max(along(other.from.position), along(other.to.position));
      return low - high > width + margin;
    };
    for (std::size_t k = 0; k < hull_.size(); ++k) {
      const Vec2d edge = hull_[(k + 1) % hull_.size()] - hull_[k];
      const Vec2d normal = Vec2d{edge.y(), -edge.x()} / edge.norm();
      double low = 1e300;
      double high = -1e300;
      for (const Vec2d& point : hull_) {
        low = std::min(low, normal.dot(point));
        high = std::max(high, normal.dot(point));
      }
      if (separated(normal, high - low) || separated(-normal, high - low)) return true;
    }
    return false;
  }

  /// Whether the shape at d, for d anywhere on a segment, overlaps the one at the origin.
  [[nodiscard]] bool met_on_segment(const RationalPoint& start, const RationalPoint& finish) const {
    Rational entry = 0;
    Rational exit = 1;
    const bool still = start.x == finish.x && start.y == finish.y;
    for (std::size_t k = 0; k < hull_.size(); ++k) {
      const RationalPoint a = rational(hull_[k]);
      const RationalPoint edge = rational(hull_[(k + 1) % hull_.size()]) - a;
      Rational nearest = cross(edge, rational(hull_[0]) - a);
      for (const Vec2d& point : hull_) nearest = std::max(nearest, cross(edge, rational(point) - a));
      for (const int sign : {1, -1}) {
        // Inside where above zero.
        const Rational before = cross(edge, start) * sign + nearest;
        const Rational after = cross(edge, finish) * sign + nearest;
        if (before <= 0 && after <= 0) return false;
        if (still) continue;
        if (before <= 0) entry = std::max(entry, Rational(before / (before - after)));
        if (after <= 0) exit = std::min(exit, Rational(before / (before - after)));
      }
    }
    return still || entry < exit;
  }

  std::vector<Vec2d> hull_;
};

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
  std::size_t exact_decisions = 0;
};

class RandomCrowd {
 public:
  explicit RandomCrowd(std::uint64_t seed)
      : seed_(seed),
        random_(seed),
        extent_(character_.shape.box().upper - character_.shape.box().lower),
        wanted_(random_.integer(2, 16)),
        room_(extent_.x() * (1.5 + wanted_ * random_.between(0.3, 0.8)), extent_.y() * random_.between(1.3, 4)),
        scenery_(tight_room(random_, extent_, room_)),
        crowd_(scenery_, with_snap(character_)),
        oracle_(scenery_.as_run(), {character_.shape.hull().begin(), character_.shape.hull().end()}),
        judge_(character_.shape.hull()),
        report_(16) {}

  void go(Tally& tally) {
    place();
    if (states_.size() < 2) return;
    scratch_ = crowd_.make_scratch(states_.size());
    inputs_.resize(states_.size());
    const Vec2d gravity{0, random_.chance(0.85) ? -30.0 : random_.between(-5, 5)};
    const double dt = random_.chance(0.8) ? 1.0 / 60 : random_.log_between(1e-3, 0.2);
    for (int step = 0; step < 60; ++step) {
      for (std::size_t i = 0; i < states_.size(); ++i) {
        if (random_.chance(0.1)) inputs_[i].move = random_.integer(-1, 1);
        if (random_.chance(0.1)) inputs_[i].jump = !inputs_[i].jump;
        if (random_.chance(0.03)) launch(i, dt, tally);
      }
      take(gravity, dt, tally);
      if (::testing::Test::HasFatalFailure()) break;
    }
    tally.exact_decisions += judge_.exact_decisions;
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
    const double speed = random_.log_between(1e-3, random_.chance(0.3) ? 1e3 : 5) / dt;
    const double angle = random_.chance(0.3) ? random_.integer(0, 7) * std::numbers::pi / 4 : random_.angle();
    states_[i].velocity = {std::cos(angle) * speed, std::sin(angle) * speed};
  }

  void take(const Vec2d& gravity, double dt, Tally& tally) {
    before_ = states_;
    ASSERT_EQ(crowd_.step(states_, inputs_, gravity, dt, scratch_, report_), StepStatus::moved) << where();
    ++tally.steps;
    tally.with_impact += report_.impacts > 0;
    tally.impacts += report_.impacts;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const CrowdMember<double>& member = report_.members[i];
      ++tally.moves;
      (may_touch_ ? tally.stayed_touching : tally.stayed) += member.stayed;
      tally.dropped += member.step.status == StepStatus::dropped;
      tally.stuck += member.step.status == StepStatus::stuck;
      check_way(i);
      for (std::size_t j = i + 1; j < states_.size(); ++j) check_pair(i, j);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }

  void check_way(std::size_t i) {
    const auto& path = report_.members[i].step.move.path;
    ASSERT_GE(path.size(), 2U) << where();
    ASSERT_EQ(path[0].position, before_[i].position) << i << where();
    ASSERT_EQ(path[0].fraction, 0) << where();
    ASSERT_EQ(path.back().position, states_[i].position) << i << where();
    ASSERT_EQ(path.back().fraction, 1) << where();
    ASSERT_TRUE(states_[i].velocity.allFinite()) << where();
    for (std::size_t k = 1; k < path.size(); ++k) {
      ASSERT_GE(path[k].fraction, path[k - 1].fraction) << where();
      ASSERT_TRUE(oracle_.met(path[k - 1].position, path[k].position).empty()) << i << " passes a solid" << where();
    }
    ASSERT_TRUE(oracle_.overlapped(states_[i].position).empty()) << i << " ends in a solid" << where();
  }

  /// Both ways side by side: parts that take no time one after the other, the first character's first.
  void check_pair(std::size_t i, std::size_t j) {
    const auto& one = report_.members[i].step.move.path;
    const auto& other = report_.members[j].step.move.path;
    std::size_t a = 0;
    std::size_t b = 0;
    double now = 0;
    while (a + 1 < one.size() || b + 1 < other.size()) {
      const Part first = part(one, a);
      const Part second = part(other, b);
      if (a + 1 < one.size() && first.to.fraction == now && first.from.fraction == now) {
        ASSERT_FALSE(judge_.meet_jump(first, second, now)) << i << " meets " << j << " at once" << where();
        ++a;
      } else if (b + 1 < other.size() && second.to.fraction == now && second.from.fraction == now) {
        ASSERT_FALSE(judge_.meet_jump(second, first, now)) << j << " meets " << i << " at once" << where();
        ++b;
      } else {
        const double next = std::min(first.to.fraction, second.to.fraction);
        ASSERT_FALSE(judge_.meet(first, second, now, next))
            << i << " meets " << j << " between " << now << " and " << next << where();
        if (first.to.fraction == next) ++a;
        if (second.to.fraction == next) ++b;
        now = next;
      }
    }
    ASSERT_FALSE(judge_.overlap(states_[i].position, states_[j].position)) << i << " ends in " << j << where();
  }

  template <class Path>
  static Part part(const Path& path, std::size_t k) {
    if (k + 1 < path.size()) return {path[k], path[k + 1]};
    return {path.back(), path.back()};
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
  PairJudge judge_;
  CrowdReport<double> report_;
  CrowdScratch scratch_;
  std::vector<CharacterState<double>> states_;
  std::vector<CharacterState<double>> before_;
  std::vector<Input> inputs_;
};

TEST(CrowdGuarantee, those_who_were_apart_never_overlap_or_pass_through_each_other_or_a_solid) {
  Tally tally;
  const int wanted = steps_wanted("PAPERPROOF_CROWD_STEPS", 20000);
  for (std::uint64_t seed = 1; tally.steps < wanted && !HasFatalFailure(); ++seed) RandomCrowd(seed).go(tally);
  std::printf(
      "%d steps, %zu moves, %zu steps with impacts, %zu impacts, %d launches; %zu kept back, %zu "
      "more from no gap, %zu dropped, %zu stuck; %zu exact decisions\n",
      tally.steps, tally.moves, tally.with_impact, tally.impacts, tally.launches, tally.stayed, tally.stayed_touching,
      tally.dropped, tally.stuck, tally.exact_decisions);
  const double share = static_cast<double>(tally.with_impact) / tally.steps;
  EXPECT_GE(share, 0.3);
  EXPECT_LE(share, 0.95);
  // The last resort is one.
  EXPECT_LE(static_cast<double>(tally.stayed), 1e-4 * static_cast<double>(tally.moves));
}

TEST(CrowdGuarantee, the_judge_sees_a_meeting_where_there_is_one) {
  const CharacterDef character;
  const PairJudge judge(character.shape.hull());
  const double width = character.shape.box().upper.x() - character.shape.box().lower.x();
  const Part still{{{width, 0}, 0}, {{width, 0}, 1}};
  EXPECT_FALSE(judge.overlap({0, 0}, {width, 0})) << "touching is no overlap";
  EXPECT_TRUE(judge.overlap({0x1p-50, 0}, {width, 0}));
  EXPECT_FALSE(judge.meet({{{0, -5}, 0}, {{0, 5}, 1}}, still, 0, 1)) << "along each other";
  EXPECT_TRUE(judge.meet({{{0x1p-50, -5}, 0}, {{0x1p-50, 5}, 1}}, still, 0, 1)) << "both ends are free";
  EXPECT_TRUE(judge.meet_jump({{{-9, 0}, 0}, {{9, 0}, 0}}, still, 0.5));
}

}  // namespace
}  // namespace paperproof::test
