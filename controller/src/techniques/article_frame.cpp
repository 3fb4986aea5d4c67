#include "techniques/article_response.hpp"

#include <cmath>
#include <limits>

namespace paperproof::article {
namespace {

/// One frame while it is worked out.
template <class Scalar>
class Frame {
 public:
  Frame(const Parts<Scalar>& parts, const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
        MoveResult<Scalar>& result) noexcept
      : parts_(parts),
        request_(request),
        scratch_(scratch),
        result_(result),
        frame_(*parts.scenery, request),

        position_(frame_.start()),
        movement_(frame_.wanted()),
        least_(frame_.wanted()),
        most_(frame_.wanted()) {
    result_.clear();
    result_.velocity = frame_.velocity();
    result_.path.push_back({request.position, 0});
    if (parts_.something_carries) measure_reach();
  }

  void run(ImpactSearch<Scalar> search) noexcept {
    for (int iteration = 0; iteration < parts_.knobs.iterations; ++iteration) {
      look_around();
      if (iteration == 0) see_where_it_begins();
      bool hit = false;
      if (search != nullptr && !parts_.something_carries) hit = shorten_along(search);
      if (search != nullptr && parts_.something_carries && iteration == 0) hit = meet_in_order_of_time(search);
      hit = resolve_penetration() || hit;
      position_ += movement_;
      if (!hit) break;
      movement_.setZero();
    }
    finish();
  }

 private:
  using Group = PieceGroup<Scalar>;

  /// What a pair ran into, and went along with from then on.
  struct Hold {
    const Group* group = nullptr;  ///< Null: nothing was hit on this side.
    ColliderIndex collider = 0;
    Side side = Side::bottom;
    Scalar since = 0;
    Scalar until = 0;
    Vec2<Scalar> seen{Vec2<Scalar>::Zero()};  ///< The character's position then, as the group sees it.
  };
  /// A pair that is pressed against something that does not give way.
  struct Squeeze {
    Hold pressed;
    ColliderIndex against = 0;
  };
  /// The next thing that a pair runs into.
  struct Meeting {
    const Group* group = nullptr;  ///< Null: nothing.
    Side side = Side::bottom;
    PairImpact<Scalar> impact;
  };
  /// Where the character touched something.
  struct Touch {
    std::size_t collision_point = 0;
    MoverIndex mover = no_mover;
    Vec2<Scalar> point;  ///< Relative to the mover's offset.
  };
  /// How far the movement can lead: each component is at any time the one that was wanted, or that of something hit.
  void measure_reach() noexcept {
    reach_ = {movement_.cwiseMin(Vec2<Scalar>::Zero()), movement_.cwiseMax(Vec2<Scalar>::Zero())};
    const auto include = [&](MoverIndex mover) {
      const Vec2<Scalar> motion = frame_.shift_at_start(mover) - frame_.shift_at_end(mover);
      reach_ = reach_.merged({motion, motion});
    };
    include(no_mover);
    for (MoverIndex mover = 0; mover < request_.movers.size(); ++mover) include(mover);
  }

  /// Finds the pieces near the total bounding box: anew in every iteration.
  void look_around() noexcept {
    const Box2<Scalar>& body = parts_.points.box;
    const Vec2<Scalar> there = position_ + movement_;
    Box2<Scalar> total{position_.cwiseMin(there) + body.lower, position_.cwiseMax(there) + body.upper};
    if (parts_.something_carries) {
      const Vec2<Scalar> extent = body.upper - body.lower;  // how far penetration resolution may push beyond
      total = total.merged({frame_.start() + reach_.lower + body.lower, frame_.start() + reach_.upper + body.upper})
                  .inflated(extent.maxCoeff() + parts_.unit);
    }
    groups_ = parts_.groups_near(total, frame_, scratch_);
  }

  void see_where_it_begins() noexcept {
    for (const Group& group : groups_) {
      const bool inside = parts_.inside(group.pieces, group.seen(position_, 0));
      began_inside_ = began_inside_ || inside;
      if (group.mover == no_mover) began_in_static_ = inside;
    }
  }

  [[nodiscard]] const CharacterShape::Pair& pair(Side side) const noexcept {
    return parts_.points.pairs[static_cast<std::size_t>(side)];
  }
  [[nodiscard]] static bool faces(Side side, Scalar along) noexcept {
    return outwards(side) < 0 ? along < 0 : along > 0;
  }

