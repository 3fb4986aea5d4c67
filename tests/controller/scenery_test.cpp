/// What a scenery makes of its definition: pieces, chains, and what is rounded.
#include <gtest/gtest.h>

#include "campaign/shapes.hpp"
#include "random_polygons.hpp"
#include "scenery_definitions.hpp"
#include "support/exact_points.hpp"
#include "support/steps_wanted.hpp"

namespace paperproof {
namespace {

using compare::chain;
using geometry::orientation_sign;
using test::one_way;
using test::Points;
using test::refusal_of;
using test::Where;
using test::where_is;

std::vector<Points> pieces_of(const Scenery& scenery) {
  std::vector<Points> pieces;
  for (PieceIndex i = 0; i < scenery.pieces().size(); ++i) {
    pieces.emplace_back();
    for (const Vec2d& vertex : scenery.vertices_of(i)) {
      pieces.back().push_back(vertex);
      EXPECT_TRUE(scenery.box(i).overlaps({vertex, vertex}));
    }
  }
  return pieces;
}
std::vector<Points> pieces_of(const ColliderDef& def) { return pieces_of(Scenery(SceneryDef{{def}})); }

/// From left to right, and upwards.
std::vector<Points> sorted(std::vector<Points> pieces) {
  std::sort(pieces.begin(), pieces.end(), [](const Points& a, const Points& b) {
    return std::pair(a[0].x(), a[0].y()) < std::pair(b[0].x(), b[0].y());
  });
  return pieces;
}

bool is_strictly_convex(const Points& piece) {
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec2d& next = piece[(i + 1) % piece.size()];
    for (const Vec2d& other : piece)
      if (other != piece[i] && other != next && orientation_sign(piece[i], next, other) <= 0) return false;
  }
  return piece.size() >= 3;
}

/// Two convex pieces are apart exactly if a side of one of them has the whole other one on its outer side.
bool interiors_are_disjoint(const Points& a, const Points& b) {
  const auto has_separating_side = [](const Points& piece, const Points& other) {
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const auto is_outside = [&](const Vec2d& vertex) {
        return orientation_sign(piece[i], piece[(i + 1) % piece.size()], vertex) <= 0;
      };
      if (std::all_of(other.begin(), other.end(), is_outside)) return true;
    }
    return false;
  };
  return has_separating_side(a, b) || has_separating_side(b, a);
}

/// Everything that a cut must be: convex, of the polygon's own vertices, without overlap, and all of it.
void expect_exact_tiling(const ColliderDef& polygon, const std::vector<Points>& pieces, test::Random& random) {
  Points own = polygon.points;
  for (const Points& hole : polygon.holes) own.insert(own.end(), hole.begin(), hole.end());
  test::Rational left = test::twice_area(polygon);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    ASSERT_TRUE(is_strictly_convex(pieces[i]));
    for (const Vec2d& vertex : pieces[i]) ASSERT_NE(std::find(own.begin(), own.end(), vertex), own.end());
    for (std::size_t j = 0; j < i; ++j) ASSERT_TRUE(interiors_are_disjoint(pieces[i], pieces[j]));
    left -= test::twice_area(pieces[i]);
  }
  ASSERT_EQ(left, 0);
  for (int i = 0; i < 10; ++i) {
    // A point of a piece, on or near a line between two of its vertices.
    const Points& piece = pieces[random.index(pieces.size())];
    const double t = random.unit();
    const Vec2d& vertex = piece[random.index(piece.size())];
    const Vec2d point = (1 - t) * vertex + t * piece[random.index(piece.size())];
    if (where_is(point, piece) != Where::inside) continue;
    ASSERT_EQ(where_is(point, polygon.points), Where::inside);
    for (const Points& hole : polygon.holes) ASSERT_EQ(where_is(point, hole), Where::outside);
  }
}

/// @return into how many pieces it was cut; none: it was refused.
std::size_t cut(const ColliderDef& def, test::Random& random) {
  if (refusal_of({{def}}) != "accepted") return 0;
  const Scenery scenery(SceneryDef{{def}});
  const std::vector<Points> pieces = pieces_of(scenery);
  expect_exact_tiling(scenery.as_run(0), pieces, random);
  return pieces.size();
}

struct Family {
  const char* name;
  ColliderDef (*make)(test::Random&);
  bool always_valid;
};

class Cutting : public testing::TestWithParam<Family> {};

