/// Knobs of the techniques, as they stand on the command line.
#pragma once

#include <paperproof/techniques.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// `name=value`, the name that of the field in `ArticleKnobs`. `octagon_sweep` has `iterations`.
struct KnobSetting {
  std::string name;
  std::string value;
};

/// @throws std::invalid_argument in words where there is no such knob.
[[nodiscard]] KnobSetting parse_knob(std::string_view text);

/// @throws std::invalid_argument in words for a value that the technique cannot take.
void check_knob(const KnobSetting& setting, TechniqueKind kind);

/// In words, one line for each knob: its name, what it is, and whose it is.
[[nodiscard]] std::vector<std::string> describe_knobs();

[[nodiscard]] bool has_knob(TechniqueKind kind, std::string_view name);

/// Turns those of the knobs that the technique has; of two of the same name the later holds.
void turn_knobs(std::span<const KnobSetting> knobs, TechniqueDef& def);

/// Those of the knobs that the technique has, as `name=value name=value`; empty for none.
[[nodiscard]] std::string turned_knobs(std::span<const KnobSetting> knobs, TechniqueKind kind);

}  // namespace paperproof::compare
