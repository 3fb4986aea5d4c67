/// What the summary, the list of scenes and the tables need, as JSON.
#pragma once

#include "report/report.hpp"

namespace paperproof::compare {

/// `{"name","description","sentence","rows":[…],"runs":n,"disagreements":n}`. A row has the keys of a rows file; a
/// metric that does not apply is absent, one that is not finite is the string "not finite". The verdict is in words.
[[nodiscard]] std::string scene_index_json(const ReportScene& scene);

/// `{"environment":[[name,value]…],"tolerances":[[name,metres]…],"guarantee_notes":[…],
/// "sections":[{"title","lines","table"}…],"scenes":[…],"studies":[…]}`.
/// @param scenes,studies one JSON object each: see `chart_page_json`.
[[nodiscard]] std::string index_json(const ReportFacts& facts, const std::vector<std::string>& scenes,
                                     const std::vector<std::string>& studies);

}  // namespace paperproof::compare
