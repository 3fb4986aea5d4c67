/// The working state of one step of the octagon sweep.
///
/// The definitions are in step_sweep.hpp, step_start.hpp, step_travel.hpp and, where something moves, step_ride.hpp,
/// step_among_movers.hpp, step_room.hpp and step_crush.hpp: each instance is compiled as a whole, so that what is
/// called from one place is inlined.
///
/// There are many instances, and g++ stops inlining where a unit grows: hence what nearly every step does is flattened
/// (an eighth of its instructions), and what hardly any does is kept out of it (3 %, and a fifth of the compile time).
#pragma once

#include "step/free_position.hpp"
#include "step/narrow_phase.hpp"
#include "step/neighbourhood.hpp"
#include "step/octagon_sweep.hpp"
#include "step/one_way.hpp"
#include "step/response.hpp"

#include <paperproof/technique.hpp>
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
  Scalar max_fall_speed;    ///< Ground that falls faster leaves its rider behind [m/s]; infinite: none does.
  Scalar look_ahead;        ///< How far ahead of a motion candidates are collected at most [m].
  int iterations;
};

/// What a sweep over all pieces found.
template <class Scalar>
struct SweepResult {
  bool hit = false;
  Scalar stop = 1;              ///< Fraction of the motion that is free.
  Scalar least_separation = 0;  ///< Of all pieces that block, at the start of the motion [m]; any value above `hit`
                                ///< where all are further away than that.
  /// What stops it there; the first decides. Of more than mostly come at one moment the rest is only reported: the next
  /// sweep meets it again.
  FixedVector<Stop<Scalar>, MoveResult<Scalar>::max_contacts> stops;

  void clear() noexcept {
    hit = false;
    stop = 1;
    least_separation = std::numeric_limits<Scalar>::infinity();
    stops.clear();
  }
};

/// A motion of the character, and the velocity behind it. What happens to one happens to the other.
template <class Scalar>
struct Drive {
  Wish<Scalar> way;       ///< For the rest of the step [m].
  Wish<Scalar> velocity;  ///< [m/s]

  /// A motion that is not steered.
  [[nodiscard]] static Drive plain(const Vec2<Scalar>& way, const Vec2<Scalar>& velocity) noexcept {
    return {{way, way}, {velocity, velocity}};
  }
};

/// What the solver knows about what moves.
template <class Scalar>
struct MoverState {
  Ride<Scalar> ride{};                  ///< What carries the character in this step; `velocity` is that of this step.
  MoverIndex carrier = no_mover;        ///< Its mover; none for a conveyor that stands still.
  bool anchored = false;                ///< The character has not moved on what carries it.
  bool looks_past_holds = false;        ///< See `stay`.
  std::uint8_t ignored = goes_through;  ///< Colliders of these roles are not in the way.
  std::size_t on_it = 0;                ///< How many lie on the character since an earlier step.
  bool side_lost = false;               ///< One of them is not known to have come from any side.
  bool leaves_any = false;              ///< The step began inside something.
  std::optional<Vec2<Scalar>> last_free{};             ///< Where the character was before, if anywhere.
  std::size_t corners_before_crush = 0;                ///< Of the path, where something crushes; and
  MoveStatus status_before_crush = MoveStatus::moved;  ///< how the step went until then.
};

template <std::size_t Lanes, class Scalar>
class StepSolver {
 public:
  StepSolver(const ConfigurationSpace<Scalar>& space, const Settings<Scalar>& settings,
             Neighbourhood<Scalar> neighbourhood, Surroundings<Scalar>& surroundings,
             MoveResult<Scalar>& result) noexcept
      : space_(space),
        pieces_(space.scenery().pieces().data()),
        settings_(settings),
        neighbourhood_(neighbourhood),
        around_(surroundings),
        memory_(neighbourhood.memory()),
        result_(result) {
    memory_.clear();
  }

  void solve(Part part, const MoveRequest<Scalar>& request) noexcept;

 private:
  using V = Vec2<Scalar>;
  using LocalMotion = Motion<Lanes, Scalar>;

