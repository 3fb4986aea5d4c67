#include "broad_phase/most_at_once.hpp"
#include "support/allocations.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>
#include <paperproof/broad_phase.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace paperproof {
namespace {

constexpr std::array all_kinds{BroadPhaseKind::all_pairs, BroadPhaseKind::buckets, BroadPhaseKind::tree};

template <class Scalar>
using Boxes = std::vector<Box2<Scalar>>;

template <class Scalar>
std::vector<PieceIndex> all_found(const BroadPhase<Scalar>& broad_phase, const Box2<Scalar>& query) {
  std::vector<PieceIndex> found(broad_phase.size());
  found.resize(broad_phase.query(query, found));
  return found;
}

/// A scene, from the level of tiles to heaps of identical boxes, at scales from 1e-3 to 1e30.
template <class Scalar>
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed) {
    scale_ = static_cast<Scalar>(std::pow(10.0, integer(0, 9) == 0 ? integer(-3, 30) : integer(0, 3)));
    const int kind = integer(0, 3);
    const int size = integer(0, 200);
    for (int i = 0; i < size; ++i) {
      if (kind == 0 && i > 0 && integer(0, 2) == 0) {
        boxes.push_back(boxes[static_cast<std::size_t>(integer(0, i - 1))]);
      } else if (kind == 1) {
        const Vec2<Scalar> corner{static_cast<Scalar>(integer(0, 15)), static_cast<Scalar>(integer(0, 15))};
        boxes.push_back({corner, corner + Vec2<Scalar>::Ones()});
      } else {
        boxes.push_back(box());
      }
    }
  }

  Box2<Scalar> query() {
    if (!boxes.empty() && integer(0, 3) == 0) return boxes[static_cast<std::size_t>(integer(0, count() - 1))];
    return box();
  }

  Boxes<Scalar> boxes;

 private:
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Scalar uniform() { return std::uniform_real_distribution<Scalar>(-1, 1)(random_); }
  int count() const { return static_cast<int>(boxes.size()); }
  /// One in eight is a point, one in four a line.
  Box2<Scalar> box() {
    const Scalar width = integer(0, 3) == 0 ? Scalar(0) : std::abs(uniform()) * scale_ / 4;
    const Scalar height = integer(0, 2) == 0 ? Scalar(0) : std::abs(uniform()) * scale_ / 4;
    const Vec2<Scalar> corner{uniform() * scale_, uniform() * scale_};
    return {corner, corner + Vec2<Scalar>(width, height)};
  }

  std::mt19937 random_;
  Scalar scale_ = 1;
};

template <class Scalar>
class BroadPhases : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BroadPhases, Scalars, );

TYPED_TEST(BroadPhases, buckets_and_tree_find_what_looking_at_every_box_finds_on_10000_scenes) {
  using Scalar = TypeParam;
  int queries = 0;
  int not_empty = 0;
  int selective = 0;
  constexpr unsigned scenes = test::sampled(10000);
  for (unsigned seed = 0; seed < scenes; ++seed) {
    RandomScene<Scalar> scene(seed);
    const auto slow = make_broad_phase<Scalar>(BroadPhaseKind::all_pairs, scene.boxes);
    const auto buckets = make_broad_phase<Scalar>(BroadPhaseKind::buckets, scene.boxes);
    const auto tree = make_broad_phase<Scalar>(BroadPhaseKind::tree, scene.boxes);
    ASSERT_EQ(slow->size(), scene.boxes.size());
    ASSERT_EQ(buckets->size(), scene.boxes.size());
    ASSERT_EQ(tree->size(), scene.boxes.size());
    for (int i = 0; i < 4; ++i) {
      const Box2<Scalar> query = scene.query();
      const std::vector<PieceIndex> expected = all_found(*slow, query);
      ASSERT_EQ(all_found(*buckets, query), expected) << "buckets, seed " << seed << ", query " << i;
      ASSERT_EQ(all_found(*tree, query), expected) << "tree, seed " << seed << ", query " << i;
      ++queries;
      if (!expected.empty()) ++not_empty;
      if (!expected.empty() && expected.size() < scene.boxes.size()) ++selective;
    }
  }
  EXPECT_GE(not_empty, queries * 3 / 10);
  EXPECT_GE(selective, queries * 3 / 10);
}

