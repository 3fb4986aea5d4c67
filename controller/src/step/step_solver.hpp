/// One step of the octagon sweep.
///
/// A step goes this way (step_solve.hpp):
///   1. step_ride.hpp: a rider adds the motion of its ground to the desired displacement.
///   2. step_start.hpp: a start that overlaps something, or is nearer than it should be, is made free.
///   3. step_sweep.hpp: the octagon is swept to the earliest time of impact. Every obstacle has its own motion; what
///      stands still has none.
///   4. step_response.hpp: the desired motion becomes one that all touched surfaces allow. Back to 3 with what is left.
///   5. step_free_position.hpp, step_crush.hpp: where movers leave no motion at all, the step looks for the nearest
///      free position; where there is none, the movers crush the character.
///   6. step_solve.hpp: does the character stand on ground?
///   7. step_stairs.hpp: is there a stair to climb, or ground to follow a little below?
///
/// The definitions are in headers, and one source includes them all: a function that is called from one place is
/// inlined. What nearly every step does is flattened (an eighth of its instructions), and what hardly any does is kept
/// out of it (3 %, and a fifth of the compile time).
#pragma once

#include "step/free_position.hpp"
#include "step/narrow_phase.hpp"
#include "step/neighbourhood.hpp"
#include "step/octagon_sweep.hpp"
#include "step/one_way.hpp"
#include "step/response.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <optional>
#include <span>

namespace paperproof::octagon_sweep {

/// What a technique knows before the first step.
template <class Scalar>
struct Settings {
  Scalar walkable_cosine;   ///< Least upward component of a normal that is walked on.
  Scalar walkable_tangent;  ///< Steepest walkable slope, as rise over run.
  Scalar snap;              ///< How far down ground is followed [m].
  Scalar step_height;       ///< How high a walker climbs [m].
  Scalar max_fall_speed;    ///< Ground that falls faster leaves its rider behind [m/s]; infinite: none does.
  Scalar look_ahead;        ///< How far ahead of a motion candidates are collected at most [m].
  int iterations;
};

/// What a sweep over all pieces found.
template <class Scalar>
struct SweepResult {
  bool hit = false;
  Scalar stop = 1;              ///< Fraction of the motion that is free.
  Scalar least_separation = 0;  ///< Of all pieces that block, at the start of the motion [m]. Any value above `hit`
                                ///< where all of them are further away than that.
  Scalar least_kept = 0;        ///< By a box direction over the whole motion, of all pieces [m].
  /// The pieces that stop it there. If there are more than fit, the others are reported too, and the next sweep meets
  /// them again.
  FixedVector<Stop<Scalar>, MoveResult<Scalar>::max_contacts> stops;

  void clear() noexcept {
    hit = false;
    stop = 1;
    least_separation = least_kept = std::numeric_limits<Scalar>::infinity();
    stops.clear();
  }
};

/// The displacement that is wanted, and the velocity behind it. Each response changes both alike.
template <class Scalar>
struct DesiredMotion {
  Desired<Scalar> displacement;  ///< For the rest of the step [m].
  Desired<Scalar> velocity;      ///< [m/s]

