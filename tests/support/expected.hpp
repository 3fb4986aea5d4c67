/// Whether a part of a JSON document is what a table says that it must be.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace paperproof::test {

[[nodiscard]] inline bool is_near(const nlohmann::json& part, const nlohmann::json& wanted, double within) {
  if (wanted.is_number() && part.is_boolean()) return (part == true) == (wanted != 0);  // what a formula says
  if (part.is_number() && wanted.is_number()) return std::abs(part.get<double>() - wanted.get<double>()) <= within;
  if (!part.is_array() || !wanted.is_array()) return part == wanted;
  return std::equal(part.begin(), part.end(), wanted.begin(), wanted.end(),
                    [within](const nlohmann::json& a, const nlohmann::json& b) { return is_near(a, b, within); });
}

/// What is wrong with a part of a record, in words; empty where nothing is.
[[nodiscard]] inline std::string fault_of(const nlohmann::json& part, const nlohmann::json& wanted) {
  if (wanted.contains("is")) {
    const double within = wanted.value("within", 0.0);
    if (!is_near(part, wanted["is"], within))
      return fmt::format("is {} instead of {} within {}", part.dump(), wanted["is"].dump(), within);
  }
  const double value = part.is_number() ? part.get<double>() : NAN;
  const std::pair<const char*, bool (*)(double, double)> bounds[]{
      {"at_least", [](double a, double b) { return a >= b; }},
      {"at_most", [](double a, double b) { return a <= b; }},
      {"above", [](double a, double b) { return a > b; }},
      {"below", [](double a, double b) { return a < b; }}};
  for (const auto& [name, holds] : bounds) {
    if (!wanted.contains(name)) continue;
    const double limit = wanted[name];
    if (!holds(value, limit)) return fmt::format("is {}, and not {} {}", part.dump(), name, limit);
  }
  return {};
}

/// `true` and `false`, or what a formula says of them.
template <class Json>
[[nodiscard]] bool is_true(const Json& said) {
  return said.is_number() ? said != 0 : said.template get<bool>();
}

/// @param known names between blanks.
template <class Json>
void refuse_other_keys(const Json& object, const std::string& known, const std::string& what) {
  for (const auto& [key, value] : object.items())
    if (known.find(" " + key + " ") == std::string::npos)
      throw std::invalid_argument("no such key of " + what + ": " + key);
}

/// @throws std::invalid_argument for what no part could miss.
inline void refuse_other_bounds(const nlohmann::json& wanted, const std::string& what) {
  refuse_other_keys(wanted, " is within at_least at_most above below ", what);
  if (wanted.size() == wanted.count("within")) throw std::invalid_argument(what + ": nothing is asked");
}

}  // namespace paperproof::test
