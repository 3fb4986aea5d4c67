// The numbers of a row, each said once: here. A member of `Row`, a column of files, tables and pages, a line of
// `paperproof list metrics` and a property of the schema of rows come of each line. In the order in which they stand in
// files.
//
// METRIC(kind, key, group, of, title, unit, meaning)
//   kind     `Metric::Kind`
//   key      in files, and the member of `Row`; ends in its unit where it has one
//   group    `Metric::Group`
//   of       `Metric::Of`
//   title    of a column
//   unit     as in `m`, `steps`, `per 1000 steps`; a pure number has none
//   meaning  one sentence without its full stop
//
// To be included where METRIC is defined, as often as it is needed.
METRIC(flag, finite, study, one, "Finite", "", "Whether every position and velocity is a number")
METRIC(flag, penetration_ok, study, one, "No penetration", "",
       "Whether the character passes nothing, and ends no step inside anything by more than an ulp, and bodies by at "
       "most 5 mm")
METRIC(flag, drift_ok, study, one, "No drift", "",
       "Whether at rest it stays within 1e-6 m (octagon_sweep in double) or 1e-4 m (others), or two ulp of its place "
       "if that is more; not asked in a crowd, nor of Box2D on slopes")
METRIC(flag, energy_ok, study, one, "No energy gained", "",
       "Whether the energy never rises, where nothing is put in, by more than gravity times the contender's reach "
       "(1e-6 m; Box2D's skin, 20 mm) and rounding; of bodies by more than 1 % of what moves and the weight of loose "
       "ones times 20 mm")
METRIC(flag, hanging_ok, study, one, "No hanging", "",
       "Whether no step that could fall hangs, and none is stuck beside a way out")
METRIC(measure, badness, study, most, "Badness", "",
       "How bad the worst is that it does, for an order: 0 nothing; below 1 it clips, hops or is off its way; from 1 on "
       "it hangs, from 2 on it ends inside something, from 3 on it passes a solid, from 4 on it fails")
METRIC(measure, skin_m, study, most, "Skin", "m", "Gap that a peer says it keeps, 20 mm at most")
METRIC(flag, events_ok, study, one, "Same events", "",
       "Whether it has the sequence of events of the case that it is a replica of: the same contacts and supports in "
       "order")
METRIC(real, border_low, study, one, "Holds up to", "",
       "Largest value of the bisected parameter that is known to hold; absent where none does")
METRIC(real, border_high, study, one, "Fails from", "",
       "Smallest value of the bisected parameter that is known not to hold; absent where all hold")
METRIC(count, characters, progress, sum, "Characters", "",
       "Characters in the run; absent for one; counts are sums over them")
METRIC(count, tunnels, safety, sum, "Tunnels", "steps", "Steps whose way crosses a solid and ends free of it")
METRIC(count, clipped, safety, sum, "Clipped", "steps",
       "Steps that pass a solid with a rim only: no deeper than 20 mm, its unit or its pixel; no tunnels")
METRIC(measure, clipped_depth_max_m, safety, most, "Clipped by", "m", "How deep the deepest of them is")
METRIC(count, steps_ending_inside, safety, sum, "Ending inside", "steps",
       "Steps that end overlapping a solid, in exact arithmetic")
METRIC(count, one_way_violations, safety, sum, "One-way broken", "steps",
       "Steps that pass a one-way chain against its normal, not on purpose")
METRIC(measure, max_penetration_m, safety, most, "Max penetration", "m", "Largest exact depth at the end of a step")
METRIC(real, max_contact_gap_m, safety, most, "Max contact gap", "m",
       "Largest exact separation at which a reported contact stopped the character")
METRIC(count, first_contact_step, contacts, first, "First contact", "step", "First step with a reported contact")
METRIC(measure, first_contact_fraction, contacts, first, "First contact", "of a step",
       "Time of impact of that contact as a fraction of the step")
METRIC(count, exact_first_impact_step, contacts, first, "First impact, exact", "step",
       "Step of the first impact of the wanted motion in exact arithmetic, reported or not")
METRIC(measure, exact_first_impact_fraction, contacts, first, "First impact, exact", "of a step",
       "Time of that impact as a fraction of the step")
METRIC(measure, contact_precision, contacts, share, "Precision", "share",
       "Share of the reported contacts that are exact, or that an exact contact deflected the motion into; contacts in "
       "reach do not count")
