/// The events of one step, for the ledger.
#pragma once

#include "metrics/ledger.hpp"
#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/met_surfaces.hpp"

#include <limits>
#include <utility>

namespace paperproof::compare::detail {

/// Events that differ by less are the same [m]: what the guarantee allows for a time of impact.
inline constexpr double same_event = 1e-6;
/// Two sides that each keep to Box2D's skin are no further apart than this [m].
inline constexpr double within_skins = 2 * box2d_skin;
/// See `Cause::float_rounding`.
inline constexpr double ulps = 4;
/// Box2D's least distance of two vertices of a chain (b2_linearSlop) [m]. Its twin's outlines are no further off.
inline constexpr double least_edge = 0.005;
/// The way of a step that Box2D travels at most [m].
inline constexpr double longest_way = 2;

/// By a crush that exact arithmetic verified.
[[nodiscard]] inline bool is_crushed(const StepJudgement& judged) {
  return !judged.crushed.empty() || !judged.pressed.empty();
}

[[nodiscard]] inline bool is_inside(const TraceStep& step) { return !step.start_overlap.empty(); }

/// Finds what two sides differ about in one step, and why: see `Ledger`. Lives for one step.
class StepLedger {
 public:
  struct Event {
    EventKind kind = EventKind::contact;
    std::optional<Cause> cause{};
    bool both_right = false;  ///< About their own motion: without a cause it is a leftover, and not unexplained.
    std::string words{};
    /// From Box2D to the surface that the event is about [m]; infinite where it is about none.
    double gap = std::numeric_limits<double>::infinity();
  };
  /// What the ledger knows of the run.
  struct Known {
    bool lockstep = false;
    bool close_vertices = false;  ///< Closer than Box2D can have them.
    bool entered = false;         ///< Box2D is inside of something that it should not have entered.
  };
  StepLedger(const LedgerParty& mine, const LedgerParty& reference, const Ledger::View& view, const Known& known);

  /// To be called once.
  [[nodiscard]] std::vector<Event> events();
  /// How far apart their places, or their wanted ways, are where the step begins [m]; the larger.
  [[nodiscard]] double apart() const noexcept { return apart_; }
  /// What one place or way of Box2D can differ by from the double that it was made of [m].
  [[nodiscard]] double rounding() const noexcept { return rounding_; }

 private:
  void match();
  void add_contacts();
  [[nodiscard]] Event of_reference(const Contact& touch, EventKind kind) const;
  [[nodiscard]] Event of_mine(const Contact& touch) const;
  void add_time();
  void add_crossings();
  void add_toggle();
  void add_stop();
  [[nodiscard]] std::optional<Cause> cause_of_stop(const Vec2d& way_apart, const Vec2d& speed_apart,
                                                   Event& event) const;
  [[nodiscard]] std::optional<Cause> circumstance_of_stop() const;
  void settle();

  [[nodiscard]] bool same_surface(const Contact& a, const Contact& b) const;
  [[nodiscard]] bool is_missed_by_mine(const Contact& touch) const;
  [[nodiscard]] bool is_right_of_mine(const Contact& touch) const;
  [[nodiscard]] bool reports_next(const Contact& touch) const;
  [[nodiscard]] bool is_capped_before(const Contact& touch) const;
  [[nodiscard]] std::optional<Cause> within_skin(double gap) const;
  [[nodiscard]] std::vector<MetSurface> near_reference() const;
  [[nodiscard]] bool is_turned_by_ghost() const;
  [[nodiscard]] double gap_when_reported(const Contact& touch) const;
  [[nodiscard]] Vec2d wanted_of_reference(const Contact& touch) const;
  [[nodiscard]] bool follows_our_law() const;
  /// Whether Box2D's velocity is what its own law makes, and if not, why.
  [[nodiscard]] bool follows_box2ds_law(std::optional<Cause>& otherwise) const;
  [[nodiscard]] std::string named(const Contact& touch) const;

  const LedgerParty& mine_;
  const LedgerParty& reference_;
  Known known_;
  const Ledger::Moment& now_;
  const Ledger::Moment* before_ = nullptr;  ///< The step before, if that is there.
  const Ledger::Moment* after_ = nullptr;
  const TraceStep& m_;
  const TraceStep& r_;
  SolidsInStep mine_solids_;
  SolidsInStep reference_solids_;
  double dt_;  ///< [s]
  double apart_ = 0;
  double rounding_ = 0;
  double taken_ = 0;
  std::vector<std::pair<const Contact*, const Contact*>> both_;
  std::vector<const Contact*> only_mine_;
  std::vector<const Contact*> only_reference_;
  std::vector<Event> events_;
};

}  // namespace paperproof::compare::detail
