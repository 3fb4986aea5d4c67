/// Which pieces may a character meet?
#pragma once

#include <paperproof/report.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/step_context.hpp>

#include "geometry/pose.hpp"
#include "inlining.hpp"

#include <span>
#include <vector>

namespace paperproof {

/// What moves in a step, and how.
struct Moving {
  /// Of each mover of the scenery, then of each of `apart`. A mover has the angle that it has at the end.
  std::span<const MoverMotion> motions{};
  /// Pieces that go by themselves: the bodies of other characters; and circles of movers that have an angle, as the
  /// centre of each goes straight. (It carries by the turn of its motion.)
  std::span<const PieceIndex> apart{};

  [[nodiscard]] std::size_t mover_count() const { return motions.size() - apart.size(); }
  /// @param mover index of a motion, or `no_mover`.
  [[nodiscard]] MoverMotion motion_of(MoverIndex mover) const {
    return mover == no_mover ? MoverMotion{} : motions[mover];
  }
};

/// Finds the solid pieces of a scenery, or its sensors, by positions of a character. Immutable; shareable between
/// threads.
class PieceFinder {
 public:
  enum class Kind : std::uint8_t { solids, sensors };

  /// @param scenery must outlive the finder.
  /// @param reach what the character at the origin touches, and a little more [m].
  PieceFinder(const Scenery& scenery, Kind kind, const Box2& reach, PieceSearch search);

  /// Appends the pieces of one mover, or those that stand still, whose boxes meet `box`. Their order means nothing.
  void find(MoverIndex mover, const Box2& box, std::vector<PieceIndex>& found) const;
  /// Around all pieces of a mover at offset zero.
  [[nodiscard]] const Box2& whole(MoverIndex mover) const { return grid_of(mover).whole(); }
  /// Whether pieces that move may come into a box during a step.
  [[nodiscard]] bool any_comes_into(const Box2& box, const Moving& moving) const;
  /// What a box covers during a step, relative to a mover.
  [[nodiscard]] static Box2 seen_by(const Box2& box, const MoverMotion& motion) {
    return {box.lower - motion.from.cwiseMax(motion.to), box.upper - motion.from.cwiseMin(motion.to)};
  }
  /// What the character touches from positions in a box, and a little more.
  [[nodiscard]] Box2 touched_from(const Box2& positions) const { return positions + reach_; }
  [[nodiscard]] const Scenery& scenery() const { return *scenery_; }
  /// Whether it finds pieces of this kind.
  [[nodiscard]] bool has(PieceIndex piece) const {
    return scenery_->pieces()[piece].sensor == (kind_ == Kind::sensors);
  }
  [[nodiscard]] PieceSearch search() const { return search_; }
  /// How far ahead of a motion candidates are collected at most [m].
  [[nodiscard]] double look_ahead() const { return look_ahead_; }

 private:
  [[nodiscard]] const PieceGrid& grid_of(MoverIndex mover) const {
    const Scenery::Group& group = scenery_->group_of(mover);
    return kind_ == Kind::solids ? group.solids : group.sensors;
  }

  const Scenery* scenery_;
  Kind kind_;
  PieceSearch search_;
  Box2 reach_;
  double look_ahead_;
};

/// Around all corners of a path, relative to a mover [m].
[[nodiscard]] Box2 box_around(std::span<const PathPoint> path, const MoverMotion& motion);

/// Has its own names for pieces.
class PieceUser {
 public:
  virtual ~PieceUser() = default;
  /// Replaces the indices of pieces by these names. It may allocate.
  /// @param mover index of their motion. @param angle that they have [rad].
  virtual void prepare(std::span<PieceIndex> pieces, MoverIndex mover, double angle) = 0;
  /// Forgets what is not as it was.
  virtual void follow_edits() = 0;
};

/// The pieces near a character in one step or question: each that it can touch from given positions, and perhaps more.
/// What is not there for it is left out here, once. Those that stand still are kept for the next steps, those of movers
/// for this one.
class Nearby {
 public:
  /// @param candidates made by a finder of the same pieces and the same character.
  /// @param moving null: movers are not looked at. @param filter null: all colliders are there.
  /// @param user gives the pieces its names; null: they are indices.
  Nearby(const PieceFinder& finder, Candidates& candidates, const Moving* moving, const ColliderFilter* filter,
         PieceUser* user = nullptr)
      : finder_(finder), known_(candidates), moving_(moving), filter_(filter), user_(user) {
    known_.moving_valid = false;
    if (known_.edit != finder.scenery().edits().count()) [[unlikely]]
      follow_edits();
    if (filter != nullptr || known_.filtered) [[unlikely]]
      forget_others();
  }

  /// Those that stand still. Within a group pieces are in the order of `Scenery::comes_before`.
  /// @param way where the character goes [m]: the next steps will need the pieces there.
  [[nodiscard]] std::span<const PieceIndex> standing(const Box2& positions, const Vec2d& way = Vec2d::Zero()) {
    if (!known_.valid || !known_.box.contains(positions)) find_standing(positions, way);
    return known_.pieces;
  }

  /// Calls `look(pieces, mover)` for those that stand still, and for each motion that some have, at any time of the
  /// step. `look` may ask again for the same positions, or fewer.
  template <class Look>
  PAPERPROOF_INLINE void for_each_group(const Box2& positions, const Vec2d& way, const Look& look) {
    look(standing(positions, way), no_mover);
    for_each_moving(positions, look);
  }
  template <class Look>
  PAPERPROOF_INLINE void for_each_moving(const Box2& positions, const Look& look) {
    if (moving_ == nullptr) return;
    if (!known_.moving_valid || !known_.moving_box.contains(positions)) find_moving(positions);
    for (const Candidates::OfMover& each : known_.moving)
      look(std::span<const PieceIndex>(known_.of_movers).subspan(each.first, each.end - each.first), each.mover);
  }

  /// All of them, for the caller to reorder: those of one collider are in a row. Nothing is kept.
  [[nodiscard]] std::span<PieceIndex> take(const Box2& positions);

  /// Makes room for all that the character may meet from positions in a box, and for what all movers may bring.
  void reserve(const Box2& positions);

  /// From now on movers are looked at.
  void look_at(const Moving& moving) {
    moving_ = &moving;
    known_.moving_valid = false;
  }

  /// Forgets what stands still: the next answer is the same after any history.
  void forget() { known_.valid = known_.moving_valid = false; }

 private:
  void find_standing(const Box2& positions, const Vec2d& way);
  void find_moving(const Box2& positions);
  void forget_others();
  void follow_edits();
  void find(MoverIndex mover, const Box2& box, double angle, std::vector<PieceIndex>& found) const;
  void add_moving(MoverIndex mover, const Box2& touched);
  void arrange(std::size_t first, std::vector<PieceIndex>& found) const;
  void name(std::span<PieceIndex> pieces, MoverIndex motion) const;

  const PieceFinder& finder_;
  Candidates& known_;
  const Moving* moving_;
  const ColliderFilter* filter_;
  PieceUser* user_;
};

}  // namespace paperproof
