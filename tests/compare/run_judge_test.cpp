/// What a run broke, over all its steps.
#include "runs/run_judge.hpp"
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

constexpr double feet = 0.625;  // of the octagon

/// The metrics match what is reported with what is exact, the judge holds each contact against its own point, and a
/// character that is met has to be another one.
TEST(RunJudge, counts_a_step_once_whichever_way_a_contact_is_found_to_be_invented) {
  TraceHeader header = promising({box(-4, -9, 4, -8), box(7, -9, 8, 9)});
  header.gravity = {0, -10};
  header.starts = {{.position = {0, 0}, .velocity = {0, 0}}};
  header.guarantees = every_clause();
  RunJudge judge(header, {});
  const Contact of_wall{
      .collider = 1, .point = {7, 0}, .normal = {-1, 0}, .fraction = 0.5, .separation = 5e-7, .side = Side::right};
  Contact of_air = of_wall;
  of_air.point = {3, feet};
  // Falls freely from rest.
  Vec2d at(0, 0);
  Vec2d velocity(0, 0);
  for (int number = 0; number < 5; ++number) {
    EXPECT_EQ(judge.breaches().contains(Clause::contact_invented), number > 1);
    velocity.y() -= 10 * dt;
    std::vector<TraceStep> records{step({at, at + velocity * dt})};
    records[0].step = number;
    if (number == 2) records[0].contacts = {of_wall};
    if (number == 4) records[0].contacts = {of_air};
    if (number == 1 || number == 2)
      records[0].met = {{.other = 0, .normal = {0, 1}, .fraction = 0.5, .side = Side::bottom}};
    at = records[0].path.back().position;
    judge.add(records);
  }
  for (int again = 0; again < 2; ++again) {
    const Breaches breaches = judge.breaches();
    ASSERT_TRUE(breaches.contains(Clause::contact_invented));
    EXPECT_EQ(breaches.at(Clause::contact_invented).steps, 3);
    EXPECT_EQ(breaches.at(Clause::contact_invented).first_step, 1);
    EXPECT_EQ(breaches.at(Clause::contact_invented).first, "met character 0, which is no other one");
  }
}

}  // namespace
}  // namespace paperproof::compare