TEST_P(Cutting, pieces_tile_random_polygons_exactly_whatever_the_winding) {
  const unsigned polygons = test::sampled(1000U);
  int valid = 0;
  int concave = 0;
  for (unsigned seed = 0; seed < polygons; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    test::Random random(seed);
    ColliderDef def = GetParam().make(random);
    if (seed % 2 == 1) {
      std::reverse(def.points.begin(), def.points.end());
      std::rotate(def.points.begin(), def.points.begin() + 1, def.points.end());
      for (Points& hole : def.holes) std::reverse(hole.begin(), hole.end());
    }
    const std::size_t pieces = cut(def, random);
    ASSERT_TRUE(pieces > 0 || !GetParam().always_valid);
    valid += pieces > 0;
    concave += pieces > 1;
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(valid, polygons * 3 / 10);
  EXPECT_GE(concave, polygons / 4);
}

INSTANTIATE_TEST_SUITE_P(Families, Cutting,
                         testing::Values(Family{"star", test::star, true},
                                         Family{"star_on_grid", test::star_on_grid, false},
                                         Family{"comb", test::comb, true}, Family{"holed", test::holed, true},
                                         Family{"rooms", test::rooms, true}, Family{"far_away", test::far_away, false}),
                         [](const auto& family) { return std::string(family.param.name); });

TEST(Cutting, polygons_of_thousands_of_vertices_are_cut_completely) {
  test::Random random(1);
  EXPECT_GT(cut({.points = test::star_ring(random, 3000, Vec2d::Zero(), 1, 3)}, random), 1000U);
}

TEST(Cutting, gives_few_pieces) {
  const ColliderDef flat_corners{.points = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
  const ColliderDef ell{.points = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  const ColliderDef frame{.points = {{0, 0}, {3, 0}, {3, 3}, {0, 3}}, .holes = {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}}};
  test::Random random(1);
  EXPECT_EQ(cut(flat_corners, random), 1U);
  EXPECT_EQ(cut(ell, random), 2U);
  EXPECT_LE(cut(frame, random), 8U);
}

TEST(Cutting, a_rectangle_has_its_vertices_counter_clockwise_from_the_first_that_was_given) {
  Points square{{1, 2}, {4, 2}, {4, 7}, {1, 7}};
  for (int corner = 0; corner < 4; ++corner) {
    const Scenery scenery(SceneryDef{{{.points = square}}});
    EXPECT_TRUE(scenery.pieces()[0].is_rectangle());
    EXPECT_EQ(pieces_of(scenery), std::vector<Points>{square});
    std::rotate(square.begin(), square.begin() + 1, square.end());
  }
}

TEST(Chains, every_segment_of_a_two_sided_chain_is_a_piece_in_the_given_direction) {
  const Scenery scenery(SceneryDef{{chain({{0, 0}, {1, 0}, {1, 2}, {0, 0}})}});
  EXPECT_EQ(pieces_of(scenery), (std::vector<Points>{{{0, 0}, {1, 0}}, {{1, 0}, {1, 2}}, {{1, 2}, {0, 0}}}));
  EXPECT_FALSE(scenery.pieces()[0].one_way);
}

TEST(Chains, a_one_way_segment_has_its_blocking_normal_on_the_left_and_blocks_nothing_along_it) {
  const Points stairs{{0, 0}, {1, 0}, {1, 1}, {2, 1}};
  const Points back{stairs.rbegin(), stairs.rend()};
  for (const Points& given : {stairs, back}) {
    // Up is on the left of what runs to the right.
    EXPECT_EQ(sorted(pieces_of(one_way(chain(given), {0, 1}))),
              (std::vector<Points>{{{0, 0}, {1, 0}}, {{1, 1}, {2, 1}}}));
    EXPECT_EQ(pieces_of(one_way(chain(given), {-3, 0})), (std::vector<Points>{{{1, 0}, {1, 1}}}));
    EXPECT_EQ(sorted(pieces_of(one_way(chain(given), {0.25, -0.5}))),
              (std::vector<Points>{{{1, 0}, {0, 0}}, {{1, 1}, {1, 0}}, {{2, 1}, {1, 1}}}));
  }
}

TEST(OneWayPolygons, have_their_outer_edges_that_face_where_one_way_points_as_pieces) {
  ColliderDef house{.points = {{0, 0}, {4, 0}, {4, 2}, {2, 3}, {0, 2}}, .holes = {{{1, 1}, {2, 1}, {1, 1.5}}}};
  house.one_way = Vec2d(0, 2);
  for (std::size_t begin = 0; begin < 2 * house.points.size(); ++begin) {
    std::rotate(house.points.begin(), house.points.begin() + 1, house.points.end());
    if (begin == house.points.size()) std::reverse(house.points.begin(), house.points.end());
    EXPECT_EQ(sorted(pieces_of(house)), (std::vector<Points>{{{0, 2}, {2, 3}}, {{2, 3}, {4, 2}}})) << begin;
    EXPECT_EQ(one_way_lines(house).size(), 1U);
  }
}

TEST(OneWayPolygons, have_a_line_for_each_run_of_such_edges) {
  const ColliderDef bowl =
      one_way({.points = {{0, 0}, {6, 0}, {6, 3}, {5, 3}, {5, 1}, {1, 1}, {1, 3}, {0, 3}}}, {0, 1});
  EXPECT_EQ(one_way_lines(bowl), (std::vector<Points>{{{6, 3}, {5, 3}}, {{5, 1}, {1, 1}}, {{1, 3}, {0, 3}}}));
  EXPECT_EQ(sorted(pieces_of(bowl)), (std::vector<Points>{{{0, 3}, {1, 3}}, {{1, 1}, {5, 1}}, {{5, 3}, {6, 3}}}));
  EXPECT_EQ(one_way_lines(one_way(chain({{0, 0}, {2, 0}}), {0, 1})), (std::vector<Points>{{{0, 0}, {2, 0}}}));
}

TEST(AsRun, says_that_traces_of_a_length_become_zero) {
  const Scenery traces(SceneryDef{{{.points = {{1e-200, 0}, {1, -5e-324}, {0, 1}}}}});
  EXPECT_EQ(traces.as_run(0).points, (Points{{0, 0}, {1, 0}, {0, 1}}));
}

TEST(AsRun, is_the_definition_that_was_given_whatever_is_kept_of_it) {
  SceneryDef def;
  Points square{{1, 2}, {4, 2}, {4, 7}, {1, 7}};
  for (int turn = 0; turn < 8; ++turn) {
    if (turn == 4) std::reverse(square.begin(), square.end());
    def.colliders.push_back({.points = square});
    std::rotate(square.begin(), square.begin() + 1, square.end());
  }
  const Points frame{{0, 0}, {3, 0}, {3, 3}, {0, 3}};
  const Points hole{{1, 1}, {2, 1}, {2, 2}, {1, 2}};
  def.colliders.push_back({.points = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}});          // a vertex on a side
  def.colliders.push_back({.points = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}});  // two pieces
  def.colliders.push_back({.points = frame, .holes = {hole}, .mover = 1});
  def.colliders.push_back(one_way({.points = frame, .holes = {hole}}, {0, 2}));
  def.colliders.push_back({.points = {{0, 0}, {1, 1}, {0.5, 3}}, .surface_speed = -2});
  def.colliders.push_back({.points = {{0.5, 3}, {1, 1}, {0, 0}}, .sensor = true});
  def.colliders.push_back(chain({{0, 0}, {1, 0}}));
  def.colliders.push_back(one_way(chain({{1, 0}, {0, 0}}), {0, 1}));
  def.colliders.push_back(one_way(chain({{1, 0}, {1, 5}}), {0, 1}));  // no piece at all
  def.colliders.push_back(one_way(chain({{0, 0}, {1, 0}, {2, 1}}, 0), {0, 1}));
  def.colliders.push_back(compare::circle({1, 2}, 0.1));
  const Scenery scenery(def);
  const SceneryDef as_run = scenery.as_run();
  ASSERT_EQ(as_run.colliders.size(), def.colliders.size());
  for (ColliderIndex i = 0; i < def.colliders.size(); ++i) {
    const auto all_of = [](const ColliderDef& of) {
      return std::tie(of.shape, of.points, of.holes, of.one_way, of.mover, of.sensor, of.surface_speed, of.radius);
    };
    EXPECT_TRUE(all_of(as_run.colliders[i]) == all_of(def.colliders[i])) << i;
    const PieceRange pieces = scenery.pieces_of(i);
    for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece)
      EXPECT_EQ(scenery.pieces()[piece].collider == i, pieces.first <= piece && piece < pieces.end) << i;
  }
  EXPECT_TRUE(Scenery(SceneryDef{}).pieces().empty());
}

}  // namespace
}  // namespace paperproof
