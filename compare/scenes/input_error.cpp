#include "scenes/input_error.hpp"

#include <array>
#include <fstream>

#include <fmt/format.h>

#include "one_line.hpp"
#include "records/input_file.hpp"
#include "scenes/load.hpp"

namespace paperproof::compare {

void refuse(const std::string& where, const std::string& expected) { throw InputError(one_line(where, expected)); }

std::string at_line(const std::string& file, std::size_t line) { return file + ":" + std::to_string(line); }

std::string read_file(const std::string& path, const std::string& given) {
  if (const std::string why = why_not_regular(path); !why.empty()) refuse(given, why);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(given, "expected a file that can be read");
  std::string text = read_all(stream, given);
  if (stream.bad()) refuse(given, "expected a file that can be read");
  return text;
}

std::string read_text(const std::string& path, const std::string& given) {
  std::string text = read_file(path, given);
  refuse_zero_bytes(text, given);
  return text;
}

void refuse_zero_bytes(std::string_view text, const std::string& given) {
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
    refuse(at_line(given, line_of(text, zero)), "expected text; a byte of zero stands here");
}

std::string read_all(std::istream& stream, const std::string& given) {
  std::string text;
  std::array<char, 1 << 16> part{};
  while (stream.read(part.data(), part.size()), stream.gcount() > 0) {
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most_bytes)
      refuse(given, fmt::format("expected at most {} MB, as what is read takes many times its size in memory; split it",
                                most_bytes / 1'000'000));
  }
  return text;
}

}  // namespace paperproof::compare
