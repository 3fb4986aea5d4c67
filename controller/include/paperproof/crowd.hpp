/// Several characters of one kind that block each other.
#pragma once

#include <paperproof/controller.hpp>

#include <algorithm>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

namespace paperproof {

/// Position of a character in the states handed to `Crowd::step`.
using CharacterIndex = std::uint32_t;

/// Another character was in the way. Both report it, with opposite normals.
struct CrowdContact {
  CharacterIndex other = 0;
  Vec2d normal{Vec2d::Zero()};  ///< Unit, from the other towards this one.
  double fraction = 0;          ///< Time of impact as a fraction of the step, in [0, 1].
  Side side = Side::bottom;     ///< Of this character.
};

/// The report of one step for one character. Contacts with scenery are in `step.move`, those with characters here.
struct CrowdMember {
  StepReport step;
  FixedVector<CrowdContact, 16> met;                    ///< One per other character and side, in order of time.
  FixedVector<CharacterIndex, 16> started_overlapping;  ///< The characters that it overlapped at the beginning.
  /// No path could be shown to be safe: the character is where its step began, with velocity zero.
  bool stayed = false;
  /// `discrete`: the lowest index in the character's time-of-impact island at the beginning of the step. Otherwise the
  /// character's own index.
  CharacterIndex island = 0;

  /// Of the character `index`, before its step.
  void clear(CharacterIndex index) noexcept {
    step.clear();
    met.clear();
    started_overlapping.clear();
    stayed = false;
    island = index;
  }
  /// Adds a contact with another, seen with this up, unless there is one on the same side.
  void add_contact(CharacterIndex other, const Vec2d& normal, double fraction, const UpFrame& up) noexcept {
    const CrowdContact contact{other, normal, fraction, up.side_of(normal)};
    const bool known = std::any_of(met.begin(), met.end(), [&](const CrowdContact& earlier) {
      return earlier.other == contact.other && earlier.side == contact.side;
    });
    if (!known) met.push_back(contact);
  }
  /// Contacts are not found in the order of their times.
  void sort_contacts() noexcept {
    std::sort(met.begin(), met.end(), [](const CrowdContact& a, const CrowdContact& b) {
      return std::tie(a.fraction, a.other, a.side) < std::tie(b.fraction, b.other, b.side);
    });
  }
};

struct CrowdReport {
  explicit CrowdReport(std::size_t most_characters) : members(most_characters) {}

  /// `moved`, or why no state changed: `invalid_input`, `out_of_range`.
  StepStatus status = StepStatus::moved;
  std::vector<CrowdMember> members;  ///< Valid up to the number of states, unless the step was refused.
  std::size_t impacts = 0;           ///< How many impacts of two characters were handled.

  /// Adds the contact of two characters to both. @param normal from the second towards the first.
  void add_contact(CharacterIndex first, CharacterIndex second, const Vec2d& normal, double fraction,
                   const UpFrame& up) noexcept {
    members[first].add_contact(second, normal, fraction, up);
    members[second].add_contact(first, Vec2d(-normal), fraction, up);
  }
};

/// Memory of a step, one per thread and crowd. It carries nothing from step to step.
struct CrowdScratch {
  std::size_t most_characters = 0;
  std::unique_ptr<OwnMemory> own;
  std::weak_ptr<const void> maker;  ///< See `Scratch::maker`.
};

/// Steps characters of one kind through one scenery. Const and shareable between threads.
///
/// All characters move at once, and impacts are handled in the order of their times (Mirtich
/// 1996, "Impulse-based Dynamic Simulation of Rigid Body Systems", without the impulses):
/// 1. Each character gets the path that `Controller` would give it. A character that has no impact with another keeps
///    this path, bit for bit.
/// 2. The earliest impact of any pair is handled, again and again. If one of the two moves into the other, faster than
///    the other recedes, the first gets a new path from the impact on. For this path the other is an obstacle, like a
///    mover that carries nothing. If both move into each other, both lose their approach speed, and the upper one gets
///    the new path (at equal height, the left one). Of impacts at the same time the one with the lowest first index
///    comes first, then the lowest second index.
/// 3. A character that others held in the air, or that is crushed, gets one more new path, past the final paths of all
///    others.
///
/// Characters that walk or fall do not push each other. A character that lands on a walkable part of another stands on
/// it, and is not carried along. Movers carry, push and crush each character as by `Controller`. If one mover carries
/// both characters of a pair, their velocities are compared relative to this mover. A character that a mover pushes
/// into another, and that has no room beside it, pushes the other on. If the other has no room either, the mover
/// crushes the character that it pushes.
///
/// The guarantee, beside that of `octagon_sweep` for each character: two that do not overlap at the beginning of a step
/// do not overlap at its end, and do not pass through each other. A character without a path that is shown to be safe
/// stays where it is (`dropped`); a mover that then runs into it is reported as crushing it. An overlap of two
/// characters is reported; they leave each other, and restore their gap, as a character leaves a solid. Two promises
/// hold only for a character that had no contact with another in the step: if it is reported crushed, it had no room;
/// and it does not hang.
///
/// Cost: n²/2 box tests for n characters, then n for each new path; meant for up to a few hundred. One character avoids
/// at most 12 others in a step. The crowd keeps a copy of the scenery, with 12 more colliders for these characters.
class Crowd {
 public:
  /// `scenery` must outlive the crowd. @throws as `Controller`.
  Crowd(const Scenery& scenery, const CharacterDef& character, const SweepDef& sweep = {});
  ~Crowd();
  Crowd(Crowd&&) noexcept;
  Crowd& operator=(Crowd&&) noexcept;

  [[nodiscard]] CrowdScratch make_scratch(std::size_t most_characters) const;

  /// One step for all characters. Allocates where a piece comes near for the first time, never throws.
  /// @param states read and written; nothing else carries over.
  /// @param inputs one per state. @param context its filter is not for the characters themselves, which block each
  ///   other always.
  /// @param scratch,report made for at least as many characters, the scratch by this crowd. Otherwise, or if one state,
  ///   input or step is refused (see `StepStatus`), no state changes.
  StepStatus step(std::span<CharacterState> states, std::span<const Input> inputs, const StepContext& context,
                  CrowdScratch& scratch, CrowdReport& report) const noexcept;

  [[nodiscard]] const CharacterDef& character() const noexcept { return controller_.character(); }

 private:
  struct Rules;
  Crowd(std::unique_ptr<const Rules> rules, Controller controller);

  std::shared_ptr<const Rules> rules_;  ///< Has no other owner: scratch memory refers to it.
  Controller controller_;
};

}  // namespace paperproof