  /// The pairs that face the movement of the frame relative to the group, or all of them.
  [[nodiscard]] bool is_tested(Side side, const Group& group) const noexcept {
    const Eigen::Index i = component_of(side);
    const Scalar drift = group.drift()[i];
    return parts_.knobs.pairs == ArticleKnobs::Pairs::all || faces(side, least_[i] + drift) ||
           faces(side, most_[i] + drift);
  }

  /// Speculative contacts: shortens the movement, in each direction in turn, to where its pair would hit.
  bool shorten_along(ImpactSearch<Scalar> search) noexcept {
    bool hit = false;
    Vec2<Scalar> free{1, 1};  // the fraction of the frame after which each component stops
    for (const Side side : all_sides) {
      if (groups_.empty() || !is_tested(side, groups_.front()) || movement_.isZero(0)) continue;
      const PairImpact<Scalar> impact = search(parts_, groups_.front().pieces, pair(side), position_, movement_);
      if (impact.hits.empty()) continue;
      hit = true;
      const Scalar fraction = shorten(side, impact, free);
      for (const CollisionPointHit<Scalar>& each : impact.hits) report(each, groups_.front(), side, fraction);
      stop(side, groups_.front(), impact.hits[0].on);
    }
    record_way(free);
    return hit;
  }

  /// @return the fraction of the frame at which the pair hit.
  Scalar shorten(Side side, const PairImpact<Scalar>& impact, Vec2<Scalar>& free) noexcept {
    if (shortens()) {
      movement_ = impact.reached;
      free *= impact.fraction;
      return free.x();
    }
    const Eigen::Index component = component_of(side);
    movement_[component] = impact.reached[component];
    free[component] *= impact.fraction;
    return free[component];
  }
  [[nodiscard]] bool shortens() const noexcept { return parts_.knobs.response == ArticleKnobs::Response::shorten; }

  /// The corners of the way: each component moves at its own pace until it stops.
  void record_way(const Vec2<Scalar>& free) noexcept {
    const Scalar first = std::min(free.x(), free.y());
    const Scalar last = std::max(free.x(), free.y());
    for (const Scalar fraction : {first, last}) {
      if (!(fraction > result_.path.back().fraction) || !(fraction < 1)) continue;
      Vec2<Scalar> way = movement_;
      for (const Eigen::Index i : {0, 1}) {
        if (fraction < free[i]) way[i] = frame_.wanted()[i] * fraction;
      }
      result_.path.push_back({position_ + way, fraction});
    }
  }

  /// Speculative contacts among movers: from one time of impact to the next, with the rest of the movement. What is
  /// left for penetration resolution is a movement of zero.
  bool meet_in_order_of_time(ImpactSearch<Scalar> search) noexcept {
    constexpr std::size_t most_meetings = MoveResult<Scalar>::max_corners - 2;  // each may be a corner of the path
    std::size_t meetings = 0;
    for (; meetings < most_meetings && time_ < 1; ++meetings) {
      const Meeting next = next_meeting(search);
      if (next.group == nullptr) break;
      respond(next);
    }
    if (meetings == most_meetings) {
      result_.status = MoveStatus::dropped;
      movement_.setZero();
    }
    position_ += movement_ * (1 - time_);
    movement_.setZero();
    for (const Hold* hold : follows_)
      if (hold != nullptr) settle(*hold);
    find_crushes();
    return meetings > 0;
  }

  [[nodiscard]] Meeting next_meeting(ImpactSearch<Scalar> search) const noexcept {
    Meeting next;
    for (const Side side : all_sides) {
      if (is_wedged_[static_cast<std::size_t>(component_of(side))]) continue;
      for (const Group& group : groups_) {
        const Vec2<Scalar> rest = (movement_ + group.drift()) * (1 - time_);
        if (rest.isZero(0) || !is_searched(side, rest)) continue;
        const PairImpact<Scalar> impact = search(parts_, group.pieces, pair(side), seen(group, side), rest);
        if (impact.hits.empty() || (next.group != nullptr && !(impact.fraction < next.impact.fraction))) continue;
        next = {&group, side, impact};
      }
    }
    return next;
  }

  /// The pairs that face what is left of the movement; or all of them, each once.
  [[nodiscard]] bool is_searched(Side side, const Vec2<Scalar>& rest) const noexcept {
    if (parts_.knobs.pairs == ArticleKnobs::Pairs::all) return holds_[static_cast<std::size_t>(side)].group == nullptr;
    return faces(side, rest[component_of(side)]);
  }

