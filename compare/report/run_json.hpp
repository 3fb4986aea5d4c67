/// One run of the replay as JSON.
#pragma once

#include "report/json_text.hpp"
#include "report/report.hpp"

namespace paperproof::compare {

/// A run whose steps are columns:
/// - `step`: differences of the step numbers;
/// - `flags`: one character per step, '0' + (grounded 1, jumping 2, respawn 4, stuck 8, dropped 16, capped 32);
/// - `path`: per step 0 and (dx, dy) where the way is one straight line from where the last one ended; -1 where there
/// is
///   none; otherwise the number of corners and (dx, dy, fraction in 1/10,000) for each;
/// - `velocity`: (dvx, dvy) in 10 quanta per second;
/// - `contacts`: per step the count, then (kind, dx, dy, fraction in 1/10,000, separation in metres) for each, where
///   (dx, dy) is the change of (point - position) since the last contact of that kind; `kinds` are
///   (collider, side, normal x, normal y), the normal in 1/10,000;
/// - `start_overlap`: {index of the stored step: [collider…]}; `crush` and `drop` in the same way, where there are
///   any;
/// - `movers`, where there are any: per step 1 and (dx, dy) from where each of them ended the step before, if any
/// begins
///   elsewhere, else 0; then for each the change of its way (to - from) since the step before.
/// - `turns`, where anything turns: per step the angle of each mover when it begins and when it ends, in 1/10,000;
/// - `met`, where there is any: {index of the stored step: [character, side, normal x, normal y, fraction…]}, the last
///   three in 1/10,000;
/// - `remainder`, where there is any: {index of the stored step: [dx, dy]}, from the end of its way to where the
/// character
///   is drawn;
/// - `others`, where there are several characters: for each but the first an object with these columns, for the same
/// steps.
/// Steps from the first one with a position that is not finite are left out, and `not_finite_from` says so.
[[nodiscard]] std::string run_json(const ReportRun& run, std::size_t scenery, const Quantum& quantum);

/// Contacts one by one: [[collider, side, x, y, normal x, normal y, fraction, separation]…], lengths in quanta,
/// normals and fractions in 1/10,000, the separation in metres.
[[nodiscard]] std::string plain_contacts_json(const std::vector<Contact>& contacts, const Quantum& quantum);

}  // namespace paperproof::compare
