/// JSON that knows where it came from: parsing with line and column, values with their JSON pointer.
#pragma once

#include <paperproof/types.hpp>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// Strict JSON: a key that stands twice in one object, nesting beyond 100 levels and numbers beyond double are refused.
/// @throws InputError as "file:line:column: ..." or "file: /pointer: ...".
[[nodiscard]] nlohmann::json parse_json(const std::string& text, const std::string& file);

/// Where a document was made from another format, its objects have under this key the line that they come from.
inline constexpr std::string_view line_key = " line";

/// A view of one value inside a document; the document and the file's name must outlive it.
class JsonCursor {
 public:
  JsonCursor(const nlohmann::json& value, const std::string& file, std::string pointer = {})
      : value_(&value), file_(&file), pointer_(std::move(pointer)) {}

  /// The root of a document whose objects have lines (`line_key`): places are lines of the file that was read.
  [[nodiscard]] static JsonCursor of_converted(const nlohmann::json& document, const std::string& file);

  /// @throws InputError "file: /pointer: expected", or with the line where the document has it.
  [[noreturn]] void refuse(const std::string& expected) const;
  /// "file: /pointer" or "file:line"
  [[nodiscard]] std::string where() const;
  [[nodiscard]] const nlohmann::json& value() const noexcept { return *value_; }

  /// The member of an object, or none. @throws InputError unless this is an object.
  [[nodiscard]] std::optional<JsonCursor> find(std::string_view key) const;
  /// @throws InputError where the key is missing.
  [[nodiscard]] JsonCursor require(std::string_view key) const;
  /// @throws InputError naming the first key that is not listed, and those that are.
  void refuse_other_keys(std::initializer_list<std::string_view> known) const;

  /// Elements of an array. @throws InputError unless this is an array.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] JsonCursor element(std::size_t i) const;

  [[nodiscard]] bool is_number() const noexcept;
  [[nodiscard]] bool is_text() const noexcept;
  [[nodiscard]] double number() const;
  [[nodiscard]] double positive() const;
  [[nodiscard]] double not_negative() const;
  /// A number in [lowest, highest].
  [[nodiscard]] double number_within(double lowest, double highest) const;
  /// A number without a fraction (120 and 120.0 are the same), in [lowest, highest].
  [[nodiscard]] int integer(int lowest, int highest) const;
  [[nodiscard]] bool boolean() const;
  /// A string that is not empty and has no control characters.
  [[nodiscard]] std::string text() const;
  /// Two numbers.
  [[nodiscard]] Vec2d point() const;
  /// An array of that many points or more.
  [[nodiscard]] std::vector<Vec2d> points(std::size_t at_least) const;
  /// The boolean under a key; false where the object does not have it.
  [[nodiscard]] bool flag(std::string_view key) const;

 private:
  /// The cursor on a member or an element of this one.
  [[nodiscard]] JsonCursor below(const nlohmann::json& value, std::string_view name) const;

  const nlohmann::json* value_;
  const std::string* file_;
  std::string pointer_;
  std::size_t line_ = 0;  ///< 0: the document has no lines.
};

}  // namespace paperproof::compare
