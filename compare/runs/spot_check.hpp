/// Asks an engine itself where the judge has its character through something, inside something, or hanging.
#pragma once

#include "records/case.hpp"
#include "records/scene_result.hpp"

#include <string>

namespace paperproof::compare {

struct SpotCheck {
  int step = 0;
  std::string judge{};          ///< What the judge says of that step.
  std::string engine{};         ///< What the engine's own query says of the places of the record.
  std::string confirmed = "-";  ///< `yes`, `no`, or `-`: it has no query, or the run cannot be made again.
};

/// Runs the Case of a peer again, and asks its engine what the character overlaps at the places that were recorded: on
/// the way through a solid, at the ends of steps inside one, at lower places where it hangs.
/// @param hole tunnel, inside or hanging. Where the run or the query fails, `engine` says why.
[[nodiscard]] SpotCheck spot_check(const Case& one, ReportEvent::Kind hole);

}  // namespace paperproof::compare
