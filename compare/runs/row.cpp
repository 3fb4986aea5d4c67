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

}  // namespace paperproof::compare
