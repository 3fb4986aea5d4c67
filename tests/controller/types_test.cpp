/// The values that every part shares.
#include <paperproof/report.hpp>

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

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

TEST(Contacts, of_one_collider_are_one_change_and_removed_ones_come_last) {
  const auto with = [](ColliderIndex collider, double fraction) {
    return Contact{.collider = collider, .fraction = fraction};
  };
  const std::vector<Contact> before{with(7, 0.1), with(3, 0.2), with(7, 0.3)};
  const std::vector<Contact> now{with(5, 0.4), with(3, 0.5), with(5, 0.6)};
  std::vector<std::tuple<ContactChange, ColliderIndex, double>> changes;
  for_each_change(before, now, [&](ContactChange change, const Contact& contact) {
    changes.emplace_back(change, contact.collider, contact.fraction);
  });
  using enum ContactChange;
  EXPECT_EQ(changes, (decltype(changes){{added, 5, 0.4}, {persisted, 3, 0.5}, {removed, 7, 0.1}}));
}

}  // namespace
}  // namespace paperproof
