#include "studies/front.hpp"

#include "records/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

bool better(const Row& row, const Row& than) {
  const double error = *row.error_max_m - *than.error_max_m;
  const double time = *time_per_second(row) - *time_per_second(than);
  return error <= 0 && time <= 0 && (error < 0 || time < 0);
}

/// Of those that are better than a row the one with the least time.
const Row* cheapest_better(const std::vector<Row>& rows, const Row& than) {
  const Row* found = nullptr;
  for (const Row& row : rows)
    if (counts(row) && better(row, than) && (found == nullptr || *time_per_second(row) < *time_per_second(*found)))
      found = &row;
  return found;
}

std::string reason(const Row& ours, const Row& other) {
  const bool same_steps = parameter_of(ours, "dt_s") == parameter_of(other, "dt_s");
  // Two that make the same motion differ by a gap or by rounding.
  const bool same_error = *ours.error_max_m - *other.error_max_m <= 2e-6 + 1e-3 * *ours.error_max_m;
  if (same_steps && same_error)
    return fmt::format(
        "Both make the same motion there, and a step without the sweep of the whole octagon costs less "
        "({:.0f} ns against {:.0f} ns).",
        *time_per_step(other), *time_per_step(ours));
  if (same_error) return "Its error is as small with longer steps.";
  return "Its error is smaller for the time.";
}

constexpr std::size_t fewest_on_a_line = 3;
constexpr double most_within = 0.15;

/// Nothing where a point does not count.
std::optional<Slope> line_through(std::span<const std::optional<std::pair<double, double>>> points) {
  if (std::any_of(points.begin(), points.end(), [](const auto& point) { return !point; })) return std::nullopt;
  const auto count = static_cast<double>(points.size());
  double mean_x = 0;
  double mean_y = 0;
  for (const auto& point : points) {
    mean_x += point->first / count;
    mean_y += point->second / count;
  }
  double xx = 0;
  double xy = 0;
  for (const auto& point : points) {
    xx += (point->first - mean_x) * (point->first - mean_x);
    xy += (point->first - mean_x) * (point->second - mean_y);
  }
  const double slope = xy / xx;
  double squares = 0;
  for (const auto& point : points) squares += std::pow(point->second - mean_y - slope * (point->first - mean_x), 2);
  const double free = count - 2;
  const double quantile = boost::math::quantile(boost::math::students_t(free), 0.975);
  return Slope{slope, quantile * std::sqrt(squares / free / xx)};
}

}  // namespace

std::optional<Slope> slope_within_a_regime(std::span<const std::optional<std::pair<double, double>>> log_points) {
  while (!log_points.empty() && !log_points.back()) log_points = log_points.first(log_points.size() - 1);
  for (std::size_t count = log_points.size(); count >= fewest_on_a_line; --count) {
    const std::optional<Slope> line = line_through(log_points.last(count));
    if (line && line->within <= most_within) return line;
  }
  return std::nullopt;
}

bool has_error(const Row& row) {
  return row.error_max_m && !falls_short(row, Axis::safety) && !falls_short(row, Axis::validity);
}

bool counts(const Row& row) { return has_error(row) && time_per_second(row); }

void mark_front(std::vector<Row>& rows) {
  for (Row& row : rows)
    if (counts(row))
      row.on_front =
          std::none_of(rows.begin(), rows.end(), [&](const Row& other) { return counts(other) && better(other, row); });
}

std::string words_of_front(const std::string& motion, const std::vector<Row>& rows) {
  std::vector<std::string> front;
  const Row* best = nullptr;
  for (const Row& row : rows) {
    if (is_guaranteed(row) && counts(row) && (best == nullptr || *row.error_max_m < *best->error_max_m)) best = &row;
    if (!row.on_front.value_or(false)) continue;
    const std::string who = row.contender + (is_float_by_choice(row) ? " (float)" : "");
    if (std::find(front.begin(), front.end(), who) == front.end()) front.push_back(who);
  }
  std::string text = fmt::format("{}: on the front: {}.", motion, fmt::join(front, ", "));
  if (best == nullptr || std::any_of(rows.begin(), rows.end(),
                                     [](const Row& row) { return is_guaranteed(row) && row.on_front.value_or(false); }))
    return text;
  const Row* other = cheapest_better(rows, *best);
  if (other == nullptr) return text;
  return text + fmt::format(
                    " octagon_sweep is not: where its error is least, {:.2g} m, {} has {:.2g} m in {:.0f} % of "
                    "the time. {}",
                    *best->error_max_m, other->contender, *other->error_max_m,
                    100 * *time_per_second(*other) / *time_per_second(*best), reason(*best, *other));
}

}  // namespace paperproof::compare
