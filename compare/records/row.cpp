#include "records/row.hpp"

#include <string_view>

namespace paperproof::compare {

std::string_view name_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::tunnels:
      return "tunnels";
    case Verdict::violates:
      return "violates";
    case Verdict::not_applicable:
      return "not_applicable";
    case Verdict::flagged:
      return "flagged";
    case Verdict::failed:
      return "failed";
  }
  return "failed";
}

std::string_view name_of(Axis axis) noexcept {
  switch (axis) {
    case Axis::safety:
      return "safety";
    case Axis::progress:
      return "progress";
    case Axis::answer:
      return "answer";
    case Axis::validity:
      return "validity";
  }
  return "validity";
}

bool was_judged(const Row& row) noexcept {
  return row.verdict != Verdict::failed && row.verdict != Verdict::not_applicable;
}

std::optional<double> parameter_of(const Row& row, std::string_view key) {
  for (const auto& [name, value] : row.parameters)
    if (name == key) return value;
  return std::nullopt;
}

std::string called(const Row& row) {
  std::string name = row.contender;
  if (!row.knob.empty()) name += " with " + row.knob;
  if (row.scalar == "float" && !row.contender.starts_with("box2d")) name += " in float";
  return name;
}

}  // namespace paperproof::compare
