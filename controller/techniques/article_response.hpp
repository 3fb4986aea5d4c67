/// What the article's techniques share: their collision points, and what happens to a movement that hits something.
///
/// The method is the article's (its part "A possibly optimum collision detection approach"): points in pairs, chosen by
/// the direction of movement; pieces near the total bounding box of current and desired position, found anew in every
/// iteration; first the search along the movement vector, where a technique has one, then penetration resolution; a
/// pair that hits changes only the component of its own direction; the position is updated at once, nothing is left of
/// the frame's movement, and the test is repeated.
///
/// Among movers all of this is about motion relative to what is met: a pair is chosen where the movement relative to a
/// mover faces that way, and a hit makes the component the mover's own, so that the mover pushes. The article asks for
/// the order of time of impact where several things move: a step with a mover (or conveyor) near is searched in that
/// order, each hit along the rest of the movement from where the last one left it; where all that is near stands still
/// it is searched pair by pair along the whole vector, as the article has it. Near is what the total bounding box
/// meets, and as far beyond as penetration resolution may push; a mover counts with all it sweeps during the step.
///
/// What stands on a mover is carried: the frame is worked out in the mover's own frame of reference. What comes to rest
/// on it is carried at once, unless it had a speed of its own along it. What a mover pushes against something that
/// stands still is not pushed through it, but crushed.
///
/// "We do nothing" where there is no collision: the movement is made, and the frame ends; no contact, no grounding.
/// What hits "the side of something" is a pair of arms. Only a bottom pair's hit is ground.
#pragma once

#include "techniques/frame_of_reference.hpp"
#include "techniques/nearby_scenery.hpp"
#include "techniques/side_points.hpp"

#include <paperproof/broad_phase.hpp>
#include <paperproof/character.hpp>
#include <paperproof/technique.hpp>
#include <paperproof/techniques.hpp>

#include <memory>
#include <span>
#include <string_view>

namespace paperproof::article {

/// How many units a search may take. Below 1e5 the bullets of the comparison would be refused; without any limit one
/// step over a million metres would take seconds. Longer movements are refused.
inline constexpr int max_search_steps = 1'000'000;
inline constexpr std::string_view too_many_units = "the motion needs more than 1,000,000 units of search in one step";

/// Where the collision points are, and which of them belong to a side.
struct CollisionPoints {
  FixedVector<Vec2d, CharacterShape::max_points> offsets;  ///< Relative to the character's position [m].
  std::array<PointPair, 4> pairs{};                        ///< By Side; a corner has the same index twice.
  Box2 box;                                                ///< Around the offsets [m].
};

/// Pieces near a character that go the same way during a step: those that stand still, or those of one mover.
struct PieceGroup {
  NearbyScenery pieces;
  MoverIndex mover = no_mover;
  Vec2d shift_at_start;  ///< See `FrameOfReference`.
  Vec2d shift_at_end;

  [[nodiscard]] Vec2d drift() const noexcept { return shift_at_end - shift_at_start; }
  /// A position of the frame of reference, at a fraction of the step, as the pieces see it.
  [[nodiscard]] Vec2d seen(const Vec2d& position, double fraction) const noexcept {
    if (!(fraction < 1)) return position + shift_at_end;
    return position + (shift_at_start + drift() * fraction);
  }
};

/// Everything that a technique of the article knows before the first step. Immutable; shareable between threads.
struct Parts {
  const Scenery* scenery = nullptr;
  std::unique_ptr<BroadPhase> broad_phase;
  CollisionPoints points;
  double unit = 0;         ///< [m]
  bool something_carries;  ///< See the function; near movers are searched in order of time.
  double fastest_surface;  ///< Of all conveyors [m/s].
  ArticleKnobs knobs;

  /// @param def its article knobs are valid. `scenery` must outlive the parts.
  Parts(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character);

