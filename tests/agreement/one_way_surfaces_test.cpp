/// A one-way chain is one surface: who sets out above it is held as by its two-sided twin, and who does not passes as
/// if it were not there. Peaks, arches, hills, sawteeth and platforms that are flat but for noise, whole or in several
/// colliders, chains and solids, at rest and moving; and exact ties on a lattice, where two implementations must agree.
#include "agreement/recorded.hpp"
#include "oracle/judge.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <sstream>

#include "one_way_surfaces.hpp"

namespace paperproof::test {
namespace {

using compare::ExactScenery;
using compare::Place;

enum class Shape { noise, arch, hill, sawtooth, peak };
constexpr std::array all_shapes{Shape::noise, Shape::arch, Shape::hill, Shape::sawtooth, Shape::peak};
constexpr std::array<const char*, all_shapes.size()> shape_names{"noise", "arch", "hill", "sawtooth", "peak"};

/// From left to right, around the origin.
std::vector<Vec2d> random_line(Shape shape, Random& random) {
  std::vector<Vec2d> line;
  switch (shape) {
    case Shape::noise: {
      const double noise = random.log_between(1e-7, 1e-4);
      const double apart = random.log_between(0.02, 1);
      for (double x = -3; x <= 3; x += apart) line.emplace_back(x, random.integer(-1, 1) * noise);
      break;
    }
    case Shape::arch: {
      const int segments = random.integer(4, 64);
      const double width = random.between(1.5, 3);
      const double height = random.between(0.2, 2);
      for (int i = 0; i <= segments; ++i) {
        const double angle = std::numbers::pi * (1 - static_cast<double>(i) / segments);
        line.emplace_back(width * std::cos(angle), height * std::sin(angle));
      }
      break;
    }
    case Shape::hill: {
      Vec2d at{-3, 0};
      line.push_back(at);
      for (const int segments = random.integer(2, 8); static_cast<int>(line.size()) <= segments;) {
        const double along = random.between(0.2, 2);
        at += Vec2d{along, along * random.between(-1.2, 1.2)};
        line.push_back(at);
      }
      break;
    }
    case Shape::sawtooth: {
      const double tooth = random.log_between(0.05, 1.5);
      const double height = tooth * random.between(0.05, 1.5);
      const double lean = random.between(0.1, 0.9);
      for (double x = -3; x <= 3; x += tooth) {
        line.emplace_back(x, 0);
        line.emplace_back(x + lean * tooth, height);
      }
      break;
    }
    case Shape::peak: {
      const double left = random.between(0.05, 1.5);
      const double right = random.between(0.05, 1.5);
      line = {{-3, -3 * left}, {0, 0}, {3, -3 * right}};
      break;
    }
  }
  return line;
}

/// A report names so many that were dropped through in one step.
constexpr std::size_t most_colliders = 32;

/// The line in one collider or several, each of which may run either way.
std::vector<ColliderDef> colliders_of(const std::vector<Vec2d>& line, MoverIndex mover, Random& random) {
  const double cut = random.chance(0.5) ? 0 : random.between(0, 1);
  std::vector<ColliderDef> colliders;
  std::vector<Vec2d> part{line[0]};
  for (std::size_t i = 1; i < line.size(); ++i) {
    part.push_back(line[i]);
    const bool last = i + 1 == line.size() || colliders.size() + 1 == most_colliders;
    if (i + 1 < line.size() && (last || !random.chance(cut))) continue;
    if (random.chance(0.3)) std::reverse(part.begin(), part.end());
    colliders.push_back({.shape = ColliderDef::Shape::chain, .points = part, .one_way = Vec2d{0, 1}, .mover = mover});
    part = {line[i]};
  }
  return colliders;
}

CharacterDef random_character(Random& random) {
  CharacterDef def;
  const int kind = random.integer(0, 3);
  if (kind == 1) def.shape = CharacterShape(std::vector<Vec2d>{{-0.3, -0.6}, {0.3, -0.6}, {0.3, 0.6}, {-0.3, 0.6}});
  if (kind == 2) def.shape = CharacterShape(std::vector<Vec2d>{{-0.4, 0.4}, {0, -0.6}, {0.4, 0.4}});
  if (random.chance(0.3)) def.snap = 0.3;
  return def;
}

/// Where a character is in relation to a line. Told apart from the code that is tested: by heights, in doubles.
enum class Stands { above, not_above, too_close_to_tell };

class Heights {
 public:
  Heights(std::vector<Vec2d> line, std::span<const Vec2d> hull) : line_(std::move(line)), hull_(hull) {}

