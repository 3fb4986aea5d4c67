/// JSON that knows where it came from: values with their JSON pointer, or the line that they were made from.
#pragma once

#include <paperproof/types.hpp>

#include <nlohmann/json.hpp>

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// A point is `[x, y]`.
template <>
struct nlohmann::adl_serializer<paperproof::Vec2d> {
  template <class Json>
  static void from_json(const Json& json, paperproof::Vec2d& point) {
    point = {json.at(0).template get<double>(), json.at(1).template get<double>()};
  }
};

namespace paperproof::compare {

using Json = nlohmann::ordered_json;

/// As `strict_json`. @throws InputError
[[nodiscard]] Json parse_json(const std::string& text, const std::string& file);

/// Where a document was made from another format, its objects have under this key the line that they come from.
inline constexpr std::string_view line_key = " line";

/// A view of one value inside a document; the document and the file's name must outlive it.
class JsonCursor {
 public:
  JsonCursor(const Json& value, const std::string& file, std::string pointer = {})
      : value_(&value), file_(&file), pointer_(std::move(pointer)) {}

  /// The root of a document whose objects have lines (`line_key`): places are lines of the file that was read.
  [[nodiscard]] static JsonCursor of_converted(const Json& document, const std::string& file);

  /// @throws InputError "file: /pointer: expected", or with the line where the document has it.
  [[noreturn]] void refuse(const std::string& expected) const;
  /// "file: /pointer" or "file:line"
  [[nodiscard]] std::string where() const;
  [[nodiscard]] const Json& value() const noexcept { return *value_; }

  /// The member of an object, or none. @throws InputError unless this is an object.
  [[nodiscard]] std::optional<JsonCursor> find(std::string_view key) const;
  /// @throws InputError where the key is missing.
  [[nodiscard]] JsonCursor require(std::string_view key) const;

  /// Elements of an array. @throws InputError unless this is an array.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] JsonCursor element(std::size_t i) const;

  [[nodiscard]] double number() const;
  /// A number without a fraction: 120 and 120.0 are the same.
  [[nodiscard]] int integer() const;

  /// Numbers, texts, and true or false are checked; of all else a schema has said what it is.
  template <class T>
  [[nodiscard]] T get() const {
    if constexpr (std::same_as<T, double>) return number();
    if constexpr (std::same_as<T, int>) return integer();
    if constexpr (std::same_as<T, bool>)
      if (!value_->is_boolean()) refuse("expected true or false");
    if constexpr (std::same_as<T, std::string>)
      if (!value_->is_string()) refuse("expected a text");
    return value_->get<T>();
  }
  /// Reads what stands under a key; leaves `to` as it is where nothing does.
  template <class T>
  void take(std::string_view key, T& to) const {
    if (const std::optional<JsonCursor> found = find(key)) to = found->get<T>();
  }
  template <class T>
  void take(std::string_view key, std::optional<T>& to) const {
    if (find(key)) take(key, to.emplace());
  }

 private:
  /// The cursor on a member or an element of this one.
  [[nodiscard]] JsonCursor below(const Json& value, std::string_view name) const;

  const Json* value_;
  const std::string* file_;
  std::string pointer_;
  std::size_t line_ = 0;  ///< 0: the document has no lines.
};

/// Calls `function(cursor)` with each entry of a list that may be missing.
template <class Function>
void for_each_entry(const std::optional<JsonCursor>& list, const Function& function) {
  for (std::size_t i = 0; list && i < list->size(); ++i) function(list->element(i));
}

}  // namespace paperproof::compare
