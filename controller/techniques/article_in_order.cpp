#include "techniques/article_in_order.hpp"

#include <paperproof/tolerances.hpp>

#include <limits>

namespace paperproof::article {
namespace {

class SearchInOrder {
 public:
  SearchInOrder(const Parts& parts, std::span<const PieceGroup> groups, const MoveRequest& request,
                FrameRecord& record) noexcept
      : parts_(parts),
        groups_(groups),
        request_(request),
        record_(record),
        result_(record.result()),
        position_(record.frame().start()),
        movement_(record.frame().wanted()) {}

  /// @return where the frame ends.
  Vec2d run(ImpactSearch search) noexcept {
    constexpr std::size_t most_meetings = MoveResult::max_corners - 2;  // each may be a corner of the path
    std::size_t meetings = 0;
    for (; meetings < most_meetings && time_ < 1; ++meetings) {
      const Meeting next = next_meeting(search);
      if (next.group == nullptr) break;
      respond(next);
    }
    if (meetings == most_meetings) {
      result_.status = StepStatus::dropped;
      movement_.setZero();
    }
    position_ += movement_ * (1 - time_);
    for (const Hold* hold : follows_)
      if (hold != nullptr) settle(*hold);
    find_crushes();
    return position_;
  }

 private:
  /// What a pair ran into, and went along with from then on.
  struct Hold {
    const PieceGroup* group = nullptr;  ///< Null: nothing was hit on this side.
    ColliderIndex collider = 0;
    Side side = Side::bottom;
    double since = 0;
    double until = 0;
    Vec2d seen{Vec2d::Zero()};  ///< The character's position then, as the group sees it.
  };
  /// A pair that is pressed against something that does not give way.
  struct Squeeze {
    Hold pressed;
    ColliderIndex against = 0;
  };
  /// The next thing that a pair runs into.
  struct Meeting {
    const PieceGroup* group = nullptr;  ///< Null: nothing.
    Side side = Side::bottom;
    PairImpact impact;
  };

  [[nodiscard]] Meeting next_meeting(ImpactSearch search) const noexcept {
    Meeting next;
    for (const Side side : all_sides) {
      if (is_wedged_[static_cast<std::size_t>(component_of(side))]) continue;
      for (const PieceGroup& group : groups_) {
        const Vec2d rest = (movement_ + group.drift()) * (1 - time_);
        if (rest.isZero(0) || !is_searched(side, rest)) continue;
        const PairImpact impact = search(parts_, group.pieces, record_.pair(side), seen(group, side), rest);
        if (impact.hits.empty() || (next.group != nullptr && !(impact.fraction < next.impact.fraction))) continue;
        next = {&group, side, impact};
      }
    }
    return next;
  }

  /// The pairs that face what is left of the movement; or all of them, each once.
  [[nodiscard]] bool is_searched(Side side, const Vec2d& rest) const noexcept {
    if (parts_.knobs.pairs == ArticleKnobs::Pairs::all) return holds_[static_cast<std::size_t>(side)].group == nullptr;
    return faces(side, rest[component_of(side)]);
  }

  /// The character's position now. What goes along with a group keeps its place there: were that rounded, a point
  /// would come to be on the line of a chain, or an ulp beyond, and would not be seen to cross it any more.
  [[nodiscard]] Vec2d seen(const PieceGroup& group, Side side) const noexcept {
    Vec2d result = group.seen(position_, time_);
    const Hold& hold = holds_[static_cast<std::size_t>(side)];
    if (hold.group == &group && !(time_ > hold.until)) result[component_of(side)] = hold.seen[component_of(side)];
    return result;
  }

  /// From here on the component of the pair goes as what it met does.
  void respond(const Meeting& meeting) noexcept {
    const PieceGroup& group = *meeting.group;
    const Side side = meeting.side;
    const auto component = static_cast<std::size_t>(component_of(side));
    const Vec2d landing = seen(group, side) + meeting.impact.reached;
    advance(meeting);
    for (const CollisionPointHit& each : meeting.impact.hits) record_.report(each, group, side, time_);
    const PointHit& hit = meeting.impact.hits[0].on;
    const Hold next{&group, record_.collider_of(hit), side, time_, time_, landing};
    const Hold* other = follows_[component];
    is_wedged_[component] = other != nullptr && other->side != side && !(time_ > other->since);
    // Between two, what stands still has its way; between two movers the one that was there first.
    const bool stays = is_wedged_[component] && group.mover != no_mover;
    if (is_wedged_[component]) squeezes_.push_back({stays ? next : *other, stays ? other->collider : next.collider});
    Hold& hold = holds_[static_cast<std::size_t>(side)];
    hold = next;
    if (stays) return;
    follows_[component] = &hold;
    follow(component_of(side), group);
    record_.stop(side, group, hit);
    if (side == Side::bottom) take_along(group, hit);
  }

