#include "techniques/article_response.hpp"

#include <cmath>

namespace paperproof::article {
namespace {

template <class Scalar>
CollisionPoints<Scalar> points_of(const CharacterShape& shape) {
  CollisionPoints<Scalar> points;
  for (const Vec2d& point : shape.points()) points.offsets.push_back(point.cast<Scalar>());
  for (const Side side : all_sides) points.pairs[static_cast<std::size_t>(side)] = shape.pair(side);
  points.box = {shape.box().lower.cast<Scalar>(), shape.box().upper.cast<Scalar>()};
  return points;
}

template <class Scalar>
CollisionPoints<Scalar> corners_of_box(const CharacterShape& shape) {
  CollisionPoints<Scalar> points;
  points.box = {shape.box().lower.cast<Scalar>(), shape.box().upper.cast<Scalar>()};
  const Box2<Scalar>& box = points.box;
  for (const Scalar y : {box.lower.y(), box.upper.y()}) {
    for (const Scalar x : {box.lower.x(), box.upper.x()}) points.offsets.push_back({x, y});
  }
  points.pairs[static_cast<std::size_t>(Side::bottom)] = {0, 1};
  points.pairs[static_cast<std::size_t>(Side::top)] = {2, 3};
  points.pairs[static_cast<std::size_t>(Side::left)] = {0, 2};
  points.pairs[static_cast<std::size_t>(Side::right)] = {1, 3};
  return points;
}

/// NaN is not.
template <class Scalar>
bool in_range(const Vec2<Scalar>& position) noexcept {
  const Scalar range = Tolerances<Scalar>{}.range;
  return std::abs(position.x()) <= range && std::abs(position.y()) <= range;
}

template <class Scalar>
void refuse(const MoveRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
  result.clear();
  result.status = MoveStatus::out_of_range;
  result.position = request.position;
  result.velocity = request.velocity;
  result.remainder = request.remainder;
  result.path.push_back({request.position, 0});
  result.path.push_back({request.position, 1});
}

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
        position_(request.position),
        movement_(request.displacement) {
    result_.clear();
    result_.velocity = request.velocity;
    result_.path.push_back({request.position, 0});
  }

  void run(ImpactSearch<Scalar> search) noexcept {
    bool began_inside = false;
    for (int iteration = 0; iteration < parts_.knobs.iterations; ++iteration) {
      const NearbyScenery<Scalar> nearby = parts_.near(position_, position_ + movement_, scratch_);
      if (iteration == 0) began_inside = parts_.inside(nearby, position_);
      bool hit = false;
      if (search != nullptr) hit = shorten_along(nearby, search);
      hit = resolve_penetration(nearby) || hit;
      position_ += movement_;
      if (!hit) break;
      movement_.setZero();
    }
    finish(began_inside);
  }

 private:
  /// The pairs that face the movement, or all of them.
  [[nodiscard]] bool is_tested(Side side) const noexcept {
    const Scalar along = request_.displacement[component_of(side)];
    return parts_.knobs.pairs == ArticleKnobs::Pairs::all || (outwards(side) < 0 ? along < 0 : along > 0);
  }
  [[nodiscard]] const CharacterShape::Pair& pair(Side side) const noexcept {
    return parts_.points.pairs[static_cast<std::size_t>(side)];
  }

  /// Speculative contacts: shortens the movement, in each direction in turn, to where its pair would hit.
  bool shorten_along(const NearbyScenery<Scalar>& nearby, ImpactSearch<Scalar> search) noexcept {
    bool hit = false;
    Vec2<Scalar> free{1, 1};  // the fraction of the frame after which each component stops
    for (const Side side : all_sides) {
      if (!is_tested(side) || nearby.empty() || movement_.isZero(0)) continue;
      const PairImpact<Scalar> impact = search(parts_, nearby, pair(side), position_, movement_);
      if (impact.hits.empty()) continue;
      hit = true;
      const Scalar fraction = shorten(side, impact, free);
      for (const CollisionPointHit<Scalar>& each : impact.hits) report(each, side, fraction);
      stop(side);
    }
    record_way(free);
    return hit;
  }

  /// @return the fraction of the frame at which the pair hit.
  Scalar shorten(Side side, const PairImpact<Scalar>& impact, Vec2<Scalar>& free) noexcept {
    if (parts_.knobs.response == ArticleKnobs::Response::shorten) {
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
        if (fraction < free[i]) way[i] = request_.displacement[i] * fraction;
      }
      result_.path.push_back({position_ + way, fraction});
    }
  }