METRIC(measure, contact_recall, contacts, share, "Recall", "share", "Share of the exact contacts that were reported")
METRIC(measure, contact_precision_box2d, contacts, share, "Precision, Box2D", "share",
       "Share of the reported contacts that the Box2D twin reports, too")
METRIC(measure, contact_recall_box2d, contacts, share, "Recall, Box2D", "share",
       "Share of the contacts of the Box2D twin that were reported")
METRIC(measure, contact_agreement_box2d, contacts, share, "Same sides as Box2D", "share",
       "Share of the steps with the same sides of contact as the Box2D twin")
METRIC(count, contact_steps, contacts, sum, "With contact", "steps", "Steps with any reported contact")
METRIC(count, colliders_touched, contacts, sum, "Colliders touched", "", "Different colliders with a reported contact")
METRIC(count, respawns, contacts, sum, "Respawns", "", "Times the character was put back at the start")
METRIC(count, crushes, progress, sum, "Crushed", "steps",
       "Steps on which movers left no room, verified by exact arithmetic; absent where nothing moves")
METRIC(count, crushes_refuted, progress, sum, "Crushed with room", "steps",
       "Steps on which a crush was reported and there was room")
METRIC(count, body_tunnels, progress, sum, "Bodies through", "steps",
       "Steps on which a body that Box2D moves passed a solid; in rows of Box2D")
METRIC(count, body_steps_inside, progress, sum, "Bodies inside", "steps",
       "Steps on which such a body ended inside something")
METRIC(measure, body_max_penetration_m, progress, most, "Depth of bodies", "m", "Largest exact depth of such a body")
METRIC(real, body_energy_gained_j, progress, most, "Energy gained by bodies", "J",
       "Largest rise of the energy of bodies and springs above its least value before")
METRIC(real, body_energy_bound_j, progress, most, "Energy bound of bodies", "J",
       "What of that rise is rounding and skin")
METRIC(count, sensor_events, progress, sum, "Sensor events", "",
       "Entries and exits that happened, in exact arithmetic; absent where there are no sensors")
METRIC(count, sensor_errors, progress, sum, "Sensor errors", "",
       "Events that were missed, and reported events that did not happen")
METRIC(measure, max_sensor_error, progress, most, "Sensor time error", "of a step",
       "Largest error of the reported fraction of an event")
METRIC(count, steps_inside_after_crush, progress, sum, "Inside after a crush", "steps",
       "Steps that overlap nothing but what a verified crush brought on")
METRIC(count, undecided_steps, progress, sum, "Undecided", "steps",
       "Steps that came so near to what turns that halving the time did not tell whether they met it")
METRIC(count, hanging_steps, progress, sum, "Hanging", "steps", "Steps that could have fallen, and did not")
METRIC(count, stuck_steps, progress, sum, "Stuck", "steps",
       "Steps on which the contender said that it is stuck inside something")
METRIC(count, stuck_refuted, progress, sum, "Stuck, refuted", "steps",
       "Steps of these on which exact arithmetic has a straight way out")
METRIC(count, ground_refuted, progress, sum, "Ground, refuted", "steps",
       "Steps on which the contender said that it stands, and exact arithmetic has nothing under it")
METRIC(count, ground_missed, progress, sum, "Ground, missed", "steps",
       "Steps on which it touches ground and does not leave it, and says that it does not stand; only where that is "
       "guaranteed")
METRIC(measure, arc_error_max_m, progress, most, "Off the arc", "m",
       "Largest distance of what turns from its true arc at the same instant; absent where nothing turns")
METRIC(count, dropped_steps, progress, sum, "Displacement left over", "steps",
       "Steps on which a part of the displacement was left when the iterations ran out")
METRIC(measure, answer_error, progress, most, "Error of the answer", "",
       "Error of the exact answer that is missed most, in the unit of that answer")
METRIC(flag, answer_ok, progress, one, "Answers met", "", "Whether all of the scene's exact answers are met")
METRIC(real, wanted_motion_lost, progress, share, "Motion lost", "share",
       "Share of the wanted horizontal motion lost to nothing exact")
METRIC(measure, distance_m, progress, sum, "Distance", "m", "Length of the way that was travelled")
METRIC(count, contact_band, contacts, sum, "In the band", "",
       "Contacts between 1e-7 and 7e-7 m, where the guarantee lets hit and hold be either")
METRIC(count, rounding, progress, sum, "Rounding", "steps",
       "Steps that end inside by no more than an ulp of the largest coordinate")
