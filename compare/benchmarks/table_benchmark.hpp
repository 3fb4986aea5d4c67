/// The table of controller/README.md, beside Box2D in the same process.
#pragma once

namespace paperproof::benchmarks {

/// Registers, beside `table/setup/...` of the set-up benchmark:
/// - `table/pieces/N`: a step of one character that walks and jumps in a level of N pieces,
/// - `table/sensors/N`: the same among N sensors,
/// - `table/characters/HOW`: a step of each of 10,000 characters, with one scratch for each and with one for all,
/// - `table/start_inside/WHERE`: the first step of a character that begins inside solids, somewhere in a level of
///   1,000,000 pieces that no cache holds: a tenth of a metre below the surface, or deep in the ground.
///
/// The controller and Box2D take turns at the same steps. Box2D is given the velocities, and reads no contact.
/// Counters, in nanoseconds, each the fastest pass: `paperproof`, `box2d`;
/// `ratio`: how many times faster than Box2D. For a start the median of all starts, and `paperproof_most` the slowest.
void register_table_benchmarks();

}  // namespace paperproof::benchmarks
