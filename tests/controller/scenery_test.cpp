/// What a scenery makes of its definition: pieces, chains, and what is rounded.
#include <gtest/gtest.h>

#include "exact_reference.hpp"
#include "random_polygons.hpp"
#include "scenery_definitions.hpp"
#include "support/steps_wanted.hpp"

namespace paperproof {
namespace {

using geometry::orientation_sign;
using test::Points;
using test::Polygon;
using test::Rational;
using test::refusal_of;
using test::scenery_of;
using test::Where;
using test::where_is;

template <class Scalar>
Points piece_of(const Scenery<Scalar>& scenery, std::size_t piece) {
  Points points;
  for (const Vec2<Scalar>& vertex : scenery.vertices_of(static_cast<PieceIndex>(piece))) {
    points.push_back(vertex.template cast<double>());
  }
  return points;
}

template <class Scalar>
std::vector<Points> pieces_of(const Scenery<Scalar>& scenery) {
  std::vector<Points> pieces;
  for (std::size_t i = 0; i < scenery.pieces().size(); ++i) pieces.push_back(piece_of(scenery, i));
  return pieces;
}

bool is_strictly_convex(const Points& piece) {
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec2d& next = piece[(i + 1) % piece.size()];
    for (const Vec2d& other : piece) {
      if (other == piece[i] || other == next) continue;
      if (orientation_sign(piece[i], next, other) <= 0) return false;
    }
  }
  return piece.size() >= 3;
}

/// Two convex pieces are apart exactly if a side of one of them has the whole other one on its outer side.
bool interiors_are_disjoint(const Points& a, const Points& b) {
  const auto has_separating_side = [](const Points& piece, const Points& other) {
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vec2d& next = piece[(i + 1) % piece.size()];
      bool separates = true;
      for (const Vec2d& vertex : other) separates = separates && orientation_sign(piece[i], next, vertex) <= 0;
      if (separates) return true;
    }
    return false;
  };
  return has_separating_side(a, b) || has_separating_side(b, a);
}

Where where_is(const Vec2d& point, const Polygon& polygon) {
  Where where = where_is(point, polygon.outer);
  for (const Points& hole : polygon.holes) {
    const Where in_hole = where_is(point, hole);
    if (in_hole == Where::on_the_outline) return in_hole;
    if (in_hole == Where::inside) where = Where::outside;
  }
  return where;
}

Rational twice_area(const Polygon& polygon) {
  Rational area = abs(test::twice_area(polygon.outer));
  for (const Points& hole : polygon.holes) area -= abs(test::twice_area(hole));
  return area;
}

Points vertices_of(const Polygon& polygon) {
  Points all = polygon.outer;
  for (const Points& hole : polygon.holes) all.insert(all.end(), hole.begin(), hole.end());
  return all;
}

/// Everything that a cut must be: convex, of the polygon's own vertices, without overlap, and all of it.
void expect_exact_tiling(const Polygon& polygon, const std::vector<Points>& pieces, test::Random& random) {
  const Points own = vertices_of(polygon);
  Rational area = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    ASSERT_TRUE(is_strictly_convex(pieces[i]));
    for (const Vec2d& vertex : pieces[i]) ASSERT_NE(std::find(own.begin(), own.end(), vertex), own.end());
    for (std::size_t j = 0; j < i; ++j) ASSERT_TRUE(interiors_are_disjoint(pieces[i], pieces[j]));
    area += test::twice_area(pieces[i]);
  }
  ASSERT_EQ(area, twice_area(polygon));
  for (int i = 0; i < 10; ++i) {
    // A point of a piece, on or near a line between two of its vertices.
    const Points& piece = pieces[random.index(pieces.size())];
    const double t = random.uniform(0, 1);
    const Vec2d& vertex = piece[random.index(piece.size())];
    const Vec2d point = (1 - t) * vertex + t * piece[random.index(piece.size())];
    if (where_is(point, piece) == Where::inside) {
      ASSERT_EQ(where_is(point, polygon), Where::inside);
    }
  }
}