  /// The character's position now. What goes along with a group keeps its place there: were that rounded, a point
  /// would come to be on the line of a chain, or an ulp beyond, and would not be seen to cross it any more.
  [[nodiscard]] Vec2<Scalar> seen(const Group& group, Side side) const noexcept {
    Vec2<Scalar> result = group.seen(position_, time_);
    const Hold& hold = holds_[static_cast<std::size_t>(side)];
    if (hold.group == &group && !(time_ > hold.until)) result[component_of(side)] = hold.seen[component_of(side)];
    return result;
  }

  /// From here on the component of the pair goes as what it met does.
  void respond(const Meeting& meeting) noexcept {
    const Group& group = *meeting.group;
    const Side side = meeting.side;
    const auto component = static_cast<std::size_t>(component_of(side));
    const Vec2<Scalar> landing = seen(group, side) + meeting.impact.reached;
    advance(meeting);
    for (const CollisionPointHit<Scalar>& each : meeting.impact.hits) report(each, group, side, time_);
    const PointHit<Scalar>& hit = meeting.impact.hits[0].on;
    const Hold next{&group, collider_of(hit.piece), side, time_, time_, landing};
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
    stop(side, group, hit);
    if (side == Side::bottom) take_along(group, hit);
  }

  void advance(const Meeting& meeting) noexcept {
    const Scalar rest = 1 - time_;
    const Vec2<Scalar> carried = meeting.group->drift() * (rest * meeting.impact.fraction);
    position_ += meeting.impact.reached - carried;
    time_ += rest * meeting.impact.fraction;
    for (Hold* hold : follows_)
      if (hold != nullptr) hold->until = time_;
    if (time_ > result_.path.back().fraction && time_ < 1)
      result_.path.push_back({frame_.in_world(position_, time_), time_});
  }

  void follow(Eigen::Index component, const Group& group) noexcept {
    for (const Eigen::Index i : {0, 1}) {
      if (i != component && !shortens()) continue;
      movement_[i] = 0 - group.drift()[i];
      include(i, movement_[i]);
    }
  }

  /// What comes to rest on moving ground is carried from then on, unless it had a speed of its own along the ground.
  void take_along(const Group& group, const PointHit<Scalar>& hit) noexcept {
    const ColliderIndex ground = collider_of(hit.piece);
    if (!frame_.carries(ground) || request_.ride.ground != Ride<Scalar>::none || request_.velocity.x() != 0) return;
    movement_.x() = frame_.surface_motion(ground).x() - group.drift().x();
    include(0, movement_.x());
    result_.velocity.x() = frame_.velocity_of(ground).x();
  }

  /// The frame's movement had this component for a while: pairs that face it are tested.
  void include(Eigen::Index component, Scalar along) noexcept {
    least_[component] = std::min(least_[component], along);
    most_[component] = std::max(most_[component], along);
  }

  /// What keeps its place relative to a mover is rounded as the mover goes on: without this a point would end an ulp
  /// inside it, and penetration resolution would push it out by a whole unit. Doubling reaches any rounding error.
  void settle(const Hold& hold) noexcept {
    const auto is_free = [&](const Vec2<Scalar>& position) {
      const Vec2<Scalar> seen = hold.group->seen(position, 1);
      return !collides<Scalar>(parts_, hold.group->pieces, pair(hold.side), hold.seen, seen);
    };
    if (is_free(position_)) return;
    const Scalar scale = std::max(position_.cwiseAbs().maxCoeff(), hold.seen.cwiseAbs().maxCoeff());
    Vec2<Scalar> nudged = position_;
    for (Scalar by = std::numeric_limits<Scalar>::epsilon() * scale; by <= Tolerances<Scalar>{}.touch; by *= 2) {
      const Eigen::Index component = component_of(hold.side);
      nudged[component] = position_[component] - static_cast<Scalar>(outwards(hold.side)) * by;
      if (!is_free(nudged)) continue;
      position_ = nudged;
      return;
    }
  }

  /// A pair that has no room is crushed where what presses it runs over it, and by what it is pressed against.
  void find_crushes() noexcept {
    for (const Squeeze& squeeze : squeezes_) {
      const Hold& pressed = squeeze.pressed;
      const Vec2<Scalar> end = pressed.group->seen(position_, 1);
      if (!collides<Scalar>(parts_, pressed.group->pieces, pair(pressed.side), pressed.seen, end)) continue;
      for (const ColliderIndex collider : {pressed.collider, squeeze.against})
        if (frame_.mover_of(collider) != no_mover) add_once(collider, result_.crushed);
    }
  }

