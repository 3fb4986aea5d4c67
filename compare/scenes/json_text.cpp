#include "scenes/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "records/input_file.hpp"
#include "scenes/input_error.hpp"

namespace paperproof::compare {

namespace {

using nlohmann::json;

/// Deeper nesting than any scene or map has; without a limit a hostile file decides how much memory is used.
constexpr std::size_t deepest = 100;

std::string escaped(std::string_view key) {
  std::string out;
  for (const char c : key) {
    if (c == '~') {
      out += "~0";
    } else if (c == '/') {
      out += "~1";
    } else {
      out += c;
    }
  }
  return out;
}

/// The pointer to a member or an element.
std::string child(std::string pointer, std::string_view name) {
  pointer += '/';
  pointer += name;
  return pointer;
}

/// Builds the document by hand, since only here position, duplicate keys and depth are all known.
class Builder : public nlohmann::json_sax<json> {
 public:
  Builder(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  [[nodiscard]] json take() { return std::move(root_); }

  bool null() override { return add(json()); }
  bool boolean(bool value) override { return add(json(value)); }
  bool number_integer(number_integer_t value) override { return add(json(value)); }
  bool number_unsigned(number_unsigned_t value) override { return add(json(value)); }
  bool number_float(number_float_t value, const string_t&) override { return add(json(value)); }
  bool string(string_t& value) override { return add(json(std::move(value))); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    key_ = name;
    if (open_.back()->contains(key_)) refuse(file_ + ": " + pointer(), "expected each key once; this one stands twice");
    return true;
  }
  bool parse_error(std::size_t position, const std::string& last_token, const json::exception& error) override {
    // The parser has read to the end of the token that it does not like; the place is where that begins. Of anything
    // but numbers and texts it knows only the end.
    const std::size_t length = last_token.size();
    // What stands before a token that is none of JSON's may be part of it: a number is one from end to end.
    const bool number = length > 0 && last_token.find_first_not_of("+-.0123456789eE") == std::string::npos;
    const bool whole = number || (length > 1 && last_token.front() == '"' && last_token.back() == '"');
    const std::size_t back = whole ? length : 1;
    const std::size_t offset = position - std::min(back, position);
    const std::size_t line_start = text_.rfind('\n', offset == 0 ? 0 : offset - 1);
    const std::size_t column = line_start == std::string::npos ? offset + 1 : offset - line_start;
    const std::string where = fmt::format("{}:{}:{}", file_, line_of(text_, offset), std::max<std::size_t>(column, 1));
    if (error.id == 406) refuse(where, fmt::format("expected a finite number, not {}", last_token));
    refuse(where, "expected JSON; " + reason(error.what()));
  }

 private:
  /// What the library says after its own prefix with id and position. It quotes the file, whose bytes may be no text.
  static std::string reason(const std::string& what) {
    const std::size_t colon = what.find(": ");
    std::string said = colon == std::string::npos ? what : what.substr(colon + 2);
    std::replace_if(
        said.begin(), said.end(), [](unsigned char c) { return c >= 0x80; }, '?');
    return said;
  }
  json* add(json value, bool) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    if (open_.back()->is_array()) {
      open_.back()->push_back(std::move(value));
      return &open_.back()->back();
    }
    return &((*open_.back())[key_] = std::move(value));
  }
  bool add(json value) {
    add(std::move(value), true);
    return true;
  }
  bool open(json value) {
    if (open_.size() == deepest) refuse(file_, fmt::format("expected at most {} levels of nesting", deepest));
    keys_.push_back(key_);
    open_.push_back(add(std::move(value), true));
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }
  [[nodiscard]] std::string pointer() const {
    std::string out;
    for (std::size_t level = 1; level < open_.size(); ++level) {
      const json& parent = *open_[level - 1];
      out = child(out, parent.is_array() ? std::to_string(parent.size() - 1) : escaped(keys_[level]));
    }
    return child(out, escaped(key_));
  }

