/// The numbers of a row as data: what files, tables, pages and `paperproof list metrics` go over. See metric_table.hpp.
#pragma once

#include "records/row.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

namespace paperproof::compare {

struct Metric {
  /// Where a page shows it.
  enum class Group : std::uint8_t { safety, progress, contacts, jitter, cost, study };
  /// How a row of several characters, or a summary of several rows, makes one number of many.
  enum class Of : std::uint8_t { sum, most, first, share, one };
  enum class Kind : std::uint8_t { flag, count, measure, real, bytes };
  using Field = std::variant<std::optional<bool> Row::*, std::optional<int> Row::*, std::optional<double> Row::*,
                             std::optional<std::size_t> Row::*>;

  std::string_view key;    ///< In files; ends in its unit where it has one.
  std::string_view title;  ///< Of a column.
  std::string_view unit;   ///< In words: `m`, `steps`, `per 1000 steps`; empty for a pure number.
  Group group = Group::safety;
  Of of = Of::one;
  std::string_view meaning;  ///< One sentence without its full stop.
  Kind kind = Kind::real;    ///< All but `real` are zero or more.
  Field field;
};

[[nodiscard]] std::string_view name_of(Metric::Group group) noexcept;
[[nodiscard]] std::string_view name_of(Metric::Of of) noexcept;
[[nodiscard]] std::string_view name_of(Metric::Kind kind) noexcept;

/// In the order in which they stand in files.
[[nodiscard]] std::span<const Metric> metrics() noexcept;

/// @return null where there is none of that key.
[[nodiscard]] const Metric* find_metric(std::string_view key) noexcept;

/// Costs differ from run to run, and are left out where rows are compared.
[[nodiscard]] bool is_cost(std::string_view key) noexcept;

/// @return nothing where the metric does not apply to the row; 0 or 1 for a truth value.
[[nodiscard]] std::optional<double> value_of(const Metric& metric, const Row& row);

/// Gives a row each number that another one has.
void take_numbers(const Row& from, Row& row);

}  // namespace paperproof::compare
