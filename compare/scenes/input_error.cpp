#include "scenes/input_error.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "one_line.hpp"
#include "scenes/load.hpp"

namespace paperproof::compare {
namespace {

std::string_view kind_of(std::filesystem::file_type type) {
  if (type == std::filesystem::file_type::fifo) return "a pipe";
  return type == std::filesystem::file_type::socket ? "a socket" : "a device";
}

}  // namespace

void refuse(const std::string& where, const std::string& expected) { throw InputError(one_line(where, expected)); }

std::string at_line(const std::string& file, std::size_t line) { return file + ":" + std::to_string(line); }

std::size_t line_of(std::string_view text, std::size_t offset) noexcept {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string read_file(const std::string& path, const std::string& given) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse(given, "expected a file that exists; there is none");
  if (std::filesystem::is_directory(status)) refuse(given, "expected a file; this is a directory");
  if (!std::filesystem::is_regular_file(status))
    refuse(given, fmt::format("expected a regular file; this is {}", kind_of(status.type())));
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(given, "expected a file that can be read");
  std::string text = read_all(stream, given);
  if (stream.bad()) refuse(given, "expected a file that can be read");
  return text;
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
