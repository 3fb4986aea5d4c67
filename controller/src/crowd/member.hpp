/// What a crowd that moves by `octagon_sweep` knows before the first step, and remembers during one.
///
/// Each character is moved by `octagon_sweep` as if it were alone. The others that it avoids are its obstacles: the
/// scenery of a crowd has a few slots, colliders of the character's shape with a mover each, and each obstacle takes
/// one. So what holds among movers holds among characters: falling between them, being pushed and crushed.
#pragma once

#include "crowd/impact_queue.hpp"
#include "step/octagon_sweep.hpp"

#include <paperproof/crowd.hpp>

#include <vector>

namespace paperproof::crowd {

/// So many others can be obstacles of one character in one step. If it hits more it holds its position.
inline constexpr std::size_t max_obstacles = 12;

using Obstacles = FixedVector<CharacterIndex, max_obstacles>;

/// What does not change from step to step.
struct SweepRules {
  SweepRules(const Scenery& scene, const CharacterDef& character, int iterations)
      : scenery(with_slots(scene, character.shape)),
        first_slot(static_cast<ColliderIndex>(scene.collider_count())),
        space(character.shape),
        walkable_cosine(character.walkable_cosine()),
        max_replans(iterations) {}

  [[nodiscard]] bool is_character(ColliderIndex collider) const noexcept {
    return collider >= first_slot && collider != no_collider;
  }

  Scenery scenery;           ///< That of the scene, and the slots.
  ColliderIndex first_slot;  ///< The collider of the first slot.
  PairSpace space;
  double walkable_cosine;  ///< Least upward component of a normal that is stood on.
  int max_replans;  ///< After so many new paths in one step a character stops steering. After twice as many it holds
                    ///< its position.
  const octagon_sweep::SweepInParts* sweep = nullptr;  ///< Made for `scenery`.

 private:
  [[nodiscard]] static SceneryDef with_slots(const Scenery& scene, const CharacterShape& shape) {
    SceneryDef def = scene.as_run();
    ColliderDef slot{.points = {shape.hull().begin(), shape.hull().end()}, .carries = false};
    for (std::size_t k = 0; k < max_obstacles; ++k) {
      slot.mover = static_cast<MoverIndex>(scene.mover_count() + k);
      def.colliders.push_back(slot);
    }
    return def;
  }
};

/// A moment of a step of one character: what one part of its path hands to the next.
struct Moment {
  double time = 0;        ///< Fraction of the step.
  CharacterState state;   ///< Its velocity is not kept up to date.
  Vec2d own_velocity;     ///< Relative to what carries it [m/s].
  double steered = 0;     ///< The part of `own_velocity` across up that this step's steering added [m/s].
  double crushed_at = 1;  ///< The end of the first part that crushed the character.
};

/// One character during a step. What it has done up to now stands in its report, what it is about to do here.
struct Member {
  Moment start;
  Moment now;
  Moment end;           ///< Of the plan.
  MoveResult plan;      ///< From now to the end of the step; its fractions are those of the step.
  Box2 box;             ///< Around the shape along the plan, and a little more.
  Obstacles obstacles;  ///< The characters that it avoids. The k-th of them takes the k-th slot of the scenery.
  int replans = 0;
  bool holds_position = false;  ///< For the rest of the step. It has no obstacles, and is one.
  bool follows_ground = false;  ///< It was on the ground and does not jump: its path follows the ground down.
  bool ground_taken = false;    ///< Another character is where it would follow the ground down to: it does not.
  double next_dt = 0;           ///< See `StepRequest`.
  bool drops = false;           ///< One-way chains do not hold it in this step.
  bool dropped = false;         ///< Its step was cut short.
  bool starts_stuck = false;    ///< It began inside scenery, and there was no way out.
};

/// Memory for a step of a crowd.
struct CrowdMemory final : OwnMemory {
  std::vector<CharacterState> states;                               ///< Those handed to the step, as they will be.
  std::vector<std::optional<octagon_sweep::StepRequest>> requests;  ///< What each character wants.
  Scratch scratch;                                                  ///< Of the technique.
  // The rest is for `octagon_sweep`.
  std::vector<Member> members;
  std::vector<PairImpact> impacts;
  std::vector<MoverMotion> motions;  ///< Of all movers and slots, during a part of a path.
  MoveResult part;                   ///< What the technique says about that part.
  MoveResult path;                   ///< The path that was planned last.
};

/// One step of a crowd: what all its parts read and write.
struct CrowdStep {
  const SweepRules& rules;
  CrowdMemory& memory;
  CrowdReport& report;
  std::span<Member> members;
  Vec2d gravity;  ///< [m/s²]
  double dt;      ///< [s]
  std::span<const MoverMotion> movers;
  const ColliderFilter* filter;  ///< See `Around`.
  UpFrame up;

  /// What a character has done up to now.
  [[nodiscard]] MoveResult& made(CharacterIndex i) const noexcept { return report.members[i].step.move; }
};

}  // namespace paperproof::crowd
