/// The values that every part shares.
#include <paperproof/report.hpp>

#include <gtest/gtest.h>

namespace paperproof {
namespace {

TEST(FixedVector, refuses_what_does_not_fit_remembers_it_and_is_copied_with_that) {
  using Corners = FixedVector<PathPoint, 2>;
  Corners corners;
  EXPECT_TRUE(corners.push_back({{1, -1}, 1}));
  EXPECT_TRUE(corners.push_back({{2, -2}, 2}));
  EXPECT_FALSE(corners.overflowed());
  EXPECT_FALSE(corners.push_back({{3, -3}, 3}));
  const Corners copy(corners);
  Corners assigned;
  assigned.push_back({{9, 9}, 9});
  assigned = corners;
  const Corners& itself = assigned;
  assigned = itself;
  corners.clear();
  EXPECT_TRUE(corners.empty());
  EXPECT_FALSE(corners.overflowed());
  for (const Corners& each : {copy, assigned}) {
    ASSERT_EQ(each.size(), 2);
    EXPECT_TRUE(each.overflowed());
    EXPECT_EQ(each[0].position, Vec2d(1, -1));
    EXPECT_EQ(each.back().fraction, 2);
  }
}

}  // namespace
}  // namespace paperproof
