/// What a scene must come to, as numbers that a program checks.
#pragma once

#include <paperproof/types.hpp>

#include <cstdint>
#include <string>

namespace paperproof::compare {

/// One number that a run must have: any value from `at_least` to `at_most`, which are the same where the answer is
/// exact. An event that never comes counts as coming when the run ends.
struct Answer {
  enum class Of : std::uint8_t {
    place,       ///< Position along `along` after `after` steps, relative to the mover `with` where one is named [m].
    speed,       ///< Velocity along `along` after `after` steps [m/s].
    farthest,    ///< The largest position along `along` on the whole way [m].
    drift,       ///< How far its position relative to the mover `with` ever gets from that after `after` steps [m].
    contact,     ///< When a contact, with `with` where it is named, is first reported [steps, with the fraction].
    contacts,    ///< On how many steps there is a contact, with `with` where it is named [steps].
    in_the_air,  ///< How many steps after the first `after` do not end grounded [steps].
    settled,     ///< After how many steps neither the position nor `grounded` changes any more [steps].
    crush,       ///< In which step, from 0, the character is first crushed, by `with` where it is named [steps].
    crushers,    ///< How many colliders are ever named as crushing [colliders].
    enter,       ///< When the sensor `with` is first entered [steps, with the fraction].
    leave,       ///< When it is first left [steps, with the fraction].
  };
  /// Gap that octagon_sweep may keep at a contact, and error of a time of impact times the speed of approach [m].
  static constexpr double gap = 1e-6;
  static constexpr int end = -1;                       ///< As `step`: after the last one.
  static constexpr std::size_t all = ~std::size_t{0};  ///< As `character`: the largest value of all of them.

  Of of = Of::place;
  double at_least = 0;
  double at_most = 0;
  /// By how much of its unit the answer changes where everything is met a metre earlier. It turns the gap that a
  /// contender keeps into what its answer may be off; 0: nothing is allowed.
  double per_metre = 1;
  double tolerance = gap;  ///< What octagon_sweep in double may be off, in the unit of the answer.
  Vec2d along{Vec2d::Zero()};
  int step = end;
  std::size_t character = 0;
  std::string with{};    ///< Id of a collider; any where it is empty.
  bool by_law = false;   ///< Only a contender that moves by the law of octagon_sweep, or can say it, is asked.
  double clearance = 0;  ///< A contender that keeps a larger gap is not asked [m]; 0: all are.
};

}  // namespace paperproof::compare