  /// Without steering.
  [[nodiscard]] static DesiredMotion plain(const Vec2<Scalar>& displacement, const Vec2<Scalar>& velocity) noexcept {
    return {{displacement, displacement}, {velocity, velocity}};
  }
};

/// How far a hull reaches to a side of the character's position [m].
template <class Scalar>
struct FootReach {
  Scalar hull;
  Scalar foot;  ///< Its lowest points.
};

/// What a step knows about its ride and about movers that crush.
template <class Scalar>
struct MoverState {
  Ride<Scalar> ride{};                    ///< What carries the character in this step, with its velocity in this step.
  MoverIndex carrier = no_mover;          ///< The mover of that; none for a conveyor that stands still.
  PieceIndex ridden = 0;                  ///< The piece of that.
  bool anchored = false;                  ///< The character has not moved relative to what carries it.
  bool waits = false;                     ///< See `wait`.
  std::uint8_t ignored = does_not_block;  ///< Colliders with one of these roles do not block.
  std::size_t overlapping = 0;            ///< How many movers overlap the character since an earlier step.
  bool side_lost = false;                 ///< From which side of one of them the character came is not known.
  std::optional<Vec2<Scalar>> last_free{};             ///< The last free position before the step, if there was one.
  std::size_t corners_before_crush = 0;                ///< Of the path, when the first mover crushed; and
  MoveStatus status_before_crush = MoveStatus::moved;  ///< the status until then.
};

/// @tparam Up of the character: `Upright` or `UpFrame`. With one class for both a step of an upright character took 2 %
/// more instructions.
template <std::size_t Lanes, class Scalar, class Up>
class StepSolver {
 public:
  StepSolver(const ConfigurationSpace<Scalar>& space, const Settings<Scalar>& settings,
             Neighbourhood<Scalar> neighbourhood, MoversInStep<Scalar>& movers, const Up& up,
             MoveResult<Scalar>& result) noexcept
      : space_(space),
        pieces_(space.scenery().pieces().data()),
        settings_(settings),
        neighbourhood_(neighbourhood),
        movers_(movers),
        memory_(neighbourhood.memory()),
        up_(up),
        result_(result) {
    memory_.clear();
  }

  void solve(Part part, const StepRequest<Scalar>& request) noexcept;

 private:
  using V = Vec2<Scalar>;
  using LocalMotion = Motion<Lanes, Scalar>;

  // step_sweep.hpp
  /// Sweeps from the present position. Motion and result are in `motion_` and `found_`.
  [[gnu::flatten]] void sweep_along(const V& displacement) noexcept;
  [[gnu::cold, gnu::noinline]] void sweep_again() noexcept;
  [[nodiscard]] bool stops_at_covered() const noexcept;
  template <Covered covered>
  void sweep(const LocalMotion& motion, std::span<const PieceIndex> pieces) noexcept;
  [[nodiscard]] LocalMotion motion_seen_by(MoverIndex mover, Scalar begin) const noexcept {
    return motion_relative_to(movers_.offset(mover, begin), movers_.relative(motion_.displacement, mover, begin));
  }
  [[nodiscard]] LocalMotion motion_relative_to(const V& offset, const V& displacement) const noexcept;
  template <Covered covered>
  void sweep_movers() noexcept;
  void keep_stop(Stop<Scalar> stop, Scalar length) noexcept;
  void order_stops() noexcept;
  [[nodiscard]] bool advance(Scalar stop) noexcept;
  [[gnu::flatten]] void report(Scalar begin) noexcept;
  [[gnu::cold, gnu::noinline]] void report_more(Scalar begin, std::size_t this_moment) noexcept;
  void report_contact(PieceIndex piece, std::size_t axis, Scalar fraction, std::size_t this_moment) noexcept;
  [[gnu::cold, gnu::noinline]] void order_contacts() noexcept;
  void note_reported() noexcept;
  [[gnu::cold, gnu::noinline]] void report_touched(PieceIndex piece) noexcept;
  [[nodiscard]] Scalar fraction_of(const Stop<Scalar>& stop, Scalar begin) noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] Scalar fraction_after_contacts(PieceIndex piece, Scalar turned) noexcept;
  [[nodiscard]] Scalar impact_of(const Stop<Scalar>& stop, const LocalMotion& motion, const V& from) noexcept;
  [[nodiscard, gnu::noinline]] Scalar impact_with_another_piece(const Stop<Scalar>& stop, const LocalMotion& motion,
                                                                const V& from) noexcept;
  [[nodiscard]] std::span<const PieceIndex> pieces_along(const LocalMotion& motion, MoverIndex mover) noexcept;
  [[nodiscard]] ColliderIndex collider_of(PieceIndex piece) const noexcept { return pieces_[piece].collider; }
  [[nodiscard, gnu::cold, gnu::noinline]] bool certified(const V& target, Scalar end) noexcept;
  [[nodiscard]] bool blocks_exactly(PieceIndex piece, const V& target, Scalar end) const noexcept;
  [[gnu::always_inline]] inline void push_corner(Scalar fraction) noexcept;
  /// Offset of the mover of a piece now, at fraction `time_`; zero for a piece that stands still.
  [[nodiscard]] V offset(PieceIndex piece) const noexcept { return offset(piece, time_); }
  [[nodiscard]] V offset(PieceIndex piece, Scalar time) const noexcept;
  /// A position relative to the mover of a piece: the piece itself is stored at offset zero.
  [[nodiscard]] V local(PieceIndex piece, const V& p) const noexcept;
  /// Calls `visit(piece)` for every piece that may be touched from positions in a box, now. `visit` must not query the
  /// pieces of movers.
  template <class Visit>
  void for_each_near(const Box2<Scalar>& box, const Visit& visit) noexcept;
  /// Whether `condition(piece)` holds for one of them.
  template <class Condition>
  [[nodiscard]] bool any_near(const Box2<Scalar>& box, const Condition& condition) noexcept;

