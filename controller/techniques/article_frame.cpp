#include "techniques/article_in_order.hpp"

#include <cmath>

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
        record_(parts, request, result),
        position_(record_.frame().start()),
        movement_(record_.frame().wanted()) {
    moves_ = parts_.something_carries && something_moves_near();
    if (moves_) measure_reach();
  }

  void run(ImpactSearch<Scalar> search) noexcept {
    for (int iteration = 0; iteration < parts_.knobs.iterations; ++iteration) {
      look_around();
      if (iteration == 0) see_where_it_begins();
      bool hit = false;
      if (search != nullptr && !moves_) hit = shorten_along(search);
      if (search != nullptr && moves_ && iteration == 0) hit = meet_in_order_of_time(search);
      hit = resolve_penetration() || hit;
      position_ += movement_;
      if (!hit) break;
      movement_.setZero();
    }
    finish();
  }

 private:
  using Group = PieceGroup<Scalar>;

  /// Where the character may come during the frame by itself.
  [[nodiscard]] Box2<Scalar> total_box() const noexcept {
    const Box2<Scalar>& body = parts_.points.box;
    const Vec2<Scalar> there = position_ + movement_;
    return {position_.cwiseMin(there) + body.lower, position_.cwiseMax(there) + body.upper};
  }

  /// How far penetration resolution may push beyond it.
  [[nodiscard]] Scalar most_push() const noexcept {
    const Vec2<Scalar> extent = parts_.points.box.upper - parts_.points.box.lower;
    return extent.maxCoeff() + parts_.unit;
  }

  /// What moves elsewhere changes nothing here: the frame is that of scenery that stands still.
  [[nodiscard]] bool something_moves_near() noexcept {
    if (request_.ride.ground != Ride<Scalar>::none) return true;
    groups_ = parts_.groups_near(total_box().inflated(most_push()), record_.frame(), scratch_);
    return std::any_of(groups_.begin(), groups_.end(), [&](const Group& group) {
      const std::span<const PieceIndex> pieces = group.pieces.pieces();
      return std::any_of(pieces.begin(), pieces.end(), [&](PieceIndex piece) {
        return record_.frame().carries(parts_.scenery->pieces()[piece].collider);
      });
    });
  }

  /// How far the movement can lead: each component is at any time the one that was wanted, or that of something hit.
  void measure_reach() noexcept {
    reach_ = {movement_.cwiseMin(Vec2<Scalar>::Zero()), movement_.cwiseMax(Vec2<Scalar>::Zero())};
    const auto include = [&](MoverIndex mover) {
      const Vec2<Scalar> motion = record_.frame().shift_at_start(mover) - record_.frame().shift_at_end(mover);
      reach_ = reach_.merged({motion, motion});
    };
    include(no_mover);
    for (MoverIndex mover = 0; mover < request_.movers.size(); ++mover) include(mover);
    const Vec2<Scalar> surface{parts_.fastest_surface * request_.dt, 0};
    reach_ = {reach_.lower - surface, reach_.upper + surface};
  }

  /// Finds the pieces near the total bounding box: anew in every iteration.
  void look_around() noexcept {
    const Box2<Scalar>& body = parts_.points.box;
    Box2<Scalar> total = total_box();
    if (moves_)
      total = total
                  .merged({record_.frame().start() + reach_.lower + body.lower,
                           record_.frame().start() + reach_.upper + body.upper})
                  .inflated(most_push());
    groups_ = parts_.groups_near(total, record_.frame(), scratch_);
  }

  void see_where_it_begins() noexcept {
    for (const Group& group : groups_) {
      const bool inside = parts_.inside(group.pieces, group.seen(position_, 0));
      began_inside_ = began_inside_ || inside;
      if (group.mover == no_mover) began_in_static_ = inside;
    }
  }

  /// Speculative contacts: shortens the movement, in each direction in turn, to where its pair would hit.
  bool shorten_along(ImpactSearch<Scalar> search) noexcept {
    bool hit = false;
    Vec2<Scalar> free{1, 1};  // the fraction of the frame after which each component stops
    for (const Side side : all_sides) {
      if (groups_.empty() || !record_.is_tested(side, groups_.front()) || movement_.isZero(0)) continue;
      const PairImpact<Scalar> impact =
          search(parts_, groups_.front().pieces, record_.pair(side), position_, movement_);
      if (impact.hits.empty()) continue;
      hit = true;
      const Scalar fraction = shorten(side, impact, free);
      for (const CollisionPointHit<Scalar>& each : impact.hits) record_.report(each, groups_.front(), side, fraction);
      record_.stop(side, groups_.front(), impact.hits[0].on);
    }
    record_way(free);
    return hit;
  }

  /// @return the fraction of the frame at which the pair hit.
  Scalar shorten(Side side, const PairImpact<Scalar>& impact, Vec2<Scalar>& free) noexcept {
    if (record_.shortens()) {
      movement_ = impact.reached;
      free *= impact.fraction;
      return free.x();
    }
    const Eigen::Index component = component_of(side);
    movement_[component] = impact.reached[component];
    free[component] *= impact.fraction;
    return free[component];
  }

  /// The corners of the way: each component moves at its own pace until it stops.
  void record_way(const Vec2<Scalar>& free) noexcept {
    const Scalar first = std::min(free.x(), free.y());
    const Scalar last = std::max(free.x(), free.y());
    for (const Scalar fraction : {first, last}) {
      if (!(fraction > result_.path.back().fraction) || !(fraction < 1)) continue;
      Vec2<Scalar> way = movement_;
      for (const Eigen::Index i : {0, 1}) {
        if (fraction < free[i]) way[i] = record_.frame().wanted()[i] * fraction;
      }
      result_.path.push_back({position_ + way, fraction});
    }
  }

  /// What is left for penetration resolution is a movement of zero.
  bool meet_in_order_of_time(ImpactSearch<Scalar> search) noexcept {
    position_ = article::meet_in_order_of_time(parts_, search, groups_, request_, record_);
    movement_.setZero();
    return !result_.contacts.empty();
  }

  /// Penetration resolution: adjusts the movement, pair by pair, until the pair is free where it arrives.
  bool resolve_penetration() noexcept {
    bool hit = false;
    if (parts_.knobs.objects == ArticleKnobs::Objects::all) {
      for (const Side side : all_sides)
        for (const Group& group : groups_) hit = resolve_pair(group, side, groups_) || hit;
      return hit;
    }
    for (const Group& group : groups_) {
      for (std::span<const PieceIndex> rest = group.pieces.pieces(); !rest.empty();) {
        Group object = group;
        object.pieces = group.pieces.object_at_front(rest);
        rest = rest.subspan(object.pieces.pieces().size());
        for (const Side side : all_sides) hit = resolve_pair(object, side, std::span(&object, 1)) || hit;
      }
    }
    return hit;
  }

  /// @param others what the pair is free of afterwards: the group among them.
  bool resolve_pair(const Group& group, Side side, std::span<const Group> others) noexcept {
    if (!record_.is_tested(side, group)) return false;
    const std::optional<PointHit<Scalar>> found = report_penetration(group, side);
    if (!found) return false;
    push_back(group, side, *found, others);
    record_.stop(side, group, *found);
    return true;
  }

  [[nodiscard]] bool pair_is_inside(Side side, const Vec2<Scalar>& position,
                                    std::span<const Group> groups) const noexcept {
    const std::span<const std::size_t> points = distinct(record_.pair(side));
    return std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
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
    for (const std::size_t i : distinct(record_.pair(side))) {
      const Vec2<Scalar> point = group.seen(position_ + movement_, 1) + parts_.points.offsets[i];
      const std::optional<PieceIndex> piece = group.pieces.containing(point);
      if (!piece) continue;
      const CollisionPointHit<Scalar> hit{group.pieces.way_out(*piece, point, back), i};
      record_.report(hit, group, side, 1);
      if (!first) first = hit.on;
    }
    return first;
  }

  /// Unit by unit towards the start and, where needed, beyond it by as much as the character is long in that direction.
  /// What is not free then (something larger than the character is in the way) does not move in that direction at all.
  void push_back(const Group& group, Side side, const PointHit<Scalar>& hit, std::span<const Group> others) noexcept {
    const Eigen::Index component = component_of(side);
    const Scalar extent = parts_.points.box.upper[component] - parts_.points.box.lower[component];
    const Vec2<Scalar> drift = group.drift();
    const Scalar wanted = record_.shortens() ? length<Scalar>(movement_ + drift)
                                             : std::abs(movement_[component]) + std::abs(drift[component]);
    const Scalar steps = std::ceil((wanted + extent) / parts_.unit);
    const int limit = steps < max_search_steps ? static_cast<int>(steps) : max_search_steps;
    if (record_.shortens() && !(wanted > 0)) return;
    for (int step = 1; step <= limit; ++step) {
      const Scalar back = static_cast<Scalar>(step) * parts_.unit;
      Vec2<Scalar> adjusted = movement_;
      if (record_.shortens())
        adjusted = adjusted * (1 - back / wanted) - drift * (back / wanted);
      else
        adjusted[component] -= static_cast<Scalar>(outwards(side)) * back;
      if (pair_is_inside(side, position_ + adjusted, others)) continue;
      if (moves_ && !may_push(group, side, adjusted, hit)) return;
      movement_ = adjusted;
      return;
    }
    if (record_.shortens())
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
        for (const std::size_t i : distinct(record_.pair(opposite(side)))) {
          const Vec2<Scalar> from = other.seen(position_ + movement_, 1) + parts_.points.offsets[i];
          if (other.pieces.first_entry(from, push)) return false;
        }
      }
      record_.add_pusher(hit);
    }
    for (const Eigen::Index i : {0, 1}) record_.include(i, push[i]);
    return true;
  }

  void finish() noexcept {
    const bool in_static = (moves_ || began_inside_) && find_what_is_inside();
    if (in_static && !began_in_static_ && !record_.pushers().empty()) return stay_where_it_began();
    record_.measure_gaps(position_);
    record_.frame().arrive(position_, result_);
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
        else if (!record_.frame().motion(group.mover).isZero(0))
          add_once(parts_.scenery->pieces()[*piece].collider, result_.crushed);
      }
    }
    return in_static;
  }

  /// Nothing is pushed into what stands still.
  void stay_where_it_began() noexcept {
    for (const ColliderIndex pusher : record_.pushers()) add_once(pusher, result_.crushed);
    stay_crushed(request_, result_);
  }

  const Parts<Scalar>& parts_;
  const MoveRequest<Scalar>& request_;
  Scratch<Scalar>& scratch_;
  MoveResult<Scalar>& result_;
  FrameRecord<Scalar> record_;
  Box2<Scalar> reach_;  ///< How far the movement can lead, where something moves.
  std::span<const Group> groups_;
  Vec2<Scalar> position_;  ///< In the frame of reference.
  Vec2<Scalar> movement_;  ///< What is left of the frame's.
  bool moves_ = false;     ///< Something that moves or carries is near.
  bool began_inside_ = false;
  bool began_in_static_ = false;
  bool inside_ = false;
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
