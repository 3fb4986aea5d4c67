/// `paperproof list`, `check` and `plan`: what there is, what is in a scene, and what a run of it leaves out.
///
/// All print to standard output and return 0. They throw InputError for scenes that cannot be used.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// @param what scenes, contenders, knobs, metrics or parameters.
int list_command(const std::string& what);

int check_command(const std::vector<std::string>& scenes);

/// @param seed of a random input that replaces the scenes' own.
int plan_command(const std::vector<std::string>& scenes, const std::optional<std::uint64_t>& seed);

}  // namespace paperproof::compare
