/// Several characters of one kind that do not get past each other either.
#pragma once

#include <paperproof/controller.hpp>

#include <memory>
#include <span>
#include <vector>

namespace paperproof {

/// Position of a character in the states handed to `Crowd::step`.
using CharacterIndex = std::uint32_t;

/// Another character was in the way. Both get one, with opposite normals.
template <class Scalar>
struct CrowdContact {
  CharacterIndex other = 0;
  Vec2<Scalar> normal{Vec2<Scalar>::Zero()};  ///< Unit, from the other towards this one.
  Scalar fraction = 0;                        ///< Time of impact as a fraction of the step, in [0, 1].
  Side side = Side::bottom;                   ///< Of this character.
};

/// What one step did to one character. Contacts with scenery are in `step.move`, those with characters here.
template <class Scalar>
struct CrowdMember {
  StepReport<Scalar> step;
  FixedVector<CrowdContact<Scalar>, 16> met;            ///< One per other character and side, in order of time.
  FixedVector<CharacterIndex, 16> started_overlapping;  ///< Whom it overlapped when the step began.
  /// No order of impacts could be shown to be safe: it stayed where the step began, with velocity zero.
  bool stayed = false;
  /// `discrete`: the time-of-impact island it was in when the step began, by the lowest character in it. Otherwise, or
  /// alone, itself.
  CharacterIndex island = 0;
};

template <class Scalar>
struct CrowdReport {
  explicit CrowdReport(std::size_t most_characters) : members(most_characters) {}

  /// `moved`, or why nothing changed for anybody: `invalid_input`, `out_of_range`.
  StepStatus status = StepStatus::moved;
  std::vector<CrowdMember<Scalar>> members;  ///< Valid up to the number of states, unless the step was refused.
  std::size_t impacts = 0;                   ///< Of characters against characters.
};

template <class Scalar>
class JointTechnique;

/// Memory of a step, one per thread and crowd; it carries nothing from step to step.
struct CrowdScratch {
  std::size_t most_characters = 0;
  std::unique_ptr<OwnMemory> own;
  std::weak_ptr<const void> maker;  ///< As `Scratch::maker`.
};

/// Steps characters of one kind through one scenery. Const and shareable between threads.
///
/// By `octagon_sweep`: all move at once; impacts are handled in the order of their times (Mirtich 1996, "Impulse-based
/// Dynamic Simulation of Rigid Body Systems", without the impulses). Each character first gets the way that
/// `Controller` would give it: one that meets nobody moves as by `Controller`, bit for bit. Then, again and again, the
/// earliest impact of any pair is looked for. Whoever of the two moves into the other, and faster than the other gives
/// way, gets a new way from there on, with the other as an obstacle that goes its own way, like a mover that carries
/// nobody. Where both do, both lose the speed with which they meet, and the upper one gives way (of two at one height
/// the left one). Neither pushes. What comes down on a walkable part of another stands on it (and is not carried
/// along). Of impacts at the same time the one with the lowest first index comes first, then the lowest second index.
/// At the end each character that others held in the air looks once more for a way down beside them.
///
/// Among movers each character is carried, pushed and crushed as by `Controller`. Two that the same mover carries are
/// compared relative to it. A character that is pushed into another, and has no room beside it, pushes the other on. If
/// that one has no room either, the mover crushes the character it presses, after a last search for room over the whole
/// step.
///
/// Its guarantee, beside that of `octagon_sweep` for each of them: characters that were apart stay apart, and do not
/// pass through each other. What cannot be shown to be safe stays where it is (`dropped`); what a mover then does to it
/// is reported as a crush. Characters that overlap are reported; they get out of each other, and restore their gaps, as
/// out of solids. Two promises hold only for a character that no other touched during the step: reported crushed, it
/// had no room; and it does not hang.
///
/// By `discrete`, which guarantees nothing: all are bodies of one joint solve, of the same mass. Only the start and the
/// expected end of the step are looked at. Characters whose boxes around both overlap form islands; in each, those that
/// are expected to end in each other are pushed apart in order of time of impact, half of the overlap each, and lose
/// the speed with which they approach, so that both go on with the mean of the two. That is repeated `iterations`
/// times with all that is near. So they push each other, also into and through solids; who is fast enough passes
/// another; and stacks sink into themselves. One that is alone moves as by `Controller`, bit for bit. What comes down
/// on another stands on it, and is not carried along. Whom a mover would push through what stands still stays where it
/// was, crushed, and is in the way. Where more than 256 bodies on average are near each character those beyond that are
/// not looked at, and everybody is `dropped`.
///
/// Cost of `octagon_sweep`: the ways are compared pair by pair, by their boxes first: n^2/2 box tests for n characters,
/// then one row of them for each impact. Meant for up to a few hundred. A character gives way to at most 12 others in
/// one step, and the crowd keeps a copy of the scenery with places for them. `discrete` sorts boxes: a little more than
/// n.
template <class Scalar>
class Crowd {
 public:
  /// Moves by `octagon_sweep`. `scenery` must outlive the crowd. @throws as `Controller`.
  Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character, const SweepDef& sweep = {});
  /// Moves by a technique that moves all at once. @throws as `Controller`.
  Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character,
        std::unique_ptr<const JointTechnique<Scalar>> technique, const Stages& stages = {});
  ~Crowd();
  Crowd(Crowd&&) noexcept;
  Crowd& operator=(Crowd&&) noexcept;

  [[nodiscard]] CrowdScratch make_scratch(std::size_t most_characters) const;

  /// One step of `dt` seconds under `gravity` [m/s²] for all of them. Never allocates, never throws.
  /// @param states read and written; nothing else carries over.
  /// @param inputs one per state.
  /// @param scratch,report made for at least as many characters, the scratch by this crowd. Otherwise, or where one
  ///   state, input or step is refused (see `StepStatus`), nothing changes for anybody.
  StepStatus step(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs, const Vec2<Scalar>& gravity,
                  Scalar dt, CrowdScratch& scratch, CrowdReport<Scalar>& report) const noexcept {
    return step(states, inputs, gravity, dt, {}, scratch, report);
  }
  /// The same among movers.
  /// @param movers one for each mover of the scenery, within +-2e6 m; anything else is invalid input.
  StepStatus step(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs, const Vec2<Scalar>& gravity,
                  Scalar dt, std::span<const MoverMotion<Scalar>> movers, CrowdScratch& scratch,
                  CrowdReport<Scalar>& report) const noexcept;

  [[nodiscard]] const CharacterDef& character() const noexcept { return controller_.character(); }

 private:
  struct Rules;
  Crowd(std::unique_ptr<const Rules> rules, Controller<Scalar> controller);
  StepStatus step_jointly(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs,
                          const Vec2<Scalar>& gravity, Scalar dt, std::span<const MoverMotion<Scalar>> movers,
                          CrowdScratch& scratch, CrowdReport<Scalar>& report) const noexcept;

  std::shared_ptr<const Rules> rules_;  ///< Shared with nobody: scratch memory refers to it.
  Controller<Scalar> controller_;
  const JointTechnique<Scalar>* joint_;  ///< The controller's technique, where it moves all at once; else null.
};

extern template class Crowd<float>;
extern template class Crowd<double>;

}  // namespace paperproof
