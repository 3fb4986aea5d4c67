/// Two methods for the first overlap with what turns: the same answers, also where a touch is no overlap.
#include "oracle/second_meeting.hpp"

#include "compare/exact_shapes.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace paperproof::compare::detail {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Kind = Meeting::Kind;
using Path = std::vector<PathPoint<double>>;

/// A question that both methods answer.
struct Question {
  std::vector<Vec2d> body = octagon();
  Path path;
  VertexWay way;
  double radius = 0;

  [[nodiscard]] std::vector<std::size_t> part() const {
    std::vector<std::size_t> numbers(way.vertices.front().size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
  }
  [[nodiscard]] Meeting first(Asked asked) const { return first_meeting(body, path, way, part(), asked, radius); }
  [[nodiscard]] Meeting second() const { return second_meeting(body, path, way, part(), radius); }
};

/// Takes points about a place by an angle.
std::vector<Vec2d> turned(const std::vector<Vec2d>& points, const Vec2d& at, double angle) {
  std::vector<Vec2d> all;
  for (const Vec2d& p : points)
    all.emplace_back(at + Vec2d(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                                std::sin(angle) * p.x() + std::cos(angle) * p.y()));
  return all;
}

std::vector<Vec2d> wheel(int corners, double radius) {
  std::vector<Vec2d> ring;
  for (int k = 0; k < corners; ++k)
    ring.push_back(radius * Vec2d(std::cos(6.28 * k / corners), std::sin(6.28 * k / corners)));
  return ring;
}

/// On straight ways that follow a turn, in each part first the turn at once about a place and then straight on.
VertexWay at_once(Random& random, const std::vector<Vec2d>& points) {
  VertexWay way;
  double angle = random.between(-7, 7);
  Vec2d at = random.point(1.2);
  const int parts = 1 + random.below(3);
  way.instants = {0};
  way.vertices = {turned(points, at, angle)};
  for (int k = 0; k < parts; ++k) {
    const double turn = random.between(-0.3, 0.3);
    const Vec2d pivot = random.point(0.6);
    way.instants.push_back((k + 0x1p-20) / parts);
    way.vertices.push_back(turned(way.vertices.back(), pivot - turned({pivot}, {0, 0}, turn)[0], turn));
    angle += turn;
    at += random.point(0.3);
    way.instants.push_back(static_cast<double>(k + 1) / parts);
    way.vertices.push_back(turned(points, at, angle));
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
  const std::vector<std::vector<Vec2d>> shapes{
      {{-0.7, 0}, {0.7, 0}}, {{-0.7, 0}, {0.7, 0}, {0.7, thin}, {-0.7, thin}}, wheel(3 + random.below(6), 0.5)};
  const std::vector<Vec2d>& shape = shapes[static_cast<std::size_t>(random.below(3))];
  return {.path = random_path(random, 1.3), .way = at_once(random, shape)};
}

/// Corners on a grid that go to corners on a grid: many touch, many are parallel, many meet at one moment.
Question on_a_grid(Random& random) {
  Question asked;
  if (random.below(2) == 0) asked.body = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  const Vec2d here = random.grid_point(8);
  const Vec2d there = random.below(2) == 0 ? here : random.grid_point(8);
  const std::vector<Vec2d> quarter{{-0.625, 0}, {0.625, 0}, {0.625, 0.625}, {-0.625, 0.625}};
  std::vector<Vec2d> shape(quarter.begin(), quarter.begin() + (random.below(2) == 0 ? 2 : 4));
  const auto placed = [&](int quarters, const Vec2d& at) {
    std::vector<Vec2d> points;
    for (Vec2d p : shape) {
      for (int k = 0; k < quarters; ++k) p = {-p.y(), p.x()};
      points.emplace_back(p + at);
    }
    return points;
  };
  const int before = random.below(4);
  asked.way = {
      .collider = 0, .instants = {0, 1}, .vertices = {placed(before, here), placed(before + random.below(2), there)}};
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
  double height = top;
  const int off = random.below(3) - 1;
  if (off > 0) height = one_ulp_up(height);
  if (off < 0) height = one_ulp_down(height);
  Question asked{.body = {{0, 0}, {1, 1}, {0, 2}, {-1, 1}}, .path = {}, .way = {}};
  asked.way = {.collider = 0, .instants = {0, 1}, .vertices = {{{-9, 0}, {9, 0}}, {{-9, -9 * slope}, {9, 9 * slope}}}};
  asked.path = {{{1, height}, 0}, {{1 - speed, height}, 1}};
  return asked;
}

Question with_a_disc(Random& random) {
  Question asked{.path = random_path(random, 1), .way = {}, .radius = random.between(0.05, 0.5)};
  asked.way = {.collider = 0, .instants = {0, random.between(0.1, 0.9), 1}, .vertices = {}};
  for (int k = 0; k < 3; ++k) asked.way.vertices.push_back({random.point(1)});
  if (random.below(2) == 0) return asked;
  asked.radius = 0.3125;  // on a grid: it touches sides
  for (auto& centre : asked.way.vertices) centre = {random.grid_point(8)};
  for (PathPoint<double>& corner : asked.path) corner.position = random.grid_point(8);
  return asked;
}

struct Tally {
  int asked = 0;
  int met = 0;
  int undecided = 0;  ///< By the first method.
};

void compare_both(const char* family, std::uint64_t seed, int rounds, const std::function<Question(Random&)>& make,
                  Tally& tally) {
  Random random(seed);
  for (int i = 0; i < rounds; ++i) {
    const Question question = make(random);
    const Meeting one = question.first(question.radius > 0 ? Asked::whether : Asked::when);
    const Meeting other = question.second();
    ++tally.asked;
    tally.met += other.kind == Kind::meets;
    tally.undecided += one.kind == Kind::undecided;
    ASSERT_NE(other.kind, Kind::undecided);
    if (one.kind == Kind::undecided) continue;
    ASSERT_EQ(one.kind, other.kind) << family << ", seed " << seed << ", round " << i;
    if (one.kind == Kind::apart) continue;
    const bool one_moment = question.path.size() == 1;
    // Of a disc the first tells the stretch; an overlap that lasts 1e-8 of a step it finds by halving.
    const double closely = question.radius > 0 || one_moment ? 1 : 1e-9;
    EXPECT_LE(other.low, other.high);
    EXPECT_LE(one.low, other.high + closely) << family << ", seed " << seed << ", round " << i;
    EXPECT_NEAR(one.high, other.high, closely) << family << ", seed " << seed << ", round " << i;
  }
  std::printf("%s: seed %llu, %d asked, %d meet, %d undecided by the first\n", family,
              static_cast<unsigned long long>(seed), tally.asked, tally.met, tally.undecided);
}

TEST(SecondMeeting, decides_a_touch_at_a_moment_that_no_halving_comes_to) {
  // In units of 0.15625 m the octagon stands at (2, 0), with a corner at (1, -4) between a level side and one of slope
  // -2. The end of a segment goes from (7, -7) to (-7, 0): it is at that corner at 3/7, on a line of slope -1/2 that
  // the octagon lies above; the other end stays below.
  const double unit = 0.15625;
  Question touch{.path = {{Vec2d(2, 0) * unit, 0}, {Vec2d(2, 0) * unit, 1}}, .way = {}};
  const auto segment = [&](const Vec2d& a, const Vec2d& b) { return std::vector<Vec2d>{a * unit, b * unit}; };
  touch.way = {.collider = 0, .instants = {0, 1}, .vertices = {segment({7, -7}, {-1, -7}), segment({-7, 0}, {-7, -8})}};
  EXPECT_EQ(touch.first(Asked::whether).kind, Kind::undecided);
  EXPECT_EQ(touch.second().kind, Kind::apart);
  for (PathPoint<double>& corner : touch.path) corner.position.y() = -0x1p-40;
  const Meeting met = touch.second();
  ASSERT_EQ(met.kind, Kind::meets);
  EXPECT_LT(met.low, 3.0 / 7);
  EXPECT_NEAR(met.high, 3.0 / 7, 1e-10);
}

TEST(SecondMeeting, agrees_with_the_first_at_random) {
  Tally tally;
  compare_both("at random", 28, 4000, at_random, tally);
  EXPECT_GE(tally.met, tally.asked * 3 / 10);
  EXPECT_LE(tally.met, tally.asked * 7 / 10);
  EXPECT_EQ(tally.undecided, 0);
}

TEST(SecondMeeting, agrees_with_the_first_on_a_grid_where_much_touches) {
  Tally tally;
  compare_both("on a grid", 29, 4000, on_a_grid, tally);
  EXPECT_GE(tally.met, tally.asked * 3 / 10);
  EXPECT_LE(tally.met, tally.asked * 7 / 10);
}

TEST(SecondMeeting, agrees_with_the_first_an_ulp_beside_the_top_of_a_parabola) {
  Tally tally;
  compare_both("grazing", 30, 1500, grazing, tally);
  EXPECT_GE(tally.met, tally.asked * 3 / 10);
  EXPECT_LE(tally.met, tally.asked * 7 / 10);
}

TEST(SecondMeeting, agrees_with_the_first_beside_discs) {
  Tally tally;
  compare_both("discs", 31, 3000, with_a_disc, tally);
  EXPECT_GE(tally.met, tally.asked * 3 / 10);
  EXPECT_LE(tally.met, tally.asked * 7 / 10);
}

}  // namespace
}  // namespace paperproof::compare::detail