  [[nodiscard]] Scratch make_scratch() const;
  /// The static pieces near the total bounding box of a character here and there.
  [[nodiscard]] NearbyScenery near(const Vec2d& here, const Vec2d& there, Scratch& scratch) const noexcept;
  /// All pieces near the box, by what they go with: first what stands still, then mover by mover. A mover of which
  /// nothing is near has no group.
  /// @param box around the character wherever it may come during the step, in the frame of reference.
  [[nodiscard]] std::span<const PieceGroup> groups_near(const Box2& box, const FrameOfReference& frame,
                                                        Scratch& scratch) const noexcept;
  /// Any of the points is in a polygon.
  [[nodiscard]] bool inside(const NearbyScenery& nearby, const Vec2d& position) const noexcept;
};

/// One of a pair's points ran into something.
struct CollisionPointHit {
  PointHit on;
  std::size_t collision_point = 0;
};

/// How far along a movement a pair can go. Without hits the whole movement is free, as far as the search can see, and
/// the other fields are not valid.
struct PairImpact {
  double fraction = 1;           ///< Of the movement, up to where the pair is free.
  Vec2d reached{Vec2d::Zero()};  ///< The part of the movement that is free [m]. Zero where the
                                 ///< pair is in something from the start.
  FixedVector<CollisionPointHit, 2> hits;
};

/// Some point of the pair would be in something at `to`, or run across a chain on the way.
/// @param from, to positions of the character as the pieces see it.
[[nodiscard]] bool collides(const Parts& parts, const NearbyScenery& nearby, const PointPair& pair, const Vec2d& from,
                            const Vec2d& to) noexcept;

/// Searches along `movement` (not zero) of a character at `position`, for one pair.
using ImpactSearch = PairImpact (*)(const Parts& parts, const NearbyScenery& nearby, const PointPair& pair,
                                    const Vec2d& position, const Vec2d& movement) noexcept;

/// One frame of the article's method.
/// @param search null: penetration resolution alone, which looks only at where the character arrives.
void move(const Parts& parts, ImpactSearch search, const MoveRequest& request, Scratch& scratch,
          MoveResult& result) noexcept;

/// Fills `result` as a refusal and returns true where the movement leaves the range of the tolerances.
[[nodiscard]] bool refuse_out_of_range(const MoveRequest& request, MoveResult& result) noexcept;

/// The step would lead beyond the range of the tolerances, alone, carried or pushed; or is no number.
[[nodiscard]] bool leaves_range(const Scenery& scenery, double fastest_surface, const MoveRequest& request) noexcept;

/// Fills `result` as a refusal and returns true where the movement leaves the range of the tolerances, or would take
/// more than `max_search_steps` units to search and `searches_by_units`.
[[nodiscard]] bool refuse(const Parts& parts, bool searches_by_units, const MoveRequest& request,
                          MoveResult& result) noexcept;

/// Fills `result` as a refusal: nothing moved.
void refuse(const MoveRequest& request, MoveResult& result, StepStatus why = StepStatus::out_of_range) noexcept;

/// Makes `result`, whose `crushed` is filled in, that of a character that stays where the step began.
void stay_crushed(const MoveRequest& request, MoveResult& result) noexcept;

/// What is there already is not added again.
template <class Colliders>
void add_once(ColliderIndex collider, Colliders& all) noexcept {
  if (std::find(all.begin(), all.end(), collider) == all.end()) all.push_back(collider);
}

/// Adds a contact with the collider that was hit, once for each collider and side; its separation is left at zero.
/// @return false where it was there already, or nothing more fits.
bool add_contact(const Scenery& scenery, const PointHit& hit, Side side, double fraction, MoveResult& result) noexcept;

/// The points of a pair, or its one point where the side is a corner.
[[nodiscard]] inline std::span<const std::size_t> distinct(const PointPair& pair) noexcept {
  return std::span(pair).first(pair[0] == pair[1] ? 1U : 2U);
}

}  // namespace paperproof::article
