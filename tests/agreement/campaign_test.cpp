/// The guarantee of octagon_sweep over every family of random runs: steps break only what is known and open, and enough
/// happens in them.
#include "campaign/campaign.hpp"
#include "agreement/known_and_open.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace paperproof::test {
namespace {

using compare::Clause;
using compare::Family;
using compare::Findings;

class Campaign : public ::testing::TestWithParam<Family> {};

TEST_P(Campaign, breaks_only_what_is_known_and_open) {
  const Family& family = GetParam();
  const Findings all = run_family(family, steps_per_family(), {}, [&](std::uint64_t seed, const Findings& run) {
    std::printf("%s", describe(run.breaches, family.replay_of(seed) + ": ").c_str());
  });
  EXPECT_EQ(all.failed, "");
  for (const auto& [clause, breach] : all.breaches)
    EXPECT_LE(breach.steps, most_broken(family.kind, clause, all.records, family.name))
        << name_of(clause) << " in " << family.title() << ", of " << all.records
        << " steps: more than known_and_open.json allows; the runs are above";
  for (const std::string& missing : uncovered(family, all)) ADD_FAILURE() << missing;
}

/// All; under sanitizers every fourth, and the first of each kind.
std::vector<Family> families_to_run() {
  const std::vector<Family>& all = compare::families();
  std::vector<Family> some;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!sanitized || i % 4 == 0 || all[i].kind != all[i - 1].kind) some.push_back(all[i]);
  return some;
}

INSTANTIATE_TEST_SUITE_P(Every, Campaign, ::testing::ValuesIn(families_to_run()),
                         [](const auto& family) { return family.param.kind + "_" + family.param.name; });

TEST(KnownAndOpen, names_families_and_clauses_that_there_are) {
  for (const nlohmann::json& entry : known_and_open().at("random")) {
    SCOPED_TRACE(entry.dump());
    const std::string runs = entry.at("runs");
    EXPECT_TRUE(compare::clause_named(entry.at("clause").get<std::string>()));
    EXPECT_EQ(compare::families_named(runs).front()->kind, runs);
    EXPECT_GT(entry.at("steps_of_one_run"), 0);
    EXPECT_GT(entry.at("steps_in_a_million"), 0);
    EXPECT_FALSE(entry.at("because").empty());
    const nlohmann::json shares = entry.value("families", nlohmann::json::object());
    for (const auto& [name, share] : shares.items()) {
      EXPECT_EQ(compare::families_named(runs + "/" + name).size(), 1U);
      EXPECT_GT(share, 0) << name;
    }
  }
}

/// What broke once, or was accused wrongly: the runs of a family, and the clauses that they keep.
struct Found {
  const char* title;
  std::vector<std::uint64_t> seeds;
  std::vector<Clause> clauses;
};
const std::vector<Clause> safety{Clause::overlap, Clause::passage, Clause::one_way,      Clause::gap,
                                 Clause::crush,   Clause::hanging, Clause::start_inside, Clause::time_of_impact};
const std::vector<Found> all_found{
    {"static/circles", {15001177}, {Clause::velocity}},
    {"movers/tiles", {2001356}, safety},
    {"movers/slopes", {4000198, 4001578}, safety},
    {"movers/papers", {8001016, 8001922}, safety},
    {"movers/chains", {10000835}, safety},
    {"movers/stairs", {14000776}, safety},
    {"movers/ceilings", {16001581, 16002797, 16004470}, safety},
    {"movers/shafts", {18001570}, safety},
    {"movers/one_way", {24000858, 24000897}, safety},
    {"turning/planks", {3000087}, {Clause::overlap}},
    {"turning/planks", {3000030}, {Clause::velocity}},
    {"turning/see_saws", {6000194}, {Clause::wanted}},
    {"turning/balls", {18000119}, {Clause::velocity}},
    {"turning/balls",
     {18000121, 18000184, 18000224},
     {Clause::overlap, Clause::time_of_impact, Clause::contact_invented}},
    {"presses/chambers", {148, 225}, {Clause::overlap, Clause::passage, Clause::gap}},
    {"presses/chambers", {55}, {Clause::speed_lost}},
    {"presses/chambers", {135}, {Clause::start_inside}},
    {"presses/chambers", {310}, {Clause::time_of_impact}},
    {"presses/chambers", {409}, {Clause::contact_invented}},
    {"presses/buckets", {765}, {Clause::overlap, Clause::passage}},
    {"crowd_movers/rooms", {412}, {Clause::overlap, Clause::passage, Clause::start_inside}},
};

TEST(CampaignFound, what_broke_once_holds) {
  for (const Found& found : all_found) {
    const Family& family = *compare::families_named(found.title).front();
    for (const std::uint64_t seed : sampled_of(found.seeds, found.seeds.size())) {
      const Findings run = run_and_judge(family.draw(seed), found.title);
      EXPECT_GT(run.steps, 0) << found.title << " " << seed;
      for (const Clause clause : found.clauses)
        EXPECT_EQ(run.breaches.count(clause), 0U) << name_of(clause) << ": " << family.replay_of(seed);
    }
  }
}

}  // namespace
}  // namespace paperproof::test