  void advance(const Meeting& meeting) noexcept {
    const double rest = 1 - time_;
    const Vec2d carried = meeting.group->drift() * (rest * meeting.impact.fraction);
    position_ += meeting.impact.reached - carried;
    time_ += rest * meeting.impact.fraction;
    for (Hold* hold : follows_)
      if (hold != nullptr) hold->until = time_;
    if (time_ > result_.path.back().fraction && time_ < 1)
      result_.path.push_back({record_.frame().in_world(position_, time_), time_});
  }

  void follow(Eigen::Index component, const PieceGroup& group) noexcept {
    for (const Eigen::Index i : {0, 1}) {
      if (i != component && !record_.shortens()) continue;
      movement_[i] = 0 - group.drift()[i];
      record_.include(i, movement_[i]);
    }
  }

  /// What comes to rest on moving ground is carried from then on, unless it had a speed of its own along the ground.
  void take_along(const PieceGroup& group, const PointHit& hit) noexcept {
    const ColliderIndex ground = record_.collider_of(hit);
    if (!record_.frame().carries(ground) || request_.ride.ground != Ride::none || request_.velocity.x() != 0) return;
    movement_.x() = record_.frame().surface_motion(ground).x() - group.drift().x();
    record_.include(0, movement_.x());
    result_.velocity.x() = record_.frame().velocity_of(ground).x();
  }

  /// What keeps its place relative to a mover is rounded as the mover goes on: without this a point would end an ulp
  /// inside it, and penetration resolution would push it out by a whole unit. Doubling reaches any rounding error.
  void settle(const Hold& hold) noexcept {
    const auto is_free = [&](const Vec2d& position) {
      const Vec2d seen = hold.group->seen(position, 1);
      return !collides(parts_, hold.group->pieces, record_.pair(hold.side), hold.seen, seen);
    };
    if (is_free(position_)) return;
    const double scale = std::max(position_.cwiseAbs().maxCoeff(), hold.seen.cwiseAbs().maxCoeff());
    Vec2d nudged = position_;
    for (double by = std::numeric_limits<double>::epsilon() * scale; by <= Tolerances{}.touch; by *= 2) {
      const Eigen::Index component = component_of(hold.side);
      nudged[component] = position_[component] - static_cast<double>(outwards(hold.side)) * by;
      if (!is_free(nudged)) continue;
      position_ = nudged;
      return;
    }
  }

  /// A pair that has no room is crushed where what presses it runs over it, and by what it is pressed against.
  void find_crushes() noexcept {
    for (const Squeeze& squeeze : squeezes_) {
      const Hold& pressed = squeeze.pressed;
      const Vec2d end = pressed.group->seen(position_, 1);
      if (!collides(parts_, pressed.group->pieces, record_.pair(pressed.side), pressed.seen, end)) continue;
      for (const ColliderIndex collider : {pressed.collider, squeeze.against})
        if (record_.frame().mover_of(collider) != no_mover) add_once(collider, result_.crushed);
    }
  }

  const Parts& parts_;
  std::span<const PieceGroup> groups_;
  const MoveRequest& request_;
  FrameRecord& record_;
  MoveResult& result_;
  Vec2d position_;                    ///< In the frame of reference.
  Vec2d movement_;                    ///< Of a whole frame, as it is now.
  double time_ = 0;                   ///< How far the search has come.
  std::array<Hold, 4> holds_;         ///< By side.
  std::array<Hold*, 2> follows_{};    ///< By component; null: the movement is what is wanted.
  std::array<bool, 2> is_wedged_{};   ///< By component.
  FixedVector<Squeeze, 2> squeezes_;  ///< A component is wedged once.
};

}  // namespace

Vec2d meet_in_order_of_time(const Parts& parts, ImpactSearch search, std::span<const PieceGroup> groups,
                            const MoveRequest& request, FrameRecord& record) noexcept {
  return SearchInOrder(parts, groups, request, record).run(search);
}

}  // namespace paperproof::article
