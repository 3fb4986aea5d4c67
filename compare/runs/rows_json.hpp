/// Rows as JSON: `"paperproof_rows": 1`.
#pragma once

#include "runs/gallery.hpp"
#include "runs/row.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// Versions, compiler, flags, cpu and build of this executable, as name and value.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> environment();

/// What does not apply is absent.
[[nodiscard]] nlohmann::ordered_json row_json(const Row& row);

/// The rows with their header.
[[nodiscard]] nlohmann::ordered_json rows_json(const std::vector<Row>& rows);

/// One object per contender: `fails_on` (scene, failure) and `cheapest_on` (scene, ns_per_step, and of the next one
/// contender and ns_per_step), each absent where the search found none.
[[nodiscard]] nlohmann::ordered_json gallery_json(const std::vector<GalleryEntry>& gallery);

}  // namespace paperproof::compare
