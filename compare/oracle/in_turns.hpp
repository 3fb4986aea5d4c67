/// Of several characters that take turns: what each turn is for the one that takes it.
#pragma once

#include "oracle/pair.hpp"
#include "records/trace.hpp"

#include <span>
#include <vector>

namespace paperproof::compare {

/// A turn is a step of one character in a level in which the bodies of the others are movers: so all rules of a step of
/// one character hold in it. Feed it every step of one run in order. Not thread-safe.
///
/// **How another goes in a turn.** Where the record of the one says that it moves, it goes straight and evenly from
/// where it began to where it ended, over the whole step, if
/// - it carries the one, as the record of the step before says: whichever of them goes first;
/// - or it goes after, and its way leads into where the one began: it pushes the one;
/// - or it went before, and came no nearer to where the one began (see `ExactPair::recedes`).
///
/// Any other stands where it is in that turn. Places alone do not tell who pushes: of two that walk one behind the
/// other the second may come to where the first began, and pushes nobody.
///
/// **Velocity.** A rider of another character takes over the velocity with which that one ends its step: of one that
/// climbs a stair or is stopped that is not its way by the time. In a turn as it is made here the rider, its ride and
/// its ground have the velocity of the mover instead.
class InTurns {
 public:
  /// @param header of the run. @param movers of its records.
  InTurns(const TraceHeader& header, std::size_t movers);

  /// With the bodies after the colliders of the scene, and their movers after those of the scene.
  [[nodiscard]] const TraceHeader& header() const noexcept { return header_; }

  /// @param steps one of each character, in order. @return their turns, likewise.
  [[nodiscard]] std::vector<TraceStep> turns(std::span<const TraceStep> steps);

 private:
  using Carrier = std::optional<CharacterIndex>;

  [[nodiscard]] MoverMotion motion_of(const TraceStep& other, const TraceStep& one, const Carrier& carrier) const;
  [[nodiscard]] TraceStep turn_of(const TraceStep& one, std::span<const TraceStep> steps, const Carrier& carrier) const;
  [[nodiscard]] ColliderIndex body_of(CharacterIndex character) const noexcept { return first_body_ + character; }

  TraceHeader header_;
  ExactPair pair_;
  ColliderIndex first_body_;
  std::vector<Carrier> carriers_;  ///< When the next step begins.
};

}  // namespace paperproof::compare
