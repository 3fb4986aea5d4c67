/// octagon_sweep among random circles, judged by a slow twin that measures in long double.
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/paperproof.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>
#include <vector>

namespace paperproof::test {
namespace {

using Real = long double;
using Place = Vec2<Real>;

/// What the twin itself may be off by, for circles as large as they are here [m].
constexpr Real noise = 1e-12L;
/// The gap that is promised at a contact [m].
constexpr Real largest_gap = 1e-6L;

Place real(const Vec2d& v) { return v.cast<Real>(); }
Real cross_of(const Place& a, const Place& b) { return a.x() * b.y() - a.y() * b.x(); }

Real distance_to_segment(const Place& p, const Place& a, const Place& b) {
  const Place along = b - a;
  const Real square = along.squaredNorm();
  const Real share = square > 0 ? std::clamp((p - a).dot(along) / square, Real(0), Real(1)) : Real(0);
  return (p - a - along * share).norm();
}

bool cross_each_other(const Place& a, const Place& b, const Place& c, const Place& d) {
  const auto side = [](const Place& from, const Place& to, const Place& p) {
    return cross_of(Place(to - from), Place(p - from)) > 0;
  };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

/// Least distance between a convex outline and a point that goes straight; zero where it gets inside.
Real least_distance(const std::vector<Place>& outline, const Place& from, const Place& to) {
  Real least = std::min(distance_to_segment(outline[0], from, to), (from - outline[0]).norm());
  bool is_inside = true;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Place& a = outline[k];
    const Place& b = outline[(k + 1) % outline.size()];
    if (cross_each_other(a, b, from, to)) return 0;
    is_inside = is_inside && cross_of(Place(b - a), Place(from - a)) > 0;
    least = std::min(
        {least, distance_to_segment(a, from, to), distance_to_segment(from, a, b), distance_to_segment(to, a, b)});
  }
  return is_inside ? Real(0) : least;
}

struct Tally {
  int steps = 0;
  int contacts = 0;       ///< With circles.
  int corner_on_arc = 0;  ///< Of these,
  int edge_on_arc = 0;
  int slides = 0;   ///< Steps that went on after a contact with a circle.
  int bullets = 0;  ///< Steps of over ten times the circle that stopped them.
  int pushed = 0;   ///< Contacts with circles that move.
  int riding = 0;
  int inside = 0;    ///< Began inside a circle, and came out.
  int touching = 0;  ///< Began at a touch but for some ulps.
  int stuck = 0;
  int thrown = 0;              ///< Into something, with a last free position,
  int back_to_their_side = 0;  ///< and came out where that sees them.
  int crushed = 0;
  int dropped = 0;
  int walkable = 0;
  int steep = 0;
  int wedged = 0;
  int untouched = 0;  ///< Went the whole way.
  int broken = 0;
  Real least_gap = 1;  ///< Least separation from a circle on the way [m].
};

class CircleRun {
 public:
  CircleRun(std::uint64_t seed, Tally& tally) : random_(seed), seed_(seed), tally_(tally) {}

  void go() {
    make();
    const Scenery<double> scenery(def_);
    const Controller<double> controller(scenery, character_);
    for (const Vec2d& point : character_.shape.hull()) hull_.push_back(real(point));
    Scratch<double> scratch = controller.make_scratch();
    motions_.resize(scenery.mover_count());
    state_.position = origin_ + Vec2d{random_.between(-3, 3), random_.between(-1, 4)};
    Input input;
    for (int step = 0; step < 60 && tally_.broken == 0; ++step) {
      move_on();
      const double gravity = random_.chance(0.1) ? random_.between(-60, 60) : -30;
      if (random_.chance(0.2)) launch();
      if (random_.chance(0.01)) teleport(state_, origin_ + Vec2d{random_.between(-3, 3), random_.between(-1, 4)});
      if (random_.chance(0.02)) touch();
      if (random_.chance(0.02)) state_.position += Vec2d{random_.between(-1, 1), random_.between(-1, 1)};
      if (random_.chance(0.1)) input = {.move = random_.integer(-1, 1), .jump = random_.chance(0.3)};
      const CharacterState<double> before = state_;
      const StepContext<double> context{{0, random_.chance(0.1) ? 0 : gravity}, 1.0 / 60, motions_};
      const std::size_t overlapped = controller.overlaps(state_.position, context, scratch, overlapped_).value_or(0);
      controller.step(state_, input, context, scratch, report_);
      judge(before, std::span(overlapped_).first(std::min(overlapped, overlapped_.size())), step);
      if (!((state_.position - origin_).cwiseAbs().maxCoeff() < 40))
        teleport(state_, origin_ + Vec2d{random_.between(-4, 4), 3});
    }
  }

