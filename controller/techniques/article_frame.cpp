#include "techniques/article_in_order.hpp"

#include <cmath>

namespace paperproof::article {
namespace {

/// One frame while it is worked out.
class Frame {
 public:
  Frame(const Parts& parts, const MoveRequest& request, Scratch& scratch, MoveResult& result) noexcept
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

  void run(ImpactSearch search) noexcept {
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
  /// Where the character may come during the frame by itself.
  [[nodiscard]] Box2 total_box() const noexcept {
    return Box2::between(position_, position_ + movement_) + parts_.points.box;
  }

  /// How far penetration resolution may push beyond it.
  [[nodiscard]] double most_push() const noexcept { return parts_.points.box.size().maxCoeff() + parts_.unit; }

  /// What moves elsewhere changes nothing here: the frame is that of scenery that stands still.
  [[nodiscard]] bool something_moves_near() noexcept {
    if (request_.ride.ground != Ride::none) return true;
    groups_ = parts_.groups_near(total_box().inflated(most_push()), record_.frame(), scratch_);
    return std::any_of(groups_.begin(), groups_.end(), [&](const PieceGroup& group) {
      const std::span<const PieceIndex> pieces = group.pieces.pieces();
      return std::any_of(pieces.begin(), pieces.end(), [&](PieceIndex piece) {
        return record_.frame().carries(parts_.scenery->pieces()[piece].collider);
      });
    });
  }

  /// How far the movement can lead: each component is at any time the one that was wanted, or that of something hit.
  void measure_reach() noexcept {
    reach_ = Box2::between(movement_, Vec2d::Zero());
    const auto include = [&](MoverIndex mover) {
      reach_ = reach_.with(record_.frame().shift_at_start(mover) - record_.frame().shift_at_end(mover));
    };
    include(no_mover);
    for (MoverIndex mover = 0; mover < request_.movers.size(); ++mover) include(mover);
    const Vec2d surface{parts_.fastest_surface * request_.dt, 0};
    reach_ = {reach_.lower - surface, reach_.upper + surface};
  }

  /// Finds the pieces near the total bounding box: anew in every iteration.
  void look_around() noexcept {
    Box2 total = total_box();
    if (moves_) total = total.merged(reach_ + record_.frame().start() + parts_.points.box).inflated(most_push());
    groups_ = parts_.groups_near(total, record_.frame(), scratch_);
  }

  void see_where_it_begins() noexcept {
    for (const PieceGroup& group : groups_) {
      const bool inside = parts_.inside(group.pieces, group.seen(position_, 0));
      began_inside_ = began_inside_ || inside;
      if (group.mover == no_mover) began_in_static_ = inside;
    }
  }

  /// Speculative contacts: shortens the movement, in each direction in turn, to where its pair would hit.
  bool shorten_along(ImpactSearch search) noexcept {
    bool hit = false;
    Vec2d free{1, 1};  // the fraction of the frame after which each component stops
    for (const Side side : all_sides) {
      if (groups_.empty() || !record_.is_tested(side, groups_.front()) || movement_.isZero(0)) continue;
      const PairImpact impact = search(parts_, groups_.front().pieces, record_.pair(side), position_, movement_);
      if (impact.hits.empty()) continue;
      hit = true;
      const double fraction = shorten(side, impact, free);
      for (const CollisionPointHit& each : impact.hits) record_.report(each, groups_.front(), side, fraction);
      record_.stop(side, groups_.front(), impact.hits[0].on);
    }
    record_way(free);
    return hit;
  }

  /// @return the fraction of the frame at which the pair hit.
  double shorten(Side side, const PairImpact& impact, Vec2d& free) noexcept {
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
  void record_way(const Vec2d& free) noexcept {
    const double first = std::min(free.x(), free.y());
    const double last = std::max(free.x(), free.y());
    for (const double fraction : {first, last}) {
      if (!(fraction > result_.path.back().fraction) || !(fraction < 1)) continue;
      Vec2d way = movement_;
      for (const Eigen::Index i : {0, 1}) {
        if (fraction < free[i]) way[i] = record_.frame().wanted()[i] * fraction;
      }
      result_.path.push_back({position_ + way, fraction});
    }
  }

  /// What is left for penetration resolution is a movement of zero.
  bool meet_in_order_of_time(ImpactSearch search) noexcept {
    position_ = article::meet_in_order_of_time(parts_, search, groups_, request_, record_);
    movement_.setZero();
    return !result_.contacts.empty();
  }

  /// Penetration resolution: adjusts the movement, pair by pair, until the pair is free where it arrives.
  bool resolve_penetration() noexcept {
    bool hit = false;
    if (parts_.knobs.objects == ArticleKnobs::Objects::all) {
      for (const Side side : all_sides)
        for (const PieceGroup& group : groups_) hit = resolve_pair(group, side, groups_) || hit;
      return hit;
    }
    for (const PieceGroup& group : groups_) {
      for (std::span<const PieceIndex> rest = group.pieces.pieces(); !rest.empty();) {
        PieceGroup object = group;
        object.pieces = group.pieces.object_at_front(rest);
        rest = rest.subspan(object.pieces.pieces().size());
        for (const Side side : all_sides) hit = resolve_pair(object, side, std::span(&object, 1)) || hit;
      }
    }
    return hit;
  }

  /// @param others what the pair is free of afterwards: the group among them.
  bool resolve_pair(const PieceGroup& group, Side side, std::span<const PieceGroup> others) noexcept {
    if (!record_.is_tested(side, group)) return false;
    const std::optional<PointHit> found = report_penetration(group, side);
    if (!found) return false;
    push_back(group, side, *found, others);
    record_.stop(side, group, *found);
    return true;
  }

  [[nodiscard]] bool pair_is_inside(Side side, const Vec2d& position,
                                    std::span<const PieceGroup> groups) const noexcept {
    const std::span<const std::size_t> points = distinct(record_.pair(side));
    return std::any_of(groups.begin(), groups.end(), [&](const PieceGroup& group) {
      return std::any_of(points.begin(), points.end(), [&](std::size_t i) {
        return group.pieces.containing(group.seen(position, 1) + parts_.points.offsets[i]).has_value();
      });
    });
  }

  /// @return the first of the hits.
  std::optional<PointHit> report_penetration(const PieceGroup& group, Side side) noexcept {
    Vec2d back{Vec2d::Zero()};
    back[component_of(side)] = static_cast<double>(-outwards(side));
    std::optional<PointHit> first;
    for (const std::size_t i : distinct(record_.pair(side))) {
      const Vec2d point = group.seen(position_ + movement_, 1) + parts_.points.offsets[i];
      const std::optional<PieceIndex> piece = group.pieces.containing(point);
      if (!piece) continue;
      const CollisionPointHit hit{group.pieces.way_out(*piece, point, back), i};
      record_.report(hit, group, side, 1);
      if (!first) first = hit.on;
    }
    return first;
  }

  /// Unit by unit towards the start and, where needed, beyond it by as much as the character is long in that direction.
  /// What is not free then (something larger than the character is in the way) does not move in that direction at all.
  void push_back(const PieceGroup& group, Side side, const PointHit& hit, std::span<const PieceGroup> others) noexcept {
    const Eigen::Index component = component_of(side);
    const double extent = parts_.points.box.upper[component] - parts_.points.box.lower[component];
    const Vec2d drift = group.drift();
    const double wanted =
        record_.shortens() ? (movement_ + drift).norm() : std::abs(movement_[component]) + std::abs(drift[component]);
    const double steps = std::ceil((wanted + extent) / parts_.unit);
    const int limit = steps < max_search_steps ? static_cast<int>(steps) : max_search_steps;
    if (record_.shortens() && !(wanted > 0)) return;
    for (int step = 1; step <= limit; ++step) {
      const double back = static_cast<double>(step) * parts_.unit;
      Vec2d adjusted = movement_;
      if (record_.shortens())
        adjusted = adjusted * (1 - back / wanted) - drift * (back / wanted);
      else
        adjusted[component] -= static_cast<double>(outwards(side)) * back;
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
  [[nodiscard]] bool may_push(const PieceGroup& group, Side side, const Vec2d& adjusted, const PointHit& hit) noexcept {
    const Vec2d push = adjusted - movement_;
    if (group.mover != no_mover) {
      for (const PieceGroup& other : groups_) {
        if (other.mover != no_mover) continue;
        for (const std::size_t i : distinct(record_.pair(side_ahead(component_of(side), outwards(side) < 0)))) {
          const Vec2d from = other.seen(position_ + movement_, 1) + parts_.points.offsets[i];
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
      result_.status = StepStatus::crushed;
    else if (began_inside_ && inside_)
      result_.status = StepStatus::stuck;
  }

  /// Movers that ran into the character crush it.
  /// @return whether any point is in what stands still.
  bool find_what_is_inside() noexcept {
    look_around();
    bool in_static = false;
    for (const PieceGroup& group : groups_) {
      for (const Vec2d& offset : parts_.points.offsets) {
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

  const Parts& parts_;
  const MoveRequest& request_;
  Scratch& scratch_;
  MoveResult& result_;
  FrameRecord record_;
  Box2 reach_;  ///< How far the movement can lead, where something moves.
  std::span<const PieceGroup> groups_;
  Vec2d position_;      ///< In the frame of reference.
  Vec2d movement_;      ///< The rest of the movement of this frame [m].
  bool moves_ = false;  ///< Something that moves or carries is near.
  bool began_inside_ = false;
  bool began_in_static_ = false;
  bool inside_ = false;
};

}  // namespace

void move(const Parts& parts, ImpactSearch search, const MoveRequest& request, Scratch& scratch,
          MoveResult& result) noexcept {
  Frame(parts, request, scratch, result).run(search);
}

}  // namespace paperproof::article
