/// Formulas in JSON: numbers that follow from others, and lists that repeat what they say. README.md has the notation.
#pragma once

#include "scenes/json_text.hpp"

#include <map>
#include <string>
#include <vector>

namespace paperproof::compare {

/// Numbers by name, for formulas.
using Values = std::map<std::string, double>;

/// What every formula may name.
[[nodiscard]] const Values& constants();

/// A formula of muParser's, in double, in the order in which it is written.
/// @throws std::invalid_argument with the formula, where it is none. Not thread-safe.
[[nodiscard]] double value_of(const std::string& formula, const Values& values);

/// Adds what a `let` names, in order: numbers, or formulas without `=`.
/// @throws std::invalid_argument for the name of a constant.
void name_numbers(const Json& let, Values& values);

/// The cases of `for`: every combination of the numbers that it lists by name, or each of a list of rows.
[[nodiscard]] std::vector<Values> cases_of(const Json& list, const Values& others);

/// The same document with a number for every text that begins with `=`, and the corners of every `box`. In other texts
/// `{formula}` is its number. Lists are without what an `if` leaves out, and have each of what a `for` repeats.
[[nodiscard]] Json computed(const Json& document, const Values& values);

}  // namespace paperproof::compare
