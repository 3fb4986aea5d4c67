/// The questions behind `study corner`, `study seam` and `study squeeze`.
#pragma once

#include "studies/sweep.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

enum class GridSize : std::uint8_t { quick, standard, full };
/// @param name as `--grid` has it. Anything unknown is `quick`.
[[nodiscard]] GridSize grid_size(std::string_view name) noexcept;

struct PreparedStudy {
  const char* name;
  const char* help;
  std::vector<StudyPart> (*parts)(GridSize);
};

[[nodiscard]] const std::vector<PreparedStudy>& prepared_studies();

/// All contenders, and some more with knobs of their own.
[[nodiscard]] std::vector<NamedContender> all_contenders_and(const std::vector<NamedContender>& more);

/// Drops contenders that nobody asked for, and parts without any. @param wanted names; empty: all.
void keep_only(const std::vector<std::string>& wanted, std::vector<StudyPart>& parts);

}  // namespace paperproof::compare
