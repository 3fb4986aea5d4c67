/// A Case and its command.
#include "records/case.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string_view>

namespace paperproof::compare {
namespace {

/// Of all that a shell takes for something else.
std::string random_word(std::mt19937_64& random, std::string_view without = "") {
  constexpr std::string_view letters = "abz09_.-/=:,+ '\"\\$`*?~#&|;<>(){}[]!%^@\t\n\xc3\xa4";
  std::string text;
  while (text.size() < 1 + random() % 12) {
    const char letter = letters[random() % letters.size()];
    if (without.find(letter) == std::string_view::npos) text += letter;
  }
  return text;
}

std::vector<Case::Setting> random_settings(std::mt19937_64& random) {
  std::vector<Case::Setting> all;
  for (std::size_t count = random() % 4; count > 0; --count)
    all.push_back({random_word(random, "="), random_word(random)});
  return all;
}

Case random_case(std::mt19937_64& random) {
  const auto coin = [&random] { return random() % 2 == 0; };
  Case one;
  one.scene = random_word(random);
  one.parameters = random_settings(random);
  one.contender = random_word(random);
  if (coin()) one.scalar = "float";
  one.knobs = random_settings(random);
  if (coin()) one.seed = random();
  if (coin()) one.steps = static_cast<int>(random() % 100'000);
  if (coin()) one.mode = "lockstep";
  one.full_plan = coin();
  one.reference = coin();
  return one;
}

/// A command says all that a Case has, so two with one command are the same.
TEST(Case, is_read_back_from_its_command) {
  std::mt19937_64 random(7);
  for (int n = 0; n < 10'000; ++n) {
    const std::string command = command_of(random_case(random));
    const std::optional<Case> read = case_of_command(command);
    ASSERT_TRUE(read) << command;
    ASSERT_EQ(command_of(*read), command);
  }
}

TEST(Case, is_not_read_from_other_commands) {
  for (const char* text :
       {"", "paperproof", "paperproof compare", "paperproof compare paper", "paperproof sweep paper --contender mask",
        "paperproof compare paper --contender", "paperproof compare paper --contender mask --trace x",
        "paperproof compare paper --contender mask --set speed", "paperproof compare paper --contender mask --steps 2x",
        "paperproof compare paper --contender mask --input 7", "paperproof compare paper --contender mask --plan half",
        "paperproof compare 'paper --contender mask", "paperproof compare paper --contender mask\\"})
    EXPECT_FALSE(case_of_command(text)) << text;
  EXPECT_EQ(case_of_command("paperproof compare  a\\ b'c d' --contender mask")->scene, "a bc d");
}

}  // namespace
}  // namespace paperproof::compare
