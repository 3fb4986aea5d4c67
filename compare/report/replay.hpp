/// The replay of a scene: traces, packed for the page.
#pragma once

#include "records/scene_result.hpp"

#include <string>
#include <string_view>

namespace paperproof::compare {

/// Lines of JSON, in this order:
/// -
/// `{"dt_list":[…],"disagreements_in_all":n,"disagreements":[{"step","who_is_right","statements":[{"run","record"}…]}…],
///   "runs":[{"every","events":[{"step","kind","words","character","collider"}…]}…]}`; a `record` is a step as a trace
///   has it, and an event names a character and a collider where there are several or one;
/// - for each run the lines of its trace, see TraceLines, with the steps that were kept. `colliders` of its header is a
///   number n: they are the n-th line that is a list. Such a line stands before the first run that has it.
[[nodiscard]] std::string replay_lines(const ReportScene& scene, std::size_t most_disagreements);

/// As a JSON string: gzip, in base64. page/trace.js reads it back.
[[nodiscard]] std::string packed(std::string_view text);

/// The replay of a scene as the page has it.
[[nodiscard]] std::string replay_json(const ReportScene& scene, std::size_t most_disagreements);

}  // namespace paperproof::compare