  const std::string& text_;
  const std::string& file_;
  json root_;
  std::vector<json*> open_;        ///< Containers from the root inwards; stable, as only the innermost one grows.
  std::vector<std::string> keys_;  ///< The key under which each of them stands, where its parent is an object.
  std::string key_;
};

std::string listed(std::initializer_list<std::string_view> words) { return fmt::format("{}", fmt::join(words, ", ")); }

}  // namespace

json parse_json(const std::string& text, const std::string& file) {
  refuse_zero_bytes(text, file);
  Builder builder(text, file);
  json::sax_parse(text, &builder);
  return builder.take();
}

JsonCursor JsonCursor::of_converted(const json& document, const std::string& file) {
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

JsonCursor JsonCursor::below(const json& value, std::string_view name) const {
  JsonCursor inner(value, *file_, child(pointer_, name));
  inner.line_ = line_;
  if (line_ > 0 && value.is_object()) inner.line_ = value.value(line_key, line_);
  return inner;
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const {
  if (!value_->is_object()) refuse("expected an object");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return below(*found, escaped(key));
}

JsonCursor JsonCursor::require(std::string_view key) const {
  if (std::optional<JsonCursor> found = find(key)) return *std::move(found);
  below(*value_, escaped(key)).refuse("expected this key, which is missing");
}

void JsonCursor::refuse_other_keys(std::initializer_list<std::string_view> known) const {
  if (!value_->is_object()) refuse("expected an object");
  for (const auto& [key, value] : value_->items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    below(value, escaped(key)).refuse(fmt::format("unknown key; expected one of {}", listed(known)));
  }
}

std::size_t JsonCursor::size() const {
  if (!value_->is_array()) refuse("expected an array");
  return value_->size();
}

JsonCursor JsonCursor::element(std::size_t i) const { return below((*value_)[i], std::to_string(i)); }

bool JsonCursor::is_number() const noexcept { return value_->is_number(); }

bool JsonCursor::is_text() const noexcept { return value_->is_string(); }

double JsonCursor::number() const {
  if (!value_->is_number()) refuse("expected a number");
  return value_->get<double>();
}

double JsonCursor::positive() const {
  const double value = number();
  if (!(value > 0)) refuse("expected a number greater than 0");
  return value;
}

double JsonCursor::not_negative() const {
  const double value = number();
  if (!(value >= 0)) refuse("expected a number that is not negative");
  return value;
}

double JsonCursor::number_within(double lowest, double highest) const {
  const double value = number();
  if (!(value >= lowest && value <= highest)) refuse(fmt::format("expected a number from {} to {}", lowest, highest));
  return value;
}

int JsonCursor::integer(int lowest, int highest) const {
  const std::string range = fmt::format("expected a whole number from {} to {}", lowest, highest);
  if (!value_->is_number()) refuse(range);
  const double value = value_->get<double>();
  if (!(value >= lowest && value <= highest && std::floor(value) == value)) refuse(range);
  return static_cast<int>(value);
}

bool JsonCursor::boolean() const {
  if (!value_->is_boolean()) refuse("expected true or false");
  return value_->get<bool>();
}

std::string JsonCursor::text() const {
  constexpr const char* expected = "expected a text that is not empty and has no control characters";
  if (!value_->is_string()) refuse(expected);
  std::string out = value_->get<std::string>();
  const bool control = std::any_of(out.begin(), out.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (out.empty() || control) refuse(expected);
  return out;
}

Vec2d JsonCursor::point() const {
  if (!value_->is_array() || value_->size() != 2) refuse("expected two numbers, [x, y]");
  return {element(0).number(), element(1).number()};
}

std::vector<Vec2d> JsonCursor::points(std::size_t at_least) const {
  if (size() < at_least) refuse(fmt::format("expected an array of at least {} points", at_least));
  std::vector<Vec2d> points;
  points.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) points.push_back(element(i).point());
  return points;
}

bool JsonCursor::flag(std::string_view key) const {
  const auto found = find(key);
  return found && found->boolean();
}

}  // namespace paperproof::compare
