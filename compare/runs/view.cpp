#include "runs/view.hpp"

#include <fmt/format.h>

#include <string_view>

namespace paperproof::compare {
namespace {

bool begins_with_number(std::string_view text) {
  constexpr std::string_view digits = "0123456789";
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  return text.find_first_of(digits) == 0;
}

}  // namespace

std::string text_of(const Table& table) {
  const auto& [heading, lines] = table;
  std::vector<std::string> texts(lines.size() + 1);
  for (std::size_t k = 0; k < heading.size(); ++k) {
    std::size_t width = heading[k].size();
    bool numbers = false;
    for (const std::vector<std::string>& line : lines) {
      width = std::max(width, line[k].size());
      numbers = numbers || begins_with_number(line[k]);
    }
    const auto put = [&](std::string& text, const std::string& what) {
      if (k > 0) text += "  ";
      text += numbers ? fmt::format("{:>{}}", what, width) : fmt::format("{:<{}}", what, width);
    };
    put(texts[0], heading[k]);
    for (std::size_t i = 0; i < lines.size(); ++i) put(texts[i + 1], lines[i][k]);
  }
  std::string all;
  for (std::string& text : texts) {
    text.erase(text.find_last_not_of(' ') + 1);
    all += text + '\n';
  }
  return all;
}

}  // namespace paperproof::compare
