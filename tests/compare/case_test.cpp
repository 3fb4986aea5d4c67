/// A Case and its command.
#include "records/case.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string_view>

namespace paperproof::compare {
namespace {

/// Words with all that a shell takes for something else.
class Words {
 public:
  std::string word(std::string_view without = "") {
    constexpr std::string_view letters = "abz09_.-/=:,+ '\"\\$`*?~#&|;<>(){}[]!%^@\t\n\xc3\xa4";
    std::string text;
    while (text.size() < 1 + random_() % 12) {
      const char letter = letters[random_() % letters.size()];
      if (without.find(letter) == std::string_view::npos) text += letter;
    }
    return text;
  }
  std::vector<Case::Setting> settings() {
    std::vector<Case::Setting> all;
    for (std::size_t count = random_() % 4; count > 0; --count) all.push_back({word("="), word()});
    return all;
  }
  std::uint64_t number() { return random_(); }
  bool coin() { return random_() % 2 == 0; }

 private:
  std::mt19937_64 random_{7};
};

Case random_case(Words& words) {
  Case one;
  one.scene = words.word();
  one.parameters = words.settings();
  one.contender = words.word();
  if (words.coin()) one.scalar = "float";
  one.knobs = words.settings();
  if (words.coin()) one.seed = words.number();
  if (words.coin()) one.steps = static_cast<int>(words.number() % 100'000);
  if (words.coin()) one.mode = "lockstep";
  one.full_plan = words.coin();
  one.reference = words.coin();
  return one;
}

/// A command says all that a Case has, so two with one command are the same.
TEST(Case, is_read_back_from_its_command) {
  Words words;
  for (int n = 0; n < 10'000; ++n) {
    const std::string command = command_of(random_case(words));
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