  /// Penetration resolution: adjusts the movement, pair by pair, until the pair is free where it arrives.
  bool resolve_penetration(const NearbyScenery<Scalar>& nearby) noexcept {
    bool hit = false;
    for (const Side side : all_sides) {
      if (!is_tested(side) || nearby.empty()) continue;
      if (!report_penetration(nearby, side)) continue;
      hit = true;
      push_back(nearby, side);
      stop(side);
    }
    return hit;
  }

  [[nodiscard]] bool pair_is_inside(const NearbyScenery<Scalar>& nearby, Side side,
                                    const Vec2<Scalar>& position) const noexcept {
    const std::span<const std::size_t> points = distinct(pair(side));
    return std::any_of(points.begin(), points.end(), [&](std::size_t i) {
      return nearby.containing(position + parts_.points.offsets[i]).has_value();
    });
  }

  bool report_penetration(const NearbyScenery<Scalar>& nearby, Side side) noexcept {
    Vec2<Scalar> back{Vec2<Scalar>::Zero()};
    back[component_of(side)] = static_cast<Scalar>(-outwards(side));
    bool found = false;
    for (const std::size_t i : distinct(pair(side))) {
      const Vec2<Scalar> point = position_ + movement_ + parts_.points.offsets[i];
      const std::optional<PieceIndex> piece = nearby.containing(point);
      if (!piece) continue;
      found = true;
      report({nearby.way_out(*piece, point, back), i}, side, 1);
    }
    return found;
  }

  /// Unit by unit towards the start and, where needed, beyond it by as much as the character is long in that direction.
  /// What is not free then (something larger than the character is in the way) does not move in that direction at all.
  void push_back(const NearbyScenery<Scalar>& nearby, Side side) noexcept {
    const Eigen::Index component = component_of(side);
    const bool whole = parts_.knobs.response == ArticleKnobs::Response::shorten;
    const Scalar extent = parts_.points.box.upper[component] - parts_.points.box.lower[component];
    const Scalar wanted = whole ? length(movement_) : std::abs(movement_[component]);
    const Scalar steps = std::ceil((wanted + extent) / parts_.unit);
    const int limit = steps < max_search_steps ? static_cast<int>(steps) : max_search_steps;
    if (whole && !(wanted > 0)) return;
    for (int step = 1; step <= limit; ++step) {
      const Scalar back = static_cast<Scalar>(step) * parts_.unit;
      Vec2<Scalar> adjusted = movement_;
      if (whole)
        adjusted *= 1 - back / wanted;
      else
        adjusted[component] -= static_cast<Scalar>(outwards(side)) * back;
      if (pair_is_inside(nearby, side, position_ + adjusted)) continue;
      movement_ = adjusted;
      return;
    }
    if (whole)
      movement_.setZero();
    else
      movement_[component] = 0;
  }

  void stop(Side side) noexcept {
    if (side == Side::bottom) result_.grounded = true;
    if (parts_.knobs.response == ArticleKnobs::Response::shorten)
      result_.velocity.setZero();
    else
      result_.velocity[component_of(side)] = 0;
  }

  void report(const CollisionPointHit<Scalar>& hit, Side side, Scalar fraction) noexcept {
    if (add_contact(*parts_.scenery, hit.on, side, fraction, result_)) touching_.push_back(hit.collision_point);
  }

  void finish(bool began_inside) noexcept {
    result_.position = position_;
    result_.path.push_back({position_, 1});
    for (std::size_t i = 0; i < result_.contacts.size(); ++i) {
      Contact<Scalar>& contact = result_.contacts[i];
      const Vec2<Scalar> gap = position_ + parts_.points.offsets[touching_[i]] - contact.point;
      contact.separation = gap.dot(contact.normal);
    }
    if (began_inside && parts_.inside(parts_.near(position_, position_, scratch_), position_)) {
      result_.status = MoveStatus::stuck;
    }
  }

  const Parts<Scalar>& parts_;
  const MoveRequest<Scalar>& request_;
  Scratch<Scalar>& scratch_;
  MoveResult<Scalar>& result_;
  Vec2<Scalar> position_;
  Vec2<Scalar> movement_;                                                ///< What is left of the frame's.
  FixedVector<std::size_t, MoveResult<Scalar>::max_contacts> touching_;  ///< The collision point of each contact.
};

}  // namespace

