/// The working state of one step of a crowd.
#pragma once

#include "crowd/rules.hpp"
#include "crowd/timetable.hpp"

#include <paperproof/crowd.hpp>

#include <span>
#include <vector>

namespace paperproof::crowd {

/// Another character that is touched: no faster than `limit` towards it [m/s].
template <class Scalar>
struct HeldBy {
  Vec2<Scalar> normal;
  Scalar limit;
};

/// One character during a step: what it has done, and what it is about to do.
template <class Scalar>
struct Runner {
  CharacterState<Scalar> state;         ///< At `begin`.
  CharacterState<Scalar> after;         ///< At the end of the step, if nothing comes in between.
  StepReport<Scalar> plan;              ///< The way from `begin` to there.
  Scalar begin = 0;                     ///< Fraction of the step.
  Box2<Scalar> box;                     ///< Around the shape along the plan.
  FixedVector<HeldBy<Scalar>, 8> held;  ///< Met since it moved last.
  int impacts = 0;
  bool halted = false;
  bool walks = false;    ///< It was on the ground and does not jump: its way follows the ground down.
  bool drops = false;    ///< One-way chains hold it not in this step.
  bool no_snap = false;  ///< Somebody stands where it would follow the ground down to.
  bool stands = false;   ///< On somebody.
  bool dropped = false;
  bool stuck = false;
  bool jump_held = false;  ///< As this step's input leaves them.
  bool jump_pending = false;
};

template <class Scalar>
struct Memory {
  std::vector<Runner<Scalar>> runners;
  std::vector<RowBest<Scalar>> rows;
  StepReport<Scalar> part;  ///< Of a way up to an impact.
};

template <class Scalar>
class Stepper {
 public:
  Stepper(const Controller<Scalar>& controller, const CrowdRules<Scalar>& rules, Memory<Scalar>& memory,
          Scratch<Scalar>& technique, CrowdReport<Scalar>& report, std::size_t count, const Vec2<Scalar>& gravity,
          Scalar dt) noexcept
      : controller_(controller),
        rules_(rules),
        memory_(memory),
        technique_(technique),
        report_(report),
        runners_(std::span(memory.runners).first(count)),
        timetable_(std::span(memory.rows).first(count)),
        gravity_(gravity),
        dt_(dt) {}

  /// The way of every character, as if it were alone. Anything but `moved`: refused.
  [[nodiscard]] StepStatus begin(std::span<const CharacterState<Scalar>> states,
                                 std::span<const Input> inputs) noexcept;
  /// Handles the impacts in order of time.
  void solve() noexcept;
  /// Checks the ways as they were made, and hands out what came of them.
  void finish(std::span<CharacterState<Scalar>> states) noexcept;

 private:
  using V = Vec2<Scalar>;

  [[nodiscard]] CrowdMember<Scalar>& member(std::size_t i) noexcept { return report_.members[i]; }
  [[nodiscard]] StepStatus move(const Runner<Scalar>& runner, Scalar duration, bool follow_down,
                                CharacterState<Scalar>& state, StepReport<Scalar>& report) noexcept;
  void plan(std::size_t i) noexcept;
  void stay(std::size_t i) noexcept;
  void halt(std::size_t i) noexcept;
  void find_box(Runner<Scalar>& runner) noexcept;
  void commit(std::size_t i, const StepReport<Scalar>& part, Scalar end) noexcept;
  void go_on_to(std::size_t i, Scalar time) noexcept;

  [[nodiscard]] Meeting<Scalar> meeting(std::size_t i, std::size_t j) const noexcept;
  void respond(std::size_t i, const Meeting<Scalar>& meeting, const V& normal, Scalar limit) noexcept;
  [[nodiscard]] bool is_held(const Runner<Scalar>& runner) const noexcept;
  void halt_between(std::size_t i) noexcept;
  void note_touched_scenery(std::size_t i, Scalar impact) noexcept;

  void keep_back(std::size_t i, const CharacterState<Scalar>& start) noexcept;
  [[nodiscard]] StepStatus status_of(std::size_t i) noexcept;
  void hand_out(std::size_t i, CharacterState<Scalar>& state) noexcept;

  const Controller<Scalar>& controller_;
  const CrowdRules<Scalar>& rules_;
  Memory<Scalar>& memory_;
  Scratch<Scalar>& technique_;
  CrowdReport<Scalar>& report_;
  std::span<Runner<Scalar>> runners_;
  Timetable<Scalar> timetable_;
  V gravity_;
  Scalar dt_;
  Scalar now_ = 0;
};

}  // namespace paperproof::crowd
