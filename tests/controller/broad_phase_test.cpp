#include "broad_phase/most_at_once.hpp"
#include "campaign/random.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>
#include <paperproof/broad_phase.hpp>

#include <cmath>
#include <limits>

namespace paperproof {
namespace {

template <class Scalar>
using Boxes = std::vector<Box2<Scalar>>;

/// A scene, from the level of tiles to heaps of identical boxes, at scales from 1e-3 to 1e30.
template <class Scalar>
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed) {
    scale_ = static_cast<Scalar>(std::pow(10.0, random_.chance(0.1) ? random_.integer(-3, 30) : random_.integer(0, 3)));
    const int kind = random_.below(4);
    const int size = random_.integer(0, 200);
    for (int i = 0; i < size; ++i) {
      if (kind == 0 && i > 0 && random_.chance(0.33)) {
        boxes.push_back(one_of_them());
      } else if (kind == 1) {
        const Vec2<Scalar> corner{static_cast<Scalar>(random_.below(16)), static_cast<Scalar>(random_.below(16))};
        boxes.push_back({corner, corner + Vec2<Scalar>::Ones()});
      } else {
        boxes.push_back(box());
      }
    }
  }
  Box2<Scalar> query() { return !boxes.empty() && random_.chance(0.25) ? one_of_them() : box(); }

  Boxes<Scalar> boxes;

 private:
  const Box2<Scalar>& one_of_them() {
    return boxes[static_cast<std::size_t>(random_.below(static_cast<int>(boxes.size())))];
  }
  Scalar length(double low) { return static_cast<Scalar>(random_.between(low, 1)) * scale_; }
  /// One in twelve is a point, about half are lines.
  Box2<Scalar> box() {
    const Scalar width = random_.chance(0.25) ? Scalar(0) : length(0) / 4;
    const Scalar height = random_.chance(0.33) ? Scalar(0) : length(0) / 4;
    const Vec2<Scalar> corner{length(-1), length(-1)};
    return {corner, corner + Vec2<Scalar>(width, height)};
  }

  compare::Random random_;
  Scalar scale_ = 1;
};

/// By definition, in ascending order.
template <class Scalar>
std::vector<PieceIndex> overlapping(const Boxes<Scalar>& boxes, const Box2<Scalar>& query) {
  std::vector<PieceIndex> all;
  for (PieceIndex i = 0; i < boxes.size(); ++i)
    if ((boxes[i].lower.array() <= query.upper.array()).all() && (query.lower.array() <= boxes[i].upper.array()).all())
      all.push_back(i);
  return all;
}

/// Every kind finds those and no others. Where there is no room for all, it counts them, and writes nothing beyond.
template <class Scalar>
void expect_to_be_found(const Boxes<Scalar>& boxes, const Boxes<Scalar>& queries) {
  constexpr PieceIndex untouched = 4294967295U;
  for (const BroadPhaseKind kind : {BroadPhaseKind::all_pairs, BroadPhaseKind::buckets, BroadPhaseKind::tree}) {
    const auto broad_phase = make_broad_phase<Scalar>(kind, boxes);
    ASSERT_EQ(broad_phase->size(), boxes.size());
    for (const Box2<Scalar>& query : queries) {
      const std::vector<PieceIndex> expected = overlapping(boxes, query);
      std::vector<PieceIndex> found(boxes.size());
      const std::size_t before = tests::allocations();
      const std::size_t count = broad_phase->query(query, found);
      ASSERT_EQ(tests::allocations(), before);
      found.resize(count);
      ASSERT_EQ(found, expected) << "kind " << static_cast<int>(kind);
      found.assign(count, untouched);
      ASSERT_EQ(broad_phase->query(query, std::span(found).first(count / 2)), count);
      for (std::size_t i = count / 2; i < count; ++i) ASSERT_EQ(found[i], untouched);
    }
  }
}

template <class Scalar>
class BroadPhases : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BroadPhases, Scalars, );

