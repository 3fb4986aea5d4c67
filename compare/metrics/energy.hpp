/// Energy that comes from nowhere.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"

#include <vector>

namespace paperproof::compare {

/// Energy of the characters per kilogram, E = v²/2 - g·x, the sum over all of them [J/kg].
/// - `energy_gained_j_kg`: how far E ever rises above the least value that it had since something was last put in. A
///   step puts something in where the wanted motion is faster than the velocity before it with gravity, or rises where
///   that one falls or rises less: steering, a jump; and where a character is put elsewhere. A character that walks has
///   legs: where a step goes sideways, and begins or ends grounded or touches what is walkable, the gain is what both E
///   and the horizontal part of v²/2 grow by, at most.
/// - `energy_bound_j_kg`: what is no gain: gravity times what the contender calls near (1e-6 m, Box2D's skin of 20 mm),
///   and rounding: 8 epsilon of the largest v², and two ulp of the largest coordinate in the field of gravity.
///
/// Exact motion gains nothing: in free flight and on a steep slope a step takes (g dt)²/2 from E at most, and an impact
/// takes more. The first step is the beginning, as a trace does not say how fast it was before. Both are absent where
/// scenery moves or conveys, which puts in what it wants. Memory does not grow with the number of steps.
class Energy {
 public:
  Energy(const TraceHeader& header, const Vec2d& gravity);
  /// Every character of every step, in order. @param dt of the step [s].
  void add(const TraceStep& step, double dt);
  void write(Row& row) const;

 private:
  struct Character {
    bool known = false;  ///< What follows is that of a step before.
    bool free = false;   ///< It began a step free: it is no longer pushed out of where the scene put it.
    bool grounded = false;
    Vec2d velocity{Vec2d::Zero()};
    double energy = 0;
  };
  /// Of the characters of one step.
  struct Sum {
    double energy = 0;
    double gain = 0;  ///< Since the step before; of a walk at most the gain in horizontal speed.
    bool put_in = false;
    bool walks = false;
  };
  [[nodiscard]] bool is_on_foot(const Character& who, const TraceStep& step) const;
  [[nodiscard]] bool is_pushed(const Character& who, const TraceStep& step, double dt) const;
  void conclude(const Sum& sum);

  Vec2d gravity_;
  bool applies_ = false;
  double least_up_ = 0;  ///< Of the normals of walkable ground.
  double reach_ = 0;     ///< What the contender calls near [m].
  double epsilon_ = 0;   ///< Of its number type.
  std::vector<Character> characters_;
  Sum now_;
  double least_ = 0;
  double gained_ = 0;
  bool any_ = false;      ///< Some step was measured.
  double fastest_ = 0;    ///< Largest v² [m²/s²].
  double outermost_ = 0;  ///< Largest coordinate [m].
};

}  // namespace paperproof::compare
