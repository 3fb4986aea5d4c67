/// The first overlap with what turns: two methods, which share the signs of numbers alone, give the same answers, also
/// where a touch is no overlap. Answers that are fractions are in ../judge/exact/turning.json.
#include "oracle/first_meeting.hpp"

#include "compare/turning_planks.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <tuple>

namespace paperproof::compare::detail {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Kind = Meeting::Kind;
using Path = std::vector<PathPoint>;

/// A question that both methods answer.
struct Question {
  std::vector<Vec2d> body = octagon();
  Path path{};
  VertexWay way{};
  double radius = 0;

  [[nodiscard]] std::vector<std::size_t> part() const {
    std::vector<std::size_t> numbers(way.vertices.front().size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
  }
  [[nodiscard]] Meeting first(Asked asked) const { return first_meeting(body, path, way, part(), asked, radius); }
  [[nodiscard]] Meeting second() const { return second_meeting(body, path, way, part(), radius); }
};

VertexWay going(std::vector<std::vector<Vec2d>> vertices, std::vector<double> instants = {0, 1}) {
  return {.collider = 0, .instants = std::move(instants), .vertices = std::move(vertices)};
}

/// A plank that is the line y = slope t x.
VertexWay rising_line(double slope) { return going({{{-9, 0}, {9, 0}}, {{-9, -9 * slope}, {9, 9 * slope}}}); }

/// A square whose lowest corner is its position.
const std::vector<Vec2d> on_its_tip{{0, 0}, {1, 1}, {0, 2}, {-1, 1}};

/// On straight ways that follow a turn, in each part first the turn at once about a place and then straight on.
VertexWay at_once(Random& random, const std::vector<Vec2d>& points) {
  double angle = random.between(-7, 7);
  Vec2d at = random.point(1.2);
  const int parts = 1 + random.below(3);
  VertexWay way = going({placed(points, at, angle)}, {0});
  for (int k = 0; k < parts; ++k) {
    const double turn = random.between(-0.3, 0.3);
    const Vec2d pivot = random.point(0.6);
    way.instants.push_back((k + 0x1p-20) / parts);
    way.vertices.push_back(placed(way.vertices.back(), pivot - turned(pivot, turn), turn));
    angle += turn;
    at += random.point(0.3);
    way.instants.push_back(static_cast<double>(k + 1) / parts);
    way.vertices.push_back(placed(points, at, angle));
  }
  return way;
}

Path random_path(Random& random, double reach) {
  const Vec2d start = random.point(reach);
  if (random.below(6) == 0) return {{start, random.between(0, 1)}};
  const Vec2d end = start + random.point(0.7);
  if (random.below(3) > 0) return {{start, 0}, {end, 1}};
  const double when = random.below(3) == 0 ? 0 : random.between(0, 1);
  const Vec2d leapt = start + random.point(0.4);
  return {{start, 0}, {start, when}, {leapt, when}, {end, 1}};
}

/// Shapes that turn at random: nothing touches but by chance.
Question at_random(Random& random) {
  const double thin = random.below(2) == 0 ? 1e-4 : 0.1;
  std::vector<Vec2d> wheel;
  const int corners = 3 + random.below(6);
  for (int k = 0; k < corners; ++k) wheel.push_back(0.5 * towards(6.28 * k / corners));
  const std::vector<std::vector<Vec2d>> shapes{{{-0.7, 0}, {0.7, 0}}, box(-0.7, 0, 0.7, thin).points, wheel};
  const std::vector<Vec2d>& shape = shapes[static_cast<std::size_t>(random.below(3))];
  return {.path = random_path(random, 1.3), .way = at_once(random, shape)};
}

/// Corners on a grid that go to corners on a grid: many touch, many are parallel, many meet at one moment.
Question on_a_grid(Random& random) {
  Question asked;
  if (random.below(2) == 0) asked.body = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  const Vec2d here = random.grid_point(8);
  const Vec2d there = random.below(2) == 0 ? here : random.grid_point(8);
  std::vector<Vec2d> shape = box(-0.625, 0, 0.625, 0.625).points;
  if (random.below(2) == 0) shape.resize(2);
  const int before = random.below(4);
  const auto placed = [&shape](int quarters, const Vec2d& at) {
    std::vector<Vec2d> points;
    for (Vec2d p : shape) {
      for (int k = 0; k < quarters; ++k) p = {-p.y(), p.x()};
      points.emplace_back(p + at);
    }
    return points;
  };
  asked.way = going({placed(before, here), placed(before + random.below(2), there)});
  const Vec2d from = random.grid_point(9);
  const Vec2d to = random.below(3) == 0 ? from : random.grid_point(9);
  asked.path = {{from, 0}, {to, 1}};
  if (random.below(4) == 0) asked.path = {{from, 0}, {from, 0.5}, {to, 0.5}, {to, 1}};
  return asked;
}

/// The tip of a square passes a parabola that a plank makes, within an ulp of its top.
Question grazing(Random& random) {
  const double slope = 0.25 * (1 + random.below(8));
  const double speed = 0.25 * (1 + random.below(8));
  // At time t the plank is the line y = slope t x, and the tip is at x = 1 - speed t: highest where both are even.
  const double top = slope / (4 * speed);
  const int off = random.below(3);
  const double height = off == 0 ? top : off == 1 ? one_ulp_up(top) : one_ulp_down(top);
  return {.body = on_its_tip, .path = {{{1, height}, 0}, {{1 - speed, height}, 1}}, .way = rising_line(slope)};
}

Question with_a_disc(Random& random) {
  Question asked{.path = random_path(random, 1), .radius = random.between(0.05, 0.5)};
  const bool on_grid = random.below(2) == 0;  // it touches sides
  if (on_grid) asked.radius = 0.3125;
  asked.way = going({}, {0, random.between(0.1, 0.9), 1});
  for (int k = 0; k < 3; ++k) asked.way.vertices.push_back({on_grid ? random.grid_point(8) : random.point(1)});
  for (PathPoint& corner : asked.path)
    if (on_grid) corner.position = random.grid_point(8);
  return asked;
}

TEST(SecondMeeting, agrees_with_the_first) {
  using Family = std::tuple<const char*, std::uint64_t, int, Question (*)(Random&)>;
  for (const auto& [name, seed, all_rounds, make] :
       {Family{"at random", 28, 4000, at_random}, Family{"on a grid", 29, 4000, on_a_grid},
        Family{"grazing", 30, 1500, grazing}, Family{"discs", 31, 3000, with_a_disc}}) {
    Random random(seed);
    const int rounds = paperproof::test::sampled(all_rounds);
    int met = 0;
    int undecided = 0;
    for (int i = 0; i < rounds; ++i) {
      SCOPED_TRACE(std::string(name) + ", seed " + std::to_string(seed) + ", round " + std::to_string(i));
      const Question question = make(random);
      const Meeting one = question.first(question.radius > 0 ? Asked::whether : Asked::when);
      const Meeting other = question.second();
      met += other.kind == Kind::meets;
      undecided += one.kind == Kind::undecided;
      ASSERT_NE(other.kind, Kind::undecided);
      if (one.kind == Kind::undecided) continue;
      ASSERT_EQ(one.kind, other.kind);
      EXPECT_EQ(question.first(Asked::whether).kind, one.kind);
      if (one.kind == Kind::apart) continue;
      // Of a disc the first tells the stretch; an overlap that lasts 1e-8 of a step it finds by halving.
      const double near = question.radius > 0 || question.path.size() == 1 ? 1 : 1e-9;
      EXPECT_LE(other.low, other.high);
      EXPECT_LE(one.low, other.high + near);
      EXPECT_NEAR(one.high, other.high, near);
    }
    EXPECT_NEAR(met, 0.5 * rounds, 0.2 * rounds) << name;
    EXPECT_LE(undecided, name == std::string("at random") ? 0 : rounds / 100) << name;
  }
}

}  // namespace
}  // namespace paperproof::compare::detail
