/// Memory of a step. The scenery sizes it, so that no fixed number decides what a step does or reports.
#pragma once

#include "step/narrow_phase.hpp"
#include "step/response.hpp"

#include <paperproof/report.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/step_context.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// A piece that stops a motion.
struct Stop {
  PieceIndex piece;
  Real stop;      ///< Fraction of the motion.
  Real together;  ///< Stops that are no further apart than this are one impact.
  EntryAxes axes;
};

/// A surface that the character touches. No motion may enter it.
struct TouchedSurface {
  PieceIndex piece;
  MoverIndex mover;
  std::size_t axis;
  Vec2 normal;
  Real offset;  ///< Of the surface along its normal [m].
};

/// Where a straight motion is nearest to a piece.
struct Nearest {
  PieceIndex piece;
  std::size_t axis;
  Real separation;  ///< [m]
  Real when;        ///< Fraction of the motion.
};

/// What a collider is for the character during a step; it may have several roles.
enum Role : std::uint8_t {
  overlaps_since_start = 1,  ///< It overlaps the character since an earlier step, and is ignored.
  crushes = 2,               ///< It crushed the character in this step, and is ignored since.
  leaving = 4,               ///< The step began inside it, and left it.
  overlaps_at_end = 8,       ///< It was ignored, and overlaps the character at the end of the step.
  known = 16,                ///< It has or had one of these.
};
inline constexpr std::uint8_t passes_through = overlaps_since_start | crushes;

/// Stairs that a walker climbs in one step, at most.
inline constexpr int most_stairs = 4;

/// What a step had reported at a corner of its path, and how it went on from there.
struct Reported {
  std::size_t contacts = 0;  ///< How many.
  Real impact = 0;           ///< The latest time of impact among them: no later motion meets anything before it.
  // Where movers are near:
  Desired velocity{Vec2::Zero(), Vec2::Zero()};  ///< [m/s]
  Real steered = 0;                              ///< See `Step`; of that.
};

/// One per thread; a step leaves nothing in it that the next one uses.
struct StepMemory final : OwnMemory, PieceUser {
  StepMemory(const CharacterShape& shape, const PieceFinder& solids) : space(shape, solids) { fit_to_scenery(); }

  void prepare(std::span<PieceIndex> pieces, MoverIndex mover, double angle) override {
    space.prepare(pieces, mover, angle);
  }
  void follow_edits() override {
    space.follow_edits();
    fit_to_scenery();
  }
  void fit_to_scenery() {
    const Scenery& scenery = space.scenery();
    most_corners = 2 * MoveResult::max_corners + 4 * scenery.counts().moving_pieces;
    reported_at.resize(most_corners);
    clear();
    roles.assign(scenery.counts().moving_pieces > 0 || scenery.counts().conveyors > 0 ? scenery.collider_count() : 0,
                 0);
  }

  /// Makes room for as many surfaces as a report has contacts without growing, and for all that may crush.
  void reserve() {
    surfaces.reserve(MoveResult::max_contacts);
    pressing.reserve(MoveResult::max_contacts);
    planes.reserve(MoveResult::max_contacts);
    marked.reserve(roles.size());
    crushers.reserve(space.scenery().counts().moving_pieces);
  }

  /// Forgets the last step.
  void clear() {
    for (const ColliderIndex collider : marked) roles[Scenery::slot_of(collider)] = 0;
    marked.clear();
    surfaces.clear();
    pressing.clear();
    crushers.clear();
  }
  /// Without effect where nothing moves: then a ride in the state comes from another scenery.
  void mark(ColliderIndex collider, Role role) {
    if (roles.empty()) return;
    std::uint8_t& roles_of = roles[Scenery::slot_of(collider)];
    if (roles_of == 0) marked.push_back(collider);
    roles_of |= role | known;
  }
  void unmark(ColliderIndex collider, Role role) {
    std::uint8_t& roles_of = roles[Scenery::slot_of(collider)];
    roles_of = static_cast<std::uint8_t>(roles_of & ~role);
  }
  [[nodiscard]] bool is(ColliderIndex collider, std::uint8_t any_of) const {
    return !marked.empty() && (roles[Scenery::slot_of(collider)] & any_of) != 0;
  }

  ConfigurationSpace space;
  std::size_t most_corners = 0;          ///< Of the path: movers may add any number. A step that needs more is dropped.
  std::vector<Reported> reported_at;     ///< At each corner of the path.
  std::vector<std::uint8_t> roles;       ///< Of each collider, where anything moves: bits of `Role`.
  std::vector<ColliderIndex> marked;     ///< Colliders with a role, in the order in which they got one.
  std::vector<TouchedSurface> surfaces;  ///< Those that are touched now, one per piece.
  std::vector<TouchedSurface> pressing;  ///< Those that left no motion, on the way to a free position.
  std::vector<HalfPlane> planes;         ///< What the touched surfaces allow.
  /// Movers that crushed, now or before, with their displacement at the end of the step.
  std::vector<Crusher> crushers;
};

/// The movers of one step. Of `no_mover`, which is what stands still, each answer is zero, and `relative` the motion
/// itself.
struct MoversInStep {
  const Moving& moving;
  Real dt;      ///< [s]
  bool active;  ///< A mover comes near the step, or there may be a conveyor.

  /// The index of a collider's motion.
  [[nodiscard]] MoverIndex of(const Scenery& scenery, ColliderIndex collider) const {
    const auto is_it = [&](PieceIndex piece) { return scenery.pieces()[piece].collider == collider; };
    const auto piece = std::ranges::find_if(moving.apart, is_it);
    if (piece == moving.apart.end()) return scenery.collider(collider).mover;
    return static_cast<MoverIndex>(moving.mover_count() + static_cast<std::size_t>(piece - moving.apart.begin()));
  }
  /// Displacement of a mover in the step [m].
  [[nodiscard]] Vec2 displacement(MoverIndex mover) const {
    return mover == no_mover ? Vec2(Vec2::Zero()) : Vec2(moving.motions[mover].to - moving.motions[mover].from);
  }
  /// [m/s]
  [[nodiscard]] Vec2 velocity(MoverIndex mover) const { return displacement(mover) / dt; }
  /// Its offset at a fraction of the step [m].
  [[nodiscard]] Vec2 offset(MoverIndex mover, Real time) const {
    return mover == no_mover ? Vec2(Vec2::Zero()) : Vec2(moving.motions[mover].at(time));
  }
  /// What is left of its displacement after a fraction of the step [m].
  [[nodiscard]] Vec2 remaining(MoverIndex mover, Real time) const { return displacement(mover) * (1 - time); }

  /// A motion for the rest of the step, relative to a mover [m]. What is nothing but rounding becomes zero: a rider at
  /// rest rests, and a sweep that looks ahead does not take noise for a direction.
  [[nodiscard]] Vec2 relative(const Vec2& motion, MoverIndex mover, Real time) const {
    if (mover == no_mover) return motion;
    constexpr Real noise = std::numeric_limits<Real>::epsilon() * 8;
    const Vec2 whole = displacement(mover);
    // Each offset is rounded: at a constant speed the displacement of a mover differs by an ulp from step to step.
    const Vec2 furthest = moving.motions[mover].from.cwiseAbs().cwiseMax(moving.motions[mover].to.cwiseAbs());
    Vec2 result = motion - remaining(mover, time);
    for (Eigen::Index i = 0; i < 2; ++i)
      if (std::abs(result[i]) <= noise * std::max({std::abs(motion[i]), std::abs(whole[i]), furthest[i]}))
        result[i] = 0;
    return result;
  }
};

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
