/// Reads the S-expressions that SuperTux writes its levels in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// A list, a word, or a quoted text. `text` points into the source, which must outlive it; escapes are left as they
/// are.
struct SExpression {
  enum class Kind : std::uint8_t { list, word, text };
  Kind kind = Kind::list;
  std::uint32_t line = 1;
  std::string_view text;
  std::vector<SExpression> items;

  /// The word that a list begins with; empty where there is none.
  [[nodiscard]] std::string_view head() const noexcept;
  /// The first list inside this one that begins with `name`, or null.
  [[nodiscard]] const SExpression* find(std::string_view name) const noexcept;
};

/// All expressions of a file, as one list. @throws InputError "file:line: ..." for brackets that do not match, a text
/// that does not end, nesting beyond 100 levels, an empty file.
[[nodiscard]] SExpression parse_s_expressions(std::string_view source, const std::string& file);

/// Reads typed values out of lists, and complains with file and line.
class SReader {
 public:
  explicit SReader(std::string file) : file_(std::move(file)) {}
  [[nodiscard]] std::string where(const SExpression& at) const;
  [[noreturn]] void refuse(const SExpression& at, const std::string& expected) const;

  /// The value of `(name value)` inside `list`; `otherwise` where there is no such entry.
  [[nodiscard]] double number(const SExpression& list, std::string_view name, std::optional<double> otherwise) const;
  [[nodiscard]] int integer(const SExpression& list, std::string_view name, std::optional<int> otherwise) const;
  [[nodiscard]] bool flag(const SExpression& list, std::string_view name, bool otherwise) const;
  [[nodiscard]] std::string_view text(const SExpression& list, std::string_view name) const;
  /// Every entry of `(name 1 2 3 ...)`; empty where there is no such entry.
  [[nodiscard]] std::vector<std::uint32_t> numbers(const SExpression& list, std::string_view name) const;

 private:
  [[nodiscard]] const SExpression* value(const SExpression& list, std::string_view name) const;
  std::string file_;
};

}  // namespace paperproof::compare
