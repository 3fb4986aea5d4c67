#include "campaign/random.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>
#include <paperproof/broad_phase.hpp>
#include <paperproof/scenery.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof {
namespace {

using Boxes = std::vector<Box2>;

/// Some are points, half of them lines. On the lattice many are alike, or touch.
Box2 random_box(compare::Random& random, double scale, bool on_lattice) {
  Vec2d corner = random.point(scale);
  const double width = random.chance(0.25) ? 0 : random.between(0, scale / 4);
  Vec2d size{width, random.chance(0.33) ? 0 : random.between(0, scale / 4)};
  if (on_lattice) {
    corner = (corner * 8 / scale).array().round() * (scale / 8);
    size = (size * 8 / scale).array().round() * (scale / 8);
  }
  return {corner, (corner + size)};
}

/// By definition, in ascending order.
std::vector<PieceIndex> overlapping(const Boxes& boxes, const Box2& query) {
  std::vector<PieceIndex> all;
  for (PieceIndex i = 0; i < boxes.size(); ++i)
    if ((boxes[i].lower.array() <= query.upper.array()).all() && (query.lower.array() <= boxes[i].upper.array()).all())
      all.push_back(i);
  return all;
}

/// The kinds find those and no others, append them, and allocate nothing where there is room.
void expect_to_be_found(const Boxes& boxes, const Boxes& queries, std::span<const BroadPhaseKind> kinds) {
  for (const BroadPhaseKind kind : kinds) {
    const auto broad_phase = make_broad_phase(kind, boxes);
    for (const Box2& query : queries) {
      std::vector<PieceIndex> expected{7};
      std::vector<PieceIndex> found{7};
      found.reserve(1 + boxes.size());
      const std::size_t before = tests::allocations();
      broad_phase->query(query, found);
      ASSERT_EQ(tests::allocations(), before);
      const std::vector<PieceIndex> all = overlapping(boxes, query);
      expected.insert(expected.end(), all.begin(), all.end());
      ASSERT_EQ(found, expected) << "kind " << static_cast<int>(kind);
    }
  }
}

constexpr std::array far{BroadPhaseKind::all_pairs, BroadPhaseKind::tree};
constexpr std::array in_range{BroadPhaseKind::buckets};

/// The grid of the core, for boxes in the range of a scenery, also where some are removed.
void expect_grid_to_find_them(const Boxes& boxes, const Boxes& queries) {
  ASSERT_NO_FATAL_FAILURE(expect_to_be_found(boxes, queries, in_range));
  PieceGrid grid;
  for (PieceIndex i = 0; i < boxes.size(); ++i) grid.add(i, boxes[i]);
  for (const Box2& query : queries) {
    std::vector<PieceIndex> found = overlapping(boxes, query);
    for (PieceIndex i = 1; i < boxes.size(); i += 2) grid.remove(i, boxes[i]);
    std::vector<PieceIndex> fewer;
    grid.find(query, boxes, fewer);
    std::sort(fewer.begin(), fewer.end());
    std::erase_if(found, [](PieceIndex piece) { return piece % 2 == 1; });
    ASSERT_EQ(fewer, found) << "some were removed";
    for (PieceIndex i = 1; i < boxes.size(); i += 2) grid.add(i, boxes[i]);
  }
}

TEST(BroadPhases, find_exactly_what_overlaps_on_thousands_of_scenes) {
  const unsigned scenes = test::sampled(10000U);
  int not_empty = 0;
  int selective = 0;
  for (unsigned seed = 0; seed < scenes; ++seed) {
    compare::Random random(seed);
    const double scale = std::pow(10.0, random.chance(0.1) ? random.integer(-3, 30) : random.integer(0, 3));
    Boxes boxes(static_cast<std::size_t>(random.integer(0, 200)));
    Boxes asked(4);
    for (Boxes* some : {&boxes, &asked})
      for (Box2& box : *some) box = random_box(random, scale, seed % 2 == 0);
    ASSERT_NO_FATAL_FAILURE(expect_to_be_found(boxes, asked, far)) << "seed " << seed;
    if (scale <= 1e6) {
      ASSERT_NO_FATAL_FAILURE(expect_grid_to_find_them(boxes, asked)) << "seed " << seed;
    }
    for (const Box2& query : asked) {
      const std::size_t count = overlapping(boxes, query).size();
      not_empty += count > 0;
      selective += count > 0 && count < boxes.size();
    }
  }
  EXPECT_GE(not_empty, 4 * scenes * 3 / 10);
  EXPECT_GE(selective, 4 * scenes * 3 / 10);
}

Box2 square_at(double x, double y, double side) { return {{x, y}, {x + side, y + side}}; }

/// `columns` wide, from the origin on.
Boxes tiles(int count, int columns) {
  Boxes all;
  for (int i = 0; i < count; ++i)
    all.push_back(square_at(static_cast<double>(i % columns), static_cast<double>(i / columns), 1));
  return all;
}

TEST(BroadPhases, find_exactly_what_overlaps_at_the_edges) {
  const double most = std::numeric_limits<double>::max();
  const double beyond = std::nextafter(1.0, 2.0);
  Boxes wide{{{-most, 0}, {most, 1}}, {{most / 2, 0}, {most / 2, 0}}};
  for (int i = 0; i < 100; ++i) wide.push_back(square_at(double(i), 0.5, 0.25));
  struct Case {
    const char* name;
    Boxes boxes;
    Boxes queries;
  };
  const std::array cases{
      Case{"nothing", {}, {square_at(-1, -1, 2)}},
      Case{"touched, and an ulp beyond",
           {square_at(0, 0, 1)},
           {square_at(1, 1, 1), {{beyond, 0}, {2, 2}}, {{0, beyond}, {2, 2}}}},
      Case{"points in one place",
           Boxes(100, square_at(3, 4, 0)),
           {square_at(3, 4, 0), square_at(2, 3, 1), square_at(5, 4, 1)}},
      Case{"a million cells, and the end of the world",
           tiles(1000, 40),
           {square_at(-500, -500, 1000),
            square_at(-1e6, 20, 2e6),
            {{-most, -most}, {most, most}},
            {{most, most}, {most, most}}}},
      Case{"one as wide as the world among small ones",
           wide,
           {square_at(3, 0, 1), square_at(1e9F, 0, 1), {{most / 2, 0}, {most / 2, 1}}, square_at(3, 2, 1)}}};
  for (const Case& edge : cases) {
    ASSERT_NO_FATAL_FAILURE(expect_to_be_found(edge.boxes, edge.queries, far)) << edge.name;
    if (&edge == &cases.back()) continue;  // no scenery is as wide as the world
    ASSERT_NO_FATAL_FAILURE(expect_grid_to_find_them(edge.boxes, edge.queries)) << edge.name;
  }
}

}  // namespace
}  // namespace paperproof
