/// The working state of one step of a crowd.
///
/// Each character is moved by the same technique as if it were alone; those it gives way to are obstacles for it, which
/// go their own ways: the scenery of a crowd has places for a few colliders of the character's shape, each with a mover
/// of its own. Thus falling between others, being carried, pushed and crushed follow the laws that hold among movers.
///
/// The definitions are in stepper_ways.hpp, stepper_impacts.hpp and stepper.cpp.
#pragma once

#include "crowd/rules.hpp"
#include "crowd/timetable.hpp"
#include "step/octagon_sweep.hpp"

#include <paperproof/crowd.hpp>

#include <optional>
#include <span>
#include <vector>

namespace paperproof::crowd {

/// A character can give way to so many others in one step. If it meets more it stays where it is.
inline constexpr std::size_t most_company = 12;

using Company = FixedVector<CharacterIndex, most_company>;

/// The scenery of a crowd: that of the scene, and places for other characters.
template <class Scalar>
struct Surrounded {
  Surrounded(const Scenery<Scalar>& scene, const CharacterShape& shape);

  Scenery<Scalar> scenery;
  ColliderIndex first_companion;  ///< The collider of the first place.
};

/// A moment of a step, with what one part of a way hands to the next.
template <class Scalar>
struct Moment {
  Scalar time = 0;               ///< Fraction of the step.
  CharacterState<Scalar> state;  ///< Its velocity is not kept up.
  Vec2<Scalar> own;              ///< Velocity relative to what carries it [m/s].
  Scalar steered = 0;            ///< The part of `own.x()` that this step's steering added [m/s].
};

/// One character during a step: what it has done, and what it is about to do.
template <class Scalar>
struct Walker {
  Moment<Scalar> start;
  Moment<Scalar> now;
  Moment<Scalar> end;       ///< Of the plan.
  MoveResult<Scalar> plan;  ///< From now to the end of the step; its fractions are those of the step.
  Box2<Scalar> box;         ///< Around the shape along the plan.
  Company company;          ///< The others it gives way to. The k-th of them takes the k-th place of the scenery.
  int changes = 0;
  bool stays = false;     ///< It keeps its place for the rest of the step, and gives way to nobody.
  bool walks = false;     ///< It was on the ground and does not jump: its way follows the ground down.
  bool drops = false;     ///< One-way chains hold it not in this step.
  bool no_snap = false;   ///< Somebody stands where it would follow the ground down to.
  bool dropped = false;   ///< Its step was cut short.
  bool is_stuck = false;  ///< It begins inside scenery, and there is no way out.
};

template <class Scalar>
struct WalkerMemory {
  std::vector<Walker<Scalar>> walkers;
  std::vector<RowBest<Scalar>> rows;
  std::vector<MoverMotion<Scalar>> motions;  ///< Of the scene's movers and of all places, during a part of a way.
  MoveResult<Scalar> part;                   ///< What the technique says about that part.
  MoveResult<Scalar> way;                    ///< The way that was asked for last: a part, a plan, or a second try.
  std::vector<ReportMemory<ColliderIndex>> crushed;  ///< For what the report of each has no room for.
};

template <class Scalar>
class Stepper {
 public:
  Stepper(const Controller<Scalar>& controller, const Surrounded<Scalar>& surrounded, const CrowdRules<Scalar>& rules,
          WalkerMemory<Scalar>& memory, Scratch<Scalar>& scratch, CrowdReport<Scalar>& report, std::size_t count,
          const Vec2<Scalar>& gravity, Scalar dt, std::span<const MoverMotion<Scalar>> movers) noexcept;

  /// The way of every character, as if it were alone. Anything but `moved`: refused.
  [[nodiscard]] StepStatus begin(std::span<const CharacterState<Scalar>> states,
                                 std::span<const Input> inputs) noexcept;
  /// Handles the impacts in order of time.
  void solve() noexcept;
  /// Checks the ways as they were made, and hands out what came of them.
  void finish(std::span<CharacterState<Scalar>> states) noexcept;

 private:
  using V = Vec2<Scalar>;
  using Part = octagon_sweep::Part;

  /// What a new way would do to a character.
  struct Outcome {
    bool run_over = false;  ///< Another character, to which it gives way, leaves it no room.
    bool pressed = false;   ///< A mover that did not crush it before leaves it no room.
    [[nodiscard]] bool free() const noexcept { return !run_over && !pressed; }
  };

