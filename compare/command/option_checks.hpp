/// Checks of what stands behind an option: they say what is allowed, and what was given instead.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace paperproof::compare {

[[nodiscard]] CLI::Validator expect_one_of(const std::vector<std::string>& allowed);

/// Digits alone, as a multiple of `step` from `step` to `most`.
[[nodiscard]] CLI::Validator expect_whole_number(std::uint64_t most, std::uint64_t step = 1);

/// Anything but nothing: a script whose variable is empty wants to know.
[[nodiscard]] CLI::Validator expect_file_name();

/// A name that ends in one of these, as `.html`, or without an end (a device): the end says what is written.
[[nodiscard]] CLI::Validator expect_ending(const std::vector<std::string>& endings);

/// Why the arguments cannot be used, in one sentence that begins with the option or argument where there is one.
/// @param command the one whose arguments were parsed when it happened.
[[nodiscard]] std::string reason_of(const CLI::ParseError& error, CLI::App& command);

}  // namespace paperproof::compare