struct Family {
  const char* name;
  Polygon (*make)(test::Random&);
  bool always_valid;
};

class Cutting : public testing::TestWithParam<Family> {};

TEST_P(Cutting, pieces_tile_random_polygons_exactly) {
  int cut = 0;
  int concave = 0;
  constexpr int polygons = test::sampled(1000);
  for (unsigned seed = 0; seed < polygons; ++seed) {
    test::Random random(seed);
    const Polygon polygon = GetParam().make(random);
    const SceneryDef def = scenery_of(polygon);
    const std::string refusal = refusal_of(def);
    if (refusal != "accepted") {
      ASSERT_FALSE(GetParam().always_valid) << refusal << ", seed " << seed;
      continue;
    }
    const std::vector<Points> pieces = pieces_of(Scenery<double>(def));
    ASSERT_NO_FATAL_FAILURE(expect_exact_tiling(polygon, pieces, random)) << "seed " << seed;
    ++cut;
    if (pieces.size() > 1) ++concave;
  }
  EXPECT_GE(cut, polygons * 3 / 10);
  EXPECT_GE(concave, polygons / 4);
}

INSTANTIATE_TEST_SUITE_P(Families, Cutting,
                         testing::Values(Family{"star", test::star, true},
                                         Family{"star_on_grid", test::star_on_grid, false},
                                         Family{"spiral", test::spiral, true}, Family{"comb", test::comb, true},
                                         Family{"holed", test::holed, true}, Family{"rooms", test::rooms, true},
                                         Family{"far_away", test::far_away, false}),
                         [](const auto& family) { return std::string(family.param.name); });

TEST(Cutting, a_polygon_is_cut_the_same_whatever_its_winding_and_however_it_is_listed) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    test::Random random(seed);
    const Polygon polygon = test::holed(random);
    Polygon turned = polygon;
    std::reverse(turned.outer.begin(), turned.outer.end());
    std::rotate(turned.outer.begin(), turned.outer.begin() + 1, turned.outer.end());
    for (Points& hole : turned.holes) std::reverse(hole.begin(), hole.end());
    const std::vector<Points> pieces = pieces_of(Scenery<double>(scenery_of(turned)));
    ASSERT_NO_FATAL_FAILURE(expect_exact_tiling(polygon, pieces, random)) << "seed " << seed;
  }
}

TEST(Cutting, a_convex_polygon_is_one_piece_without_the_vertices_on_its_sides) {
  const Polygon square{{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}, {}};
  for (const bool clockwise : {false, true}) {
    Polygon polygon = square;
    if (clockwise) std::reverse(polygon.outer.begin(), polygon.outer.end());
    const Scenery<double> scenery(scenery_of(polygon));
    ASSERT_EQ(scenery.pieces().size(), 1U);
    EXPECT_EQ(scenery.pieces()[0].vertex_count, 4U);
    EXPECT_EQ(test::twice_area(piece_of(scenery, 0)), 2 * 2 * 2);
    EXPECT_EQ(scenery.box(0).lower, Vec2d(0, 0));
    EXPECT_EQ(scenery.box(0).upper, Vec2d(2, 2));
  }
}

TEST(Cutting, an_l_is_two_pieces_and_a_frame_is_at_most_eight) {
  const Polygon l{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}};
  EXPECT_EQ(Scenery<double>(scenery_of(l)).pieces().size(), 2U);
  const Polygon frame{{{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}}};
  const std::size_t pieces = Scenery<double>(scenery_of(frame)).pieces().size();
  EXPECT_GE(pieces, 3U);
  EXPECT_LE(pieces, 8U);
}

