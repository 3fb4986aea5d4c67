#include "scenes/json_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "one_line.hpp"
#include "records/strict_json.hpp"
#include "scenes/input_error.hpp"
#include "scenes/load.hpp"

namespace paperproof::compare {

Json parse_json(const std::string& text, const std::string& file) {
  try {
    return strict_json(text, file);
  } catch (const std::runtime_error& error) {
    throw InputError(one_line(error.what()));
  }
}

JsonCursor JsonCursor::of_converted(const Json& document, const std::string& file) {
  JsonCursor root(document, file);
  root.line_ = document.at(line_key).get<std::size_t>();
  return root;
}

void JsonCursor::refuse(const std::string& expected) const {
  // A line does not say which of its attributes is meant.
  const std::string key = pointer_.substr(pointer_.rfind('/') + 1);
  const bool is_named = line_ > 0 && key.find_first_not_of("0123456789") != std::string::npos;
  compare::refuse(where(), is_named ? fmt::format("{} in \"{}\"", expected, key) : expected);
}

std::string JsonCursor::where() const {
  return line_ > 0 ? at_line(*file_, line_) : *file_ + ": " + (pointer_.empty() ? "/" : pointer_);
}

JsonCursor JsonCursor::below(const Json& value, std::string_view name) const {
  JsonCursor inner(value, *file_, pointer_ + (Json::json_pointer() / std::string(name)).to_string());
  inner.line_ = line_;
  if (line_ > 0 && value.is_object()) inner.line_ = value.value(line_key, line_);
  return inner;
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const {
  if (!value_->is_object()) refuse("expected an object");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return below(*found, key);
}

JsonCursor JsonCursor::require(std::string_view key) const {
  if (std::optional<JsonCursor> found = find(key)) return *std::move(found);
  below(*value_, key).refuse("expected this key, which is missing");
}

std::size_t JsonCursor::size() const {
  if (!value_->is_array()) refuse("expected a list");
  return value_->size();
}

JsonCursor JsonCursor::element(std::size_t i) const { return below((*value_)[i], std::to_string(i)); }

double JsonCursor::number() const {
  if (!value_->is_number()) refuse("expected a number");
  return value_->get<double>();
}

int JsonCursor::integer() const {
  constexpr int most = std::numeric_limits<int>::max();
  const double value = value_->is_number() ? value_->get<double>() : NAN;
  if (!(std::abs(value) <= most && std::floor(value) == value))
    refuse(fmt::format("expected a whole number from {} to {}", -most, most));
  return static_cast<int>(value);
}

}  // namespace paperproof::compare
