/// The working state of one step of the octagon sweep.
#pragma once

#include "techniques/octagon_sweep/configuration_space.hpp"
#include "techniques/octagon_sweep/narrow_phase.hpp"

#include <paperproof/technique.hpp>
#include <paperproof/tolerances.hpp>

#include <optional>
#include <span>

namespace paperproof::octagon_sweep {

/// What a technique knows before the first step.
template <class Scalar>
struct Settings {
  Scalar walkable_cosine;   ///< Least upward component of a normal that is walked on.
  Scalar walkable_tangent;  ///< Steepest walkable slope, as rise over run.
  Scalar snap;              ///< How far down ground is followed [m].
  Scalar look_ahead;        ///< How far ahead of a motion candidates are collected at most [m].
  int iterations;
};

/// Which pieces the solver may have to look at. Superset of what meets a box; kept between steps.
template <class Scalar>
class Neighbourhood {
 public:
  Neighbourhood(const ConfigurationSpace<Scalar>& space, const BroadPhase<Scalar>& broad_phase, Scalar look_ahead,
                Scratch<Scalar>& scratch) noexcept
      : space_(space), broad_phase_(broad_phase), look_ahead_(look_ahead), scratch_(scratch) {}

  /// Every piece that the octagon can touch while its reference point is in `box`, and perhaps more; ascending.
  /// @param way where it is going [m]: what is there will be wanted next.
  [[nodiscard]] std::span<const PieceIndex> around(const Box2<Scalar>& box,
                                                   const Vec2<Scalar>& way = Vec2<Scalar>::Zero()) noexcept;

  /// What comes next does not depend on what was collected before, not even in how much more it is.
  void forget() noexcept { scratch_.valid = false; }

 private:
  const ConfigurationSpace<Scalar>& space_;
  const BroadPhase<Scalar>& broad_phase_;
  Scalar look_ahead_;
  Scratch<Scalar>& scratch_;
};

/// A piece that stops a motion.
template <class Scalar>
struct Stop {
  PieceIndex piece;
  Scalar stop;  ///< Fraction of the motion.
  EntryAxes axes;
};

/// What a sweep over all pieces found.
template <class Scalar>
struct SweepResult {
  bool hit = false;
  Scalar stop = 1;              ///< Fraction of the motion that is free.
  Scalar least_separation = 0;  ///< Of all pieces that block, at the start of the motion [m].
  FixedVector<Stop<Scalar>, MoveResult<Scalar>::max_contacts> stops;  ///< All that stop it there; the first decides.

  void clear() noexcept {
    hit = false;
    stop = 1;
    least_separation = std::numeric_limits<Scalar>::infinity();
    stops.clear();
  }
};

template <std::size_t Lanes, class Scalar>
class StepSolver {
 public:
  StepSolver(const ConfigurationSpace<Scalar>& space, const Settings<Scalar>& settings,
             Neighbourhood<Scalar> neighbourhood, MoveResult<Scalar>& result) noexcept
      : space_(space), settings_(settings), neighbourhood_(neighbourhood), result_(result) {}

  void solve(const MoveRequest<Scalar>& request) noexcept;

 private:
  using V = Vec2<Scalar>;

  /// Sweeps from the present position, and keeps motion and result.
  void look_along(const V& way) noexcept;
  void keep(const Stop<Scalar>& stop) noexcept;
  void order_stops() noexcept;

  /// Makes room around a start that is nearer than `hit` to something, or inside it. False: stuck.
  [[nodiscard]] bool prepare_start(const MoveRequest<Scalar>& request) noexcept;
  [[nodiscard]] std::optional<V> find_way_out(const MoveRequest<Scalar>& request) noexcept;
  [[nodiscard]] Scalar reach_of_solids_inside() noexcept;
  [[nodiscard]] bool overlaps(const V& position) noexcept;
  [[nodiscard]] bool overlaps(PieceIndex piece, const V& position) const noexcept;
  void restore_gap() noexcept;
  [[nodiscard]] bool clear_way(const V& from, const V& to) noexcept;

  void travel() noexcept;
  [[nodiscard]] bool advance(Scalar stop) noexcept;
  void report(Scalar begin) noexcept;
  [[nodiscard]] Scalar impact_of(const Stop<Scalar>& stop, const V& from) noexcept;
  [[nodiscard]] V aimed_back(const V& way, const Stop<Scalar>& at) const noexcept;
  void halt() noexcept;

  [[nodiscard]] bool stands() noexcept;
  [[nodiscard]] bool stands_on(PieceIndex piece) const noexcept;
  void follow_ground_down(Scalar travelled_sideways) noexcept;
  void push_corner(Scalar fraction) noexcept;
  [[nodiscard]] bool walkable(const V& normal) const noexcept { return normal.y() >= settings_.walkable_cosine; }

  const ConfigurationSpace<Scalar>& space_;
  const Settings<Scalar>& settings_;
  Neighbourhood<Scalar> neighbourhood_;
  MoveResult<Scalar>& result_;

  Motion<Lanes, Scalar> motion_;  ///< Of the last sweep,
  SweepResult<Scalar> found_;     ///< and what it met.
  V start_{V::Zero()};        ///< Where the step began, before its gaps were restored: impacts count from there.
  V position_{V::Zero()};
  V velocity_{V::Zero()};
  Scalar time_ = 0;       ///< Fraction of the step that is spent.
  bool certify_ = false;  ///< Something is nearer than rounding: every motion needs an exact certificate.
  bool ended_in_crease_ = false;
  bool met_ground_ = false;  ///< Something walkable was in the way during this step,
  bool on_ground_ = false;   ///< and nothing has moved since.
  PieceIndex ground_ = 0;    ///< What that was, where `met_ground_`.
};

}  // namespace paperproof::octagon_sweep
