/// Metrics: pure functions of a trace and its judgement.
#pragma once

#include "metrics/energy.hpp"
#include "metrics/events.hpp"
#include "metrics/jitter.hpp"
#include "metrics/measured.hpp"
#include "metrics/rest.hpp"
#include "metrics/window.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/judge.hpp"
#include "records/clause.hpp"
#include "records/row.hpp"

#include <set>
#include <utility>

namespace paperproof::compare {

/// Collects one run. Feed every step with its judgement in order, then write the row. Memory does not grow with the
/// number of steps. Not thread-safe.
///
/// - `tunnels`, `clipped`, `one_way_violations`, `steps_ending_inside`: steps with any; see `Judge`. The third only
///   where the scenery has a one-way chain. What `Measured` leaves out is absent.
/// - `max_penetration_m`: deepest exact penetration at the end of a step. `max_contact_gap_m`: largest exact separation
///   at which a reported contact stopped the character.
/// - `contact_precision`: the share of reported contacts (one per step, collider and side) for which exact arithmetic
///   has one with the same collider and side in the same step (Box2D: within one step, exempted), or an exact one
///   deflected the motion there. Contacts that are don't-care do not count (exempted), unless they are ghosts; of
///   octagon_sweep in double only those in `contact_band` do not.
/// - `contact_recall`: the share of exact (step, side) for which a contact of that side with one of the colliders that
///   exact arithmetic has there was reported in the same step (Box2D: within one): a floor of two abutting tiles is one
///   contact. Steps that are said to be stuck do not count (exempted; of octagon_sweep in double those that are right:
///   a character that is stuck inside something does not move and meets nothing).
/// - `normal_error_max_deg`: largest angle between the normal of a reported contact and the nearest exact one with that
///   collider on that side.
/// - `undecided_steps`: steps of which 45 halvings of the time did not tell whether they meet what turns; absent where
///   nothing does.
/// - `hanging_steps`, `stuck_refuted`, `ground_refuted`: see `Judge`. `distance_m`: length of the ways.
///   `wanted_motion_lost`: share of the wanted horizontal motion, over the run, that was lost to nothing exact.
/// - `rounding`: steps ending inside by no more than rounding, of a contender that promises nothing. `exempted`: what
///   was not held against the contender, and how often: see oracle/exemptions.hpp.
/// - `contact_steps`: steps with a reported contact. `colliders_touched`: how many different ones.
/// - `first_contact_step`, `first_contact_fraction`: the earliest reported contact.
/// - `exact_first_impact_step`, `exact_first_impact_fraction`: the first impact of the wanted motion that exact
///   arithmetic has, over the steps that began free. None after a character came beside another at the same time: what
///   two would have met of each other is not asked (`CompanyJudge`).
/// - `toi_error_max`: largest difference of the first reported fraction of a step and the exact first impact, over the
///   steps where the two are comparable (see `Judge`) and the reported collider is one of exact arithmetic's.
/// - `ghost_speed_loss`: largest share of the wanted horizontal speed lost in one step to nothing exact; only where
///   horizontal motion was wanted.
/// - `rest_peak_to_peak_m`, `rest_rms_m`, `contact_toggles`, `rest_sign_changes`, `rest_upper_band`: see `Rest`.
/// - `log_dimensionless_jerk`, `seam_hop_share`, `seam_hop_m`: see `Smoothness`.
/// - `crushes`: steps with a crush that exact arithmetic verified; what movers press the character into on them is not
///   counted as inside, but in `steps_inside_after_crush` for as long as it lasts. `crushes_refuted`: steps with one
///   that it refuted.
/// - `sensor_events`: entries and exits that there were. `sensor_errors`: those that were not reported, and reports of
///   others. `max_sensor_error`: of the fractions of the rest.
/// - `respawns`, `stuck_steps`, `dropped_steps`: counted.
///
/// Of several characters each step of each one counts: counts are sums over them, maxima the largest, shares those of
/// all contacts together, the first contact the earliest, rest that of the least quiet one. Characters that pass or
/// overlap each other count as passing or overlapping a solid, each pair once; a contact with another character is one
/// in `contact_steps`, `first_contact_*` and `toi_error_max`, while `contact_precision` and `contact_recall` are about
/// scenery. `characters` says how many there were.
class Metrics {
 public:
  explicit Metrics(const TraceHeader& header, const Measured& measured = {});
  /// Contacts are matched when the step after them comes: then those that were missed or invented are noted.
  /// @param far the step is not held against the contender.
  void add(const TraceStep& step, const StepJudgement& judgement, Breaches& breaches, bool far = false);
  /// Notes the same of the last step.
  void end(Breaches& breaches) const;
  /// Fills every metric that applies; leaves verdict, reason, cost and the comparison with Box2D alone.
  void write(Row& row) const;

 private:
  using Touch = std::pair<ColliderIndex, Side>;
  struct Moment {
    std::vector<Touch> reported;
    std::vector<Touch> exact;
    std::vector<ColliderIndex> dont_care;
    std::vector<Touch> ghosts;
    bool stuck = false;
    bool held = false;  ///< Crushed, as verified, or inside something where it begins.
    bool far = false;
    int step = 0;
    std::vector<Touch> deflected{};
    std::vector<Touch> ahead{};
    std::vector<Touch> band{};
    bool beside_another = false;
  };
  struct Matches {
    int counted = 0;
    int right = 0;
    int wanted = 0;
    int found = 0;
    int band = 0;
    int late = 0;
    int reach = 0;
    int by_company = 0;
    int stuck = 0;
    int deflected = 0;
    int ahead = 0;
  };
  using View = detail::Window<Moment>::View;
  /// What is matched from step to step.
  struct Follower {
    explicit Follower(const SceneryDef& scenery) : rest(scenery), smoothness(scenery) {}
    detail::Window<Moment> window{};
    Rest rest;
    Smoothness smoothness;
  };
  [[nodiscard]] Matches all_matches(Breaches& breaches) const;
  void note(Clause clause, const Moment& moment, const Touch& touch, Breaches& breaches) const;
  void match(const View& view, Matches& matches, Breaches& breaches) const;
  void match_wanted(const View& view, Matches& matches, Breaches& breaches) const;
  void add_progress(const TraceStep& step, const StepJudgement& judgement);
  void add_exempted(const StepJudgement& judgement);
  void add_first_contact(const TraceStep& step, const StepJudgement& judgement);
  void add_exact_impact(const TraceStep& step, const StepJudgement& judgement);
  void add_contacts(const TraceStep& step, const StepJudgement& judgement, Breaches& breaches, bool far);
  void add_events(const TraceStep& step, const StepJudgement& judgement);
  void add_passings(const TraceStep& step, const StepJudgement& judgement);

  std::vector<std::string> ids_;
  double dt_;  ///< [s]
  Measured measured_;
  bool has_one_way_ = false;
  bool promises_ = false;     ///< See `Party::promising`.
  bool sampled_ = false;      ///< See `Party::sampled`.
  bool met_another_ = false;  ///< One was beside another that goes at the same time.
  double motion_wanted_ = 0;
  double motion_lost_ = 0;
  std::vector<Follower> followers_;  ///< By character.
  Energy energy_;
  Events events_;
  Matches matches_;
  std::set<ColliderIndex> touched_;
  Row sums_;  ///< Counts and maxima so far, absent until something applies.
};

}  // namespace paperproof::compare
