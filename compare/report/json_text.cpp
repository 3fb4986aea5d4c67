#include "report/json_text.hpp"

namespace paperproof::compare {

std::string script_safe(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

std::string list_of(const std::vector<std::string>& objects) {
  std::string list;
  for (const std::string& object : objects) list += (list.empty() ? "" : ",") + object;
  return '[' + list + ']';
}

}  // namespace paperproof::compare
