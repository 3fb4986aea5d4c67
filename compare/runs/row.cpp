#include "runs/row.hpp"

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

std::string called(const Row& row) {
  std::string name = row.contender;
  if (!row.knob.empty()) name += " with " + row.knob;
  if (row.scalar == "float" && !row.contender.starts_with("box2d")) name += " in float";
  return name;
}

}  // namespace paperproof::compare