template <class Scalar>
Scalar length(const Vec2<Scalar>& vector) noexcept {
  return std::sqrt(vector.x() * vector.x() + vector.y() * vector.y());
}

template <class Scalar>
Parts<Scalar>::Parts(const TechniqueDef& def, const Scenery<Scalar>& where, const CharacterDef& character)
    : scenery(&where),
      broad_phase(make_broad_phase<Scalar>(def.broad_phase, where.static_boxes())),
      points(def.article.points == 4 ? corners_of_box<Scalar>(character.shape) : points_of<Scalar>(character.shape)),
      unit(static_cast<Scalar>(def.article.unit)),
      knobs(def.article) {}

template <class Scalar>
Scratch<Scalar> Parts<Scalar>::make_scratch() const {
  Scratch<Scalar> scratch;
  scratch.candidates.resize(scenery->pieces().size());
  return scratch;
}

template <class Scalar>
NearbyScenery<Scalar> Parts<Scalar>::near(const Vec2<Scalar>& here, const Vec2<Scalar>& there,
                                          Scratch<Scalar>& scratch) const noexcept {
  const Box2<Scalar> total{here.cwiseMin(there) + points.box.lower, here.cwiseMax(there) + points.box.upper};
  scratch.valid = false;  // found anew in every iteration: never valid for the next
  scratch.candidate_count = broad_phase->query(total, scratch.candidates);
  return {*scenery, std::span<const PieceIndex>(scratch.candidates).first(scratch.candidate_count)};
}

template <class Scalar>
bool Parts<Scalar>::inside(const NearbyScenery<Scalar>& nearby, const Vec2<Scalar>& position) const noexcept {
  return std::any_of(points.offsets.begin(), points.offsets.end(),
                     [&](const Vec2<Scalar>& offset) { return nearby.containing(position + offset).has_value(); });
}

template <class Scalar>
void move(const Parts<Scalar>& parts, ImpactSearch<Scalar> search, const MoveRequest<Scalar>& request,
          Scratch<Scalar>& scratch, MoveResult<Scalar>& result) noexcept {
  Frame<Scalar>(parts, request, scratch, result).run(search);
}

template <class Scalar>
bool refuse_out_of_range(const MoveRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
  const Vec2<Scalar> end = request.position + request.displacement;
  if (in_range(request.position) && in_range(end)) return false;
  refuse(request, result);
  return true;
}

template <class Scalar>
bool refuse(const Parts<Scalar>& parts, bool searches_by_units, const MoveRequest<Scalar>& request,
            MoveResult<Scalar>& result) noexcept {
  if (refuse_out_of_range(request, result)) return true;
  const bool quick = !searches_by_units || length(request.displacement) <= parts.unit * Scalar(max_search_steps);
  if (!quick) refuse(request, result);
  return !quick;
}

template <class Scalar>
bool add_contact(const Scenery<Scalar>& scenery, const PointHit<Scalar>& hit, Side side, Scalar fraction,
                 MoveResult<Scalar>& result) noexcept {
  const ColliderIndex collider = scenery.pieces()[hit.piece].collider;
  for (const Contact<Scalar>& known : result.contacts) {
    if (known.collider == collider && known.side == side) return false;
  }
  return result.contacts.push_back({collider, hit.point, hit.normal, fraction, 0, side});
}

#define PAPERPROOF_INSTANTIATE(Scalar)                                                                         \
  template struct Parts<Scalar>;                                                                               \
  template Scalar length(const Vec2<Scalar>&) noexcept;                                                        \
  template void move(const Parts<Scalar>&, ImpactSearch<Scalar>, const MoveRequest<Scalar>&, Scratch<Scalar>&, \
                     MoveResult<Scalar>&) noexcept;                                                            \
  template bool refuse_out_of_range(const MoveRequest<Scalar>&, MoveResult<Scalar>&) noexcept;                 \
  template bool refuse(const Parts<Scalar>&, bool, const MoveRequest<Scalar>&, MoveResult<Scalar>&) noexcept;  \
  template bool add_contact(const Scenery<Scalar>&, const PointHit<Scalar>&, Side, Scalar, MoveResult<Scalar>&) noexcept
PAPERPROOF_INSTANTIATE(float);
PAPERPROOF_INSTANTIATE(double);
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::article