  // step_sweep.hpp
  /// Sweeps from the present position, and keeps motion and result.
  [[gnu::flatten]] void look_along(const V& way) noexcept;
  [[gnu::cold, gnu::noinline]] void look_again() noexcept;
  [[nodiscard]] bool stops_at_covered() const noexcept;
  template <Covered covered>
  void sweep(const LocalMotion& motion, std::span<const PieceIndex> pieces) noexcept;
  void keep(Stop<Scalar> stop, Scalar length) noexcept;
  void order_stops() noexcept;
  [[nodiscard]] bool advance(Scalar stop) noexcept;
  [[gnu::flatten]] void report(Scalar begin) noexcept;
  [[gnu::cold, gnu::noinline]] void report_more(Scalar begin, std::size_t this_moment) noexcept;
  void report_contact(PieceIndex piece, std::size_t axis, Scalar fraction, std::size_t this_moment) noexcept;
  [[gnu::cold, gnu::noinline]] void report_touched(PieceIndex piece) noexcept;
  [[nodiscard]] Scalar fraction_of(const Stop<Scalar>& stop, Scalar begin) noexcept;
  [[nodiscard]] Scalar impact_of(const Stop<Scalar>& stop, const LocalMotion& motion, const V& from) noexcept;
  [[nodiscard, gnu::noinline]] Scalar impact_with_another_piece(const Stop<Scalar>& stop, const LocalMotion& motion,
                                                                const V& from) noexcept;
  [[nodiscard]] std::span<const PieceIndex> pieces_along(const LocalMotion& motion, MoverIndex mover) noexcept;
  [[nodiscard]] ColliderIndex collider_of(PieceIndex piece) const noexcept { return pieces_[piece].collider; }
  [[nodiscard, gnu::cold, gnu::noinline]] bool certified(const V& target, Scalar end) noexcept;
  [[nodiscard]] bool bars(PieceIndex piece, const V& target, Scalar end) const noexcept;
  [[gnu::always_inline]] inline void push_corner(Scalar fraction) noexcept;
  /// Where the mover of a piece is now, at fraction `time_`; zero where nothing moves.
  [[nodiscard]] V offset(PieceIndex piece) const noexcept { return offset(piece, time_); }
  [[nodiscard]] V offset(PieceIndex piece, Scalar time) const noexcept;
  /// A position as a piece sees it that is still at offset zero.
  [[nodiscard]] V local(PieceIndex piece, const V& p) const noexcept;
  /// Calls `visit(piece)` for everything near a box, where it is now.
  template <class Visit>
  void for_each_near(const Box2<Scalar>& box, const Visit& visit) noexcept;

  /// Whether a piece can stop a motion at all.
  [[nodiscard]] bool in_way(const LocalMotion& motion, PieceIndex piece) const noexcept {
    return blocks(space_, motion, piece) && !dropped(piece);
  }
  /// A one-way segment in a step that drops through them.
  [[nodiscard]] bool dropped(PieceIndex piece) const noexcept {
    return drops_ && space_.info(piece).one_way_axis != ObstacleInfo::not_one_way;
  }

  // step_start.hpp
  /// Makes room around a start that is nearer than `hit` to something, or inside it. False: stuck.
  [[nodiscard, gnu::cold, gnu::noinline]] bool prepare_start(Part part, const MoveRequest<Scalar>& request) noexcept;
  [[nodiscard]] std::optional<V> find_way_out(const MoveRequest<Scalar>& request) noexcept;
  [[nodiscard]] std::optional<V> find_way_out(FreePositionQuery<Scalar> query, Scalar whole) noexcept;
  [[nodiscard]] std::span<PieceIndex> pieces_for(const FreePositionQuery<Scalar>& query, Scalar radius) noexcept;
  template <class Condition>
  [[nodiscard]] std::size_t put_first(std::span<PieceIndex> pieces, const Condition& condition) const noexcept;
  [[nodiscard]] Scalar reach_of_solids_inside() noexcept;
  [[nodiscard]] bool overlaps(const V& position) noexcept;
  [[nodiscard]] bool overlaps(PieceIndex piece, const V& position) const noexcept;
  [[nodiscard, gnu::always_inline]] inline bool may_block(PieceIndex piece, const V& position) const noexcept;
  void restore_gap() noexcept;
  [[nodiscard]] bool clear_way(const V& from, const V& to) noexcept;
  [[nodiscard]] bool clear_way(PieceIndex piece, const V& from, const V& to, Scalar end) const noexcept;
  void restore_gaps_to_movers() noexcept;
  [[nodiscard]] bool keeps_gaps(const V& q) noexcept;

