/// Small pieces of JSON, written straight into a string: the replay has millions of numbers.
#pragma once

#include <paperproof/types.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// A quoted JSON string that may stand inside a `<script>` element: no `<` is left in it, so neither `</script>` nor
/// `<!--` can end the element early. Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string json_string(std::string_view text);

/// The same for JSON that is already written: outside of strings JSON has no `<`.
[[nodiscard]] std::string script_safe(std::string_view json);

/// A number with this many significant digits, for display. One that is not finite becomes null.
[[nodiscard]] std::string short_number(double number, int digits = 3);

/// A comma-separated list in brackets, written number by number.
class JsonArray {
 public:
  JsonArray& add(std::int64_t number);
  /// Three significant digits.
  JsonArray& add_short(double number);
  JsonArray& add_raw(std::string_view json);
  [[nodiscard]] std::string take() &&;

 private:
  void separate();
  std::string text_ = "[";
};

/// An object, written member by member; the keys are ours and need no escaping.
class JsonObject {
 public:
  JsonObject& put(std::string_view key, std::string_view json);
  JsonObject& put(std::string_view key, std::int64_t number);
  [[nodiscard]] bool empty() const noexcept { return text_.size() == 1; }
  [[nodiscard]] std::string take() &&;

 private:
  std::string text_ = "{";
};

/// A point in display units.
struct DisplayPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend bool operator==(const DisplayPoint&, const DisplayPoint&) = default;
};

/// Rounds metres to a whole number of display units, the same for all coordinates of a scene.
class Quantum {
 public:
  /// A power of ten: `extent / 10,000` or finer, unless `farthest` is so large that whole numbers up to 2^53 would not
  /// do.
  /// @param extent   size of the character [m]; @param farthest  largest coordinate [m].
  Quantum(double extent, double farthest);
  [[nodiscard]] double metres() const noexcept { return metres_; }
  [[nodiscard]] std::int64_t round(double metres) const noexcept;
  [[nodiscard]] DisplayPoint round(const Vec2d& point) const noexcept { return {round(point.x()), round(point.y())}; }

 private:
  double metres_ = 1;
};

/// A list of objects that are JSON already.
[[nodiscard]] std::string list_of(const std::vector<std::string>& objects);

}  // namespace paperproof::compare
