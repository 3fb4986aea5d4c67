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

/// One flies at another, which stands. In turns the contact with its body is judged; at the same time none is.
TEST(RunJudge, in_turns_a_meeting_is_said_by_whom_it_stopped_and_has_happened) {
  constexpr double width = 2 * half_width;
  TraceHeader header = promising({box(-4, -9, 4, -8)});
  header.characters = 2;
  header.starts = {{.position = {0, 0}, .velocity = {32, 0}}, {.position = {width + 0.25, 0}, .velocity = {0, 0}}};
  header.guarantees = every_clause();
  TraceStep flies;
  flies.path = {{{0, 0}, 0}, {{0.25 - gap, 0}, 0.5}, {{0.25 - gap, 0}, 1}};
  flies.requested = {0.5, 0};
  flies.met = {{.other = 1, .normal = {-1, 0}, .fraction = 0.5, .side = Side::right}};
  TraceStep stands = step({{width + 0.25, 0}, {width + 0.25, 0}});
  stands.character = 1;
  const auto broken = [&](std::optional<CharacterIndex> turn, double fraction, double aside) {
    std::vector<TraceStep> records{flies, stands};
    records[0].turn = turn;
    if (turn) records[1].turn = 1 - *turn;
    records[0].met[0].fraction = fraction;
    TraceHeader apart = header;
    records[1].path.front().position.x() = apart.starts[1].position.x() += aside;
    records[1].path.back().position.x() += aside;
    RunJudge judge(apart, {});
    judge.add(records);
    std::string all;
    for (const auto& [clause, breach] : judge.breaches()) all += std::string(name_of(clause)) + " ";
    return all;
  };
  EXPECT_EQ(broken(0, 0.5, 0), "");
  EXPECT_EQ(broken(1, 0.5, 0), "");
  EXPECT_EQ(broken(0, 0.25, 0), "time_of_impact ");
  EXPECT_NE(broken(0, 0.5, 1).find("contact_invented"), std::string::npos) << "it is a metre away";
  for (const double fraction : {0.25, 0.5}) EXPECT_EQ(broken({}, fraction, 0), "") << "at the same time";
}

}  // namespace
}  // namespace paperproof::compare
