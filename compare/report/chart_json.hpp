/// What a study found, as the JSON that a page carries.
#pragma once

#include "report/chart_page.hpp"

#include <string>

namespace paperproof::compare {

/// Without the environment, which a page has once. It may stand inside a `<script>` element.
[[nodiscard]] std::string chart_page_json(const ChartPage& page);

}  // namespace paperproof::compare
