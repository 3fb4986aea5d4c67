/// Numbers with their nouns, and other small pieces of sentences.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// "1 step", "2 steps": for nouns that take an s.
template <class Count>
[[nodiscard]] std::string counted(Count count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

/// "a", "a or b", "a, b or c".
[[nodiscard]] inline std::string one_of_words(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

/// What somebody typed, within quotes where it would not be seen.
[[nodiscard]] inline std::string shown(const std::string& typed) {
  return typed.find_first_not_of(" \t") == std::string::npos ? '"' + typed + '"' : typed;
}

}  // namespace paperproof::compare
