#include "records/strict_json.hpp"

#include "records/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

/// An object or a list that the parser is in.
struct Open {
  bool is_list = false;
  std::size_t entry = 0;  ///< Of a list: which one the parser is at.
  std::string key{};      ///< Of an object: the same.
  std::set<std::string> keys{};
};

std::string pointer_to(const std::vector<Open>& open) {
  ordered_json::json_pointer at;
  for (const Open& each : open) each.is_list ? at /= each.entry : at /= each.key;
  return at.empty() ? "/" : at.to_string();
}

/// The library's words without its prefix of id and position. They quote the file, and its bytes may be no text.
std::string reason_of(const std::string& what) {
  std::string reason = what.substr(what.find(": ") + 2);
  std::ranges::replace_if(
      reason, [](unsigned char c) { return c >= 0x80; }, '?');
  return reason;
}

}  // namespace

ordered_json strict_json(std::string_view text, const std::string& file, std::size_t first_line) {
  const std::size_t last = text.empty() ? 0 : text.size() - 1;
  const auto line_at = [&](std::size_t offset) {
    return fmt::format("{}:{}", file, first_line - 1 + line_of(text, offset));
  };
  const auto refuse = [](const std::string& at, const std::string& expected) {
    throw std::runtime_error(at + ": " + expected);
  };
  // The library takes a byte of zero for the end.
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
    refuse(line_at(zero), "expected text; a byte of zero stands here");
  // Where in the text the parser is it does not tell those who look on.
  const std::string where = line_of(text, last) == 1 ? line_at(0) : file;
  std::vector<Open> open;
  const auto place = [&] { return where + ": " + pointer_to(open); };
  constexpr std::size_t deepest = 100;  // without a limit a hostile file decides how much memory is used
  const auto look = [&](int /*depth*/, ordered_json::parse_event_t event, ordered_json& parsed) {
    using Event = ordered_json::parse_event_t;
    if (event == Event::key) {
      open.back().key = parsed.get<std::string>();
      if (!open.back().keys.insert(open.back().key).second)
        refuse(place(), "expected each key once; this one stands twice");
    } else if (event == Event::object_start || event == Event::array_start) {
      if (open.size() == deepest) refuse(where, fmt::format("expected at most {} levels of nesting", deepest));
      open.push_back({.is_list = event == Event::array_start});
    } else {
      if (event != Event::value) open.pop_back();
      if (!open.empty()) ++open.back().entry;
    }
    return true;
  };
  try {
    return ordered_json::parse(text, look);
  } catch (const ordered_json::parse_error& error) {
    // An end that comes too early is behind the last line feed.
    const std::size_t offset = std::min(error.byte > 0 ? error.byte - 1 : 0, last);
    const std::size_t column = offset - text.substr(0, offset).rfind('\n');  // behind no line feed that is one more
    refuse(fmt::format("{}:{}", line_at(offset), column), "expected JSON; " + reason_of(error.what()));
  } catch (const ordered_json::out_of_range& error) {
    const std::string what = error.what();
    refuse(place(), "expected a finite number, not " + what.substr(std::min(what.find('\''), what.size())));
  }
  return {};
}

}  // namespace paperproof::compare
