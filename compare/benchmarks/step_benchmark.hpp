/// What one step costs, and how that compares with Box2D.
#pragma once

namespace paperproof::benchmarks {

/// Registers `step/WORKLOAD/SUBJECT` for every pair. A subject and a bare Box2D world (chain loops around the union of
/// the solids, as Box2D recommends) take turns at the same steps of the same level, so that whatever else the machine
/// does disturbs both. Time is the mean of the passes; the counters:
/// - `ns_min`, `ns_max`: nanoseconds per step in the fastest and in the slowest pass,
/// - `box2d_ns`: the same for the bare Box2D world, fastest pass,
/// - `box2d_ratio`: how many times faster than that the subject is, fastest pass against fastest pass,
/// - `pieces`: convex pieces in the level.
void register_step_benchmarks();

}  // namespace paperproof::benchmarks
