/// Several characters of one kind that block each other.
#pragma once

#include <paperproof/controller.hpp>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace paperproof {

/// Position of a character in the states handed to `Crowd::step`.
using CharacterIndex = std::uint32_t;

/// Another character was in the way. Both report it, with opposite normals.
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
  FixedVector<CharacterIndex, 16> started_overlapping;  ///< The characters that it overlapped when the step began.
  /// No path could be shown to be safe: it is where the step began, with velocity zero.
  bool stayed = false;
  /// `discrete`: the lowest index in its time-of-impact island at the beginning of the step. Otherwise its own index.
  CharacterIndex island = 0;

  /// Adds a contact with another, unless there is one on the same side.
  void add_contact(CharacterIndex other, const Vec2<Scalar>& normal, Scalar fraction) noexcept {
    const CrowdContact<Scalar> contact{other, normal, fraction, side_of_normal(normal.x(), normal.y())};
    const bool known = std::any_of(met.begin(), met.end(), [&](const CrowdContact<Scalar>& earlier) {
      return earlier.other == contact.other && earlier.side == contact.side;
    });
    if (!known) met.push_back(contact);
  }
};

template <class Scalar>
struct CrowdReport {
  explicit CrowdReport(std::size_t most_characters) : members(most_characters) {}

  /// `moved`, or why no state changed: `invalid_input`, `out_of_range`.
  StepStatus status = StepStatus::moved;
  std::vector<CrowdMember<Scalar>> members;  ///< Valid up to the number of states, unless the step was refused.
  std::size_t impacts = 0;                   ///< How many impacts of two characters were handled.

  /// Adds the contact of two characters to both. @param normal from the second towards the first.
  void add_contact(CharacterIndex first, CharacterIndex second, const Vec2<Scalar>& normal, Scalar fraction) noexcept {
    members[first].add_contact(second, normal, fraction);
    members[second].add_contact(first, Vec2<Scalar>(-normal), fraction);
  }
};

template <class Scalar>
class JointTechnique;

/// Memory of a step, one per thread and crowd. It carries nothing from step to step.
struct CrowdScratch {
  std::size_t most_characters = 0;
  std::unique_ptr<OwnMemory> own;
  std::weak_ptr<const void> maker;  ///< See `Scratch::maker`.
};

/// Steps characters of one kind through one scenery. Const and shareable between threads.
///
/// **By `octagon_sweep`.** All characters move at once, and impacts are handled in the order of their times (Mirtich
/// 1996, "Impulse-based Dynamic Simulation of Rigid Body Systems", without the impulses):
/// 1. Each character gets the path that `Controller` would give it. One that has no impact with another keeps it, bit
///    for bit.
/// 2. The earliest impact of any pair is handled, again and again. Where one of the two moves into the other, faster
///    than that one recedes, it gets a new path from there on, on which the other is an obstacle like a mover that
///    carries nothing. Where both do, both lose the speed with which they approach, and the upper one gets the new path
///    (of two at one height the left one). Of impacts at the same time the one with the lowest first index comes first,
///    then the lowest second index.
/// 3. A character that others held in the air, or that is crushed, is planned once more past the final paths of all.
///
/// Characters that walk or fall do not push each other. One that lands on a walkable part of another stands on it, and
/// is not carried along. Movers carry, push and crush each one as by `Controller`; the velocities of two that the same
/// mover carries are compared relative to it. A character that is pushed into another, and has no room beside it,
/// pushes the other on. If that one has no room either, the mover crushes the character that it pushes.
///
/// The guarantee, beside that of `octagon_sweep` for each character: two that do not overlap at the beginning of a step
/// do not overlap at its end, and do not pass through each other. A character without a path that is shown to be safe
/// stays where it is (`dropped`); movers that run into it then are reported to crush it. Two that overlap are reported;
/// they leave each other, and restore their gap, as they leave a solid. Two promises hold only for a character that had
/// no contact with another in the step: it had no room if it is reported crushed; and it does not hang.
///
/// Cost: n²/2 box tests for n characters, then n for each new path; meant for up to a few hundred. One character avoids
/// at most 12 others in a step. The crowd keeps a copy of the scenery, with 12 colliders for these.
///
/// **By `discrete`**, which guarantees nothing: all characters are bodies of one joint solve, of the same mass. Only
/// the beginning and the expected end of the step are looked at. Characters whose boxes around both overlap form
/// islands. In each island, those that are expected to end overlapping are pushed apart in order of time of impact,
/// each by half of the overlap, and both go on with the mean of their velocities along the normal. This is repeated
/// `iterations` times, with all pieces nearby. So characters push each other, also into and through solids; a fast one
/// passes another; and stacks sink into themselves. One that is alone moves as by `Controller`, bit for bit. A
/// character that lands on another stands on it, and is not carried along. A character that a mover would push through
/// a standing solid stays where it was, crushed, and is in the way. Where more than 256 bodies on average are near each
/// character, those beyond that are ignored, and every character is `dropped`. Cost: sorting boxes, a little more than
/// n.
template <class Scalar>
class Crowd {
 public:
  /// Moves by `octagon_sweep`. `scenery` must outlive the crowd. @throws as `Controller`.
  Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character, const SweepDef& sweep = {});
  /// Moves by a technique that moves all characters in one call. @throws as `Controller`.
  Crowd(const Scenery<Scalar>& scenery, const CharacterDef& character,
        std::unique_ptr<const JointTechnique<Scalar>> technique, const Stages& stages = {});
  ~Crowd();
  Crowd(Crowd&&) noexcept;
  Crowd& operator=(Crowd&&) noexcept;

  [[nodiscard]] CrowdScratch make_scratch(std::size_t most_characters) const;

  /// One step of `dt` seconds under `gravity` [m/s²] for all characters. Never allocates, never throws.
  /// @param states read and written; nothing else carries over.
  /// @param inputs one per state.
  /// @param scratch,report made for at least as many characters, the scratch by this crowd. Otherwise, or where one
  ///   state, input or step is refused (see `StepStatus`), no state changes.
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
  [[nodiscard]] bool accepts(const CharacterState<Scalar>& state, const Input& input,
                             const Vec2<Scalar>& gravity) const noexcept;

  std::shared_ptr<const Rules> rules_;  ///< Has no other owner: scratch memory refers to it.
  Controller<Scalar> controller_;
};

extern template class Crowd<float>;
extern template class Crowd<double>;

}  // namespace paperproof