 private:
  ColliderDef circle(const Vec2d& centre, double radius) {
    return {.shape = ColliderDef::Shape::circle, .points = {centre}, .radius = radius};
  }

  void make() {
    if (random_.chance(0.5)) {
      std::vector<Vec2d> points;
      const int corners = random_.integer(3, 8);
      const double width = random_.log_between(0.05, 1);
      const double height = random_.log_between(0.05, 1);
      const double turn = random_.chance(0.3) ? 0.0 : random_.angle();
      for (int i = 0; i < corners; ++i) {
        const double angle = turn + (i + random_.between(0, 0.8)) * 2 * std::numbers::pi / corners;
        points.emplace_back(width * std::cos(angle), height * std::sin(angle));
      }
      try {
        character_.shape = CharacterShape(points);
      } catch (const InvalidCharacter&) {  // too thin: the article's then
      }
    }
    if (random_.chance(0.3)) character_.step_height = random_.between(0.05, 0.5);
    if (random_.chance(0.3)) character_.snap = random_.between(0.05, 0.5);
    const auto box = [](double left, double bottom, double right, double top) {
      return ColliderDef{.points = {{left, bottom}, {right, bottom}, {right, top}, {left, top}}};
    };
    if (random_.chance(0.7)) def_.colliders.push_back(box(-9, -2, 9, -1));
    if (random_.chance(0.3)) def_.colliders.push_back(box(-5, -1, -4, 9));
    if (random_.chance(0.3)) def_.colliders.push_back({.points = {{1, -1}, {5, -1}, {5, random_.between(-0.9, 3)}}});
    const int circles = random_.integer(1, 14);
    const double moving = random_.chance(0.2) ? 0.9 : 0.2;
    MoverIndex movers = 0;
    for (int i = 0; i < circles; ++i) {
      const double radius = random_.chance(0.7) ? random_.log_between(0.05, 3) : random_.log_between(1e-4, 1e5);
      const Vec2d near{random_.between(-4, 4), 0};
      const double angle = random_.chance(0.3) ? std::numbers::pi / 2 : random_.angle();
      const double height = random_.between(-1, 4);
      const Vec2d surface = near + Vec2d(0, random_.chance(0.2) ? -1 : height);
      const double far = radius < 1 ? 0 : radius;
      def_.colliders.push_back(circle(surface - far * Vec2d(std::cos(angle), std::sin(angle)), radius));
      if (random_.chance(moving)) def_.colliders.back().mover = movers++;
      if (random_.chance(0.05)) def_.colliders.back().surface_speed = random_.between(-3, 3);
    }
    if (random_.chance(0.1)) origin_ = {random_.between(-9e5, 9e5), random_.between(-9e5, 9e5)};
    for (ColliderDef& collider : def_.colliders)
      for (Vec2d& point : collider.points) point += origin_;
    for (MoverIndex i = 0; i < movers; ++i)
      courses_.push_back({random_.either_sign_log_between(1e-3, 2), random_.either_sign_log_between(1e-3, 2),
                          random_.between(0.5, 6), random_.angle()});
  }

  void move_on() {
    time_ += 1.0 / 60;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const auto& [x, y, pace, phase] = courses_[i];
      motions_[i].from = motions_[i].to;
      motions_[i].to = {x * std::sin(pace * time_ + phase), y * std::cos(pace * time_)};
      if (time_ < 0.02) motions_[i].from = motions_[i].to;
    }
  }

  void launch() {
    const double speed = random_.log_between(0.01, 3e4);
    const double angle = random_.chance(0.2) ? random_.integer(0, 3) * std::numbers::pi / 2 : random_.angle();
    state_.velocity = {speed * std::cos(angle), speed * std::sin(angle)};
  }

