/// What other controllers have, where no other test and no situation shows it. `coming_from.md` lists all of it, with
/// the tests; tests/situations/complaints.json has most of what users complain of.
#include "controller/stepping.hpp"

#include <paperproof/report.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace paperproof::stepping {
namespace {

constexpr double stop = Tolerances{}.stop;
constexpr double touch = 1e-6;  ///< Largest gap of what was stopped [m].

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

TEST(PeersSituation, a_wall_is_still_found_without_a_key) {
  Stepper idle({rectangle(-9, -1, 9, 0), rectangle(1, 0, 2, 4)});
  idle.at(0, half_height + stop).steps(60, {.move = 1});
  ASSERT_TRUE(idle.state.wall_right);
  idle.steps(60, {.move = 0});
  EXPECT_FALSE(idle.state.wall_right) << "nothing was wanted to the right";
  std::array<Contact, 4> found;
  const std::size_t count = idle.sweep().contacts_at(idle.state.position, touch, {.dt = idle.dt}, idle.scratch, found);
  EXPECT_GT(std::ranges::count(std::span(found).first(count), Side::right, &Contact::side), 0);
}

}  // namespace
}  // namespace paperproof::stepping
