/// What rows of work and precision say: slopes, the Pareto front, and the front in words.
#pragma once

#include "records/row.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// Of a line through points of one regime, by least squares.
struct Slope {
  double value = 0;
  double within = 0;  ///< Half of its 95 % interval, by Student's t.
};

/// Of as many of the finest points that count as lie on one line: three neighbours at least, and the slope is known
/// within 0.15. Where a curve jumps, as a contender begins to go through, or bends, a line over all of it says nothing.
/// @param log_points from coarse to fine; a point that does not count is nothing, and ends a run.
[[nodiscard]] std::optional<Slope> slope_within_a_regime(
    std::span<const std::optional<std::pair<double, double>>> log_points);

/// Whether a row has an error, and it means something: its run passes nothing, ends inside nothing, and stays within
/// the limits that the contender documents.
[[nodiscard]] bool has_error(const Row& row);
/// The same of error and time.
[[nodiscard]] bool counts(const Row& row);

/// Sets `on_front` of every row that counts: no other of the rows has less error for less time, or the
/// same of one and less of the other.
/// @param rows of one motion.
void mark_front(std::vector<Row>& rows);

/// Who is on the front; and where octagon_sweep in double is not, who has less error for less time there, and why.
/// @param rows of one motion, with the front marked.
[[nodiscard]] std::string words_of_front(const std::string& motion, const std::vector<Row>& rows);

}  // namespace paperproof::compare