  [[nodiscard]] Stands of(const Vec2d& position) const {
    constexpr double rounding = 1e-9;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec2d& corner : hull_)
      least = std::min(least, (position + corner).y() - height((position + corner).x()));
    for (const Vec2d& vertex : std::span(line_).subspan(1, line_.size() - 2))
      if (const auto rim = rim_at(vertex.x() - position.x())) least = std::min(least, position.y() + *rim - vertex.y());
    if (std::abs(least) <= rounding * (1 + position.cwiseAbs().maxCoeff())) return Stands::too_close_to_tell;
    return least > 0 ? Stands::above : Stands::not_above;
  }
  /// Whether it has something of the line itself below it, or beside.
  [[nodiscard]] bool beside(const Vec2d& position) const {
    double low = 0;
    double high = 0;
    for (const Vec2d& corner : hull_) {
      low = std::min(low, corner.x());
      high = std::max(high, corner.x());
    }
    return position.x() + low >= line_.back().x() || position.x() + high <= line_.front().x();
  }

 private:
  [[nodiscard]] double height(double x) const {
    std::size_t i = 1;
    while (i + 1 < line_.size() && line_[i].x() < x) ++i;
    const Vec2d along = line_[i] - line_[i - 1];
    return line_[i - 1].y() + along.y() / along.x() * (x - line_[i - 1].x());
  }
  /// Of the lowest point of the hull there.
  [[nodiscard]] std::optional<double> rim_at(double x) const {
    std::optional<double> lowest;
    for (std::size_t k = 0; k < hull_.size(); ++k) {
      const Vec2d& a = hull_[k];
      const Vec2d& b = hull_[(k + 1) % hull_.size()];
      if (!(std::min(a.x(), b.x()) < x && x < std::max(a.x(), b.x()))) continue;
      const double y = a.y() + (b.y() - a.y()) / (b.x() - a.x()) * (x - a.x());
      lowest = std::min(lowest.value_or(y), y);
    }
    return lowest;
  }

  std::vector<Vec2d> line_;
  std::span<const Vec2d> hull_;
};

struct Tally {
  int cases = 0;
  int steps = 0;
  int above = 0;    ///< Steps all of whose legs begin above,
  int held = 0;     ///< and with a contact with the surface.
  int beneath = 0;  ///< Steps none of whose legs does,
  int through = 0;  ///< and beside which the surface is passed, or begun to be.
  int mixed = 0;
  int too_close = 0;
  int dropped = 0;  ///< Through, on purpose.
};

/// One way of one character over one surface, from the same state each step as among others: with the two-sided twin,
/// and without.
class Play {
 public:
  Play(Shape shape, std::uint64_t seed)
      : seed_(seed),
        random_(seed),
        shape_(shape),
        moves_(random_.chance(0.3)),
        origin_(random_.chance(0.8) ? Vec2d{0, 0} : Vec2d{random_.between(-1e5, 1e5), random_.between(-1e5, 1e5)}),
        line_(placed(random_line(shape, random_))),
        chains_(colliders_of(line_, moves_ ? 0 : no_mover, random_)),
        character_(random_character(random_)),
        one_way_(scenery(Sides::one), character_),
        twin_(scenery(Sides::two), character_),
        bare_(scenery(Sides::none), character_),
        heights_(line_, one_way_.controller.character().shape.hull()) {}

