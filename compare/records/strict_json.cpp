#include "records/strict_json.hpp"

#include "records/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

namespace paperproof::compare {

using nlohmann::ordered_json;

ordered_json strict_json(std::string_view text, const std::string& file, std::size_t first_line) {
  const std::size_t last = text.empty() ? 0 : text.size() - 1;
  const auto refuse = [&](std::size_t offset, const std::string& expected) {
    // An end that comes too early is behind the last line feed.
    throw std::runtime_error(
        fmt::format("{}:{}: {}", file, first_line - 1 + line_of(text, std::min(offset, last)), expected));
  };
  // Where in the text the parser is it does not tell those who look on.
  const bool is_one_line = line_of(text, last) == 1;
  const std::string somewhere = is_one_line ? fmt::format("{}:{}", file, first_line) : file;
  // The library takes a byte of zero for the end.
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
    refuse(zero, "expected text; a byte of zero stands here");
  constexpr int deepest = 100;
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto look = [&](int depth, ordered_json::parse_event_t event, ordered_json& parsed) {
    using Event = ordered_json::parse_event_t;
    if (depth > deepest)
      throw std::runtime_error(fmt::format("{}: expected at most {} levels of nesting", somewhere, deepest));
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key && !keys.back().insert(parsed.get_ref<const std::string&>()).second)
      throw std::runtime_error(fmt::format("{}: expected each key once; \"{}\" stands twice in one object", somewhere,
                                           parsed.get_ref<const std::string&>()));
    return true;
  };
  try {
    return ordered_json::parse(text, look);
  } catch (const ordered_json::parse_error& error) {
    refuse(error.byte > 0 ? error.byte - 1 : 0, "expected JSON");
  } catch (const ordered_json::out_of_range&) {
    refuse(0, "expected finite numbers");
  }
  return {};
}

}  // namespace paperproof::compare