  // step_travel.hpp
  void begin_drive(const MoveRequest<Scalar>& request) noexcept;
  [[nodiscard]] Drive<Scalar> drive() const noexcept;
  [[gnu::flatten]] void travel() noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool falls_between(const V& way) noexcept;
  [[nodiscard]] V aimed_back(const V& way, const Stop<Scalar>& at) const noexcept;
  void halt() noexcept;
  [[gnu::cold, gnu::noinline]] void cut_short() noexcept;
  [[nodiscard]] bool stands() noexcept;
  [[nodiscard]] bool stands_on_any() noexcept;
  [[gnu::cold, gnu::noinline]] void report_ground(const V& wanted) noexcept;
  [[nodiscard]] bool stands_on(PieceIndex piece) const noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool touches_ground() noexcept;
  /// The normal of a piece where it is touched now and is walkable ground.
  [[nodiscard, gnu::always_inline]] inline std::optional<V> touched_ground(PieceIndex piece) const noexcept;
  [[gnu::cold, gnu::noinline]] void keep_ground() noexcept;
  [[gnu::noinline]] void follow_ground_down(const MoveRequest<Scalar>& request) noexcept;
  [[nodiscard]] bool walkable(const V& normal) const noexcept { return normal.y() >= settings_.walkable_cosine; }

