/// How far a contender and its reference agree, and who is right where they do not.
#include "metrics/agreement.hpp"

#include "compare/moments.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace paperproof::compare {
namespace {

class AgreementTest : public testing::Test {
 protected:
  Row compare(const std::vector<std::pair<Moment, Moment>>& run) {
    agreement_.emplace(header(), reference_header_, 2);
    for (const auto& [mine, reference] : run) agreement_->add(mine.step, mine.judged, reference.step, reference.judged);
    Row row;
    agreement_->write(row);
    return row;
  }

  const TraceHeader reference_header_ = header("box2d");
  std::optional<Agreement> agreement_;
};

const Contact floor = contact(0, Side::bottom);
const ExactContact truth = exact(0, Side::bottom);

/// Ours and Box2D's, in which nothing happens.
std::vector<std::pair<Moment, Moment>> silence(int steps) {
  std::vector<std::pair<Moment, Moment>> run;
  for (int i = 0; i < steps; ++i) run.emplace_back(moment(i), moment(i));
  return run;
}

TEST_F(AgreementTest, exact_arithmetic_says_who_is_right) {
  using Right = SideDisagreement::Right;
  const auto one = [&](const Moment& mine, const Moment& reference) {
    compare({{mine, reference}});
    return agreement_->disagreements().at(0).right;
  };
  EXPECT_EQ(one(moment(0, {floor}, {truth}), moment(0, {}, {truth})), Right::mine);
  EXPECT_EQ(one(moment(0, {floor}), moment(0)), Right::reference);
  EXPECT_EQ(one(moment(0, {floor}, {truth}), moment(0)), Right::both);
  EXPECT_EQ(one(moment(0, {}, {truth}), moment(0, {contact(0, Side::top)}, {truth})), Right::neither);
  EXPECT_EQ(agreement_->count(Right::neither), 1);
  EXPECT_EQ(agreement_->disagreements()[0].who_is_right,
            "mine reports no contact where exact arithmetic has bottom, box2d reports top where exact arithmetic has "
            "bottom: neither is right");
}

TEST_F(AgreementTest, a_first_difference_on_which_both_are_right_is_followed_by_the_first_on_which_one_is_not) {
  std::vector<std::pair<Moment, Moment>> run = silence(4);
  run[0].first = moment(0, {floor}, {truth});
  run[3].first.step.contacts = {floor};
  const Row row = compare(run);
  EXPECT_EQ(row.first_difference_box2d_step, 0);
  EXPECT_NE(row.first_difference_box2d.find("; step 3 is the first on which one is not"), std::string::npos)
      << row.first_difference_box2d;
}

TEST_F(AgreementTest, positions_apart_by_more_than_the_skin_are_a_difference) {
  std::vector<std::pair<Moment, Moment>> run = silence(5);
  run[2].second.step.path.back().position = {0.0209, 0};
  EXPECT_FALSE(compare(run).first_difference_box2d_step);
  run[3].second.step.path.back().position = {0.0211, 0};
  EXPECT_EQ(compare(run).first_difference_box2d_step, 3);
  EXPECT_NE(compare(run).first_difference_box2d.find("they respond differently"), std::string::npos);
  run[1].second.judged.tunnelled = {1};
  EXPECT_NE(compare(run).first_difference_box2d.find("mine is right, as box2d passed or entered a solid on step 1"),
            std::string::npos);
  run[2].first.judged.end_overlap = run[2].first.judged.entered = {0};
  EXPECT_NE(compare(run).first_difference_box2d.find("neither is right"), std::string::npos);
}

}  // namespace
}  // namespace paperproof::compare
