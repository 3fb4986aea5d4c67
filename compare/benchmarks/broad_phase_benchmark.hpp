/// What a query of the broad phase costs, by number of pieces.
#pragma once

namespace paperproof::benchmarks {

/// Registers `broad_phase/KIND/PIECES`: one query with the box of a character's step, somewhere in a level of so many
/// tiles. Counter `found`: pieces per query.
void register_broad_phase_benchmarks();

}  // namespace paperproof::benchmarks