  // step_ride.hpp
  [[nodiscard]] MoverIndex mover_of(PieceIndex piece) const noexcept { return pieces_[piece].mover; }
  [[nodiscard]] bool carries(PieceIndex piece) const noexcept;
  [[nodiscard]] Scalar surface_speed(PieceIndex piece) const noexcept;
  [[nodiscard]] V ground_velocity(PieceIndex piece, const V& normal) const noexcept;
  [[nodiscard]] V ground_rest(PieceIndex piece, const V& normal) const noexcept;
  [[nodiscard]] std::optional<Hold<Scalar>> ground_here(ColliderIndex ridden, bool walkable_only) noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] V begin_ride(const MoveRequest<Scalar>& request) noexcept;
  /// Ground that falls faster than the character may.
  [[nodiscard]] bool falls_away(const V& ground) const noexcept { return ground.y() < -settings_.max_fall_speed; }
  [[nodiscard, gnu::cold, gnu::noinline]] bool takes_along(const Hold<Scalar>& ground) const noexcept;
  [[gnu::cold, gnu::noinline]] void mount(const Hold<Scalar>& ground) noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] V anchor(Scalar time) const noexcept;
  [[gnu::cold, gnu::noinline]] void note_motion_on_ground() noexcept;
  [[gnu::cold, gnu::noinline]] void end_ride() noexcept;

  // step_among_movers.hpp
  template <Covered covered>
  void look_at_movers() noexcept;
  [[nodiscard]] bool ignored(PieceIndex piece) const noexcept;
  [[nodiscard]] bool kept_clear_by_hold(const LocalMotion& motion, PieceIndex piece) const noexcept;
  void update_holds() noexcept;
  [[nodiscard]] V rest_of(const Hold<Scalar>& hold) const noexcept;
  [[nodiscard]] V velocity_of(const Hold<Scalar>& hold) const noexcept;
  [[nodiscard]] bool allowed(const Drive<Scalar>& drive, const Hold<Scalar>& hold) const noexcept;
  [[nodiscard]] bool allowed(const Drive<Scalar>& drive) const noexcept;
  [[nodiscard]] Drive<Scalar> response_to(const Hold<Scalar>& hold, const Drive<Scalar>& drive,
                                          bool after_walk) const noexcept;
  [[nodiscard, gnu::always_inline]] inline bool respond_to_surface(const V& normal,
                                                                   Drive<Scalar>& drive) const noexcept;
  [[nodiscard, gnu::noinline]] bool respond_to_all(Drive<Scalar>& drive) noexcept;
  [[nodiscard]] bool respond_one_by_one(Drive<Scalar>& drive) const noexcept;
  [[nodiscard]] bool respond_in_crease(Drive<Scalar>& drive) noexcept;
  [[nodiscard]] bool respond_together(Drive<Scalar>& drive) const noexcept;
  [[nodiscard]] std::optional<Drive<Scalar>> nearest_allowed_to(const V& way, const V& velocity) const noexcept;
  [[nodiscard]] bool respond_to_holds(Drive<Scalar>& drive) noexcept;
  [[gnu::cold, gnu::noinline]] void last_resort(const V& way) noexcept;

  // step_room.hpp
  /// A position where there is room, and the corner of the path to reach it from.
  struct Room {
    Scalar distance;  ///< From where the character is [m].
    V position;
    std::size_t corner;
  };
  [[nodiscard]] bool find_room(Scalar reach, std::size_t corners) noexcept;
  [[nodiscard]] Room nearest_room(Scalar gap, Scalar reach, std::size_t corners) noexcept;
  [[nodiscard]] FreePositionQuery<Scalar> query_for_room(std::size_t corner, Scalar gap) const noexcept;
  void find_room_from(std::size_t corner, Scalar gap, Room& room) noexcept;
  void go_on_until_bounded(Room& room) noexcept;
  [[nodiscard]] bool may_pass(PieceIndex piece, std::size_t corner) const noexcept;
  [[nodiscard]] bool is_proved(std::size_t corner, const V& target, Scalar end) noexcept;
  void note_what_is_left() noexcept;
  void go_to(const V& end) noexcept;
  void report_room(std::size_t corner) noexcept;
  void add_near_pieces(std::size_t corner, const PathPoint<Scalar>& to) noexcept;
  [[nodiscard]] Nearest<Scalar> nearest_on_way(PieceIndex piece, const V& from, const V& to) const noexcept;
  void go_back_to(std::size_t corner) noexcept;

  // step_crush.hpp
  [[nodiscard]] bool pinned() const noexcept;
  [[nodiscard, gnu::cold, gnu::noinline]] bool gives_way() noexcept;
  [[gnu::cold, gnu::noinline]] void take_back_crushes() noexcept;
  [[nodiscard]] bool presses(const Hold<Scalar>& hold) const noexcept;
  [[gnu::cold, gnu::noinline]] bool crush_what_presses() noexcept;
  void crush(PieceIndex piece) noexcept;
  void name_as_crushing(ColliderIndex collider) noexcept;
  template <class Condition>
  bool let_through(const Condition& condition) noexcept;
  bool let_through_what_is_on_it(const MoveRequest<Scalar>& request) noexcept;
  [[nodiscard]] bool leaves_what_is_on_it(const MoveRequest<Scalar>& request) noexcept;
  [[nodiscard]] MoverIndex mover_of_collider(ColliderIndex collider) const noexcept {
    return space_.scenery().collider(collider).mover;
  }
  [[nodiscard]] V course_of(ColliderIndex collider) const noexcept;
  void remember(const Crusher<Scalar>& now) noexcept;
  void hand_on_crushers() noexcept;
  [[gnu::cold, gnu::noinline]] void end_wait() noexcept;
  [[gnu::cold, gnu::noinline]] void stay(bool may_give_way) noexcept;
  void crush_what_came_in(Scalar since) noexcept;
  [[gnu::cold, gnu::noinline]] void keep_place(const MoveRequest<Scalar>& request) noexcept;

  const ConfigurationSpace<Scalar>& space_;
  const PieceInfo* pieces_;
  const Settings<Scalar>& settings_;
  Neighbourhood<Scalar> neighbourhood_;
  Surroundings<Scalar>& around_;
  StepMemory<Scalar>& memory_;
  MoveResult<Scalar>& result_;

  LocalMotion motion_;         ///< Of the last sweep,
  SweepResult<Scalar> found_;  ///< and what it met.
  V start_{V::Zero()};         ///< Where the step began, before its gaps were restored: impacts count from there.
  V position_{V::Zero()};
  V velocity_{V::Zero()};
  Scalar time_ = 0;          ///< Fraction of the step that is spent.
  Scalar dt_ = 0;            ///< Of the step [s].
  Scalar fall_ = 0;          ///< Vertical velocity without steering, before what is touched now was met [m/s].
  Scalar steered_ = 0;       ///< The part of the horizontal velocity that this step's steering added [m/s].
  bool drops_ = false;       ///< One-way segments hold nobody in this step.
  bool certify_ = false;     ///< Something is nearer than rounding: every motion needs an exact certificate.
  bool climbs_ = false;      ///< It began on the ground, and no faster upwards than ground can be climbed.
  bool after_walk_ = false;  ///< See `Surface`.
  bool wedged_ = false;      ///< A fall ended between the surfaces that were touched together.
  bool met_ground_ = false;  ///< Something walkable was in the way during this step,
  bool on_ground_ = false;   ///< and neither has anything moved since nor was anything else in the way.
  PieceIndex ground_ = 0;    ///< What that was, where `met_ground_`.
  MoverState<Scalar> moving_;
};

}  // namespace paperproof::octagon_sweep
