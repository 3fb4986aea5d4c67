/// JSON that says one thing: what a lenient reader would pass over is refused.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace paperproof::compare {

/// @param file to stand before the place. @param first_line of `text` in that file.
/// @throws std::runtime_error "`file`:line: expected ...": it is no JSON, an object has a key twice, bytes of zero,
/// more than 100 levels of nesting, a number beyond double.
[[nodiscard]] nlohmann::ordered_json strict_json(std::string_view text, const std::string& file,
                                                 std::size_t first_line = 1);

}  // namespace paperproof::compare
