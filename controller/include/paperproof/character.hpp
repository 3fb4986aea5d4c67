/// The character: its shape, how it wants to move, and its state.
#pragma once

#include <paperproof/tolerances.hpp>
#include <paperproof/types.hpp>

#include <optional>
#include <span>
#include <stdexcept>

namespace paperproof {

class InvalidCharacter : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The collision points of a character, relative to its position [m], y up in the world. They are the corners of a
/// convex polygon.
class CharacterShape {
 public:
  static constexpr std::size_t max_points = 8;

  /// The article's 20 x 40 pixel character: two points each for head, feet, left and right arm, at `pixels_per_metre`.
  [[nodiscard]] static CharacterShape article(double pixels_per_metre = 32);

  /// From points in a sprite's pixels (y down, any order); the position is the centre of their bounding box.
  /// @throws InvalidCharacter as the constructor.
  [[nodiscard]] static CharacterShape from_pixels(std::span<const Vec2d> points_px, double pixels_per_metre);

  /// @param points relative to the position [m], y up, in any order.
  /// @throws InvalidCharacter unless there are 3 to 8 distinct finite points that are all corners of their hull.
  explicit CharacterShape(std::span<const Vec2d> points);

  /// In the order given.
  [[nodiscard]] std::span<const Vec2d> points() const noexcept { return {points_.begin(), points_.end()}; }
  /// The same points, counter-clockwise, starting with the lowest (leftmost of equals).
  [[nodiscard]] std::span<const Vec2d> hull() const noexcept { return {hull_.begin(), hull_.end()}; }
  [[nodiscard]] const Box2& box() const noexcept { return box_; }

 private:
  FixedVector<Vec2d, max_points> points_;
  FixedVector<Vec2d, max_points> hull_;
  Box2 box_;
};

/// How a character wants to move. The defaults are the values for a scene that gives none.
struct CharacterDef {
  CharacterShape shape = CharacterShape::article();
  double walk_speed = 6;                     ///< [m/s]
  double acceleration = 60;                  ///< Of the horizontal speed on the ground [m/s²].
  std::optional<double> air_acceleration{};  ///< The same in the air [m/s²]; `acceleration` where absent.
  double jump_speed = 12;                    ///< Upward speed that a jump sets [m/s].
  /// For how long a character that has left the ground without a jump may still jump [s].
  double coyote_time = 0;
  /// For how long a press of the button that cannot jump yet stays pending, whether the button is held or not [s].
  /// Absent: as long as the button is held.
  std::optional<double> jump_buffer{};
  /// The share of its upward speed that a jump keeps if the button is released during the rise, or before it, in
  /// [0, 1]. On a mover it is a share of the speed in the world. A speed that the game sets is no jump, and is not cut.
  double jump_cut = 1;
  std::optional<double> max_fall_speed{};  ///< Against up [m/s]; no limit where absent.
  double max_climb_degrees = 50;           ///< Steepest walkable ground, from the horizontal; in [0, 89].
  /// How far down a walker follows its ground in one step, over crests and down all stairs that it passes in the step
  /// [m]; 0: not at all. A jump leaves the ground.
  double snap = 0;
  /// How high a walker climbs in one step, up a kerb or the stairs that stop it [m], if there is room above and
  /// walkable ground behind the edge; 0: not at all. It keeps its speed sideways, and gains none. On the way it stands
  /// on the corner.
  double step_height = 0;
  /// The article's rule: a character that stands beside a wall cannot jump toward this wall. A wall is beside the
  /// character if a move by `wall_reach` would meet the wall, or if the last step met it.
  bool no_jump_toward_wall = false;
  double wall_reach = 1.0 / 32;     ///< For that rule: a pixel of the article [m].
  bool side_hit_ends_rise = false;  ///< The article's rule: hitting the side of something while rising ends the rise.

  /// @throws InvalidCharacter naming the value that is not finite or out of range.
  void validate() const;

  /// Least upward component of the unit normal of walkable ground. Ground of exactly the climb limit is walkable: the
  /// limit is widened by `climb`, so that the rounding of a normal decides nothing.
  [[nodiscard]] double walkable_cosine(double climb = Tolerances{}.climb) const noexcept;
};

/// The player's wishes for one step.
struct Input {
  /// Direction across up in [-1, 1], (up.y, -up.x) being positive: the speed approaches `move * walk_speed`. Absent:
  /// nothing steers, and the horizontal speed stays as it is.
  std::optional<double> move{};
  /// The jump button is down. One press gives at most one jump; a press that cannot jump yet stays pending while held;
  /// or, if there is a `CharacterDef::jump_buffer`, for that long.
  bool jump = false;
  /// One-way chains do not block while this is true: a character that stands on a chain drops through it. (For a
  /// `box2d::Hero`: fixtures that `surface_of` makes ledges; a `b2ChainShape` alone is none.) One step with
  /// `drop` is enough to leave a chain that the character touches: from partly below a chain the character goes on
  /// without `drop`.
  bool drop = false;
};

/// What holds a character from below at the end of a step.
enum class GroundState : std::uint8_t {
  air,       ///< Nothing.
  walkable,  ///< Ground that it stands on.
  steep,     ///< A surface that it touches and slides down: too steep to stand on.
  wedge,     ///< It stands between surfaces that are too steep, and that hold it together.
};

/// What a character stands on or slides down at the end of a step. The rest is valid where the state is not `air`.
/// `octagon_sweep` tells it; other techniques always say `air`.
struct Ground {
  GroundState state = GroundState::air;
  ColliderIndex collider = no_collider;
  Vec2d normal{Vec2d::Zero()};    ///< Of the surface; of several one that points up most.
  Vec2d velocity{Vec2d::Zero()};  ///< Of the surface, conveyor included [m/s].

