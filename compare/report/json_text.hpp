/// Small pieces of JSON as text.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// JSON on one line. Bytes that are not UTF-8 become U+FFFD.
template <class Json>
[[nodiscard]] std::string dumped(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// JSON that may stand inside a `<script>` element: no `<` is left in it, so neither `</script>` nor `<!--` can end the
/// element early. Outside of strings JSON has no `<`.
[[nodiscard]] std::string script_safe(std::string_view json);

/// A list of objects that are JSON already.
[[nodiscard]] std::string list_of(const std::vector<std::string>& objects);

}  // namespace paperproof::compare