  /// Puts the character where it touches a circle but for some ulps.
  void touch() {
    const auto collider = static_cast<std::size_t>(random_.integer(0, static_cast<int>(def_.colliders.size()) - 1));
    const ColliderDef& def = def_.colliders[collider];
    if (def.shape != ColliderDef::Shape::circle || def.radius > 100) return;
    const MoverIndex mover = def.mover;
    const Vec2d centre = def.points[0] + (mover == no_mover ? Vec2d(0, 0) : motions_[mover].from);
    const double angle = random_.angle();
    const Vec2d along{std::cos(angle), std::sin(angle)};
    Real low = 0;
    Real high = Real(def.radius) + 3;
    for (int i = 0; i < 70; ++i) {
      const Real middle = (low + high) / 2;
      const Place at = real(centre) + real(along) * middle;
      const bool is_inside = least_distance(hull_, real(centre) - at, real(centre) - at) < Real(def.radius);
      (is_inside ? low : high) = middle;
    }
    Vec2d at = (real(centre) + real(along) * high).cast<double>();
    for (int i = random_.integer(-2, 2); i != 0; i += i < 0 ? 1 : -1)
      at.y() = std::nextafter(at.y(), i < 0 ? -1e9 : 1e9);
    teleport(state_, at);
    ++tally_.touching;
  }

  [[nodiscard]] Place offset(ColliderIndex collider, double fraction) const {
    const MoverIndex mover = def_.colliders[collider].mover;
    if (mover == no_mover) return Place::Zero();
    const Place from = real(motions_[mover].from);
    return from + (real(motions_[mover].to) - from) * Real(fraction);
  }
  /// Of a circle from the character on a straight way.
  [[nodiscard]] Real separation(ColliderIndex collider, const Vec2d& from, double begin, const Vec2d& to,
                                double end) const {
    const ColliderDef& def = def_.colliders[collider];
    const Place centre = real(def.points[0]);
    return least_distance(hull_, centre + offset(collider, begin) - real(from),
                          centre + offset(collider, end) - real(to)) -
           Real(def.radius);
  }
  [[nodiscard]] Real separation(ColliderIndex collider, const Vec2d& at, double fraction) const {
    return separation(collider, at, fraction, at, fraction);
  }

  /// Whether no circle is in the straight way from a place, as all are when the step begins.
  [[nodiscard]] bool is_seen_from(const Vec2d& place, const Vec2d& from) const {
    for (ColliderIndex collider = 0; collider < def_.colliders.size(); ++collider)
      if (def_.colliders[collider].shape == ColliderDef::Shape::circle &&
          separation(collider, place, 0, from, 0) < -noise)
        return false;
    return true;
  }
  [[nodiscard]] bool may_be_carried(const CharacterState<double>& before) const {
    for (ColliderIndex collider = 0; collider < def_.colliders.size(); ++collider) {
      const ColliderDef& def = def_.colliders[collider];
      if ((def.mover != no_mover || def.surface_speed != 0) && separation(collider, before.position, 0) < 1e-5L)
        return true;
    }
    return before.ride.ground != Ride<double>::none;
  }

  void fail(int step, const char* what, Real figure) {
    ++tally_.broken;
    std::ostringstream way;
    way.precision(17);
    for (std::size_t i = 0; i < def_.colliders.size(); ++i) {
      const ColliderDef& def = def_.colliders[i];
      way << "\n  " << i << ": " << def.points[0].transpose() << " r " << def.radius;
      if (def.mover != no_mover)
        way << " moves " << motions_[def.mover].from.transpose() << " -> " << motions_[def.mover].to.transpose();
    }
    for (const auto& crusher : state_.crushers) way << "\n  crusher " << crusher.collider;
    way << "\n status " << int(report_.status);
    for (const PathPoint<double>& corner : report_.move.path)
      way << "\n  at " << corner.fraction << ": " << corner.position.transpose();
    for (const Contact<double>& contact : report_.move.contacts)
      way << "\n  at " << contact.fraction << " meets " << contact.collider << " by " << contact.normal.transpose()
          << ", gap " << contact.separation;
    ADD_FAILURE() << what << ": seed " << seed_ << ", step " << step << ", " << static_cast<double>(figure)
                  << "; requested " << report_.requested.transpose() << way.str();
  }

