/// The memory of a step.
#pragma once

#include <paperproof/step_context.hpp>

#include <memory>
#include <vector>

namespace paperproof {

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
  std::size_t count = 0;           ///< How many of them, where a technique keeps the rest of them as room.
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
