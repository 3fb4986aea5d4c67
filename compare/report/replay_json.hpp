/// The replay of a scene as compact JSON: columns of whole numbers, each the difference to the one before.
#pragma once

#include "report/report.hpp"

namespace paperproof::compare {

/// `{"quantum":q,"sceneries":[…],"runs":[…],"disagreements":[…],"disagreements_in_all":n}`; page/decode.js reads it
/// back. Runs whose scenery is the same share it.
[[nodiscard]] std::string replay_json(const ReportScene& scene, const ReportOptions& options);

}  // namespace paperproof::compare
