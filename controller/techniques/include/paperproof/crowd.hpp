/// What a step of several characters reports that a joint technique moves.
#pragma once

#include <paperproof/together.hpp>

#include <algorithm>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

namespace paperproof {

/// The report of one step for one character. Contacts with scenery are in `step.move`, those with characters here.
struct CrowdMember {
  StepReport step;
  FixedVector<CrowdContact, 16> met;                    ///< One per other character and side, in order of time.
  FixedVector<CharacterIndex, 16> started_overlapping;  ///< The characters that it overlapped at the beginning.
  /// The lowest index in the character's time-of-impact island at the beginning of the step.
  CharacterIndex island = 0;

  /// Of the character `index`, before its step.
  void clear(CharacterIndex index) noexcept {
    step.clear();
    met.clear();
    started_overlapping.clear();
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

}  // namespace paperproof