  void go(Tally& tally) {
    compare::TraceHeader header;
    const auto hull = one_way_.controller.character().shape.hull();
    header.points.assign(hull.begin(), hull.end());
    header.scenery = one_way_.scenery.as_run();
    const double dt = random_.chance(0.6) ? 1.0 / 60 : random_.log_between(1e-3, 0.05);
    header.dt = dt;
    compare::Judge judge(header);
    const Vec2d speed = moves_ ? Vec2d{random_.between(-2, 2), random_.between(-2, 2)} : Vec2d{0, 0};
    state_.position = origin_ + Vec2d{random_.between(-2, 2),
                                      random_.chance(0.7) ? random_.between(0.7, 2.5) : random_.between(-2.5, 0)};
    Input input;
    ++tally.cases;
    for (int step = 0; step < 60 && !::testing::Test::HasFailure(); ++step) {
      if (random_.chance(0.1)) input.move = random_.integer(-1, 1);
      input.jump = random_.chance(0.02);
      input.drop = random_.chance(input.drop ? 0.7 : 0.02);
      if (random_.chance(0.01)) launch();
      const double turns = step % 20 < 10 ? 1 : -1;
      motion_ = {motion_.to, motion_.to + turns * dt * speed};
      take(input, dt, tally, judge);
      if ((state_.position - origin_).cwiseAbs().maxCoeff() > 12) return;
    }
  }

 private:
  enum class Sides { one, two, none };
  struct Player {
    Player(const SceneryDef& def, const CharacterDef& character)
        : scenery(def), controller(scenery, character), scratch(controller.make_scratch()) {}
    Scenery<double> scenery;
    Controller<double> controller;
    Scratch<double> scratch;
    StepReport<double> report;
  };

  /// A solid with the chain as its top, sides along `one_way` and a bottom: it must do as the chain alone.
  [[nodiscard]] static ColliderDef solid_below(ColliderDef chain) {
    double bottom = chain.points[0].y();
    for (const Vec2d& vertex : chain.points) bottom = std::min(bottom, vertex.y() - 0.5);
    const double first = chain.points.front().x();
    chain.shape = ColliderDef::Shape::polygon;
    chain.points.emplace_back(chain.points.back().x(), bottom);
    chain.points.emplace_back(first, bottom);
    return chain;
  }

  [[nodiscard]] std::vector<Vec2d> placed(std::vector<Vec2d> line) const {
    for (Vec2d& vertex : line) vertex += origin_;
    return line;
  }
  /// With a floor far below, which is the first collider. What is not there is far away, and moves all the same.
  [[nodiscard]] SceneryDef scenery(Sides sides) const {
    const auto corner = [&](double x, double y) { return Vec2d(origin_ + Vec2d(x, y)); };
    SceneryDef def;
    def.colliders.push_back({.points = {corner(-20, -9), corner(20, -9), corner(20, -8), corner(-20, -8)}});
    Random solid(seed_ + 1);
    for (ColliderDef chain : chains_) {
      const bool is_solid = solid.chance(0.3);
      if (sides == Sides::one && is_solid) chain = solid_below(chain);
      if (sides == Sides::two) chain.one_way.reset();
      if (sides == Sides::none)
        for (Vec2d& vertex : chain.points) vertex.x() += 1e4;
      def.colliders.push_back(chain);
    }
    return def;
  }

  void launch() {
    const double speed = random_.log_between(0.1, 200);
    const double angle = random_.angle();
    state_.velocity = Vec2d{std::cos(angle) * speed, std::sin(angle) * speed};
  }

  [[nodiscard]] CharacterState<double> step(Player& player, const Input& input, double dt) const {
    CharacterState<double> state = state_;
    std::vector<MoverMotion<double>> movers(player.scenery.mover_count(), motion_);
    player.controller.step(state, input, {{0, -30}, dt, movers}, player.scratch, player.report);
    return state;
  }