  /// Whether a piece can stop a motion at all.
  [[nodiscard]] bool in_way(const LocalMotion& motion, PieceIndex piece) const noexcept {
    return blocks(space_, motion, piece) && !passes_one_way(piece);
  }
  /// A one-way segment in a step that drops through them.
  [[nodiscard]] bool passes_one_way(PieceIndex piece) const noexcept {
    return drops_ && space_.info(piece).one_way_axis != ObstacleInfo::not_one_way;
  }

  // step_start.hpp
  /// Makes a start free that overlaps something, or is nearer than `hit` to it. False: the character is stuck.
  [[nodiscard, gnu::cold, gnu::noinline]] bool prepare_start(Part part, const StepRequest<Scalar>& request) noexcept;
  [[nodiscard]] std::optional<V> find_way_out(const StepRequest<Scalar>& request) noexcept;
  [[nodiscard]] std::optional<V> find_way_out(FreePositionQuery<Scalar> query, Scalar whole) noexcept;
  [[nodiscard]] std::span<PieceIndex> pieces_for(const FreePositionQuery<Scalar>& query, Scalar radius) noexcept;
  template <class Condition>
  [[nodiscard]] std::size_t put_first(std::span<PieceIndex> pieces, const Condition& condition) const noexcept;
  [[nodiscard]] Scalar reach_of_solids_inside() noexcept;
  [[nodiscard]] bool overlaps(const V& position) noexcept;
  [[nodiscard]] bool overlaps(PieceIndex piece, const V& position) const noexcept;
  [[nodiscard, gnu::always_inline]] inline bool may_block(PieceIndex piece, const V& position) const noexcept;
  void restore_gap() noexcept;
  [[nodiscard]] bool exactly_clear(const V& from, const V& to) noexcept;
  [[nodiscard]] bool exactly_clear(PieceIndex piece, const V& from, const V& to, Scalar end) const noexcept;
  void restore_gaps_to_movers() noexcept;

