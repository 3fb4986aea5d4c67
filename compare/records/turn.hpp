/// How a mover turns.
#pragma once

namespace paperproof::compare {

/// How a mover turns during one step: evenly, from one angle to another [radians], counter-clockwise.
struct TurnMotion {
  double from = 0;
  double to = 0;
};

}  // namespace paperproof::compare
