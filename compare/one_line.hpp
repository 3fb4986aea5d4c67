/// Messages as they are printed: one line each, of bounded length, whatever a file or a command line held.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// Of a message, with its line break [bytes]. Small: file, place and what was expected do not fit. Large: one file
/// fills the terminal.
inline constexpr std::size_t longest_message = 300;

/// At most `most` bytes (20 or more): where there are more the middle gives way to " ... ", and no character of UTF-8
/// is cut in two. The front names the file and the place, the end says what was expected.
[[nodiscard]] inline std::string cut_in_the_middle(std::string_view text, std::size_t most) {
  constexpr std::string_view gap = " ... ";
  if (text.size() <= most) return std::string(text);
  const auto continues = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U; };
  const std::size_t kept = most - gap.size();
  std::size_t front = kept * 2 / 3;
  std::size_t back = text.size() - (kept - front);
  // A character has at most three bytes that continue it; more of them are no text.
  for (int i = 0; i < 3 && front > 0 && continues(front); ++i) --front;
  for (int i = 0; i < 3 && back < text.size() && continues(back); ++i) ++back;
  return std::string(text.substr(0, front)).append(gap).append(text.substr(back));
}

/// Line breaks and control characters become spaces.
[[nodiscard]] inline std::string without_controls(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text;
}

/// A message without its line break.
[[nodiscard]] inline std::string one_line(std::string text) {
  return cut_in_the_middle(without_controls(std::move(text)), longest_message - 1);
}

/// "`where`: `expected`" in one line that keeps the begin and the end of both.
[[nodiscard]] inline std::string one_line(std::string_view where, std::string_view expected) {
  constexpr std::size_t room = longest_message - 3;
  constexpr std::size_t room_for_where = 160;
  const std::size_t left = room - std::min(room, expected.size());
  const std::string place = cut_in_the_middle(where, std::max(room_for_where, left));
  return one_line(place + ": " + cut_in_the_middle(expected, room - place.size()));
}

}  // namespace paperproof::compare
