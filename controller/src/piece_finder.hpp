/// Which pieces may a character meet?
#pragma once

#include <paperproof/octagon_sweep.hpp>
#include <paperproof/report.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/scratch.hpp>

#include <span>
#include <vector>

namespace paperproof {

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
  [[nodiscard]] const Box2& whole(MoverIndex mover) const noexcept { return grid_of(mover).whole(); }
  /// What a box covers during a step, relative to a mover.
  [[nodiscard]] static Box2 seen_by(const Box2& box, const MoverMotion& motion) noexcept {
    return {box.lower - motion.from.cwiseMax(motion.to), box.upper - motion.from.cwiseMin(motion.to)};
  }
  /// What the character touches from positions in a box, and a little more.
  [[nodiscard]] Box2 touched_from(const Box2& positions) const noexcept {
    return {positions.lower + reach_.lower, positions.upper + reach_.upper};
  }
  [[nodiscard]] const Scenery& scenery() const noexcept { return *scenery_; }
  [[nodiscard]] PieceSearch search() const noexcept { return search_; }
  /// How far ahead of a motion candidates are collected at most [m].
  [[nodiscard]] double look_ahead() const noexcept { return look_ahead_; }

 private:
  [[nodiscard]] const PieceGrid& grid_of(MoverIndex mover) const noexcept {
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
[[nodiscard]] Box2 box_around(std::span<const PathPoint> path, const MoverMotion& motion) noexcept;

/// Has its own names for pieces.
class PieceUser {
 public:
  virtual ~PieceUser() = default;
  /// Replaces the indices of pieces by these names. It may allocate.
  virtual void prepare(std::span<PieceIndex> pieces) = 0;
  /// Forgets what is not as it was.
  virtual void follow_edits() = 0;
};

/// The pieces near a character in one step or question: each that it can touch from given positions, and perhaps more.
/// What is not there for it is left out here, once. Those that stand still are kept for the next steps, those of movers
/// for this one.
class Nearby {
 public:
  /// @param candidates made by a finder of the same pieces and the same character.
  /// @param movers one for each mover of the scenery, or none: movers are not looked at.
  /// @param filter null: all colliders are there. @param user gives the pieces its names; null: they are indices.
  Nearby(const PieceFinder& finder, Candidates& candidates, std::span<const MoverMotion> movers,
         const ColliderFilter* filter, PieceUser* user = nullptr) noexcept
      : finder_(finder), known_(candidates), movers_(movers), filter_(filter), user_(user) {
    known_.moving_valid = false;
    if (known_.edit != finder.scenery().edits().count()) [[unlikely]]
      follow_edits();
    if (filter != nullptr || known_.filtered) [[unlikely]]
      forget_others();
  }

  /// Those that stand still. Within a group pieces are in the order of `Scenery::comes_before`.
  /// @param way where the character goes [m]: the next steps will need the pieces there.
  [[nodiscard]] std::span<const PieceIndex> standing(const Box2& positions, const Vec2d& way = Vec2d::Zero()) noexcept {
    if (!known_.valid || !known_.box.contains(positions)) find_standing(positions, way);
    return known_.pieces;
  }

  /// Calls `look(pieces, mover)` for those that stand still, and for each mover that has some, at any time of the step.
  /// `look` may ask again for the same positions, or fewer.
  template <class Look>
  [[gnu::always_inline]] inline void for_each_group(const Box2& positions, const Vec2d& way,
                                                    const Look& look) noexcept {
    look(standing(positions, way), no_mover);
    for_each_moving(positions, look);
  }
  template <class Look>
  [[gnu::always_inline]] inline void for_each_moving(const Box2& positions, const Look& look) noexcept {
    if (movers_.empty()) return;
    if (!known_.moving_valid || !known_.moving_box.contains(positions)) find_moving(positions);
    for (const Candidates::OfMover& each : known_.moving)
      look(std::span<const PieceIndex>(known_.of_movers).subspan(each.first, each.end - each.first), each.mover);
  }

  /// All of them, for the caller to reorder: those of one collider are in a row. Nothing is kept.
  [[nodiscard]] std::span<PieceIndex> take(const Box2& positions) noexcept;

  /// Makes room for all that the character may meet from positions in a box, and for what all movers may bring.
  void reserve(const Box2& positions);

  /// From now on movers are looked at.
  void look_at(std::span<const MoverMotion> movers) noexcept {
    movers_ = movers;
    known_.moving_valid = false;
  }

  /// Forgets what stands still: the next answer is the same after any history.
  void forget() noexcept { known_.valid = known_.moving_valid = false; }

 private:
  void find_standing(const Box2& positions, const Vec2d& way) noexcept;
  void find_moving(const Box2& positions) noexcept;
  void forget_others() noexcept;
  void follow_edits() noexcept;
  void find(MoverIndex mover, const Box2& box, std::vector<PieceIndex>& found) const noexcept;

  const PieceFinder& finder_;
  Candidates& known_;
  std::span<const MoverMotion> movers_;
  const ColliderFilter* filter_;
  PieceUser* user_;
};

}  // namespace paperproof
