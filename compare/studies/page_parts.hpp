/// The page of a study, and the library that draws it; embedded at build time.
#pragma once

#include <string_view>

namespace paperproof::compare::studies {

extern const std::string_view study_html;  ///< The frame, with a marker for each of the other parts.
extern const std::string_view study_js;
extern const std::string_view chart_min_js;  ///< Chart.js, MIT licence.

}  // namespace paperproof::compare::studies