TEST(Cutting, the_pieces_of_several_colliders_keep_their_collider_and_their_order) {
  SceneryDef def;
  def.colliders.push_back({.points = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}});
  def.colliders.push_back({.shape = ColliderDef::Shape::chain, .points = {{5, 0}, {6, 0}, {7, 1}}});
  def.colliders.push_back({.points = {{9, 9}, {10, 9}, {9, 10}}});
  const Scenery<double> scenery(def);
  std::vector<ColliderIndex> colliders;
  for (std::size_t i = 0; i < scenery.pieces().size(); ++i) {
    const PieceInfo& piece = scenery.pieces()[i];
    colliders.push_back(piece.collider);
    EXPECT_FALSE(piece.one_way);
    for (const Vec2d& vertex : scenery.vertices_of(static_cast<PieceIndex>(i))) {
      EXPECT_TRUE(scenery.box(static_cast<PieceIndex>(i)).overlaps({vertex, vertex}));
    }
  }
  EXPECT_EQ(colliders, (std::vector<ColliderIndex>{0, 0, 1, 1, 2}));
  EXPECT_EQ(scenery.boxes().size(), scenery.pieces().size());
}

TEST(Chains, every_segment_of_a_two_sided_chain_is_a_piece_in_the_given_direction) {
  const Points chain{{0, 0}, {1, 0}, {1, 2}, {0, 0}};
  const Scenery<double> scenery(scenery_of(chain, {}));
  ASSERT_EQ(scenery.pieces().size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(piece_of(scenery, i), (Points{chain[i], chain[i + 1]}));
    EXPECT_FALSE(scenery.pieces()[i].one_way);
  }
}

TEST(Chains, a_one_way_segment_has_its_blocking_normal_on_the_left_whatever_its_direction) {
  for (const Vec2d& one_way : {Vec2d(0, 1), Vec2d(0, -3), Vec2d(1, 0), Vec2d(-0.5, 0.25)}) {
    for (unsigned seed = 0; seed < 200; ++seed) {
      test::Random random(seed);
      const Points chain{random.point(10), random.point(10)};
      const Scenery<double> scenery(scenery_of(chain, one_way));
      ASSERT_EQ(scenery.pieces().size(), 1U);
      EXPECT_TRUE(scenery.pieces()[0].one_way);
      const Points segment = piece_of(scenery, 0);
      const Vec2d along = segment[1] - segment[0];
      const Vec2d normal_on_the_left(-along.y(), along.x());
      EXPECT_GT(normal_on_the_left.dot(one_way), 0) << "seed " << seed;
    }
  }
}

TEST(Chains, a_one_way_segment_along_its_direction_blocks_nothing) {
  const Scenery<double> stairs(scenery_of({{0, 0}, {1, 0}, {1, 1}, {2, 1}}, Vec2d(0, 1)));
  ASSERT_EQ(stairs.pieces().size(), 2U);
  // Up is on the left of what runs to the right.
  EXPECT_EQ(piece_of(stairs, 0), (Points{{0, 0}, {1, 0}}));
  EXPECT_EQ(piece_of(stairs, 1), (Points{{1, 1}, {2, 1}}));
}

/// Pairs of end points, sorted.
std::vector<Points> pieces_of(const Scenery<double>& scenery) {
  std::vector<Points> pieces;
  for (std::size_t i = 0; i < scenery.pieces().size(); ++i) pieces.push_back(piece_of(scenery, i));
  std::sort(pieces.begin(), pieces.end(), [](const Points& a, const Points& b) { return a[0].x() < b[0].x(); });
  return pieces;
}

TEST(OneWayPolygons, have_their_outer_edges_that_face_where_one_way_points_as_pieces) {
  const Points house{{0, 0}, {4, 0}, {4, 2}, {2, 3}, {0, 2}};
  for (const bool clockwise : {false, true}) {
    for (std::size_t begin = 0; begin < house.size(); ++begin) {
      ColliderDef def{.points = house, .holes = {{{1, 1}, {2, 1}, {1, 1.5}}}, .one_way = Vec2d(0, 2)};
      std::rotate(def.points.begin(), def.points.begin() + static_cast<std::ptrdiff_t>(begin), def.points.end());
      if (clockwise) std::reverse(def.points.begin(), def.points.end());
      const Scenery<double> scenery(SceneryDef{{def}});
      EXPECT_EQ(pieces_of(scenery), (std::vector<Points>{{{0, 2}, {2, 3}}, {{2, 3}, {4, 2}}})) << begin;
      EXPECT_TRUE(scenery.pieces()[0].one_way && scenery.pieces()[1].one_way);
      EXPECT_EQ(one_way_lines(def).size(), 1U);
      const ColliderDef as_run = scenery.as_run(0);
      EXPECT_EQ(as_run.shape, ColliderDef::Shape::polygon);
      EXPECT_EQ(as_run.points, def.points);
      EXPECT_EQ(as_run.holes, def.holes);
      EXPECT_EQ(as_run.one_way, def.one_way);
    }
  }
}