  /// @param overlapped at first, by the controller's own word: that decides where the twin cannot.
  void judge(const CharacterState<double>& before, std::span<const ColliderIndex> overlapped, int step) {
    const MoveResult<double>& move = report_.move;
    ++tally_.steps;
    tally_.dropped += move.status == MoveStatus::dropped;
    tally_.walkable += move.ground.state == GroundState::walkable;
    tally_.steep += move.ground.state == GroundState::steep;
    tally_.wedged += move.ground.state == GroundState::wedge;
    tally_.riding += state_.ride.ground != Ride<double>::none;
    tally_.crushed += !move.crushed.empty();
    if (!state_.position.allFinite() || !state_.velocity.allFinite()) return fail(step, "not finite", 0);
    if (move.status == MoveStatus::out_of_range) return;
    if (move.status == MoveStatus::stuck) {
      ++tally_.stuck;
      if (overlapped.empty()) fail(step, "stuck in nothing", 0);
      return;
    }
    for (ColliderIndex collider = 0; collider < def_.colliders.size(); ++collider) {
      if (def_.colliders[collider].shape != ColliderDef::Shape::circle) continue;
      const auto is_it = [&](const Crusher<double>& crusher) { return crusher.collider == collider; };
      if (std::find(move.crushed.begin(), move.crushed.end(), collider) != move.crushed.end() ||
          std::any_of(before.crushers.begin(), before.crushers.end(), is_it) ||
          std::any_of(state_.crushers.begin(), state_.crushers.end(), is_it))
        continue;
      const Real at_first = separation(collider, before.position, 0);
      const bool is_named = std::find(overlapped.begin(), overlapped.end(), collider) != overlapped.end();
      if (std::abs(at_first) > noise && is_named != (at_first < 0)) fail(step, "overlaps it, or not", at_first);
      if (is_named && move.status == MoveStatus::crushed) continue;  // it is stuck there, too
      tally_.inside += is_named;
      // What moves and is overlapped may leave the character, too.
      const bool is_left = is_named && def_.colliders[collider].mover != no_mover;
      for (std::size_t k = 0; !is_left && k + 1 < move.path.size(); ++k) {
        if (is_named && move.path[k].fraction == 0 && move.path[k + 1].fraction == 0) continue;
        const Real gap = separation(collider, move.path[k].position, move.path[k].fraction, move.path[k + 1].position,
                                    move.path[k + 1].fraction);
        tally_.least_gap = std::min(tally_.least_gap, gap);
        if (!(gap >= -noise)) return fail(step, "passes into a circle", gap);
      }
      if (!(separation(collider, state_.position, 1) >= -noise)) return fail(step, "ends inside", 0);
    }
    if (!overlapped.empty() && before.has_last_free && move.path.size() > 1 && move.path[1].fraction == 0) {
      ++tally_.thrown;
      tally_.back_to_their_side += is_seen_from(before.last_free, move.path[1].position);
    }
    if (move.contacts.empty() && move.status == MoveStatus::moved && character_.snap == 0 && !before.crushed &&
        !may_be_carried(before)) {
      ++tally_.untouched;
      const Vec2d missing = state_.position - before.position - report_.requested;
      const bool is_made_free = move.path.size() > 2 || move.path[1].fraction == 0;
      if (!is_made_free && !(missing.norm() <= 1e-9 * (1 + report_.requested.norm())))
        fail(step, "stopped by nothing", missing.norm());
    }
    judge_contacts(before, step);
  }

  void judge_contacts(const CharacterState<double>& before, int step) {
    const MoveResult<double>& move = report_.move;
    bool slides = false;
    for (const Contact<double>& contact : move.contacts) {
      const ColliderDef& def = def_.colliders[contact.collider];
      if (def.shape != ColliderDef::Shape::circle) continue;
      ++tally_.contacts;
      tally_.pushed += def.mover != no_mover;
      slides = slides || (contact.fraction < 1 && (state_.position - before.position).norm() > 0);
      tally_.bullets += (report_.requested).norm() > 20 * def.radius;
      bool is_edge = false;
      for (std::size_t k = 0; k < hull_.size(); ++k) {
        const Place edge = hull_[(k + 1) % hull_.size()] - hull_[k];
        is_edge = is_edge || std::abs(cross_of(Place(-edge.y(), edge.x()).normalized(), real(contact.normal))) < 1e-15L;
      }
      (is_edge ? tally_.edge_on_arc : tally_.corner_on_arc)++;
      if (!(std::abs(contact.normal.norm() - 1) < 1e-14)) fail(step, "normal", contact.normal.norm());
      if (!(contact.separation <= largest_gap)) fail(step, "contact from afar", contact.separation);
      if (!(contact.separation >= 0) && move.crushed.empty()) fail(step, "contact inside", contact.separation);
      // The point is where the circle is at some time of the step: at its centre plus radius times normal.
      if (def.mover != no_mover) continue;
      const Real off = (real(contact.point) - real(def.points[0]) - real(contact.normal) * Real(def.radius)).norm();
      if (!(off <= largest_gap + 1e-14L * Real(def.radius))) fail(step, "contact point", off);
    }
    tally_.slides += slides;
    judge_first_impact(before, step);
  }

