/// What stands in every report, whatever was run.
#pragma once

#include "report/report.hpp"

#include <vector>

namespace paperproof::compare {

/// What each contender is excused.
[[nodiscard]] ReportSection exemptions_section();

/// That, and what differs between the sides by their nature.
[[nodiscard]] std::vector<ReportSection> standing_sections();

}  // namespace paperproof::compare
