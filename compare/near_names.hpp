/// What a mistyped name may have meant.
#pragma once

#include "words.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// Fewest letters to put in, leave out or replace that turn `word` into `name`, or with `anywhere` into some part of
/// `name` (Levenshtein 1966; Sellers 1980: a part may begin and end where it likes).
[[nodiscard]] inline std::size_t edit_distance(std::string_view word, std::string_view name, bool anywhere) {
  std::vector<std::size_t> row(name.size() + 1, 0);
  if (!anywhere) std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : word) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < name.size(); ++j) {
      const std::size_t replaced = diagonal + (letter == name[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min(replaced, 1 + std::min(row[j], row[j + 1]));
    }
  }
  return anywhere ? *std::min_element(row.begin(), row.end()) : row.back();
}

/// In small letters, as if written in one word.
[[nodiscard]] inline std::string letters_of(std::string_view name) {
  std::string letters;
  for (const char c : name)
    if (c != '_' && c != '-' && c != ' ') letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

/// Those of `known`, at most five and in their order, that are `word` in other letters; else those that hold it; else
/// those that are it with the fewest slips, or hold it with the fewest: one in four letters at most.
[[nodiscard]] inline std::vector<std::string> near_names(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t letters_per_slip = 4;
  constexpr std::size_t fewest_letters = 3;  // two stand in nearly every name
  constexpr std::size_t most_names = 5;
  struct Rule {
    bool anywhere;
    std::size_t slips;
  };
  const std::string letters = letters_of(word);
  if (letters.size() < fewest_letters) return {};
  const std::size_t slips = letters.size() / letters_per_slip;
  for (const Rule& rule : {Rule{false, 0}, Rule{true, 0}, Rule{false, slips}, Rule{true, slips}}) {
    std::vector<std::string> near;
    std::size_t fewest = rule.slips;
    for (const std::string& name : known) {
      const std::size_t distance = edit_distance(letters, letters_of(name), rule.anywhere);
      if (distance > fewest) continue;
      if (distance < fewest) near.clear();
      fewest = distance;
      near.push_back(name);
    }
    near.resize(std::min(near.size(), most_names));
    if (!near.empty()) return near;
  }
  return {};
}

/// "; did you mean a, b or c?", or nothing where no name is near.
[[nodiscard]] inline std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::vector<std::string> near = near_names(word, known);
  return near.empty() ? "" : "; did you mean " + one_of_words(near) + "?";
}

}  // namespace paperproof::compare
