/// The studies that are lists of sweeps.
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

/// A question with its cases, as data.
struct PreparedStudy {
  const char* name;
  const char* help;
  /// @param contenders that were asked for; empty: all that the study is about. It may have others: see `keep_only`.
  std::vector<StudyPart> (*parts)(GridSize, const std::vector<std::string>& contenders);
  std::string title{};                    ///< Of its page.
  std::vector<std::string> paragraphs{};  ///< Of its page, below how to read its maps.
  const char* grid = "quick";             ///< Where none is named.
  bool in_one_table = false;              ///< Contenders by groups, and no maps: see `FieldView`.
  /// What theory says of a border, in a word; none: nothing is said. @param who ran, with its knobs. @param at value of
  /// the first axis.
  std::string (*theory)(const std::string& who, double at) = nullptr;
};

/// bullet, corner, seam, squeeze, field, stability.
[[nodiscard]] const std::vector<PreparedStudy>& prepared_studies();

/// All contenders, and some more with knobs of their own.
[[nodiscard]] std::vector<NamedContender> all_contenders_and(const std::vector<NamedContender>& more);

/// Drops contenders that nobody asked for, and parts without any. @param wanted names; empty: all.
void keep_only(const std::vector<std::string>& wanted, std::vector<StudyPart>& parts);

}  // namespace paperproof::compare
