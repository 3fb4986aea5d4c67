/// Which files are read: regular ones, up to a size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// Why this is no regular file, in words to stand behind its name; empty where it is one. A pipe or a device may never
/// end.
[[nodiscard]] std::string why_not_regular(const std::string& path);

/// Opens a regular file of at most `most` bytes (whole megabytes).
/// @throws std::runtime_error "`path`: expected ...": it is no such file, or cannot be read.
[[nodiscard]] std::ifstream open_input(const std::string& path, std::uintmax_t most);

/// The whole of such a file. @throws std::runtime_error as `open_input` does.
[[nodiscard]] std::string read_input(const std::string& path, std::uintmax_t most);

/// Line (from 1) of the byte at `offset`.
[[nodiscard]] std::size_t line_of(std::string_view text, std::size_t offset) noexcept;

}  // namespace paperproof::compare
