/// Runs one Case, and tells the Case of a run.
#pragma once

#include "records/case.hpp"
#include "records/row.hpp"
#include "runs/run.hpp"
#include "scenes/parameters.hpp"

#include <optional>
#include <span>
#include <string>

namespace paperproof::compare {

/// That a Case runs in. @throws InputError
[[nodiscard]] Scene scene_of(const Case& one);

/// A pure function of the Case, which is to be free and without the twin, and of the files it names. What goes wrong is
/// a row that says so. Costs are not measured.
[[nodiscard]] Row run_case(const Case& one);

/// The same with how far it is from the exact motion. @param timed with its cost, too; a peer times itself.
[[nodiscard]] Row run_case_beside_motion(const Case& one, bool timed);

/// The same with its steps recorded, so many before and after the one that matters: see `cut_to_excerpt`. One row; no
/// run where it could not be made to its end, or takes more than 100,000 steps.
/// @param middle the step that matters; absent: what the run itself has.
[[nodiscard]] ReportScene excerpt_of(const Case& one, int around, std::optional<int> middle = {});

/// The Case of a row that `run_scene` gave.
/// @param scene as it was typed. @param settings parameters of the scene that were turned.
/// @return nothing for the twin of a contender in lockstep, which is no run of its own.
[[nodiscard]] std::optional<Case> case_of(const RunOptions& options, const std::string& scene,
                                          std::span<const ParameterSetting> settings, const Row& row);

/// The row of a Case that gave none. @param reason in words.
[[nodiscard]] Row failed_row(const Case& one, const std::string& reason);

}  // namespace paperproof::compare
