/// What a step is given: choices, surroundings, memory.
#pragma once

#include <paperproof/scenery.hpp>
#include <paperproof/up_frame.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace paperproof {

/// Which colliders are there for a character in one step: those that collide by the filters, and by a predicate.
///
/// A predicate does not take seams away. Of two tiles that abut, the sides between them stay covered if one is left
/// out: the character is stopped at half the usual gap there. Chains that are one surface stay one. Give such colliders
/// different filters instead: see `ColliderDef::filter`.
struct ColliderFilter : Filter {
  /// If set, it is asked for each collider that collides by the filters: false if the collider is not there. During a
  /// step it must give the same answers, and between steps it may change them. It must not throw. It may be called from
  /// any thread that steps.
  bool (*is_there)(ColliderIndex collider, const void* user) = nullptr;
  const void* user = nullptr;  ///< Handed to `is_there`.

  [[nodiscard]] bool operator()(const Scenery& scenery, ColliderIndex collider) const noexcept {
    return (*this)(collider, scenery.collider(collider).filter);
  }
  /// @param other that of the collider.
  [[nodiscard]] bool operator()(ColliderIndex collider, const Filter& other) const noexcept {
    return collide(*this, other) && (is_there == nullptr || is_there(collider, user));
  }
};

/// The surroundings of a step. All characters of a step share them.
struct StepContext {
  Vec2d gravity{Vec2d::Zero()};  ///< [m/s²]
  double dt = 0;                 ///< Duration of the step, above zero [s].
  /// One for each mover of the scenery, or more; within +-2e6 m, and where they have an angle within +-1e6 m and
  /// radians.
  std::span<const MoverMotion> movers{};
  /// The filter of the characters. If it is null, a default filter is used. A step is as if the colliders that the
  /// filter leaves out were not in the scenery (but see `ColliderFilter` for seams): they give no contact and no event.
  const ColliderFilter* filter = nullptr;
  /// Up of the characters: any unit vector, which may differ from step to step. It decides what is horizontal (a
  /// positive `Input::move` goes along (up.y, -up.x)), where a jump goes, what `max_fall_speed` limits, which surfaces
  /// are ground, walls and ceilings, how far down `snap` looks, and the sides of contacts. Gravity is a vector of the
  /// world: turn it as well. The flags of a state are those that its last step saw. The shape does not turn, and
  /// whether a motion is free does not depend on up. Invalid input: an up that is not finite, or whose length differs
  /// from 1 by more than the rounding of `double`.
  Vec2d up{0, 1};
};

/// How a step finds the pieces that it looks at. It changes the cost of a step, and never its bits.
enum class PieceSearch : std::uint8_t {
  grid,        ///< The grid of the scenery finds those that are near.
  one_by_one,  ///< The box of each is compared.
  /// The slow, honest twin of the others. Each step looks at every piece that stands and of each mover that it comes
  /// near to, and asks for sensors, one-way chains and filters, whether the scenery has any or not.
  none,
};

struct SweepDef {
  PieceSearch search = PieceSearch::grid;
  int iterations = 12;  ///< Impacts per step before the rest of the displacement is dropped; from 1 to 60.
};

/// Memory that only its owner knows how to use.
struct OwnMemory {
  virtual ~OwnMemory() = default;
};

/// Pieces near a character: the answer of a broad phase. That of what stands still holds for the next steps as well.
struct Candidates {
  /// Pieces that go with one mover: a range of `of_movers`.
  struct OfMover {
    MoverIndex mover;
    std::size_t first;
    std::size_t end;
  };

  std::vector<PieceIndex> pieces;  ///< Those that stand still.
  Box2 box;                        ///< Positions of the character for which they are complete, if `valid`.
  bool valid = false;
  std::vector<PieceIndex> of_movers;
  std::vector<OfMover> moving;  ///< In the order of their motions.
  Box2 moving_box;              ///< The same for pieces of movers, in this step alone.
  bool moving_valid = false;
  std::uint64_t edit = 0;   ///< After so many edits of the scenery.
  bool filtered = false;    ///< Pieces that are not there are missing,
  ColliderFilter filter{};  ///< by this filter.
};

/// Memory of a step, one per thread. It belongs to the controller that made it and carries nothing
/// from one step to the next that could change a result.
struct Scratch {
  Candidates solids;
  std::unique_ptr<OwnMemory> own;  ///< Of `octagon_sweep`, and of few other techniques.
  std::unique_ptr<OwnMemory> sensors;
  std::unique_ptr<OwnMemory> turning;
  bool notes_turned = false;  ///< See `Controller::turned`.
  /// The maker of this memory: a controller refuses memory that another controller made. The mark expires with its
  /// controller, so it never matches a later controller at the same address.
  std::weak_ptr<const void> maker;
};

}  // namespace paperproof