  friend bool operator==(const Ground&, const Ground&) = default;
};

/// The ground that carries a character: a mover or a conveyor.
struct Ride {
  static constexpr ColliderIndex none = no_collider;
  ColliderIndex ground = none;
  /// Where the character stands relative to the mover's offset [m]. It changes only when the character moves relative
  /// to the ground that carries it, so errors do not add up, however long the ride is.
  Vec2d place{Vec2d::Zero()};
  Vec2d velocity{Vec2d::Zero()};  ///< Of the ground in the last step, conveyor included [m/s].

  friend bool operator==(const Ride&, const Ride&) = default;
};

/// A mover that crushed the character and still overlaps it.
struct Crusher {
  ColliderIndex collider = 0;
  /// Where the character was when it was last free of the collider [m].
  Vec2d last_free{Vec2d::Zero()};
  /// How far the collider has moved since then [m]. Seen from the collider, the character came from
  /// `last_free + displacement`.
  Vec2d displacement{Vec2d::Zero()};
  bool has_side = true;  ///< False: the list was full, so the side from which the character came is unknown.

  friend bool operator==(const Crusher&, const Crusher&) = default;
};
/// A state remembers at most eight crushers. If more overlap the character, it does not move until the others have
/// left, even where there is room, because the side from which it came is unknown. Other movers that run into the
/// character meanwhile crush it as well.
using Crushers = FixedVector<Crusher, 8>;

/// Everything that one step hands to the next. A plain value: copy it to save a game or to roll back.
struct CharacterState {
  Vec2d position{Vec2d::Zero()};   ///< [m]
  Vec2d velocity{Vec2d::Zero()};   ///< [m/s]
  Vec2d last_free{Vec2d::Zero()};  ///< Last position that overlapped nothing; valid with `has_last_free`.
  /// Value that the technique hands to its own next step. `octagon_sweep` needs none: zero.
  Vec2d technique_memory{Vec2d::Zero()};
  bool has_last_free = false;
  bool grounded = false;      ///< It stands: on walkable ground, or in a wedge.
  bool jumping = false;       ///< The article's jumping flag: set by a jump, cleared by ground.
  bool jump_held = false;     ///< The jump button was down in the last step.
  bool jump_pending = false;  ///< A press that has not become a jump yet.
  double coyote_left = 0;     ///< For how long the character may still jump in the air [s]: see `coyote_time`.
  double pending_left = 0;    ///< For how long a press stays pending [s]: see `jump_buffer`.
  bool wall_left = false;     ///< The last step met something on the left of the character as it stands.
  bool wall_right = false;
  /// Movers left no room, and one of them still overlaps the character. The character stays in place. Another mover
  /// that runs into it leaves it room on the side from which the character came, or crushes it as well.
  bool crushed = false;
  Crushers crushers{};           ///< While `crushed`.
  std::uint8_t stuck_steps = 0;  ///< Number of consecutive steps that ended inside a solid.
  Ride ride;                     ///< None on ground that does not move.
  Ground ground{};               ///< After the last step. In the air all of it is as at first.

  friend bool operator==(const CharacterState&, const CharacterState&) = default;
};

/// Puts a character elsewhere at once, without a sweep: a portal, a new room, a restart. The state forgets what
/// belongs to the old place: ground and ride, coyote time, walls, the last free position, what crushed the character,
/// and how long it was stuck. It keeps its velocity (in the world: that of a ride is in it) and the state of the jump
/// button. If the place is not free, the next step resolves that: see `Controller::overlaps`.
/// @param position [m]
inline void teleport(CharacterState& state, const Vec2d& position) noexcept {
  CharacterState there;
  there.position = position;
  there.velocity = state.velocity;
  there.jumping = state.jumping;
  there.jump_held = state.jump_held;
  there.jump_pending = state.jump_pending;
  there.pending_left = state.pending_left;
  state = there;
}

/// Adds a velocity to that of the character: an explosion, a spring, a hit. The character leaves the ground, also where
/// the velocity points into it, and what carries it, whose velocity it keeps. It cannot jump before it stands again:
/// the coyote time is over; a press of the button stays pending. If it was jumping, the jump is over, too: to release
/// the button does not cut the rise. Steering works as in the air. A crushed character stays in place.
/// @param velocity [m/s]
inline void knock_back(CharacterState& state, const Vec2d& velocity) noexcept {
  state.velocity += velocity;
  state.grounded = state.jumping = false;
  state.coyote_left = 0;
  state.ride = {};
  state.ground = {};
}

}  // namespace paperproof
