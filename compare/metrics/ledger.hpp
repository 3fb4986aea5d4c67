/// The ledger of disagreement: every event on which a contender and Box2D differ, attributed to one cause.
#pragma once

#include "metrics/window.hpp"
#include "oracle/exact.hpp"
#include "oracle/judge.hpp"
#include "records/row.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace paperproof::compare {

/// What two sides can differ about in one step.
enum class EventKind : std::uint8_t {
  contact,       ///< Only one reports a contact with this surface.
  side,          ///< Both report the collider, but other surfaces of it.
  time,          ///< Both report the surface, at times that are more than 1e-6 m apart along its normal.
  crossing,      ///< Box2D or the contender passes or enters a solid, or passes a one-way chain backwards.
  stop,          ///< The step takes more than 1e-6 m of what was wanted from one than from the other.
  toggle_ours,   ///< At rest, only the contender changes the sides of its contacts.
  toggle_box2d,  ///< At rest, only Box2D does.
};
[[nodiscard]] std::string_view name_of(EventKind kind) noexcept;

/// Why they differ. Each cause has a predicate. Those marked * are circumstances: something that is so in the step and
/// that the laws do not know; it is asked last, and does not prove that it made the difference.
///
/// A side is *right* about a contact if exact arithmetic has it for the motion of that side, or, for Box2D, if the
/// collider is within its skin. It is right about a stop if its velocity follows its law. Where both are right, they
/// differ because of where they were when the step began, or because of another event of the step, which then gives its
/// cause to both.
///
/// - `skin`: Box2D is within (0, 20 mm] of the collider, and the contender reports all that its own motion meets; or
///   both follow their laws at the same surfaces, and their ways differ by no more than two skins.
/// - `travel_cap`: up to the contact it is more than the 2 m that Box2D travels; *of a stop: the way of the step is.
/// - `event_latency`: exact arithmetic has the contact for Box2D's motion in this step. Box2D reports it in the next
///   one, and is no more than 20 mm away.
/// - `response_law`: both report the same surfaces, and both velocities are what the two laws make of the wanted one,
///   in closed form: see oracle/response_laws.hpp.
/// - `solver_iterations`: Box2D's velocity is what 8 rounds of impulses at two surfaces leave, short of its own law.
/// - `outline`: Box2D cannot have vertices closer than 5 mm. Where the scenery has such, the twin's loops are up to
///   5 mm off: its velocity is what its law makes with the normal that it reports, or with one tilted by as much.
/// - `sampled_time`: Box2D tells no times, so the twin's recorder takes them from where the body was seen. Exact
///   arithmetic refutes this one: at that place the body is out of its skin.
/// - `intent`: in lockstep, from the same start, the two want different motions: a scene's jump rule asks for the
///   contacts of the last step, which the twin does not take over.
/// - `ghost_collision`: Box2D reports, or no law but a push along it explains, a normal along which no face stands out
///   (`StepJudgement::ghosts`).
/// - `float`: the difference, or the gap, is within 4 ulps (float) of the coordinate and of the way.
/// - `start_inside` *: the step begins inside a solid that no error of Box2D led into. The contender takes the shortest
///   way out, Box2D is pushed step by step.
/// - `crush` *: movers left no room, which exact arithmetic verified. The contender stays; Box2D has no word for it.
/// - `company` *: one met another character in this step, or stands within Box2D's skin of one. In Box2D alone
///   characters push each other.
/// - `error_of_box2d`: exact arithmetic refutes Box2D: it passes or enters a solid, or misses a contact thereby, or
///   reports one that is out of its skin and not met.
/// - `error_of_ours`: exact arithmetic refutes the contender: the same, or it loses motion to nothing, or hangs.
///
/// What no cause is found for is one of three:
/// - `remaining_lockstep`: in lockstep, both are right. The twin begins 15 mm aside, and nothing else is known.
/// - `after_divergence`: in a free run, both are right, and an earlier event took them apart.
/// - `unexplained`: everything else.
enum class Cause : std::uint8_t {
  skin,
  travel_cap,
  event_latency,
  response_law,
  solver_iterations,
  outline,
  sampled_time,
  intent,
  ghost_collision,
  float_rounding,
  start_inside,
  crush,
  company,
  error_of_box2d,
  error_of_ours,
  remaining_lockstep,
  after_divergence,
  unexplained,
};
inline constexpr std::size_t cause_count = static_cast<std::size_t>(Cause::unexplained) + 1;
[[nodiscard]] std::string_view name_of(Cause cause) noexcept;

/// One side of a run. The header and the scenery must outlive the ledger.
struct LedgerParty {
  const TraceHeader* header = nullptr;
  const ExactScenery* solids = nullptr;
};

/// Compares a contender with Box2D. Feed both runs' steps in order, then `finish`. Not thread-safe; memory does not
/// grow with the number of steps.
///
/// Events are matched within a step. Two contacts are with the same surface if their normals are within 26 degrees of
/// each other and they are with one collider, or their points lie in one plane to 20 mm: two tiles of a floor are one
/// surface.
///
/// In a free run the first stop or crossing that has a cause takes the two apart, or rounding that adds up. Until they
/// are together again (to 4 ulps) an event about which both are right is `after_divergence`. In lockstep each step
/// stands alone.
class Ledger {
 public:
  Ledger(const LedgerParty& mine, const LedgerParty& reference, bool lockstep);
  /// @param beside_another one of the two is within Box2D's skin of another character.
  void add(const TraceStep& mine, const StepJudgement& mine_judged, const TraceStep& reference,
           const StepJudgement& reference_judged, bool beside_another = false);
  /// The last step has no successor.
  void finish();
  /// Adds what was found to the row.
  void write(Row& row) const;

  using Key = std::pair<Cause, EventKind>;
  /// The words of each first event are what each side says, with the numbers that show the cause.
  [[nodiscard]] const std::map<Key, Disagreements>& sums() const noexcept { return sums_; }

  struct Says {
    TraceStep step;
    StepJudgement judged;
  };
  /// A step of both.
  struct Moment {
    Says mine;
    Says reference;
    int rests_mine = 0;  ///< Steps that it has been at rest for.
    int rests_reference = 0;
    bool beside_another = false;
  };
  using View = detail::Window<Moment>::View;

 private:
  /// What took the two apart since they were last together.
  struct Divergence {
    int step = 0;
    Cause cause = Cause::unexplained;
  };
  void judge(const View& view);

  LedgerParty mine_;
  LedgerParty reference_;
  bool lockstep_;
  bool has_close_vertices_ = false;  ///< Closer than Box2D can have them.
  bool entered_ = false;             ///< Box2D is inside of something that it should not have entered.
  detail::Window<Moment> window_;
  std::optional<Divergence> divergence_;
  int apart_for_ = 0;  ///< Steps since the two were together.
  int rests_mine_ = 0;
  int rests_reference_ = 0;
  std::map<Key, Disagreements> sums_;
};

}  // namespace paperproof::compare
