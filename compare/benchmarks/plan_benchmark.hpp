/// What the plan saves.
#pragma once

namespace paperproof::benchmarks {

/// Registers `plan/WORKLOAD`: octagon_sweep in double as planned for the workload, in turns with one that leaves
/// nothing out, over the same steps. Both end at the same bits, or the benchmark fails. Time is the mean of the planned
/// passes; the counters:
/// - `planned_ns`, `full_ns`: nanoseconds per step in the fastest pass of each,
/// - `ratio`: how many times faster the planned one is, fastest pass against fastest pass,
/// - `omitted`: stages that are left out.
void register_plan_benchmarks();

}  // namespace paperproof::benchmarks
