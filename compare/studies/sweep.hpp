/// Sweeps: one scene or family with parameters varied along axes, for several contenders. A sweep is a list of Cases.
#pragma once

#include "records/case.hpp"
#include "records/row.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// A parameter of the scene, or a knob of the contenders, with the values that it takes.
struct SweepAxis {
  std::string key;
  std::vector<std::string> values;
};

/// `speed=10:2000:log12` (12 values, each as many times the one before), `speed=0:1:lin5`, or `speed=1,2,4`.
/// @throws InputError in words for anything else; at most 1,000,000 values.
[[nodiscard]] SweepAxis parse_axis(std::string_view text);
/// Several, with a space between.
[[nodiscard]] std::vector<SweepAxis> parse_axes(std::string_view text);

/// Who runs: a contender with knobs of its own.
struct NamedContender {
  std::string name;
  std::vector<Case::Setting> knobs{};
  [[nodiscard]] std::string called() const;  ///< `box2d bullet=off solids=dynamic`
};

struct Sweep {
  std::string scene;
  std::vector<Case::Setting> set;  ///< The same for all.
  std::vector<SweepAxis> axes;     ///< The contender varies fastest, then the scalar, then the last axis.
  std::vector<NamedContender> contenders;
  std::vector<std::string> scalars{"double"};
  std::optional<std::uint64_t> seed;
  std::optional<int> steps;
  /// Parameter that is bisected instead of varied, to where a contender ceases to hold: one row for each combination of
  /// the others.
  std::optional<std::string> border;
  std::optional<std::pair<double, double>> border_range;  ///< Looked over; absent: all that the parameter takes.

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] Case at(std::size_t index) const;
};

/// One of the sweeps of a study.
struct StudyPart {
  std::string title;  ///< Of its maps and its table; parts of one title are shown together.
  Sweep sweep;
  std::function<Row(const Sweep& sweep, std::size_t index)> run{};  ///< Of a case; none: `run_at`.
  Bad bad = Bad::does_not_hold;                                     ///< What its maps count.
  std::string question{};                                           ///< One sentence; empty where the title says it.
};

/// Reads `KEY`, or `KEY=FIRST:LAST`, as a sweep's border. @throws InputError in words for anything else.
void parse_border(const std::string& text, Sweep& sweep);

/// @throws InputError where an axis or a setting is no parameter of the scene and no knob, or out of its range, and
/// where the scene cannot be used at all.
void check(const Sweep& sweep);

/// The row of a Case; with a border, of its bisection.
[[nodiscard]] Row run_at(const Sweep& sweep, std::size_t index);

/// A case of one of several sweeps.
struct PartCase {
  std::size_t part = 0;   ///< Which of the sweeps.
  std::size_t index = 0;  ///< In it.
};
/// Where a case is in sweeps that stand one behind the other. @param index among all their cases, of which it is one.
[[nodiscard]] PartCase part_case(const std::vector<StudyPart>& parts, std::size_t index);

/// What a study runs: each case gives a row.
struct StudyCases {
  std::string id;  ///< Tells two studies apart: 16 hexadecimal digits.
  std::size_t count = 0;
  std::function<Row(std::size_t)> run;                              ///< In a process of its own. It must not throw.
  std::function<Row(std::size_t, const std::string& reason)> lost;  ///< Where that process ended or was killed.
  /// Whether a row of a file can be that of a case.
  std::function<bool(std::size_t, const Row& row)> is_of;
  int limit_s = 60;  ///< A case that takes longer fails, where the options do not say otherwise.
};
/// Those of sweeps that stand one behind the other. @param parts are to live as long.
[[nodiscard]] StudyCases cases_of(const std::vector<StudyPart>& parts);

/// How the border of a sweep is looked for.
struct BorderSearch {
  std::function<Row(const Case&)> run;    ///< As a rule `run_case`.
  std::function<bool(const Row&)> holds;  ///< As a rule `is_safe`.
  int strides = 64;
};
/// The row of the bisection of a sweep's border.
[[nodiscard]] Row border_at(const Sweep& sweep, std::size_t index, const BorderSearch& search);

/// Passes nothing, and ends inside nothing.
[[nodiscard]] bool is_safe(const Row& row);

/// Keys that the axes of a sweep have in the `parameters` of rows.
[[nodiscard]] std::vector<std::string> axis_keys_of(const Sweep& sweep);

/// Looks for the border of a parameter between where a contender holds and where it does not: upwards over its range in
/// strides, equal in its logarithm where the range allows; from the first that does not hold back by bisection, until
/// the two ends differ by a ten-thousandth of the larger. A run that cannot be made ends the search.
/// @param run_with the row at a value. @param holds of such a row.
/// @return the row at the upper end of the bracket, or at the end of the range where all hold; of a run that could not
/// be made that run's row, with what is known of the border.
[[nodiscard]] Row find_border(const std::string& key, double least, double most,
                              const std::function<Row(double)>& run_with, int strides = 64,
                              const std::function<bool(const Row&)>& holds = is_safe);

}  // namespace paperproof::compare
