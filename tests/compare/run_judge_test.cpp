/// What a run broke, over all its steps.
#include "runs/run_judge.hpp"
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

constexpr double feet = 0.625;  // of the octagon

/// Falls freely from rest, a step at a time, and says that it touched something.
class Fall {
 public:
  Fall() : header_(promising({box(-4, -9, 4, -8), box(7, -9, 8, 9)})) {
    header_.gravity = {0, -10};
    header_.starts = {{.position = {0, 0}, .velocity = {0, 0}}};
    header_.guarantees = every_clause();
  }
  [[nodiscard]] const TraceHeader& header() const { return header_; }
  [[nodiscard]] int steps() const { return step_; }
  TraceStep next(std::vector<Contact<double>> contacts) {
    velocity_.y() -= 10 * dt;
    TraceStep fall = step({at_, at_ + velocity_ * dt});
    fall.step = step_++;
    fall.contacts = std::move(contacts);
    at_ = fall.path.back().position;
    return fall;
  }

 private:
  TraceHeader header_;
  Vec2d at_{Vec2d::Zero()};
  Vec2d velocity_{Vec2d::Zero()};
  int step_ = 0;
};

Contact<double> touch_of_wall() {
  return {.collider = 1, .point = {7, 0}, .normal = {-1, 0}, .fraction = 0.5, .separation = 5e-7, .side = Side::right};
}

/// The metrics match what is reported with what is exact, the judge holds each contact against its own point, and a
/// character that is met has to be another one.
TEST(RunJudge, counts_a_step_once_whichever_way_a_contact_is_found_to_be_invented) {
  Fall fall;
  RunJudge judge(fall.header(), {});
  Contact<double> of_air = touch_of_wall();
  of_air.point = {3, feet};
  for (const std::vector<Contact<double>>& contacts :
       {std::vector<Contact<double>>{}, {}, {touch_of_wall()}, {}, {of_air}}) {
    EXPECT_EQ(judge.breaches().contains(Clause::contact_invented), fall.steps() > 1);
    std::vector<TraceStep> records{fall.next(contacts)};
    if (records[0].step == 1 || records[0].step == 2)
      records[0].met = {{.other = 0, .normal = {0, 1}, .fraction = 0.5, .side = Side::bottom}};
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