  void take(const Input& input, double dt, Tally& tally, compare::Judge& judge) {
    const CharacterState<double> before = state_;
    const CharacterState<double> after = step(one_way_, input, dt);
    const StepReport<double>& report = one_way_.report;
    ++tally.steps;
    std::vector<MoverMotion<double>> movers(one_way_.scenery.mover_count(), motion_);
    compare::TraceStep record = recorded(report, after, movers);
    record.respawn = true;  // launches apart, it goes on where it was
    const compare::StepJudgement judged = judge.judge(record);
    EXPECT_FALSE(judged.broke()) << where(before, input);
    tally.dropped += !report.dropped_through.empty();
    EXPECT_TRUE(input.drop || report.dropped_through.empty()) << where(before, input);
    switch (all_of(report.move.path)) {
      case Stands::above:
        if (input.drop) break;
        ++tally.above;
        tally.held += touches_surface(report);
        EXPECT_TRUE(same(after, step(twin_, input, dt), twin_.report))
            << where(before, input) << "\n  twin" << way(twin_.report);
        break;
      case Stands::not_above:
        ++tally.beneath;
        tally.through += !heights_.beside(seen(report.move.path[0]));
        EXPECT_FALSE(touches_surface(report)) << where(before, input);
        EXPECT_TRUE(same(after, step(bare_, input, dt), bare_.report))
            << where(before, input) << "\n  bare" << way(bare_.report);
        break;
      case Stands::too_close_to_tell:
        ++tally.mixed;
        break;
    }
    state_ = after;
  }

  [[nodiscard]] Vec2d seen(const PathPoint<double>& corner) const {
    return moves_ ? Vec2d(corner.position - motion_.at(corner.fraction)) : corner.position;
  }
  template <class Path>
  [[nodiscard]] Stands all_of(const Path& path) const {
    const Stands first = heights_.of(seen(path[0]));
    for (const PathPoint<double>& corner : path)
      if (heights_.of(seen(corner)) != first) return Stands::too_close_to_tell;
    return first;
  }
  [[nodiscard]] static bool touches_surface(const StepReport<double>& report) {
    return std::any_of(report.move.contacts.begin(), report.move.contacts.end(),
                       [](const Contact<double>& contact) { return contact.collider > 0; });
  }

  /// To the last bit, where nothing moves. (A step that has a mover about may be made another way than one that has
  /// not.)
  [[nodiscard]] bool same(const CharacterState<double>& ours, const CharacterState<double>& theirs,
                          const StepReport<double>& report) const {
    const auto& a = one_way_.report.move.contacts;
    const auto& b = report.move.contacts;
    const bool contacts = std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
      return x.collider == y.collider && x.normal == y.normal;
    });
    const double near = moves_ ? 1e-6 : 0;
    return contacts && ours.grounded == theirs.grounded &&
           (ours.position - theirs.position).cwiseAbs().maxCoeff() <= near &&
           (ours.velocity - theirs.velocity).cwiseAbs().maxCoeff() <= near;
  }

  [[nodiscard]] static std::string way(const StepReport<double>& report) {
    std::ostringstream text;
    text.precision(17);
    for (const PathPoint<double>& corner : report.move.path)
      text << " (" << corner.position.x() << ", " << corner.position.y() << " @ " << corner.fraction << ")";
    for (const Contact<double>& contact : report.move.contacts)
      text << "\n    " << contact.collider << " n " << contact.normal.transpose() << " @ " << contact.fraction
           << " gap " << contact.separation;
    text << (report.move.grounded ? " grounded" : "") << " status " << static_cast<int>(report.status);
    return text.str();
  }
  [[nodiscard]] std::string where(const CharacterState<double>& before, const Input& input) const {
    std::ostringstream text;
    text.precision(17);
    text << shape_names[static_cast<std::size_t>(shape_)] << ", seed " << seed_ << (moves_ ? ", moves" : "")
         << (input.drop ? ", drops" : "") << ", from " << before.position.transpose() << " at "
         << before.velocity.transpose() << "\n  one-way" << way(one_way_.report);
    return text.str();
  }

  std::uint64_t seed_;
  Random random_;
  Shape shape_;
  bool moves_;
  Vec2d origin_;
  std::vector<Vec2d> line_;
  std::vector<ColliderDef> chains_;
  CharacterDef character_;
  Player one_way_;
  Player twin_;
  Player bare_;
  Heights heights_;
  CharacterState<double> state_;
  MoverMotion<double> motion_;
};

class OneWaySurface : public ::testing::TestWithParam<Shape> {};

