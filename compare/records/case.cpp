#include "records/case.hpp"

#include "number_in.hpp"

#include <fmt/format.h>

namespace paperproof::compare {
namespace {

/// As one word of a shell.
std::string shell_word(const std::string& word) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./=:,+-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

}  // namespace

std::string command_of(const Case& one) {
  std::string text = fmt::format("paperproof compare {}", shell_word(one.scene));
  for (const Case::Setting& each : one.parameters) text += fmt::format(" --set {}={}", each.key, each.value);
  text += fmt::format(" --contender {}", one.contender);
  if (one.scalar != "double") text += fmt::format(" --scalar {}", one.scalar);
  for (const Case::Setting& each : one.knobs) text += fmt::format(" --knob {}={}", each.key, each.value);
  if (one.seed) text += fmt::format(" --input random:{}", *one.seed);
  if (one.steps) text += fmt::format(" --steps {}", *one.steps);
  if (one.mode != "free") text += " --mode " + one.mode;
  if (one.full_plan) text += " --plan full";
  return text + (one.reference ? "" : " --no-reference");
}

std::string hash_of(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char letter : text) {
    hash ^= static_cast<unsigned char>(letter);
    hash *= 1099511628211ULL;
  }
  return fmt::format("{:016x}", hash);
}

std::string id_of(const Case& one) { return hash_of(command_of(one)); }

void put_case(const Case& one, Row& row) {
  row.case_id = id_of(one);
  row.command = command_of(one);
  for (const Case::Setting& each : one.knobs)  // one that is a word stands in `knob`
    if (const std::optional<double> value = number_in<double>(each.value))
      row.parameters.emplace_back(each.key, *value);
  if (one.seed) row.parameters.emplace_back("seed", static_cast<double>(*one.seed));
}

}  // namespace paperproof::compare