TEST(OneWayPolygons, have_a_line_for_each_run_of_such_edges) {
  const ColliderDef bowl{.points = {{0, 0}, {6, 0}, {6, 3}, {5, 3}, {5, 1}, {1, 1}, {1, 3}, {0, 3}},
                         .one_way = Vec2d(0, 1)};
  EXPECT_EQ(one_way_lines(bowl), (std::vector<Points>{{{6, 3}, {5, 3}}, {{5, 1}, {1, 1}}, {{1, 3}, {0, 3}}}));
  EXPECT_EQ(pieces_of(Scenery<double>(SceneryDef{{bowl}})),
            (std::vector<Points>{{{0, 3}, {1, 3}}, {{1, 1}, {5, 1}}, {{5, 3}, {6, 3}}}));
  const ColliderDef ledge{.shape = ColliderDef::Shape::chain, .points = {{0, 0}, {2, 0}}, .one_way = Vec2d(0, 1)};
  EXPECT_EQ(one_way_lines(ledge), std::vector<Points>{ledge.points});
}

TEST(FloatScenery, vertices_are_rounded_first_and_the_definition_as_run_says_to_what) {
  const Polygon polygon{{{0.1, 0.2}, {1.1, 0.3}, {0.7, 1.3}}, {}};
  const Scenery<float> scenery(scenery_of(polygon));
  for (std::size_t i = 0; i < 3; ++i) {
    for (const Eigen::Index axis : {0, 1}) {
      const float rounded = static_cast<float>(polygon.outer[i][axis]);
      EXPECT_EQ(scenery.vertices_of(0)[i][axis], rounded);
      const double as_run = scenery.as_run(0).points[i][axis];
      EXPECT_EQ(as_run, rounded);
      EXPECT_NE(as_run, polygon.outer[i][axis]);
    }
  }
  EXPECT_EQ(Scenery<double>(scenery_of(polygon)).as_run(0).points, polygon.outer);
}

TEST(FloatScenery, a_polygon_that_rounding_destroys_is_refused_with_the_reason) {
  const double x = 1000;
  const Polygon thin{{{x, 0}, {x + 1e-6, 0}, {x + 1e-6, 1}, {x, 1}}, {}};
  EXPECT_EQ(refusal_of<double>(scenery_of(thin)), "accepted");
  EXPECT_NE(refusal_of<float>(scenery_of(thin)).find("after rounding the coordinates"), std::string::npos);
}

TEST(FloatScenery, pieces_of_random_polygons_tile_what_runs) {
  int cut = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    test::Random random(seed);
    const SceneryDef def = scenery_of(test::holed(random));
    if (refusal_of<float>(def) != "accepted") continue;
    const Scenery<float> scenery(def);
    const ColliderDef as_run = scenery.as_run(0);
    ASSERT_NO_FATAL_FAILURE(expect_exact_tiling({as_run.points, as_run.holes}, pieces_of(scenery), random))
        << "seed " << seed;
    ++cut;
  }
  EXPECT_GE(cut, 250);
}

TEST(Scenery, traces_of_a_length_become_zero_and_the_definition_as_run_says_so) {
  const Scenery<double> scenery(scenery_of(Polygon{{{1e-200, 0}, {1, -5e-324}, {0, 1}}, {}}));
  EXPECT_EQ(scenery.as_run(0).points, (Points{{0, 0}, {1, 0}, {0, 1}}));
}

