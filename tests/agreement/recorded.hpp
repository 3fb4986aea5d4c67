/// A step of a controller as a trace has it.
#pragma once

#include "runs/technique_parts.hpp"

#include <paperproof/controller.hpp>

#include <span>

namespace paperproof::test {

/// @param state after the step.
[[nodiscard]] inline compare::TraceStep recorded(const StepReport<double>& report, const CharacterState<double>& state,
                                                 std::span<const MoverMotion<double>> motions) {
  compare::TraceStep record;
  compare::write_report(report, state, compare::Sides::as_said, record);
  record.movers.assign(motions.begin(), motions.end());
  return record;
}

}  // namespace paperproof::test
