#include "scenes/s_expression.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "scenes/input_error.hpp"

#include <paperproof/number_in.hpp>

namespace paperproof::compare {

namespace {

constexpr std::size_t deepest = 100;

constexpr bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }
constexpr bool ends_word(char c) { return is_space(c) || c == '(' || c == ')' || c == '"' || c == ';'; }

class Parser {
 public:
  Parser(std::string_view source, const std::string& file) : source_(source), file_(file) {}

  SExpression all() {
    std::vector<SExpression> open(1);
    while (skip_space()) {
      const char c = source_[at_];
      if (c == '(') {
        if (open.size() > deepest) fail(line_, fmt::format("expected at most {} levels of nesting", deepest));
        open.push_back({.kind = SExpression::Kind::list, .line = line_, .text = {}, .items = {}});
        ++at_;
      } else if (c == ')') {
        if (open.size() == 1) fail(line_, "expected no \")\" here: nothing is open");
        SExpression closed = std::move(open.back());
        open.pop_back();
        open.back().items.push_back(std::move(closed));
        ++at_;
      } else {
        open.back().items.push_back(c == '"' ? text() : word());
      }
    }
    if (open.size() > 1) fail(open.back().line, "expected a \")\" for the \"(\" of this line before the file ends");
    if (open.front().items.empty()) fail(1, "expected an S-expression; the file is empty");
    return std::move(open.front());
  }

 private:
  [[noreturn]] void fail(std::uint32_t line, const std::string& expected) const {
    compare::refuse(at_line(file_, line), expected);
  }

  /// Also skips comments. @returns whether anything is left.
  bool skip_space() {
    for (; at_ < source_.size(); ++at_) {
      if (source_[at_] == ';') {
        at_ = std::min(source_.find('\n', at_), source_.size());
        if (at_ == source_.size()) return false;
      }
      if (!is_space(source_[at_])) return true;
      if (source_[at_] == '\n') ++line_;
    }
    return false;
  }

  SExpression word() {
    const std::size_t begin = at_;
    while (at_ < source_.size() && !ends_word(source_[at_])) ++at_;
    return {.kind = SExpression::Kind::word, .line = line_, .text = source_.substr(begin, at_ - begin), .items = {}};
  }

  SExpression text() {
    const std::uint32_t line = line_;
    const std::size_t begin = ++at_;
    for (; at_ < source_.size() && source_[at_] != '"'; ++at_) {
      if (source_[at_] == '\\' && at_ + 1 < source_.size()) ++at_;
      if (source_[at_] == '\n') ++line_;
    }
    if (at_ == source_.size()) fail(line, "expected the closing quote of the text of this line");
    return {.kind = SExpression::Kind::text, .line = line, .text = source_.substr(begin, at_++ - begin), .items = {}};
  }

  std::string_view source_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1;
};

}  // namespace

std::string_view SExpression::head() const noexcept {
  return items.empty() || items.front().kind != Kind::word ? std::string_view() : items.front().text;
}

const SExpression* SExpression::find(std::string_view name) const noexcept {
  for (const SExpression& item : items) {
    if (item.kind == Kind::list && item.head() == name) return &item;
  }
  return nullptr;
}

SExpression parse_s_expressions(std::string_view source, const std::string& file) { return Parser(source, file).all(); }

std::string SReader::where(const SExpression& at) const { return at_line(file_, at.line); }

void SReader::refuse(const SExpression& at, const std::string& expected) const { compare::refuse(where(at), expected); }

const SExpression* SReader::value(const SExpression& list, std::string_view name) const {
  const SExpression* entry = list.find(name);
  if (entry == nullptr) return nullptr;
  if (entry->items.size() < 2) refuse(*entry, fmt::format("expected a value in ({})", name));
  return &entry->items[1];
}

double SReader::number(const SExpression& list, std::string_view name, std::optional<double> otherwise) const {
  const SExpression* found = value(list, name);
  if (found == nullptr) {
    if (!otherwise) refuse(list, fmt::format("expected ({} NUMBER) in ({})", name, list.head()));
    return *otherwise;
  }
  const std::optional<double> number = number_in<double>(found->text);
  if (!number) refuse(*found, fmt::format("expected a finite number in ({})", name));
  return *number;
}

int SReader::integer(const SExpression& list, std::string_view name, std::optional<int> otherwise) const {
  const double value = number(list, name, otherwise);
  constexpr int largest = std::numeric_limits<int>::max();
  if (!(std::abs(value) <= largest && std::floor(value) == value)) {
    refuse(*list.find(name), fmt::format("expected a whole number in ({})", name));
  }
  return static_cast<int>(value);
}

bool SReader::flag(const SExpression& list, std::string_view name, bool otherwise) const {
  const SExpression* found = value(list, name);
  if (found == nullptr) return otherwise;
  if (found->text != "#t" && found->text != "#f") refuse(*found, fmt::format("expected #t or #f in ({})", name));
  return found->text == "#t";
}

std::string_view SReader::text(const SExpression& list, std::string_view name) const {
  const SExpression* found = value(list, name);
  return found == nullptr ? std::string_view() : found->text;
}

std::vector<std::uint32_t> SReader::numbers(const SExpression& list, std::string_view name) const {
  std::vector<std::uint32_t> out;
  const SExpression* entry = list.find(name);
  if (entry == nullptr) return out;
  out.reserve(entry->items.size());
  for (std::size_t i = 1; i < entry->items.size(); ++i) {
    const std::string_view text = entry->items[i].text;
    const std::optional<std::uint32_t> value = number_in<std::uint32_t>(text);
    if (!value) refuse(entry->items[i], fmt::format("expected a number in ({}), not \"{}\"", name, text));
    out.push_back(*value);
  }
  return out;
}

}  // namespace paperproof::compare
