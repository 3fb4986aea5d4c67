/// The one interface of the techniques: the wanted move goes in, the possible move comes out.
#pragma once

#include <paperproof/crowd.hpp>
#include <paperproof/report.hpp>
#include <paperproof/step_context.hpp>

#include <span>
#include <string_view>

namespace paperproof {

struct MoveRequest {
  Vec2d position{Vec2d::Zero()};          ///< Where the step begins [m].
  Vec2d displacement{Vec2d::Zero()};      ///< The wanted displacement [m].
  Vec2d velocity{Vec2d::Zero()};          ///< The velocity behind the displacement [m/s].
  Vec2d technique_memory{Vec2d::Zero()};  ///< See `CharacterState::technique_memory`.
  bool drop = false;                      ///< One-way chains do not block: see `Input::drop`.
  std::span<const MoverMotion> movers{};  ///< One for each mover of the scenery.
  double dt = 0;                          ///< [s]
  /// The ground that carries the character, if any: `displacement` and `velocity` are then relative to this ground, and
  /// the technique adds the ground's motion.
  Ride ride{};
};

/// A way to find out how far a character can move. Const and shareable between threads; each thread brings its scratch.
/// Up is (0, 1), and every collider is there for every character.
class Technique {
 public:
  virtual ~Technique() = default;
  /// The technique's name on the command line.
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  [[nodiscard]] virtual Scratch make_scratch() const = 0;
  /// Size of the technique's own copy of the level [bytes]; 0 for a technique that reads the scenery.
  [[nodiscard]] virtual std::size_t memory_bytes() const noexcept { return 0; }
  /// Never allocates and never throws.
  /// @param scratch made by this technique, which is not checked here.
  virtual void move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept = 0;
};

/// A technique that moves several characters in one call.
class JointTechnique : public Technique {
 public:
  /// Memory for up to `most_characters`. For one character it is the memory of `make_scratch`.
  [[nodiscard]] virtual Scratch make_joint_scratch(std::size_t most_characters) const = 0;

  /// Never allocates and never throws.
  /// @param requests one for each character, all with the same movers; at most as many as the scratch was made for.
  /// @param report has at least as many members, cleared. The technique sets `step.move`, `met` (see
  ///   `CrowdReport::add_contact`), `started_overlapping` and `island` of each, and the `impacts` of the report.
  /// @return false if a step would leave the range that the technique is made for: then nothing moved.
  virtual bool move_together(std::span<const MoveRequest> requests, Scratch& scratch,
                             CrowdReport& report) const noexcept = 0;
};

}  // namespace paperproof