  // step_solve.hpp
  void begin_motion(const StepRequest<Scalar>& request) noexcept;
  [[gnu::cold, gnu::noinline]] void ignore_filtered(const ColliderFilter& filter) noexcept;
  [[nodiscard]] DesiredMotion<Scalar> desired() const noexcept;
  [[gnu::flatten]] void travel() noexcept;
  [[gnu::cold, gnu::noinline]] void end_at_surfaces(DesiredMotion<Scalar>& desired) noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool shift_to_fall(const V& displacement, const V& aside) noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool fall_along_a_side(const V& displacement, const V& velocity,
                                                                 DesiredMotion<Scalar>& desired) noexcept;
  [[nodiscard]] V with_gap_restored(const V& displacement, const Stop<Scalar>& at) const noexcept;
  void halt() noexcept;
  [[gnu::cold, gnu::noinline]] void cut_short() noexcept;
  [[gnu::always_inline]] inline void find_ground() noexcept;
  [[gnu::cold, gnu::noinline]] void look_for_ground() noexcept;
  [[gnu::always_inline]] inline void note_ground(GroundState state, PieceIndex piece, const V& normal) noexcept;
  [[gnu::cold, gnu::noinline]] void note_ground_velocity(PieceIndex piece) noexcept;
  [[gnu::cold, gnu::noinline]] void land(const V& wanted) noexcept;
  [[nodiscard, gnu::always_inline]] inline bool stands_on(PieceIndex piece) const noexcept;
  [[nodiscard, gnu::always_inline]] inline bool leaves(PieceIndex piece, const V& normal) const noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] Scalar falls_away_from_tangent(PieceIndex piece, V motion) const noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool touches_ground() noexcept;
  /// The normal of a piece, if the character touches it now and it is walkable ground.
  [[nodiscard, gnu::always_inline]] inline std::optional<V> touched_ground(PieceIndex piece) const noexcept;
  [[gnu::cold, gnu::noinline]] void stop_at_touched_ground() noexcept;
  [[nodiscard]] bool walkable(const V& normal) const noexcept { return up_.up_of(normal) >= settings_.walkable_cosine; }

  // step_stairs.hpp
  [[nodiscard, gnu::cold, gnu::noinline]] FootReach<Scalar> foot_reach(Scalar side) const noexcept;
  [[nodiscard]] bool go_along(const V& displacement) noexcept;
  [[nodiscard]] std::optional<TouchedSurface<Scalar>> ground_below(Scalar side, Scalar down, Scalar lean) noexcept;
  bool step_down_to(const TouchedSurface<Scalar>& ground, Scalar speed) noexcept;
  [[nodiscard]] bool climb_by(Scalar rise, Scalar sideways, Scalar speed) noexcept;
  [[gnu::cold, gnu::noinline]] void climb_stairs(const StepRequest<Scalar>& request, const V& wanted,
                                                 Scalar speed) noexcept;
  [[gnu::cold, gnu::noinline]] void follow_ground_down(const StepRequest<Scalar>& request) noexcept;
  [[nodiscard]] bool hardly_leaves(const TouchedSurface<Scalar>& ground) const noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] Scalar falls_away_below_rider() const noexcept;

  // step_ride.hpp
  [[nodiscard]] MoverIndex mover_of(PieceIndex piece) const noexcept { return pieces_[piece].mover; }
  /// The mover that takes along what stands on a piece, if one does.
  [[nodiscard]] MoverIndex carrier_of(PieceIndex piece) const noexcept;
  [[nodiscard]] bool carries(PieceIndex piece) const noexcept;
  [[nodiscard]] Scalar surface_speed(PieceIndex piece) const noexcept;
  [[nodiscard]] V ground_velocity(PieceIndex piece, const V& normal) const noexcept;
  [[nodiscard]] V carried_velocity(PieceIndex piece, const V& normal) const noexcept;
  [[nodiscard]] V velocity_with(MoverIndex mover, PieceIndex piece, const V& normal) const noexcept;
  [[nodiscard]] V ground_rest(PieceIndex piece, const V& normal) const noexcept;
  [[nodiscard]] std::optional<TouchedSurface<Scalar>> carrier_here(ColliderIndex ridden, bool walkable_only) noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] V begin_ride(const StepRequest<Scalar>& request) noexcept;
  /// Ground that falls faster than the character may.
  [[nodiscard]] bool falls_away(const V& ground) const noexcept {
    return up_.up_of(ground) < -settings_.max_fall_speed;
  }
  [[nodiscard, gnu::cold, gnu::noinline]] bool carries_from_now(const TouchedSurface<Scalar>& ground) const noexcept;
  [[gnu::cold, gnu::noinline]] void begin_to_ride(const TouchedSurface<Scalar>& ground) noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] V anchor(Scalar time) const noexcept;
  [[gnu::cold, gnu::noinline]] void note_motion_on_ground() noexcept;
  [[gnu::cold, gnu::noinline]] void end_ride() noexcept;

  // step_response.hpp
  [[nodiscard]] bool ignored(PieceIndex piece) const noexcept;
  [[nodiscard]] bool slides_along_touched(const LocalMotion& motion, PieceIndex piece) const noexcept;
  [[nodiscard]] TouchedSurface<Scalar> surface_at(PieceIndex piece, std::size_t axis) const noexcept {
    return {piece, mover_of(piece), axis, space_.normal(piece, axis), space_.offset(piece, axis)};
  }
  void update_surfaces() noexcept;
  [[nodiscard]] V remaining_of(const TouchedSurface<Scalar>& surface) const noexcept;
  [[nodiscard]] V velocity_of(const TouchedSurface<Scalar>& surface) const noexcept;
  [[nodiscard]] bool allowed(const DesiredMotion<Scalar>& desired,
                             const TouchedSurface<Scalar>& surface) const noexcept;
  [[nodiscard]] bool allowed(const DesiredMotion<Scalar>& desired) const noexcept;
  [[nodiscard]] DesiredMotion<Scalar> response_to(const TouchedSurface<Scalar>& surface,
                                                  const DesiredMotion<Scalar>& desired, bool after_walk) const noexcept;
  [[gnu::always_inline]] inline void respond_to_surface(const V& normal, DesiredMotion<Scalar>& desired) const noexcept;
  [[nodiscard, gnu::noinline]] bool respond_to_all(DesiredMotion<Scalar>& desired) noexcept;
  [[gnu::cold, gnu::noinline]] void fall_between(DesiredMotion<Scalar>& desired) const noexcept;
  [[nodiscard]] bool respond_one_by_one(DesiredMotion<Scalar>& desired) const noexcept;
  [[nodiscard]] bool respond_in_crease(DesiredMotion<Scalar>& desired) noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool ends_fall_in_wedge(const DesiredMotion<Scalar>& desired) const noexcept;
  [[nodiscard]] bool respond_together(DesiredMotion<Scalar>& desired) const noexcept;
  [[nodiscard]] std::optional<DesiredMotion<Scalar>> nearest_allowed_to(const V& displacement,
                                                                        const V& velocity) const noexcept;
  [[nodiscard]] bool respond_to_surfaces(DesiredMotion<Scalar>& desired) noexcept;
  [[gnu::cold, gnu::noinline]] void last_resort(const V& displacement) noexcept;

  // step_free_position.hpp
  /// A free position, and the corner of the path from which it is reached.
  struct FreePosition {
    Scalar distance;  ///< From where the character is [m].
    V position;
    std::size_t corner;
  };
  /// Corners of the path.
  struct Corners {
    std::size_t first;
    std::size_t end;  ///< One past the last.
  };
  [[nodiscard]] bool find_free_position(Scalar reach, Corners corners) noexcept;
  [[nodiscard]] std::optional<FreePosition> nearest_free_position(Scalar gap, Scalar reach, Corners corners) noexcept;
  [[nodiscard]] FreePositionQuery<Scalar> query_from(std::size_t corner, Scalar gap) const noexcept;
  void search_from(std::size_t corner, Scalar gap, FreePosition& room) noexcept;
  void extend_until_contact(FreePosition& room) noexcept;
  [[nodiscard]] bool may_pass(PieceIndex piece, std::size_t corner) const noexcept;
  void note_colliders_left() noexcept;
  void go_to(const V& end) noexcept;
  void report_free_position(std::size_t corner) noexcept;
  [[nodiscard]] std::optional<Nearest<Scalar>> next_near(std::size_t corner, const PathPoint<Scalar>& to,
                                                         const std::optional<Nearest<Scalar>>& last) noexcept;
  [[nodiscard]] bool is_contact(const Nearest<Scalar>& near) const noexcept;
  [[nodiscard]] Nearest<Scalar> nearest_on_way(PieceIndex piece, const V& from, const V& to) const noexcept;
  void go_back_to(std::size_t corner) noexcept;

  // step_crush.hpp
  [[nodiscard]] bool is_passed_through() const noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool goes_to_free_position() noexcept;
  [[nodiscard]] bool circle_flings(const V& wanted, const V& allowed) const noexcept;
  [[nodiscard, gnu::noinline]] bool limit_squeeze(const DesiredMotion<Scalar>& wanted,
                                                  DesiredMotion<Scalar>& allowed) const noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool goes_beside_circle(const V& allowed) noexcept;
  [[gnu::cold, gnu::noinline]] void undo_crushes() noexcept;
  [[nodiscard]] bool moves_in(const TouchedSurface<Scalar>& surface) const noexcept;
  [[gnu::cold, gnu::noinline]] bool note_crushers() noexcept;
  void crush(PieceIndex piece, Scalar since) noexcept;
  bool ignore_overlapping_movers(const StepRequest<Scalar>& request) noexcept;
  [[nodiscard]] bool leaves_overlapping_movers(const StepRequest<Scalar>& request) noexcept;
  [[nodiscard]] V displacement_of(ColliderIndex collider) const noexcept;
  void remember(const Crusher<Scalar>& now) noexcept;
  void hand_on_crushers() noexcept;
  [[gnu::cold, gnu::noinline]] void find_movers_that_still_overlap() noexcept;
  [[gnu::cold, gnu::noinline]] void wait(bool may_move) noexcept;
  [[gnu::cold, gnu::noinline]] void stay_in_place(const StepRequest<Scalar>& request) noexcept;

  const ConfigurationSpace<Scalar>& space_;
  const PieceInfo* pieces_;
  const Settings<Scalar>& settings_;
  Neighbourhood<Scalar> neighbourhood_;
  MoversInStep<Scalar>& movers_;
  StepMemory<Scalar>& memory_;
  [[no_unique_address]] Up up_;
  MoveResult<Scalar>& result_;

  LocalMotion motion_;         ///< Of the last sweep,
  SweepResult<Scalar> found_;  ///< and what it met.
  V start_{V::Zero()};   ///< Where the step began, or the way out of a solid ended, before gaps were restored. Times of
                         ///< impact count from there.
  V wanted_{V::Zero()};  ///< Displacement in the step, that of the ground included, before anything was met [m].
  V position_{V::Zero()};
  V velocity_{V::Zero()};
  Scalar time_ = 0;           ///< Fraction of the step that is spent.
  Scalar dt_ = 0;             ///< Of the step [s].
  Scalar latest_impact_ = 0;  ///< See `Reported`.
  Scalar fall_ = 0;     ///< Velocity upwards without steering, before the surfaces that are touched now were met [m/s].
  Scalar steered_ = 0;  ///< The part of the horizontal velocity that this step's steering added [m/s].
  Scalar leaves_ground_above_ = 0;  ///< See `StepRequest`.
  bool drops_ = false;              ///< One-way segments do not block in this step.
  bool certify_ = false;            ///< Something is nearer than rounding: every motion needs an exact certificate.
  bool climbs_ = false;             ///< The step began on ground, with no more upward speed than climbing gives.
  bool after_walk_ = false;         ///< See `Surface`.
  bool wedged_ = false;             ///< A fall ended between surfaces that are touched together.
  bool met_ground_ = false;         ///< Walkable ground was hit in this step,
  bool on_ground_ = false;          ///< and the character has not moved since, nor hit anything else.
  PieceIndex ground_ = 0;  ///< That ground, where `met_ground_`; the surface that points up most, where `wedged_`;
  std::size_t ground_axis_ = 0;  ///< and the axis of its normal.
  MoverState<Scalar> moving_;
};

}  // namespace paperproof::octagon_sweep
