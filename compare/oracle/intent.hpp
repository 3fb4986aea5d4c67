/// What a character wanted in a step: worked out from scene, input and the state before, not from what a contender
/// says.
#pragma once

#include "oracle/exact.hpp"
#include "records/trace.hpp"

#include <functional>

namespace paperproof::compare {

/// What a step was asked for.
struct Wanted {
  Vec2d displacement{Vec2d::Zero()};  ///< In the world: what carries the character is included [m].
  Vec2d velocity{Vec2d::Zero()};      ///< The same [m/s].
  double steered = 0;                 ///< The part of the displacement across up that steering added [m].
  double walk = 0;                    ///< The speed across up, relative to the ground that it rides [m/s].
  Vec2d carried{Vec2d::Zero()};       ///< The way that its ground carries it, in the world [m].
  /// The collider that carries it where the step begins: it moves or conveys.
  std::optional<ColliderIndex> ridden{};
  Vec2d rode{Vec2d::Zero()};  ///< How fast that went in the step before [m/s].
  bool jumped = false;        ///< A jump begins.
  bool jumping = false;       ///< The same, or one goes on.
  bool pending = false;       ///< A press that has not become a jump yet.
  int parts = 1;              ///< Shorter steps that the step consists of.
  bool from_ground = false;   ///< It stood when the step began.

  [[nodiscard]] bool operator==(const Wanted&) const = default;
  /// What it rides, unless it jumps off. Who drops through its carrier still counts.
  [[nodiscard]] std::optional<ColliderIndex> stays_on() const { return jumped ? std::nullopt : ridden; }
};

/// Whether it says that it touched something from above.
[[nodiscard]] bool touches_from_above(const TraceStep& step, const Vec2d& up);

/// Whether a wall is beside the character in the direction of `move`, within the character's `wall_reach`.
/// @param solids of the header: what turns is none of them.
[[nodiscard]] bool is_wall_ahead(const TraceHeader& header, const ExactScenery& solids, const Place& at,
                                 const Vec2d& up, double move);

/// The discrete law of motion (§4 of the design), for one character: horizontal speed approaches the input's by
/// acceleration times dt, a jump that is allowed sets the upward speed, gravity is added, the fall is limited, and the
/// displacement is the velocity times dt (semi-implicit Euler). On ground that carries, all of it is relative to the
/// ground. Where a step consists of several shorter ones, each steers and falls for its part of the time; what is
/// wanted is what the first of them would come to in the whole step.
///
/// Position, velocity, ground and ride at the end of a step are read from its record, where they are judged. The state
/// of the jump button is derived from the inputs. Only whether it jumped in a later one of shorter steps is read, too:
/// who lands in one may jump in the next. Feed it every step of one character in order. Not thread-safe.
class Intent {
 public:
  /// See `is_wall_ahead`: for the rule that it cannot jump toward a wall.
  using WallAhead = std::function<bool(const TraceStep& step, double move)>;

  /// @param header must outlive this.
  explicit Intent(const TraceHeader& header) : header_(&header) {}

  /// What the step was asked for. @param parts shorter steps that it consists of.
  [[nodiscard]] Wanted begin(const TraceStep& step, int parts, const WallAhead& wall_ahead);
  /// Takes over the state at the end of the same step.
  void end(const TraceStep& step);
  /// How far two answers may differ by rounding alone [m].
  [[nodiscard]] double rounding(const TraceStep& step, const Wanted& wanted) const;

 private:
  void start_anew(const TraceStep& step);
  void note_press(bool pressed, double dt);
  void end_later_parts(const TraceStep& step);
  [[nodiscard]] bool jumped_later(const TraceStep& step) const;
  [[nodiscard]] double use_button(const TraceStep& step, double dt, double rise, const WallAhead& wall_ahead,
                                  Wanted& wanted);
  [[nodiscard]] bool may_jump(const TraceStep& step, const WallAhead& wall_ahead) const;
  [[nodiscard]] bool is_climb_of_walk(double walk, double rise) const;
  [[nodiscard]] Vec2d carried(const TraceStep& step, double dt) const;

  const TraceHeader* header_;
  bool begun_ = false;
  int parts_ = 1;             ///< Of the step that has begun,
  double rise_ = 0;           ///< and how fast up it wants to go [m/s].
  Vec2d end_{Vec2d::Zero()};  ///< Where the step before ended [m].
  TraceState state_;          ///< Its velocity is that in the world.
  double pending_left_ = 0;   ///< [s]
  double coyote_left_ = 0;    ///< [s]
  bool crushed_ = false;
  bool wall_left_ = false;
  bool wall_right_ = false;
  Vec2d ground_velocity_{Vec2d::Zero()};  ///< [m/s]
  /// How the mover that carries went in the step before [m/s].
  Vec2d carrier_velocity_{Vec2d::Zero()};
};

}  // namespace paperproof::compare