  [[nodiscard]] CrowdMember<Scalar>& member(std::size_t i) noexcept { return report_.members[i]; }
  [[nodiscard]] bool is_companion(ColliderIndex collider) const noexcept {
    return collider >= surrounded_.first_companion;
  }

  // Ways
  [[nodiscard]] V place(std::size_t i, Scalar time, bool after) noexcept;
  [[nodiscard]] Scalar next_corner(const Walker<Scalar>& walker, Scalar time) noexcept;
  void set_motions(const Company& company, Scalar begin, Scalar end) noexcept;
  [[nodiscard]] MoveRequest<Scalar> request_at(const Walker<Scalar>& walker, const Moment<Scalar>& at,
                                               Scalar end) noexcept;
  [[nodiscard]] bool ask(std::size_t i, Scalar until, MoveResult<Scalar>& way, Moment<Scalar>& at) noexcept;
  void append(const MoveResult<Scalar>& part, Scalar begin, Scalar end, MoveResult<Scalar>& way) const noexcept;
  void pass_on(const MoveResult<Scalar>& part, Scalar end, Moment<Scalar>& at) const noexcept;
  void remember(const Crushers<Scalar>& crushers, CharacterState<Scalar>& state) const noexcept;
  [[nodiscard]] Outcome outcome_of(std::size_t i, const MoveResult<Scalar>& way) noexcept;
  Outcome plan(std::size_t i) noexcept;
  void stay(std::size_t i) noexcept;
  void ask_to_stay(std::size_t i) noexcept;
  void make(std::size_t i, const MoveResult<Scalar>& way) noexcept;
  void go_on_to(std::size_t i, Scalar time) noexcept;
  void cut_plan(std::size_t i, Scalar time, const V& there) noexcept;

  // Impacts
  [[nodiscard]] bool gives_way_to(std::size_t i, std::size_t other) const noexcept;
  [[nodiscard]] Meeting<Scalar> meeting(std::size_t i, std::size_t j) noexcept;
  void keep_company_from_the_start() noexcept;
  void stand_still(std::size_t i, const V& ride) noexcept;
  [[nodiscard]] bool is_above(std::size_t i, std::size_t j) const noexcept;
  void meet(std::size_t i, std::size_t j, const Meeting<Scalar>& meeting) noexcept;
  void meet_at_once(std::size_t i, std::size_t j, const Meeting<Scalar>& meeting) noexcept;
  [[nodiscard]] bool may_go_on(std::size_t i) noexcept;
  Outcome give_way(std::size_t i, std::size_t other) noexcept;
  void one_gives_way(std::size_t i, std::size_t other) noexcept;
  [[nodiscard]] bool is_clear(std::size_t i, const MoveResult<Scalar>& way) noexcept;
  void take_back(std::size_t i, std::size_t other) noexcept;
  void slow_down(std::size_t i, const V& normal, Scalar limit) noexcept;
  [[nodiscard]] V common_ride(std::size_t i, std::size_t j) const noexcept;

  // The end
  [[nodiscard]] Scalar reach_of_crush(std::size_t i) noexcept;
  [[nodiscard]] bool lost_its_ground(std::size_t i) noexcept;
  [[nodiscard]] bool is_on_another(std::size_t i) const noexcept;
  [[nodiscard]] Scalar missed_fall(std::size_t i) noexcept;
  enum class Course : std::uint8_t { straight, real };
  [[nodiscard]] bool goes_free(std::size_t i, Course course, Moment<Scalar>& end) noexcept;
  [[nodiscard]] bool seek_room(std::size_t i) noexcept;
  void keep_back(std::size_t i, const CharacterState<Scalar>& start) noexcept;
  void hand_out(std::size_t i, CharacterState<Scalar>& state) noexcept;

  const Controller<Scalar>& controller_;
  const octagon_sweep::SweepInParts<Scalar>& sweep_;
  const Surrounded<Scalar>& surrounded_;
  const PairSpace<Scalar>& space_;
  Scalar walkable_cosine_;
  int most_changes_;  ///< After so many changes of its way a character stops steering. After twice as many it stays.
  WalkerMemory<Scalar>& memory_;
  Scratch<Scalar>& scratch_;
  CrowdReport<Scalar>& report_;
  std::span<Walker<Scalar>> walkers_;
  Timetable<Scalar> timetable_;
  V gravity_;
  Scalar dt_;
  std::span<const MoverMotion<Scalar>> movers_;
  Scalar time_ = 0;  ///< Of the present impact.
};

}  // namespace paperproof::crowd
