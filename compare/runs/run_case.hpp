/// Runs one Case.
#pragma once

#include "records/case.hpp"
#include "records/row.hpp"

namespace paperproof::compare {

/// A pure function of the Case and of the files it names. What goes wrong is a row that says so. Costs are not
/// measured.
[[nodiscard]] Row run_case(const Case& one);

/// The row of a Case that gave none. @param reason in words.
[[nodiscard]] Row failed_row(const Case& one, const std::string& reason);

}  // namespace paperproof::compare
