#include "report/json_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace paperproof::compare {

std::string script_safe(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string json_string(std::string_view text) {
  return script_safe(nlohmann::json(std::string(text)).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string short_number(double number, int digits) {
  return std::isfinite(number) ? fmt::format("{:.{}g}", number, digits) : "null";
}

void JsonArray::separate() {
  if (text_.size() > 1) text_ += ',';
}

JsonArray& JsonArray::add(std::int64_t number) {
  separate();
  char digits[24];
  const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  text_.append(digits, end);
  return *this;
}

JsonArray& JsonArray::add_short(double number) { return add_raw(short_number(number)); }

JsonArray& JsonArray::add_raw(std::string_view json) {
  separate();
  text_ += json;
  return *this;
}

std::string JsonArray::take() && {
  text_ += ']';
  return std::move(text_);
}

JsonObject& JsonObject::put(std::string_view key, std::string_view json) {
  if (!empty()) text_ += ',';
  text_ += '"';
  text_ += key;
  text_ += "\":";
  text_ += json;
  return *this;
}

JsonObject& JsonObject::put(std::string_view key, std::int64_t number) { return put(key, std::to_string(number)); }

std::string JsonObject::take() && {
  text_ += '}';
  return std::move(text_);
}

Quantum::Quantum(double extent, double farthest) {
  constexpr double largest_whole = 9'007'199'254'740'992.0;  // 2^53: what a JavaScript number holds exactly
  constexpr double room = 4;                                 // differences of two coordinates must fit as well
  if (std::isfinite(extent) && extent > 0) metres_ = std::pow(10.0, std::floor(std::log10(extent * 1e-4)));
  while (std::isfinite(farthest) && farthest / metres_ * room > largest_whole) metres_ *= 10;
}

std::int64_t Quantum::round(double metres) const noexcept {
  return std::isfinite(metres) ? std::llround(metres / metres_) : 0;
}

std::string list_of(const std::vector<std::string>& objects) {
  JsonArray list;
  for (const std::string& object : objects) list.add_raw(object);
  return std::move(list).take();
}

}  // namespace paperproof::compare
