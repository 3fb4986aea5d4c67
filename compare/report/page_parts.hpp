/// The page's own files, embedded at build time (see embed.cmake).
#pragma once

#include <string_view>

namespace paperproof::compare::page {

extern const std::string_view page_html;  ///< The frame, with a marker for each of the other parts.
extern const std::string_view style_css;
extern const std::string_view time_js;
extern const std::string_view trace_js;
extern const std::string_view draw_js;
extern const std::string_view tables_js;
extern const std::string_view disagreements_js;
extern const std::string_view focus_js;
extern const std::string_view controls_js;
extern const std::string_view replay_js;
extern const std::string_view charts_js;
extern const std::string_view grids_js;
extern const std::string_view cells_js;
extern const std::string_view first_js;
extern const std::string_view main_js;
extern const std::string_view chart_min_js;  ///< Chart.js, MIT licence.

}  // namespace paperproof::compare::page