/// Boxes on a lattice, so that moving them is exact in either scalar; some stand still, the others go with movers.
template <class Scalar>
class MovingScene {
 public:
  explicit MovingScene(unsigned seed) : random_(seed) {
    groups_.resize(1 + below(6));
    offsets_.resize(groups_.size(), Vec2<Scalar>::Zero());  // the first stays where it is
    for (std::size_t i = below(120); i > 0; --i) groups_[below(groups_.size())].push_back(box(16, 4));
  }

  void move_on() {
    for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += point(8);
  }
  Box2<Scalar> query() { return box(16, 12); }

  /// Of each group in turn: one broad phase for it where it was defined, which is asked with the box as it is seen from
  /// there.
  [[nodiscard]] std::vector<PieceIndex> found_by_shifting(BroadPhaseKind kind, const Box2<Scalar>& query) const {
    std::vector<PieceIndex> found;
    PieceIndex first = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const auto broad_phase = make_broad_phase<Scalar>(kind, groups_[i]);
      const Box2<Scalar> seen{query.lower - offsets_[i], query.upper - offsets_[i]};
      for (const PieceIndex piece : all_found(*broad_phase, seen)) found.push_back(first + piece);
      first += static_cast<PieceIndex>(groups_[i].size());
    }
    return found;
  }
  /// One broad phase over all boxes where they are now.
  [[nodiscard]] std::vector<PieceIndex> found_by_moving(BroadPhaseKind kind, const Box2<Scalar>& query) const {
    Boxes<Scalar> moved;
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (const Box2<Scalar>& box : groups_[i]) moved.push_back({box.lower + offsets_[i], box.upper + offsets_[i]});
    return all_found(*make_broad_phase<Scalar>(kind, moved), query);
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  Vec2<Scalar> point(int reach) {
    const auto coordinate = [&] {
      return static_cast<Scalar>(static_cast<int>(below(16U * static_cast<unsigned>(reach))) - 8 * reach) / 8;
    };
    const Scalar x = coordinate();
    return {x, coordinate()};
  }
  Box2<Scalar> box(int reach, int size) {
    const Vec2<Scalar> a = point(reach);
    const Vec2<Scalar> b = a + point(size);
    return {a.cwiseMin(b), a.cwiseMax(b)};
  }

  std::mt19937 random_;
  std::vector<Boxes<Scalar>> groups_;
  std::vector<Vec2<Scalar>> offsets_;
};

TYPED_TEST(BroadPhases, find_the_same_boxes_in_the_same_order_on_10000_scenes_that_move) {
  using Scalar = TypeParam;
  int queries = 0;
  int not_empty = 0;
  constexpr unsigned scenes = test::sampled(10000);
  for (unsigned seed = 0; seed < scenes; ++seed) {
    MovingScene<Scalar> scene(seed);
    for (int step = 0; step < 2; ++step) {
      const Box2<Scalar> query = scene.query();
      const std::vector<PieceIndex> expected = scene.found_by_moving(BroadPhaseKind::all_pairs, query);
      for (const BroadPhaseKind kind : all_kinds) {
        const auto name = testing::Message()
                          << "kind " << static_cast<int>(kind) << ", seed " << seed << ", step " << step;
        ASSERT_EQ(scene.found_by_shifting(kind, query), expected) << name;
        ASSERT_EQ(scene.found_by_moving(kind, query), expected) << name;
      }
      ++queries;
      not_empty += expected.empty() ? 0 : 1;
      scene.move_on();
    }
  }
  EXPECT_GE(not_empty, queries * 2 / 10);
  EXPECT_LE(not_empty, queries * 8 / 10);
}

