#include "records/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>

namespace paperproof::compare {

std::string why_not_regular(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return "expected a file that exists; there is none";
  if (std::filesystem::is_directory(status)) return "expected a file; this is a directory";
  if (std::filesystem::is_regular_file(status)) return "";
  return fmt::format("expected a regular file; this is {}", std::filesystem::is_fifo(status)     ? "a pipe"
                                                            : std::filesystem::is_socket(status) ? "a socket"
                                                                                                 : "a device");
}

std::ifstream open_input(const std::string& path, std::uintmax_t most) {
  const auto refuse = [&](const std::string& why) { throw std::runtime_error(path + ": " + why); };
  if (const std::string why = why_not_regular(path); !why.empty()) refuse(why);
  constexpr std::uintmax_t megabyte = 1'000'000;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > most)
    refuse(fmt::format("expected at most {} MB; this file has {} MB", most / megabyte, size / megabyte));
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse("expected a file that can be read");
  return stream;
}

std::string read_input(const std::string& path, std::uintmax_t most) {
  std::ifstream stream = open_input(path, most);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (stream.bad()) throw std::runtime_error(path + ": expected a file that can be read");
  return text;
}

std::size_t line_of(std::string_view text, std::size_t offset) noexcept {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  return 1 + static_cast<std::size_t>(std::ranges::count(before, '\n'));
}

}  // namespace paperproof::compare