TEST(Scenery, the_definition_as_run_is_the_one_that_was_given_whatever_is_kept_of_it) {
  const auto chain = ColliderDef::Shape::chain;
  SceneryDef def;
  Points square{{1, 2}, {4, 2}, {4, 7}, {1, 7}};
  for (const bool clockwise : {false, true}) {
    if (clockwise) std::reverse(square.begin(), square.end());
    for (int corner = 0; corner < 4; ++corner) {
      def.colliders.push_back({.points = square});
      std::rotate(square.begin(), square.begin() + 1, square.end());
    }
  }
  def.colliders.push_back({.points = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}});          // a vertex on a side
  def.colliders.push_back({.points = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}});  // two pieces
  def.colliders.push_back(
      {.points = {{0, 0}, {3, 0}, {3, 3}, {0, 3}}, .holes = {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}}, .mover = 1});
  def.colliders.push_back({.points = {{0, 0}, {1, 1}, {0.5, 3}}, .surface_speed = -2});
  def.colliders.push_back({.points = {{0.5, 3}, {1, 1}, {0, 0}}, .sensor = true});
  def.colliders.push_back({.shape = chain, .points = {{0, 0}, {1, 0}}});
  def.colliders.push_back({.shape = chain, .points = {{1, 0}, {0, 0}}, .one_way = Vec2d(0, 1)});
  def.colliders.push_back({.shape = chain, .points = {{1, 0}, {1, 5}}, .one_way = Vec2d(0, 1)});  // no piece at all
  def.colliders.push_back(
      {.shape = chain, .points = {{0, 0}, {1, 0}, {2, 1}}, .one_way = Vec2d(0, 1), .mover = 0, .carries = false});
  const Scenery<double> scenery(def);
  const SceneryDef as_run = scenery.as_run();
  ASSERT_EQ(as_run.colliders.size(), def.colliders.size());
  for (ColliderIndex i = 0; i < def.colliders.size(); ++i) {
    const ColliderDef& given = def.colliders[i];
    const ColliderDef& back = as_run.colliders[i];
    EXPECT_EQ(back.shape, given.shape) << i;
    EXPECT_EQ(back.points, given.points) << i;
    EXPECT_EQ(back.holes, given.holes) << i;
    EXPECT_EQ(back.one_way, given.one_way) << i;
    EXPECT_EQ(back.mover, given.mover) << i;
    EXPECT_EQ(back.sensor, given.sensor) << i;
    EXPECT_EQ(back.surface_speed, given.surface_speed) << i;
    EXPECT_EQ(back.carries, given.carries) << i;
    const PieceRange pieces = scenery.pieces_of(i);
    for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece)
      EXPECT_EQ(scenery.pieces()[piece].collider == i, pieces.first <= piece && piece < pieces.end) << i;
  }
}

TEST(Scenery, a_rectangle_has_its_vertices_counter_clockwise_from_the_first_that_was_given) {
  Points square{{1, 2}, {4, 2}, {4, 7}, {1, 7}};
  for (int corner = 0; corner < 4; ++corner) {
    const Scenery<float> scenery(SceneryDef{{{.points = square}}});
    EXPECT_TRUE(scenery.pieces()[0].is_rectangle());
    EXPECT_EQ(piece_of(scenery, 0), square);
    std::rotate(square.begin(), square.begin() + 1, square.end());
  }
}

TEST(Scenery, no_colliders_at_all_are_a_scenery) {
  const Scenery<double> scenery(SceneryDef{});
  EXPECT_TRUE(scenery.pieces().empty());
  EXPECT_TRUE(scenery.boxes().empty());
}

TEST(Scenery, polygons_of_thousands_of_vertices_are_cut_completely) {
  test::Random random(1);
  const Polygon polygon{test::star_ring(random, 3000, Vec2d::Zero(), 1, 3), {}};
  const Scenery<double> scenery(scenery_of(polygon));
  Rational area = 0;
  for (const Points& piece : pieces_of(scenery)) {
    ASSERT_TRUE(is_strictly_convex(piece));
    area += test::twice_area(piece);
  }
  EXPECT_EQ(area, twice_area(polygon));
}

}  // namespace
}  // namespace paperproof