TYPED_TEST(BroadPhases, looking_at_every_box_finds_exactly_those_that_overlap_in_ascending_order) {
  using Scalar = TypeParam;
  for (unsigned seed = 0; seed < 500; ++seed) {
    RandomScene<Scalar> scene(seed);
    const Box2<Scalar> query = scene.query();
    std::vector<PieceIndex> expected;
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
      const Box2<Scalar>& box = scene.boxes[i];
      const bool apart = box.upper.x() < query.lower.x() || query.upper.x() < box.lower.x() ||
                         box.upper.y() < query.lower.y() || query.upper.y() < box.lower.y();
      if (!apart) expected.push_back(static_cast<PieceIndex>(i));
    }
    ASSERT_EQ(all_found(*make_broad_phase<Scalar>(BroadPhaseKind::all_pairs, scene.boxes), query), expected)
        << "seed " << seed;
  }
}

TYPED_TEST(BroadPhases, more_boxes_than_room_are_counted_and_nothing_is_written_beyond_it) {
  using Scalar = TypeParam;
  constexpr PieceIndex untouched = 4294967295U;
  int overflows = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    RandomScene<Scalar> scene(seed);
    const Box2<Scalar> query = scene.query();
    for (const BroadPhaseKind kind : all_kinds) {
      const auto broad_phase = make_broad_phase<Scalar>(kind, scene.boxes);
      const std::size_t count = all_found(*broad_phase, query).size();
      if (count == 0) continue;
      std::vector<PieceIndex> memory(count, untouched);
      const std::size_t room = count / 2;
      ASSERT_EQ(broad_phase->query(query, std::span(memory).first(room)), count) << "seed " << seed;
      for (std::size_t i = room; i < count; ++i) ASSERT_EQ(memory[i], untouched) << "seed " << seed;
      ++overflows;
    }
  }
  EXPECT_GE(overflows, 500);
}

TYPED_TEST(BroadPhases, touching_boxes_are_found_and_boxes_one_bit_further_are_not) {
  using Scalar = TypeParam;
  const Boxes<Scalar> boxes{{{0, 0}, {1, 1}}};
  const Scalar beyond = std::nextafter(Scalar(1), Scalar(2));
  for (const BroadPhaseKind kind : all_kinds) {
    const auto broad_phase = make_broad_phase<Scalar>(kind, boxes);
    EXPECT_EQ(all_found(*broad_phase, {{1, 1}, {2, 2}}).size(), 1U);
    EXPECT_EQ(all_found(*broad_phase, {{beyond, 0}, {2, 2}}).size(), 0U);
    EXPECT_EQ(all_found(*broad_phase, {{0, beyond}, {2, 2}}).size(), 0U);
  }
}

TYPED_TEST(BroadPhases, no_boxes_at_all_is_a_scene_too) {
  using Scalar = TypeParam;
  for (const BroadPhaseKind kind : all_kinds) {
    const auto broad_phase = make_broad_phase<Scalar>(kind, std::span<const Box2<Scalar>>());
    EXPECT_EQ(broad_phase->size(), 0U);
    EXPECT_EQ(broad_phase->query({{-1, -1}, {1, 1}}, {}), 0U);
  }
}

/// Whatever the query, all kinds find the same.
template <class Scalar>
void expect_agreement(const Boxes<Scalar>& boxes, const Boxes<Scalar>& queries) {
  const auto slow = make_broad_phase<Scalar>(BroadPhaseKind::all_pairs, boxes);
  for (const BroadPhaseKind kind : {BroadPhaseKind::buckets, BroadPhaseKind::tree}) {
    const auto fast = make_broad_phase<Scalar>(kind, boxes);
    for (const Box2<Scalar>& query : queries) EXPECT_EQ(all_found(*fast, query), all_found(*slow, query));
  }
}

template <class Scalar>
Box2<Scalar> square_at(Scalar x, Scalar y, Scalar side) {
  return {{x, y}, {x + side, y + side}};
}

