#include "records/verdict.hpp"

#include "records/clause.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

TEST(Verdict, is_the_worst_of_all_axes_and_the_reason_names_each) {
  Row row;
  settle(row);
  EXPECT_EQ(row.verdict, Verdict::holds);
  EXPECT_EQ(row.reason, "");
  add_fault(row, Axis::validity, Verdict::flagged, "3 steps beyond the cap");
  add_fault(row, Axis::safety, Verdict::tunnels, "passes the paper");
  add_fault(row, Axis::progress, Verdict::flagged, "hangs on 2 steps");
  add_fault(row, Axis::progress, Verdict::flagged, "drops 1 step");
  settle(row);
  EXPECT_EQ(row.verdict, Verdict::tunnels) << "the cap hides no tunnel";
  EXPECT_EQ(row.reason,
            "safety: passes the paper; progress: hangs on 2 steps, drops 1 step; validity: 3 steps beyond the cap");
  add_fault(row, Axis::answer, Verdict::flagged, "1 m off");
  settle(row);
  EXPECT_EQ(row.verdict, Verdict::tunnels);
  EXPECT_TRUE(row.reason.ends_with("; answer: 1 m off; validity: 3 steps beyond the cap")) << row.reason;
}

TEST(Verdict, goes_from_failed_through_a_broken_guarantee_to_what_is_only_flagged) {
  const std::vector<Verdict> worst_first{Verdict::violates, Verdict::tunnels, Verdict::flagged};
  for (std::size_t i = 0; i < worst_first.size(); ++i) {
    Row row;
    for (std::size_t k = i; k < worst_first.size(); ++k) add_fault(row, Axis::safety, worst_first[k], "x");
    settle(row);
    EXPECT_EQ(row.verdict, worst_first[i]);
  }
}

TEST(Verdict, of_a_run_that_was_not_made_stays) {
  for (const Verdict verdict : {Verdict::failed, Verdict::not_applicable}) {
    Row row;
    row.verdict = verdict;
    row.reason = "no slopes";
    add_fault(row, Axis::progress, Verdict::flagged, "hangs");
    settle(row);
    EXPECT_EQ(row.verdict, verdict);
    EXPECT_EQ(row.reason, "no slopes");
  }
}

TEST(Breach, counts_a_step_once_and_keeps_what_happened_first) {
  Breach breach;
  for (const auto& [step, words] : {std::pair{3, "first"}, {3, "second"}, {4, "third"}, {7, "fourth"}, {7, "fifth"}})
    breach.add(step, [words = words] { return std::string(words); });
  EXPECT_EQ(breach.steps, 3);
  EXPECT_EQ(breach.first_step, 3);
  EXPECT_EQ(breach.first, "first");
  Breach at_zero;
  at_zero.add(0, [] { return std::string("at once"); });
  EXPECT_EQ(at_zero.steps, 1);
}

}  // namespace
}  // namespace paperproof::compare
