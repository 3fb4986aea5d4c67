/// Finding the bodies whose boxes overlap: the sweep against the slow, honest twin.
#include "controller/article_support.hpp"
#include "techniques/discrete/pairs.hpp"

#include <gtest/gtest.h>

namespace paperproof::article_tests {
namespace {

using discrete::BodyIndex;
using discrete::Pair;
using discrete::PairList;
using discrete::Reaches;

/// Sorted. @param find fills a list.
std::vector<Pair> sorted(const auto& find) {
  PairList pairs;
  find(pairs);
  std::vector<Pair> all = pairs.all();
  std::sort(all.begin(), all.end());
  return all;
}

template <class Scalar>
std::vector<Pair> expect_both_alike(Reaches<Scalar> reaches) {
  const std::vector<Pair> slow = sorted([&](PairList& pairs) { find_pairs_one_by_one(reaches, pairs); });
  EXPECT_EQ(sorted([&](PairList& pairs) { find_pairs_by_sweep(reaches, pairs); }), slow);
  return slow;
}

/// Boxes in a field, a row or a tower; on whole quarters of a metre, so that many touch and begin at the same place.
template <class Scalar>
Reaches<Scalar> any_reaches(Random& random, double share_that_moves) {
  const Vec2d field{random.between(0.5, 12), random.between(0.5, 12)};
  const auto place = [&random](double most) { return std::floor(random.between(0, 4 * most)) / 4; };
  Reaches<Scalar> reaches;
  const int count = random.below(60);
  for (int i = 0; i < count; ++i) {
    const Vec2d lower{place(field.x()), place(field.y())};
    const Vec2d size{place(random.below(10) == 0 ? 12 : 1), place(1)};
    (random.chance(share_that_moves) ? reaches.movable : reaches.fixed)
        .push_back({{lower.cast<Scalar>(), (lower + size).cast<Scalar>()}, static_cast<BodyIndex>(i)});
  }
  return reaches;
}

template <class Scalar>
void compare_with_twin(std::uint64_t seed, int scenes) {
  Random random(seed);
  std::size_t possible = 0;
  std::size_t found = 0;
  for (int scene = 0; scene < scenes; ++scene) {
    const Reaches<Scalar> reaches = any_reaches<Scalar>(random, random.unit());
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", scene " << scene);
    const std::size_t movable = reaches.movable.size();
    possible += movable * (movable + reaches.fixed.size());
    found += expect_both_alike(reaches).size();
  }
  EXPECT_GT(found, possible / 50);
  EXPECT_LT(found, possible / 3);
}

TEST(DiscretePairs, of_a_sweep_are_those_of_looking_at_all) {
  compare_with_twin<double>(61, 9000);
  compare_with_twin<float>(62, 1000);
}

TEST(DiscretePairs, have_first_what_can_be_moved_and_the_lower_of_two_that_can) {
  const Box2<double> here{{0, 0}, {1, 1}};
  const Reaches<double> reaches{.movable = {{here, 3}, {here, 1}}, .fixed = {{here, 0}, {here, 2}}};
  const std::vector<Pair> expected{{1, 0}, {1, 2}, {1, 3}, {3, 0}, {3, 2}};
  EXPECT_EQ(expect_both_alike(reaches), expected);
}

TEST(DiscretePairs, beyond_the_limit_are_left_out_and_that_is_remembered) {
  PairList pairs;
  pairs.limit(2);
  for (BodyIndex i = 1; i <= 3; ++i) {
    EXPECT_FALSE(pairs.overflowed()) << i;
    pairs.add({0, i});
  }
  EXPECT_TRUE(pairs.overflowed());
  EXPECT_EQ(pairs.all().size(), 2U);
  pairs.clear();
  EXPECT_FALSE(pairs.overflowed());
  EXPECT_TRUE(pairs.all().empty());
}

}  // namespace
}  // namespace paperproof::article_tests
