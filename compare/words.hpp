/// Numbers with their nouns, and other small pieces of sentences.
#pragma once

#include <cstddef>
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

/// A sentence on a terminal has no more bytes than this: more is not read. The report and the rows have the whole.
inline constexpr std::size_t longest_sentence = 300;

/// The sentence, or as many of its words as fit, and " …".
[[nodiscard]] inline std::string shortened(const std::string& sentence, std::size_t most = longest_sentence) {
  constexpr std::string_view cut = " …";
  if (sentence.size() <= most) return sentence;
  const std::size_t space = sentence.rfind(' ', most - cut.size());
  if (space != std::string::npos && space > 0) return sentence.substr(0, space) + std::string(cut);
  std::size_t end = most - cut.size();
  while (end > 0 && (static_cast<unsigned char>(sentence[end]) & 0xC0U) == 0x80) --end;  // not within a character
  return sentence.substr(0, end) + std::string(cut);
}

/// One by one, shortened, each with a line feed.
[[nodiscard]] inline std::string in_lines(const std::string& sentences) {
  constexpr std::string_view stop = ". ";
  std::string lines;
  for (std::size_t begin = 0; begin < sentences.size();) {
    const std::size_t found = sentences.find(stop, begin);
    const std::size_t end = found == std::string::npos ? sentences.size() : found + 1;
    lines += shortened(sentences.substr(begin, end - begin)) + '\n';
    begin = found == std::string::npos ? end : end + 1;
  }
  return lines;
}

/// What was typed, within quotes where it would not be seen.
[[nodiscard]] inline std::string shown(const std::string& typed) {
  return typed.find_first_not_of(" \t") == std::string::npos ? '"' + typed + '"' : typed;
}

}  // namespace paperproof::compare
