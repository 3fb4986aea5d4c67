#include "records/metric.hpp"

#include <algorithm>
#include <array>

namespace paperproof::compare {
namespace {

constexpr std::array all_metrics{
#define METRIC(kind, key, group, of, title, unit, meaning) \
  Metric{#key, title, unit, Metric::Group::group, Metric::Of::of, meaning, Metric::Kind::kind, &Row::key},
#include "records/metric_table.hpp"
};

}  // namespace

std::string_view name_of(Metric::Group group) noexcept {
  constexpr std::array<std::string_view, 6> names{"safety", "progress", "contacts", "jitter", "cost", "study"};
  return names[static_cast<std::size_t>(group)];
}

std::string_view name_of(Metric::Of of) noexcept {
  constexpr std::array<std::string_view, 5> names{"sum", "largest", "first", "share", "single"};
  return names[static_cast<std::size_t>(of)];
}

std::string_view name_of(Metric::Kind kind) noexcept {
  constexpr std::array<std::string_view, 5> names{"flag", "count", "measure", "real", "bytes"};
  return names[static_cast<std::size_t>(kind)];
}

std::span<const Metric> metrics() noexcept { return all_metrics; }

const Metric* find_metric(std::string_view key) noexcept {
  const auto found = std::ranges::find(all_metrics, key, &Metric::key);
  return found == all_metrics.end() ? nullptr : &*found;
}

bool is_cost(std::string_view key) noexcept {
  const Metric* metric = find_metric(key);
  return key == "on_front" || (metric != nullptr && metric->group == Metric::Group::cost && key != "memory_bytes");
}

void take_numbers(const Row& from, Row& row) {
  for (const Metric& metric : all_metrics)
    std::visit(
        [&](const auto member) {
          if (from.*member) row.*member = from.*member;
        },
        metric.field);
}

std::optional<double> value_of(const Metric& metric, const Row& row) {
  return std::visit(
      [&](const auto field) { return row.*field ? std::optional(static_cast<double>(*(row.*field))) : std::nullopt; },
      metric.field);
}

}  // namespace paperproof::compare
