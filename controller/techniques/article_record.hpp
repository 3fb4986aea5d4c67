/// What one frame of the article's method has hit, on its way into the result.
#pragma once

#include "techniques/article_response.hpp"

namespace paperproof::article {

/// Keeps what the parts of a frame have in common: contacts, velocity and ground go into the result, and the directions
/// in which the character was moved say which pairs are tested.
class FrameRecord {
 public:
  using Colliders = FixedVector<ColliderIndex, 64>;

  /// Begins `result`: its velocity, and the start of its path.
  FrameRecord(const Parts& parts, const MoveRequest& request, MoveResult& result) noexcept;

  [[nodiscard]] const FrameOfReference& frame() const noexcept { return frame_; }
  [[nodiscard]] MoveResult& result() noexcept { return result_; }
  [[nodiscard]] bool shortens() const noexcept { return parts_.knobs.response == ArticleKnobs::Response::shorten; }
  [[nodiscard]] const PointPair& pair(Side side) const noexcept {
    return parts_.points.pairs[static_cast<std::size_t>(side)];
  }
  [[nodiscard]] ColliderIndex collider_of(const PointHit& hit) const noexcept {
    return parts_.scenery->pieces()[hit.piece].collider;
  }

  /// The pairs that face a movement of the frame relative to the group, or all of them.
  [[nodiscard]] bool is_tested(Side side, const PieceGroup& group) const noexcept {
    if (parts_.knobs.pairs == ArticleKnobs::Pairs::all) return true;
    const Eigen::Index i = component_of(side);
    const double drift = group.shift_at_end[i] - group.shift_at_start[i];
    // Of the movements the furthest to that side is enough.
    return outwards(side) < 0 ? least_[i] + drift < 0 : most_[i] + drift > 0;
  }
  /// The frame's movement had this component for a while: pairs that face it are tested.
  void include(Eigen::Index component, double along) noexcept;

  /// Adds a contact.
  void report(const CollisionPointHit& hit, const PieceGroup& group, Side side, double fraction) noexcept;
  /// The velocity becomes that of what was hit, in the direction of the pair. What is below is ground.
  void stop(Side side, const PieceGroup& group, const PointHit& hit) noexcept;
  /// A mover gave the character some of its motion.
  void add_pusher(const PointHit& hit) noexcept { add_once(collider_of(hit), pushers_); }
  [[nodiscard]] const Colliders& pushers() const noexcept { return pushers_; }
  /// Fills in the separations of all contacts, for a frame that ended at `position`.
  void measure_gaps(const Vec2d& position) noexcept;

 private:
  /// Where the character touched something.
  struct Touch {
    std::size_t collision_point = 0;
    MoverIndex mover = no_mover;
    Vec2d point;  ///< Relative to the mover's offset.
  };

  const Parts& parts_;
  MoveResult& result_;
  FrameOfReference frame_;
  Vec2d least_;  ///< Of all movements that the frame had, by component.
  Vec2d most_;
  Colliders pushers_;
  FixedVector<Touch, MoveResult::max_contacts> touches_;  ///< Of each contact.
};

/// The pair of that side meets what lies along a movement with this component.
[[nodiscard]] inline bool faces(Side side, double along) noexcept { return outwards(side) < 0 ? along < 0 : along > 0; }

}  // namespace paperproof::article
