/// JSON that says one thing: what a lenient reader would pass over is refused.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace paperproof::compare {

/// @param file to stand before the place. @param first_line of `text` in that file.
/// @throws std::runtime_error "`file`:line:column: expected ..." for what is no JSON, "`file`:line: ..." for bytes of
/// zero; "`file`: /pointer: ...", with the line where the text has only one, for a key that an object has twice and a
/// number beyond double; "`file`: ..." for more than 100 levels of nesting.
[[nodiscard]] nlohmann::ordered_json strict_json(std::string_view text, const std::string& file,
                                                 std::size_t first_line = 1);

}  // namespace paperproof::compare
