#include "records/case.hpp"

#include <paperproof/number_in.hpp>

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

/// The words of a command as a shell reads them: quotes hold together, a backslash outside of them takes the next
/// letter as it is. Nothing where a quote does not end.
std::optional<std::vector<std::string>> words_of_shell(std::string_view text) {
  std::vector<std::string> words;
  bool in_word = false;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!quoted && text[i] == ' ') {
      in_word = false;
      continue;
    }
    if (!in_word) words.emplace_back();
    in_word = true;
    if (text[i] == '\'') {
      quoted = !quoted;
      continue;
    }
    if (!quoted && text[i] == '\\' && ++i == text.size()) return std::nullopt;
    words.back() += text[i];
  }
  return quoted ? std::nullopt : std::optional(words);
}

bool read_setting(const std::string& text, std::vector<Case::Setting>& settings) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return false;
  settings.push_back({text.substr(0, equals), text.substr(equals + 1)});
  return true;
}

template <class Number>
bool read_number(std::string_view text, std::optional<Number>& number) {
  number = number_in<Number>(text);
  return number.has_value();
}

/// An option with its value. @return whether it is one of a Case.
bool read_option(const std::string& name, const std::string& value, Case& one) {
  constexpr std::string_view random = "random:";
  if (name == "--set") return read_setting(value, one.parameters);
  if (name == "--knob") return read_setting(value, one.knobs);
  if (name == "--steps") return read_number(value, one.steps);
  if (name == "--input") return value.starts_with(random) && read_number(value.substr(random.size()), one.seed);
  if (name == "--contender") one.contender = value;
  if (name == "--peer") one.peer = value.substr(value.find('=') + 1);
  if (name == "--scalar") one.scalar = value;
  if (name == "--mode") one.mode = value;
  if (name == "--plan") one.full_plan = value == "full";
  return name == "--contender" || name == "--peer" || name == "--scalar" || name == "--mode" ||
         (name == "--plan" && one.full_plan);
}

std::string setting_in_words(const char* option, const Case::Setting& each) {
  return fmt::format(" {} {}", option, shell_word(each.key + "=" + each.value));
}

}  // namespace

std::string command_of(const Case& one) {
  std::string text = fmt::format("paperproof compare {}", shell_word(one.scene));
  for (const Case::Setting& each : one.parameters) text += setting_in_words("--set", each);
  text += " --contender " + shell_word(one.contender);
  if (!one.peer.empty()) text += setting_in_words("--peer", {one.contender, one.peer});
  if (one.scalar != "double") text += " --scalar " + shell_word(one.scalar);
  for (const Case::Setting& each : one.knobs) text += setting_in_words("--knob", each);
  if (one.seed) text += fmt::format(" --input random:{}", *one.seed);
  if (one.steps) text += fmt::format(" --steps {}", *one.steps);
  if (one.mode != "free") text += " --mode " + shell_word(one.mode);
  if (one.full_plan) text += " --plan full";
  return text + (one.reference ? "" : " --no-reference");
}

std::optional<Case> case_of_command(std::string_view command) {
  const std::optional<std::vector<std::string>> words = words_of_shell(command);
  if (!words || words->size() < 3 || words->at(0) != "paperproof" || words->at(1) != "compare") return std::nullopt;
  Case one;
  one.scene = words->at(2);
  one.reference = true;
  for (std::size_t i = 3; i < words->size(); ++i) {
    const std::string& name = words->at(i);
    if (name == "--no-reference") {
      one.reference = false;
      continue;
    }
    if (++i == words->size() || !read_option(name, words->at(i), one)) return std::nullopt;
  }
  if (one.contender.empty()) return std::nullopt;
  return one;
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