METRIC(measure, normal_error_max_deg, contacts, most, "Normal error", "degrees",
       "Largest angle between a reported normal and the exact one")
METRIC(measure, toi_error_max, safety, most, "Impact time error", "of a step",
       "Largest error of the first time of impact of a step")
METRIC(real, ghost_speed_loss, jitter, most, "Snag", "share",
       "Largest share of the wanted horizontal speed lost in one step to nothing exact")
METRIC(real, energy_gained_j_kg, progress, most, "Energy gained", "J/kg",
       "Largest rise of the characters' energy while nothing puts any in")
METRIC(real, energy_bound_j_kg, progress, most, "Energy bound", "J/kg",
       "What of that rise is rounding, and reach in the field of gravity")
METRIC(count, events, contacts, one, "Events", "steps",
       "Steps that end with other contacts or another support than the step before")
METRIC(measure, rest_peak_to_peak_m, jitter, most, "Rest jitter", "m, peak to peak",
       "Larger of the ranges of x and y at rest")
METRIC(measure, rest_rms_m, jitter, most, "Rest jitter", "m, RMS",
       "Root mean square distance from the mean position at rest")
METRIC(measure, contact_toggles, jitter, most, "Contact toggles", "per 1000 steps", "Contacts that come and go at rest")
METRIC(measure, rest_sign_changes, jitter, most, "Sign changes", "per 1000 steps",
       "Sign changes of the velocity at rest; a tremble has one in each step")
METRIC(
    measure, rest_upper_band, jitter, most, "Upper half band", "share",
    "Share of the power at rest above half of the highest frequency, trend removed; 1 is a flutter from step to step")
METRIC(real, log_dimensionless_jerk, jitter, most, "Smoothness", "",
       "Logarithm of the dimensionless jerk of the last positions; larger is smoother")
METRIC(real, seam_hop_share, jitter, most, "Seam hop", "share of speed",
       "Largest change of speed between two steps on level ground")
METRIC(real, seam_hop_m, jitter, most, "Seam hop", "m", "Largest change of height between two steps on level ground")
METRIC(measure, max_position_difference_box2d_m, contacts, most, "Distance to Box2D", "m",
       "Largest distance to the Box2D twin at the end of a step")
METRIC(count, first_difference_box2d_step, contacts, first, "First difference to Box2D", "step",
       "First step with other sides of contact than the Box2D twin, or further from it than its skin")
METRIC(measure, error_max_m, study, most, "Error", "m", "Largest distance from the continuous motion")
METRIC(measure, error_rms_m, study, most, "Error, RMS", "m", "Root mean square distance from the continuous motion")
METRIC(count, hanging_by_law, study, sum, "Hanging by law", "steps",
       "Hanging steps on which the exact law of steps, of who promises nothing also that of a body without friction, "
       "stays as well")
METRIC(measure, error_law_max_m, study, most, "Error beside the law of steps", "m",
       "Largest distance from the exact law of steps: the error of its collision, without that of its steps")
METRIC(real, slope, study, one, "Slope", "",
       "Slope of log error over the logarithm of the parameter named in `curve`, where the three finest points or "
       "more lie on one line")
METRIC(measure, slope_within, study, one, "Slope, within", "", "Half of its 95 % interval")
METRIC(flag, on_front, study, one, "On the front", "", "Whether no other run has less error in less time")
METRIC(measure, ns_per_step, cost, most, "Cost", "ns per step", "Minimum of the repeats")
METRIC(measure, ns_per_step_median, cost, most, "Cost, median", "ns per step", "Median of the repeats")
METRIC(measure, ns_per_step_max, cost, most, "Cost, slowest", "ns per step", "Maximum of the repeats")
METRIC(measure, ns_per_step_own_clock, cost, most, "Cost, own clock", "ns per step",
       "Mean time of a step by the clock of a peer, which is a process of its own: not to be held against the others")
METRIC(measure, ns_per_step_bare, cost, most, "Cost, bare", "ns per step",
       "Box2D alone, given its velocities, with nothing recorded; minimum of the repeats")
METRIC(measure, impact_step_ns, cost, most, "Impact step", "ns",
       "The step of the exact first impact alone, if it is among the first 120; least of the repeats; of Box2D bare")
METRIC(measure, impact_step_cold_ns, cost, most, "Impact step, cold", "ns",
       "The same, after 4 MB of other memory were written")
METRIC(bytes, memory_bytes, cost, most, "Memory", "bytes", "Size of a contender's own picture of the level")

#undef METRIC