  /// Penetration resolution: adjusts the movement, pair by pair, until the pair is free where it arrives.
  bool resolve_penetration() noexcept {
    bool hit = false;
    for (const Side side : all_sides) {
      for (const Group& group : groups_) {
        if (!is_tested(side, group)) continue;
        const std::optional<PointHit<Scalar>> found = report_penetration(group, side);
        if (!found) continue;
        hit = true;
        push_back(group, side, *found);
        stop(side, group, *found);
      }
    }
    return hit;
  }

  [[nodiscard]] bool pair_is_inside(Side side, const Vec2<Scalar>& position) const noexcept {
    const std::span<const std::size_t> points = distinct(pair(side));
    return std::any_of(groups_.begin(), groups_.end(), [&](const Group& group) {
      return std::any_of(points.begin(), points.end(), [&](std::size_t i) {
        return group.pieces.containing(group.seen(position, 1) + parts_.points.offsets[i]).has_value();
      });
    });
  }

  /// @return the first of the hits.
  std::optional<PointHit<Scalar>> report_penetration(const Group& group, Side side) noexcept {
    Vec2<Scalar> back{Vec2<Scalar>::Zero()};
    back[component_of(side)] = static_cast<Scalar>(-outwards(side));
    std::optional<PointHit<Scalar>> first;
    for (const std::size_t i : distinct(pair(side))) {
      const Vec2<Scalar> point = group.seen(position_ + movement_, 1) + parts_.points.offsets[i];
      const std::optional<PieceIndex> piece = group.pieces.containing(point);
      if (!piece) continue;
      const CollisionPointHit<Scalar> hit{group.pieces.way_out(*piece, point, back), i};
      report(hit, group, side, 1);
      if (!first) first = hit.on;
    }
    return first;
  }

  /// Unit by unit towards the start and, where needed, beyond it by as much as the character is long in that direction.
  /// What is not free then (something larger than the character is in the way) does not move in that direction at all.
  void push_back(const Group& group, Side side, const PointHit<Scalar>& hit) noexcept {
    const Eigen::Index component = component_of(side);
    const Scalar extent = parts_.points.box.upper[component] - parts_.points.box.lower[component];
    const Vec2<Scalar> drift = group.drift();
    const Scalar wanted =
        shortens() ? length<Scalar>(movement_ + drift) : std::abs(movement_[component]) + std::abs(drift[component]);
    const Scalar steps = std::ceil((wanted + extent) / parts_.unit);
    const int limit = steps < max_search_steps ? static_cast<int>(steps) : max_search_steps;
    if (shortens() && !(wanted > 0)) return;
    for (int step = 1; step <= limit; ++step) {
      const Scalar back = static_cast<Scalar>(step) * parts_.unit;
      Vec2<Scalar> adjusted = movement_;
      if (shortens())
        adjusted = adjusted * (1 - back / wanted) - drift * (back / wanted);
      else
        adjusted[component] -= static_cast<Scalar>(outwards(side)) * back;
      if (pair_is_inside(side, position_ + adjusted)) continue;
      if (parts_.something_carries && !may_push(group, side, adjusted, hit)) return;
      movement_ = adjusted;
      return;
    }
    if (shortens())
      movement_.setZero();
    else
      movement_[component] = 0;
  }

  /// A mover pushes nothing through what stands still: the pair in front looks where it is pushed. What is pushed moves
  /// that way, so that from now on the pairs that face it are tested.
  [[nodiscard]] bool may_push(const Group& group, Side side, const Vec2<Scalar>& adjusted,
                              const PointHit<Scalar>& hit) noexcept {
    const Vec2<Scalar> push = adjusted - movement_;
    if (group.mover != no_mover) {
      for (const Group& other : groups_) {
        if (other.mover != no_mover) continue;
        for (const std::size_t i : distinct(pair(opposite(side)))) {
          const Vec2<Scalar> from = other.seen(position_ + movement_, 1) + parts_.points.offsets[i];
          if (other.pieces.first_entry(from, push)) return false;
        }
      }
      add_once(collider_of(hit.piece), pushers_);
    }
    for (const Eigen::Index i : {0, 1}) include(i, push[i]);
    return true;
  }

  void stop(Side side, const Group& group, const PointHit<Scalar>& hit) noexcept {
    const Vec2<Scalar> velocity = frame_.velocity(group.mover);
    if (shortens())
      result_.velocity = velocity;
    else
      result_.velocity[component_of(side)] = velocity[component_of(side)];
    if (group.mover != no_mover && !frame_.motion(group.mover).isZero(0)) add_once(collider_of(hit.piece), pushers_);
    if (side != Side::bottom) return;
    result_.grounded = true;
    const ColliderIndex ground = collider_of(hit.piece);
    result_.ride.ground = frame_.carries(ground) ? ground : Ride<Scalar>::none;
  }