TEST_P(OneWaySurface, holds_like_its_two_sided_twin_from_above_and_is_nothing_from_below) {
  Tally tally;
  const int cases = steps_wanted("PAPERPROOF_ONE_WAY_CASES", std::max(40, sampled(400)));  // fewer cover too little
  for (int i = 0; i < cases && !HasFailure(); ++i)
    Play(GetParam(), 1000003 * (static_cast<std::uint64_t>(GetParam()) + 1) + static_cast<std::uint64_t>(i)).go(tally);
  std::printf("%s: %d cases, %d steps, %d above (%d held), %d beneath (%d through), %d mixed, %d dropped through\n",
              shape_names[static_cast<std::size_t>(GetParam())], tally.cases, tally.steps, tally.above, tally.held,
              tally.beneath, tally.through, tally.mixed, tally.dropped);
  EXPECT_GE(tally.held, tally.steps * 0.04);
  EXPECT_GE(tally.through, tally.steps * 0.02);
  EXPECT_LE(tally.mixed, tally.steps * 0.25);
  EXPECT_GE(tally.dropped, tally.cases * 0.02);
}

INSTANTIATE_TEST_SUITE_P(Shapes, OneWaySurface, ::testing::ValuesIn(all_shapes),
                         [](const auto& shape) { return shape_names[static_cast<std::size_t>(shape.param)]; });

/// Lines on a lattice of integers, and a character with integer corners: ties everywhere.
TEST(OneWaySurfaces, controller_and_oracle_agree_on_a_lattice_of_ties) {
  Random random(20);
  const CharacterShape shape(
      std::vector<Vec2d>{{-1, -2}, {1, -2}, {2, -1}, {2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}});
  const std::vector<Vec2d> hull(shape.hull().begin(), shape.hull().end());
  int above = 0;
  int asked = 0;
  for (int scene = 0; scene < steps_wanted("PAPERPROOF_ONE_WAY_CASES", sampled(400)); ++scene) {
    const std::array<Vec2d, 6> ways{Vec2d{0, 1}, Vec2d{0, -3}, Vec2d{1, 0}, Vec2d{1, 2}, Vec2d{-1, 1}, Vec2d{3, -1}};
    const Vec2d one_way = ways[static_cast<std::size_t>(random.integer(0, 5))];
    SceneryDef def;
    for (int chain = random.integer(1, 6); chain > 0; --chain) {
      ColliderDef collider{.shape = ColliderDef::Shape::chain, .points = {}, .one_way = one_way};
      for (int points = random.chance(0.6) ? 2 : random.integer(3, 6); points > 0;) {
        const Vec2d next{static_cast<double>(random.integer(-4, 4)), static_cast<double>(random.integer(-4, 4))};
        if (!collider.points.empty() && collider.points.back() == next) continue;
        collider.points.push_back(next);
        --points;
      }
      def.colliders.push_back(collider);
    }
    const Scenery<double> scenery(def);
    const OneWaySurfaces<double> surfaces(scenery, shape);
    const ExactScenery oracle(def, hull);
    for (int place = 0; place < 20; ++place) {
      const Vec2d at{static_cast<double>(random.integer(-8, 8)), static_cast<double>(random.integer(-8, 8))};
      for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece) {
        const ColliderIndex collider = scenery.pieces()[piece].collider;
        const bool ours = surfaces.is_above(surfaces.of(piece), at);
        bool one_answer = true;
        for (PieceIndex other = 0; other < scenery.pieces().size(); ++other)
          if (scenery.pieces()[other].collider == collider)
            one_answer = one_answer && surfaces.is_above(surfaces.of(other), at) == ours;
        if (!one_answer) continue;
        // The oracle says what is met on a way: on one that ends across a segment it is, if the way begins above.
        const auto ends = scenery.vertices_of(piece);
        const Place across(Vec2d((ends[0] + ends[1]) / 2));
        ASSERT_EQ(ours, oracle.meets(Place(at), across, collider))
            << "scene " << scene << " at " << at.transpose() << " segment " << ends[0].transpose() << " to "
            << ends[1].transpose();
        ++asked;
        above += ours;
      }
    }
  }
  EXPECT_GE(above, asked * 0.1);
  EXPECT_LE(above, asked * 0.9);
}

}  // namespace
}  // namespace paperproof::test