TYPED_TEST(BroadPhases, find_exactly_what_overlaps_without_memory_and_no_more_than_most_at_once_on_10000_scenes) {
  using Scalar = TypeParam;
  int queries = 0;
  int not_empty = 0;
  int selective = 0;
  for (unsigned seed = 0; seed < test::sampled(10000); ++seed) {
    RandomScene<Scalar> scene(seed);
    const Boxes<Scalar> asked{scene.query(), scene.query(), scene.query(), scene.query()};
    ASSERT_NO_FATAL_FAILURE(expect_to_be_found(scene.boxes, asked)) << "seed " << seed;
    for (const Box2<Scalar>& query : asked) {
      const std::size_t count = overlapping(scene.boxes, query).size();
      ++queries;
      not_empty += count > 0;
      selective += count > 0 && count < scene.boxes.size();
      const Vec2<Scalar> size = query.upper - query.lower;
      if (!scene.boxes.empty() && size.maxCoeff() > 0) {
        ASSERT_LE(count, broad_phase::most_at_once<Scalar>(scene.boxes, size)) << "seed " << seed;
      }
    }
  }
  EXPECT_GE(not_empty, queries * 3 / 10);
  EXPECT_GE(selective, queries * 3 / 10);
}

template <class Scalar>
Box2<Scalar> square_at(Scalar x, Scalar y, Scalar side) {
  return {{x, y}, {x + side, y + side}};
}

/// `columns` wide, from the origin on.
template <class Scalar>
Boxes<Scalar> tiles(int count, int columns) {
  Boxes<Scalar> all;
  for (int i = 0; i < count; ++i) {
    const int row = i / columns;
    all.push_back(square_at<Scalar>(static_cast<Scalar>(i % columns), static_cast<Scalar>(row), 1));
  }
  return all;
}

TYPED_TEST(BroadPhases, find_exactly_what_overlaps_at_the_edges) {
  using Scalar = TypeParam;
  const Scalar most = std::numeric_limits<Scalar>::max();
  const Scalar beyond = std::nextafter(Scalar(1), Scalar(2));
  Boxes<Scalar> wide{{{-most, 0}, {most, 1}}, {{most / 2, 0}, {most / 2, 0}}};
  for (int i = 0; i < 100; ++i) wide.push_back(square_at<Scalar>(Scalar(i), Scalar(0.5), Scalar(0.25)));
  struct Case {
    const char* name;
    Boxes<Scalar> boxes;
    Boxes<Scalar> queries;
  };
  const std::array cases{Case{"nothing", {}, {square_at<Scalar>(-1, -1, 2)}},
                         Case{"touched, and an ulp beyond",
                              {square_at<Scalar>(0, 0, 1)},
                              {square_at<Scalar>(1, 1, 1), {{beyond, 0}, {2, 2}}, {{0, beyond}, {2, 2}}}},
                         Case{"points in one place",
                              Boxes<Scalar>(100, square_at<Scalar>(3, 4, 0)),
                              {square_at<Scalar>(3, 4, 0), square_at<Scalar>(2, 3, 1), square_at<Scalar>(5, 4, 1)}},
                         Case{"a million cells, and the end of the world",
                              tiles<Scalar>(1000, 40),
                              {square_at<Scalar>(-500, -500, 1000),
                               square_at<Scalar>(-1e6, 20, 2e6),
                               {{-most, -most}, {most, most}},
                               {{most, most}, {most, most}}}},
                         Case{"one as wide as the world among small ones",
                              wide,
                              {square_at<Scalar>(3, 0, 1),
                               square_at<Scalar>(1e9F, 0, 1),
                               {{most / 2, 0}, {most / 2, 1}},
                               square_at<Scalar>(3, 2, 1)}}};
  for (const Case& edge : cases) ASSERT_NO_FATAL_FAILURE(expect_to_be_found(edge.boxes, edge.queries)) << edge.name;
  EXPECT_LE(broad_phase::most_at_once<Scalar>(tiles<Scalar>(10'000, 100), {Scalar(0.6), Scalar(1.2)}), 144U);
}

}  // namespace
}  // namespace paperproof
