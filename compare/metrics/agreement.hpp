/// Two runs of the same scene, step by step: how often they differ about contacts, and who is right. Why they differ,
/// event by event, is in metrics/ledger.hpp.
#pragma once

#include "metrics/window.hpp"
#include "oracle/judge.hpp"
#include "records/row.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// A step on which the two report different sides of contact.
struct SideDisagreement {
  enum class Right : std::uint8_t { mine, reference, both, neither };
  int step = 0;
  TraceStep mine;
  TraceStep reference;
  std::string facts;  ///< What each says, and exact arithmetic of each motion.
  Right right = Right::both;
  std::string who_is_right;  ///< The facts, then `right` in words.
};

/// Positions that are nearer agree [m]: Box2D keeps bodies up to its skin apart by design.
inline constexpr double beyond_box2d_skin = 0.021;

/// Compares a contender with the reference (Box2D). Feed both runs' steps in order. Not thread-safe.
///
/// - `contact_agreement_box2d`: the share of steps with the same set of sides. A side that only one reports is excused
///   where its collider lies in the reference's skin (`dont_care`): Box2D touches from 20 mm away by design. Another
///   side in its place is not excused.
/// - `contact_precision_box2d`: the share of (step, side) of the contender that the reference reports too within one
///   step; `contact_recall_box2d`: the share of (step, side) of the reference that the contender reports too within one
///   step. Excused sides do not count.
/// - `max_position_difference_box2d_m`: largest distance of the two ends of a step [m].
///
/// - `first_difference_box2d_step`: the first step with other sides of contact, or with ends of the step further apart
///   than Box2D's skin (21 mm). Positions differ for a reason that may lie earlier: right is then the side that has not
///   passed or entered a solid so far, where just one has.
///
/// Right is the side that reports, on that step, no side that exact arithmetic does not have for its own motion within
/// one step, and misses none that exact arithmetic has.
class Agreement {
 public:
  /// @param most disagreements that are kept; all are counted.
  Agreement(const TraceHeader& mine, const TraceHeader& reference, std::size_t most = 24);
  void add(const TraceStep& mine, const StepJudgement& mine_judged, const TraceStep& reference,
           const StepJudgement& reference_judged);
  /// Fills the metrics above; leaves everything else alone.
  void write(Row& row) const;

  /// The first ones, in order. Who is right on the last step that was added may still change with the next one.
  [[nodiscard]] const std::vector<SideDisagreement>& disagreements() const noexcept { return disagreements_; }
  /// The first step on which the two differ, in words with who is right; where both are right there, also the first on
  /// which one of them is not.
  [[nodiscard]] std::optional<std::pair<int, std::string>> first_difference() const;
  /// How many there were, by who is right.
  [[nodiscard]] int count(SideDisagreement::Right right) const noexcept {
    return counts_[static_cast<std::size_t>(right)];
  }

 private:
  /// Sets of sides.
  struct Party {
    unsigned reported = 0;
    unsigned exact = 0;
    unsigned excused = 0;  ///< Reported, but only for colliders in its own skin.
  };
  struct Moment {
    Party mine;
    Party reference;
    unsigned excused = 0;  ///< A difference about these sides is none.
  };
  struct Matches {
    int mine = 0;
    int mine_matched = 0;
    int reference = 0;
    int reference_matched = 0;
  };
  /// Positions further apart than the skin.
  struct Apart {
    int step = 0;
    double by = 0;  ///< [m]
    bool mine_inside = false;
    bool reference_inside = false;
  };
  using View = detail::Window<Moment>::View;
  static void match(const View& view, Matches& matches);
  [[nodiscard]] static bool is_right(const View& view, Party Moment::*party);
  [[nodiscard]] static SideDisagreement::Right who(const View& view);
  void settle_last(const View& view);
  void judge_last(SideDisagreement::Right right);
  void note_positions(const TraceStep& mine, const StepJudgement& mine_judged, const TraceStep& reference,
                      const StepJudgement& reference_judged);
  [[nodiscard]] std::string words_about_positions() const;

  std::string mine_name_;
  std::string reference_name_;
  std::size_t most_;
  detail::Window<Moment> window_;
  Matches matches_;
  int steps_ = 0;
  int same_ = 0;
  double farthest_ = 0;
  std::optional<Apart> apart_;
  std::optional<int> mine_broke_;  ///< The first step that passed or entered a solid, while they are not apart.
  std::optional<int> reference_broke_;
  std::optional<int> reference_capped_;
  std::optional<SideDisagreement> first_wrong_;  ///< The first on which not both are right.
  std::array<int, 4> counts_{};
  std::optional<SideDisagreement> last_;  ///< Of the step before, if the two differ there.
  bool last_is_kept_ = false;
  std::vector<SideDisagreement> disagreements_;
};

/// What several characters of one run agree on with their twins, one each: the largest difference of positions, the
/// mean share of steps with the same sides, the first difference of any; of one, everything.
void write_agreement(const std::vector<Agreement>& of_characters, Row& row);

}  // namespace paperproof::compare
