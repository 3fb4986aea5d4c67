/// The studies that are lists of sweeps.
#pragma once

#include "studies/sweep.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

enum class GridSize : std::uint8_t { quick, standard, full };
/// @param name as `--grid` has it. Anything unknown is `quick`.
[[nodiscard]] GridSize grid_size(std::string_view name) noexcept;

/// A question with its cases, as data.
struct PreparedStudy {
  std::string name;
  std::string help{};
  /// @param contenders that were asked for; empty: all that the study is about. It may have others: see `keep_only`.
  std::function<std::vector<StudyPart>(GridSize, const std::vector<std::string>& contenders)> parts{};
  std::string title{};                    ///< Of its page.
  std::vector<std::string> paragraphs{};  ///< Of its page, below how to read its maps.
  std::string grid{};                     ///< Where none is named.
  bool in_one_table = false;              ///< Contenders by groups, and no maps: see `FieldView`.
  /// What theory says of a border, in a word; none: nothing is said. @param who ran, with its knobs. @param at value of
  /// the first axis.
  std::string (*theory)(const std::string& who, double at) = nullptr;
};

/// Those of prepared_studies.json.
[[nodiscard]] const std::vector<PreparedStudy>& prepared_studies();

/// What prepared_studies.json has of one; README.md says what its keys mean.
[[nodiscard]] const nlohmann::ordered_json& study_text(std::string_view name);

/// The entry of a list for a size of the grid; the last one counts for larger ones, too.
[[nodiscard]] const nlohmann::ordered_json& of_size(const nlohmann::ordered_json& list, GridSize size);

/// A part as it stands there; it runs as every sweep does.
[[nodiscard]] StudyPart part_of(const nlohmann::ordered_json& text, GridSize size);

/// All contenders, and some more with knobs of their own.
[[nodiscard]] std::vector<NamedContender> all_contenders_and(const std::vector<NamedContender>& more);

/// Drops contenders that nobody asked for, and parts without any. @param wanted names; empty: all.
void keep_only(const std::vector<std::string>& wanted, std::vector<StudyPart>& parts);

}  // namespace paperproof::compare