TYPED_TEST(BroadPhases, all_boxes_may_be_points_in_one_place) {
  using Scalar = TypeParam;
  const Boxes<Scalar> boxes(100, square_at<Scalar>(3, 4, 0));
  expect_agreement<Scalar>(boxes, {square_at<Scalar>(3, 4, 0), square_at<Scalar>(2, 3, 1), square_at<Scalar>(5, 4, 1)});
}

TYPED_TEST(BroadPhases, a_query_over_a_million_cells_and_one_at_the_end_of_the_world_are_answered) {
  using Scalar = TypeParam;
  Boxes<Scalar> boxes;
  for (int i = 0; i < 1000; ++i) boxes.push_back(square_at<Scalar>(static_cast<Scalar>(i % 40), Scalar(i / 40), 1));
  const Scalar most = std::numeric_limits<Scalar>::max();
  expect_agreement<Scalar>(boxes, {square_at<Scalar>(-500, -500, 1000),
                                   square_at<Scalar>(-1e6, 20, 2e6),
                                   {{-most, -most}, {most, most}},
                                   {{most, most}, {most, most}}});
}

TYPED_TEST(BroadPhases, one_box_as_wide_as_the_world_lies_among_small_ones) {
  using Scalar = TypeParam;
  const Scalar most = std::numeric_limits<Scalar>::max();
  Boxes<Scalar> boxes{{{-most, 0}, {most, 1}}};
  for (int i = 0; i < 100; ++i) boxes.push_back(square_at<Scalar>(Scalar(i), Scalar(0.5), Scalar(0.25)));
  boxes.push_back({{most / 2, 0}, {most / 2, 0}});
  expect_agreement<Scalar>(boxes, {square_at<Scalar>(3, 0, 1),
                                   square_at<Scalar>(1e9F, 0, 1),
                                   {{most / 2, 0}, {most / 2, 1}},
                                   square_at<Scalar>(3, 2, 1)});
}

TYPED_TEST(BroadPhases, no_box_meets_more_than_most_at_once_and_of_many_that_is_few) {
  using Scalar = TypeParam;
  for (unsigned seed = 0; seed < test::sampled(2000); ++seed) {
    RandomScene<Scalar> scene(seed);
    if (scene.boxes.empty()) continue;
    const auto broad_phase = make_broad_phase<Scalar>(BroadPhaseKind::all_pairs, scene.boxes);
    for (int i = 0; i < 10; ++i) {
      const Box2<Scalar> query = scene.query();
      const Vec2<Scalar> size = query.upper - query.lower;
      if (!(size.maxCoeff() > 0)) continue;
      EXPECT_LE(all_found(*broad_phase, query).size(), broad_phase::most_at_once<Scalar>(scene.boxes, size))
          << "seed " << seed;
    }
  }
  Boxes<Scalar> tiles;
  for (int i = 0; i < 10'000; ++i)
    tiles.push_back(square_at<Scalar>(static_cast<Scalar>(i % 100), Scalar(i / 100), 1));  // NOLINT(*-integer-division)
  EXPECT_LE(broad_phase::most_at_once<Scalar>(tiles, {Scalar(0.6), Scalar(1.2)}), 144U);
}

TYPED_TEST(BroadPhases, a_query_takes_no_memory) {
  using Scalar = TypeParam;
  for (const BroadPhaseKind kind : all_kinds) {
    RandomScene<Scalar> scene(17);
    const auto broad_phase = make_broad_phase<Scalar>(kind, scene.boxes);
    std::vector<PieceIndex> found(scene.boxes.size());
    const std::size_t before = tests::allocations();
    std::size_t count = 0;
    for (int i = 0; i < 1000; ++i) count += broad_phase->query(scene.query(), found);
    EXPECT_EQ(tests::allocations(), before);
    EXPECT_GT(count, 0U);
  }
}

}  // namespace
}  // namespace paperproof
