/// How the loaders complain: always one line that begins with the file as the user gave it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// Throws InputError("`where`: `expected`"). `where` is the file as given, with a line or a JSON pointer behind it
/// where there is one: see `at_line` and JsonCursor. Line breaks and control characters become spaces, so the message
/// stays one line whatever the file contained.
[[noreturn]] void refuse(const std::string& where, const std::string& expected);

/// "file:line"
[[nodiscard]] std::string at_line(const std::string& file, std::size_t line);

/// Line (from 1) of the byte at `offset`.
[[nodiscard]] std::size_t line_of(std::string_view text, std::size_t offset) noexcept;

/// The whole file. @throws InputError naming `given`: missing, unreadable, a directory.
[[nodiscard]] std::string read_file(const std::string& path, const std::string& given);

}  // namespace paperproof::compare
