/// The guarantee of octagon_sweep over every family of random runs: steps break only what is known and open, and enough
/// happens in them.
#include "campaign/campaign.hpp"
#include "embedded.hpp"
#include "support/expected.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>

namespace paperproof::test {
namespace {

using compare::Clause;
using compare::Family;
using compare::Findings;

/// What random runs may break of the guarantee, because it is known and open.
const nlohmann::json& known_and_open() {
  static const nlohmann::json known = nlohmann::json::parse(std::ifstream(PAPERPROOF_KNOWN_AND_OPEN));
  return known;
}

/// How many of so many steps of a family may break a clause. The file has the share of each family that broke it where
/// that was measured: no other may; or of all runs together, where there are no families. What one run breaks it breaks
/// for several steps: runs come by chance, their number varies by its root, and each counts for as many steps as the
/// worst did.
/// @param runs as the file names them: "static", "any_up", "movers", "turning", "crowd" and so on.
int most_broken(const std::string& runs, Clause clause, int steps, const std::string& family) {
  for (const nlohmann::json& entry : known_and_open().at("random")) {
    if (entry.at("runs") != runs || entry.at("clause") != std::string(name_of(clause))) continue;
    const double share = entry.contains("families") ? entry.at("families").value(family, 0.0)
                                                    : entry.at("steps_in_a_million").get<double>();
    const double expected = share * steps / 1e6;
    const double worst = entry.at("steps_of_one_run").get<double>();
    return expected > 0 ? static_cast<int>(expected + 4 * std::sqrt(expected * worst) + worst) : 0;
  }
  return 0;
}

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

/// Their text has no schema.
TEST(Families, have_no_key_that_nothing_reads_and_name_families_and_happenings_that_there_are) {
  const auto check = [](const nlohmann::json& of, const std::string& keys) {
    refuse_other_keys(of, keys + " share covers ", "families");
    const nlohmann::json covers = of.value("covers", nlohmann::json::object());
    for (const auto& [happening, shares] : covers.items()) EXPECT_NO_THROW((void)compare::happening_named(happening));
  };
  for (const nlohmann::json& kind : nlohmann::json::parse(compare::families_file.front().text)) {
    check(kind, " kind first_seed first_seeds only but ");
    const auto check_name = [&](const std::string& name) {
      EXPECT_EQ(compare::families_named(kind.at("kind").get<std::string>() + "/" + name).size(), 1U);
    };
    const nlohmann::json only = kind.value("only", nlohmann::json::array());
    for (const std::string name : only) check_name(name);
    const nlohmann::json but = kind.value("but", nlohmann::json::object());
    for (const auto& [name, own] : but.items()) {
      check_name(name);
      check(own, " because ");
    }
  }
}

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
TEST(CampaignFound, what_broke_once_holds) {
  const nlohmann::json file = nlohmann::json::parse(std::ifstream(PAPERPROOF_BROKE_ONCE));
  for (const nlohmann::json& found : file.at("found")) {
    const std::string title = found.at("runs");
    const Family& family = *compare::families_named(title).front();
    const std::vector<std::uint64_t> seeds = found.at("seeds");
    const nlohmann::json& clauses = found.at("keep").is_string() ? file.at(found["keep"]) : found["keep"];
    for (const std::uint64_t seed : sampled_of(seeds, seeds.size())) {
      const Findings run = run_and_judge(family.draw(seed), title);
      EXPECT_GT(run.steps, 0) << title << " " << seed;
      for (const std::string name : clauses) {
        const std::optional<Clause> clause = compare::clause_named(name);
        EXPECT_TRUE(clause && !run.breaches.contains(*clause)) << name << ": " << family.replay_of(seed);
      }
    }
  }
}

}  // namespace
}  // namespace paperproof::test