  void report(const CollisionPointHit<Scalar>& hit, const Group& group, Side side, Scalar fraction) noexcept {
    if (!add_contact(*parts_.scenery, hit.on, side, fraction, result_)) return;
    touches_.push_back({hit.collision_point, group.mover, hit.on.point});
    if (group.mover != no_mover) result_.contacts.back().point += frame_.offset(group.mover, fraction);
  }

  [[nodiscard]] ColliderIndex collider_of(PieceIndex piece) const noexcept {
    return parts_.scenery->pieces()[piece].collider;
  }
  using Colliders = decltype(MoveResult<Scalar>::crushed);

  void finish() noexcept {
    const bool in_static = (parts_.something_carries || began_inside_) && find_what_is_inside();
    if (in_static && !began_in_static_ && !pushers_.empty()) return stay_where_it_began();
    for (std::size_t i = 0; i < result_.contacts.size(); ++i) {
      Contact<Scalar>& contact = result_.contacts[i];
      const Touch& touch = touches_[i];
      const Vec2<Scalar> seen = position_ + frame_.shift_at_end(touch.mover);
      const Vec2<Scalar> gap = seen + parts_.points.offsets[touch.collision_point] - touch.point;
      contact.separation = gap.dot(contact.normal);
    }
    frame_.arrive(position_, result_);
    result_.path.push_back({result_.position, 1});
    if (!result_.crushed.empty())
      result_.status = MoveStatus::crushed;
    else if (began_inside_ && inside_)
      result_.status = MoveStatus::stuck;
  }

  /// Movers that ran into the character crush it.
  /// @return whether any point is in what stands still.
  bool find_what_is_inside() noexcept {
    look_around();
    bool in_static = false;
    for (const Group& group : groups_) {
      for (const Vec2<Scalar>& offset : parts_.points.offsets) {
        const auto piece = group.pieces.containing(group.seen(position_, 1) + offset);
        if (!piece) continue;
        inside_ = true;
        if (group.mover == no_mover)
          in_static = true;
        else if (!frame_.motion(group.mover).isZero(0))
          add_once(collider_of(*piece), result_.crushed);
      }
    }
    return in_static;
  }

  /// Nothing is pushed into what stands still.
  void stay_where_it_began() noexcept {
    for (const ColliderIndex pusher : pushers_) add_once(pusher, result_.crushed);
    stay_crushed(request_, result_);
  }

  const Parts<Scalar>& parts_;
  const MoveRequest<Scalar>& request_;
  Scratch<Scalar>& scratch_;
  MoveResult<Scalar>& result_;
  FrameOfReference<Scalar> frame_;
  Box2<Scalar> reach_;
  std::span<const Group> groups_;
  Vec2<Scalar> position_;  ///< In the frame of reference, as all that follows.
  Vec2<Scalar> movement_;  ///< What is left of the frame's.
  Vec2<Scalar> least_;     ///< Of all movements that the frame had, by component.
  Vec2<Scalar> most_;
  Scalar time_ = 0;                   ///< How far the search has come.
  std::array<Hold, 4> holds_;         ///< By side.
  std::array<Hold*, 2> follows_{};    ///< By component; null: the movement is what is wanted.
  std::array<bool, 2> is_wedged_{};   ///< By component.
  FixedVector<Squeeze, 2> squeezes_;  ///< A component is wedged once.
  bool began_inside_ = false;
  bool began_in_static_ = false;
  bool inside_ = false;
  Colliders pushers_;  ///< Colliders of movers that gave the character some of their motion.
  FixedVector<Touch, MoveResult<Scalar>::max_contacts> touches_;  ///< Of each contact.
};

}  // namespace

template <class Scalar>
void move(const Parts<Scalar>& parts, ImpactSearch<Scalar> search, const MoveRequest<Scalar>& request,
          Scratch<Scalar>& scratch, MoveResult<Scalar>& result) noexcept {
  Frame<Scalar>(parts, request, scratch, result).run(search);
}

template void move(const Parts<float>&, ImpactSearch<float>, const MoveRequest<float>&, Scratch<float>&,
                   MoveResult<float>&) noexcept;
template void move(const Parts<double>&, ImpactSearch<double>, const MoveRequest<double>&, Scratch<double>&,
                   MoveResult<double>&) noexcept;

}  // namespace paperproof::article
