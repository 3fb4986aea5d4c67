/// How the loaders complain: always one line that begins with the file as the user gave it.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// Throws InputError("`where`: `expected`"). `where` is the file as given, with a line or a JSON pointer behind it
/// where there is one: see `at_line` and JsonCursor. The message is one line of at most `longest_message` bytes
/// whatever the file contained.
[[noreturn]] void refuse(const std::string& where, const std::string& expected);

/// "file:line"
[[nodiscard]] std::string at_line(const std::string& file, std::size_t line);

/// The most that is read of one file [bytes]. Small: a level of a million tiles as JSON does not fit. Large: a hostile
/// file decides how much memory is used, which is some twenty times as much.
inline constexpr std::size_t most_bytes = 64'000'000;

/// The whole file. @throws InputError naming `given`: missing, unreadable, larger than `most_bytes`, or no regular file
/// (a pipe or a device may never end).
[[nodiscard]] std::string read_file(const std::string& path, const std::string& given);

/// The same for text: readers of JSON and XML take a byte of zero for the end, and pass over what stands behind it.
/// @throws InputError as `read_file`, and with the line of a byte of zero.
[[nodiscard]] std::string read_text(const std::string& path, const std::string& given);
/// @throws InputError with the line of the first byte of zero.
void refuse_zero_bytes(std::string_view text, const std::string& given);

/// What is left of a stream. @throws InputError naming `given` for more than `most_bytes`.
[[nodiscard]] std::string read_all(std::istream& stream, const std::string& given);

}  // namespace paperproof::compare