  /// A contact of the first leg is where the wanted motion touches the circle.
  void judge_first_impact(const CharacterState<double>& before, int step) {
    const MoveResult<double>& move = report_.move;
    if (move.contacts.empty() || move.status != MoveStatus::moved || may_be_carried(before)) return;
    if (character_.snap > 0 || character_.step_height > 0 || move.path[1].fraction == 0) return;
    const Contact<double>& first = move.contacts[0];
    if (def_.colliders[first.collider].shape != ColliderDef::Shape::circle) return;
    if (first.fraction > move.path[1].fraction + 1e-3 || move.path.size() < 3) return;
    // Who would be flung gives way from the start.
    const Vec2d leg = move.path[1].position - before.position;
    if ((leg - report_.requested * move.path[1].fraction).cwiseAbs().maxCoeff() > largest_gap) return;
    const Vec2d there = before.position + report_.requested * first.fraction;
    const Real rounding = 1e-15L * Real(report_.requested.norm() + def_.colliders[first.collider].radius) + 1e-9L;
    const Real gap = separation(first.collider, there, first.fraction);
    if (!(gap >= -rounding && gap <= largest_gap)) fail(step, "time of impact", gap);
  }

  struct Course {
    double x, y, pace, phase;
  };
  Random random_;
  std::uint64_t seed_;
  Tally& tally_;
  SceneryDef def_;
  std::array<ColliderIndex, 64> overlapped_{};
  Vec2d origin_{0, 0};
  CharacterDef character_;
  std::vector<Place> hull_;
  std::vector<Course> courses_;
  std::vector<MoverMotion<double>> motions_;
  CharacterState<double> state_;
  StepReport<double> report_;
  double time_ = 0;
};

TEST(AmongRandomCircles, no_step_gets_into_one) {
  const int wanted = steps_wanted("PAPERPROOF_CIRCLE_STEPS", sampled(60'000));
  auto seed = static_cast<std::uint64_t>(steps_wanted("PAPERPROOF_CIRCLE_FIRST_SEED", 1));
  Tally tally;
  for (; tally.steps < wanted && tally.broken == 0; ++seed) CircleRun(seed, tally).go();
  std::printf(
      "%d steps: %d contacts with circles (%d of a corner, %d of an edge), %d slides, %d bullets, %d with what moves, "
      "%d riding, %d from inside (%d of %d to their side), %d from a touch, %d stuck, %d crushed, %d dropped, %d "
      "walkable, %d steep, %d wedged, "
      "%d untouched; "
      "least gap %.3g m\n",
      tally.steps, tally.contacts, tally.corner_on_arc, tally.edge_on_arc, tally.slides, tally.bullets, tally.pushed,
      tally.riding, tally.inside, tally.back_to_their_side, tally.thrown, tally.touching, tally.stuck, tally.crushed,
      tally.dropped, tally.walkable, tally.steep, tally.wedged, tally.untouched, static_cast<double>(tally.least_gap));
  EXPECT_EQ(tally.broken, 0);
  if (wanted < 20'000) return;
  // So that it is known to have looked at everything.
  EXPECT_GT(tally.contacts, tally.steps / 10);
  EXPECT_GT(tally.corner_on_arc, tally.steps / 50);
  EXPECT_GT(tally.edge_on_arc, tally.steps / 50);
  EXPECT_GT(tally.slides, tally.steps / 50);
  EXPECT_GT(tally.untouched, tally.steps / 10);
  for (const int some : {tally.bullets, tally.pushed, tally.riding, tally.inside, tally.touching, tally.stuck,
                         tally.walkable, tally.steep, tally.wedged})
    EXPECT_GT(some, tally.steps / 1000);
  EXPECT_GT(tally.crushed, tally.steps / 20'000);
  EXPECT_GT(tally.thrown, tally.steps / 1000);
  EXPECT_GT(tally.back_to_their_side, tally.thrown / 2);
}

/// Four characters that are thrown about among circles, some of which move.
class CrowdRun {
 public:
  explicit CrowdRun(std::uint64_t seed) : random_(seed) {}

  struct Tally {
    int steps = 0;
    int contacts = 0;
    int met = 0;
    int crushed = 0;
    Real least_gap = 1;
  };

  void go(Tally& tally) {
    SceneryDef def{{{.points = {{-9, -2}, {9, -2}, {9, -1}, {-9, -1}}}}};
    const int circles = random_.integer(2, 10);
    MoverIndex movers = 0;
    for (int i = 0; i < circles; ++i) {
      const double radius = random_.log_between(0.02, 2);
      const Vec2d centre{random_.between(-4, 4), random_.between(-1, 3)};
      def.colliders.push_back({.shape = ColliderDef::Shape::circle, .points = {centre}, .radius = radius});
      if (random_.chance(0.3)) def.colliders.back().mover = movers++;
    }
    const Scenery<double> scenery(def);
    const Crowd<double> crowd(scenery, character_);
    for (const Vec2d& point : character_.shape.hull()) hull_.push_back(real(point));
    CrowdScratch scratch = crowd.make_scratch(4);
    CrowdReport<double> report(4);
    std::vector<CharacterState<double>> states(4);
    std::vector<Input> inputs(4);
    std::vector<MoverMotion<double>> motions(movers);
    for (std::size_t k = 0; k < states.size(); ++k) states[k].position = {2.0 * static_cast<double>(k) - 3, 6};
    for (int step = 0; step < 60; ++step, ++tally.steps) {
      for (std::size_t i = 0; i < motions.size(); ++i) {
        const double time = step / 60.0 + static_cast<double>(i);
        motions[i].from = step == 0 ? Vec2d(0, 0) : motions[i].to;
        motions[i].to = {motions[i].from.x() + 0.05 * std::sin(3 * time), motions[i].from.y() + 0.05 * std::cos(time)};
      }
      for (CharacterState<double>& state : states)
        if (random_.chance(0.1)) state.velocity = {random_.between(-40, 40), random_.between(-40, 40)};
      const std::vector<CharacterState<double>> before = states;
      ASSERT_EQ(crowd.step(states, inputs, {{0, -30}, 1.0 / 60, motions}, scratch, report), StepStatus::moved);
      for (std::size_t k = 0; k < states.size(); ++k) judge(def, motions, before[k], report.members[k], tally);
    }
  }

 private:
  void judge(const SceneryDef& def, const std::vector<MoverMotion<double>>& motions,
             const CharacterState<double>& before, const CrowdMember<double>& member, Tally& tally) {
    const MoveResult<double>& move = member.step.move;
    tally.contacts += static_cast<int>(move.contacts.size());
    tally.met += static_cast<int>(member.met.size());
    tally.crushed += !move.crushed.empty();
    if (before.crushed || !move.crushed.empty() || before.stuck_steps > 0 || move.status == MoveStatus::stuck) return;
    for (std::size_t i = 1; i < def.colliders.size(); ++i) {
      const ColliderDef& circle = def.colliders[i];
      const auto centre_at = [&](double fraction) -> Place {
        if (circle.mover == no_mover) return real(circle.points[0]);
        const Place from = real(motions[circle.mover].from);
        return real(circle.points[0]) + from + (real(motions[circle.mover].to) - from) * Real(fraction);
      };
      for (std::size_t k = 0; k + 1 < move.path.size(); ++k) {
        const Real gap = least_distance(hull_, centre_at(move.path[k].fraction) - real(move.path[k].position),
                                        centre_at(move.path[k + 1].fraction) - real(move.path[k + 1].position)) -
                         Real(circle.radius);
        tally.least_gap = std::min(tally.least_gap, gap);
        ASSERT_GE(gap, -noise);
      }
    }
  }

  Random random_;
  CharacterDef character_;
  std::vector<Place> hull_;
};

TEST(AmongRandomCircles, no_member_of_a_crowd_gets_into_one) {
  const int wanted = steps_wanted("PAPERPROOF_CIRCLE_STEPS", sampled(60'000)) / 10;
  CrowdRun::Tally tally;
  for (std::uint64_t seed = 1; tally.steps < wanted; ++seed) {
    CrowdRun(seed).go(tally);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  std::printf("%d steps of four: %d contacts, %d meetings, %d crushed; least gap %.3g m\n", tally.steps, tally.contacts,
              tally.met, tally.crushed, static_cast<double>(tally.least_gap));
  EXPECT_GT(tally.contacts, tally.steps / 4);
  EXPECT_GT(tally.met, tally.steps / 50);
}

}  // namespace
}  // namespace paperproof::test
