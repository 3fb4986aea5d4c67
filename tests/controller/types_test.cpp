/// The values that every part shares.
#include <paperproof/technique.hpp>

#include <gtest/gtest.h>

namespace paperproof {
namespace {

using Corners = FixedVector<PathPoint<double>, 2>;

TEST(FixedVector, refuses_what_does_not_fit_and_remembers_it) {
  Corners corners;
  EXPECT_TRUE(corners.push_back({{1, 2}, 0}));
  EXPECT_TRUE(corners.push_back({{3, 4}, 1}));
  EXPECT_FALSE(corners.overflowed());
  EXPECT_FALSE(corners.push_back({{5, 6}, 1}));
  EXPECT_TRUE(corners.overflowed());
  ASSERT_EQ(corners.size(), 2);
  EXPECT_EQ(corners.back().position, Vec2d(3, 4));
}

TEST(FixedVector, is_copied_with_its_elements_and_its_overflow) {
  Corners corners;
  for (const double x : {1.0, 2.0, 3.0}) corners.push_back({{x, -x}, x});
  Corners copy(corners);
  Corners assigned;
  assigned.push_back({{9, 9}, 9});
  assigned = corners;
  const Corners& itself = assigned;
  assigned = itself;
  corners.clear();
  for (const Corners& each : {copy, assigned}) {
    ASSERT_EQ(each.size(), 2);
    EXPECT_TRUE(each.overflowed());
    EXPECT_EQ(each[0].position, Vec2d(1, -1));
    EXPECT_EQ(each[1].fraction, 2);
  }
  EXPECT_TRUE(corners.empty());
  EXPECT_FALSE(corners.overflowed());
}

}  // namespace
}  // namespace paperproof
