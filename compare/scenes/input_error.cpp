#include "scenes/input_error.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "scenes/load.hpp"

namespace paperproof::compare {

void refuse(const std::string& where, const std::string& expected) {
  std::string message = where + ": " + expected;
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  throw InputError(message);
}

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
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(given, "expected a file that can be read");
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) refuse(given, "expected a file that can be read");
  return text;
}

}  // namespace paperproof::compare
