/// The way out of a solid.
///
/// In configuration space the start p lies in the obstacles of some colliders. A way out may pass those, but must not
/// end in them; of every other solid it must avoid the shadow that this has from p, and its obstacle with the gap. All
/// of these regions are convex. A straight way that has entered a shadow never leaves it, and a solid that may not be
/// passed is entered from outside: so the shortest way ends where it leaves the obstacle of a collider that it may
/// pass. That is on a facet of one, at the foot of the perpendicular, or where the last of the regions stops to cover
/// the facet. So along every such facet the nearest uncovered place is looked for on both sides of its foot.
///
/// Where the end must be seen from the last free position as well, the shadows of all pieces from there are further
/// regions. Those can be left going outwards: their tangents, and the facets of one-way segments, are looked along in
/// the same way. So are those of what lies on the character, from where it was when that came over it.
#include "step/escape.hpp"

#include "step/certificate.hpp"
#include "step/narrow_phase.hpp"
#include "step/one_way.hpp"
#include "step/shadow.hpp"

#include <paperproof/tolerances.hpp>

namespace paperproof::octagon_sweep {
namespace {

template <std::size_t Lanes, class Scalar>
class Escape {
 public:
  using V = Vec2<Scalar>;

  Escape(const ConfigurationSpace<Scalar>& space, std::span<PieceIndex> pieces,
         const WayOutQuery<Scalar>& query) noexcept
      : space_(space), pieces_(pieces), query_(query), nearest_(query.reach) {}

  std::optional<V> find() noexcept {
    put_colliders_inside_first();
    if (query_.last_free && is_inside_something(*query_.last_free)) return std::nullopt;
    for (const PieceIndex piece : pieces_.first(inside_)) {
      look_along_facets(piece);
      if (const std::optional<V> side = side_of(piece)) look_along_tangents(piece, *side);
    }
    if (!query_.last_free) return best_;
    for (const PieceIndex piece : pieces_) {
      look_along_tangents(piece, *query_.last_free);
      if (!solid(piece)) look_along_facets(piece);
    }
    return best_;
  }

 private:
  /// Rounding stays below this: a position this little inside a region counts as outside [m].
  static constexpr Scalar slack = Tolerances<Scalar>{}.certain;
  /// A way keeps this many times more from the corners that it passes than what would stop it, which is measured along
  /// axes: no two neighbouring ones are more than a right angle apart.
  static constexpr Scalar margin = Scalar(1.5);
  /// A line that an edge of a region leaves by less per metre does not leave it there.
  static constexpr Scalar parallel = std::numeric_limits<Scalar>::epsilon() * 64;
  /// Where rounding spoils a place, others beyond it are tried: first this far, then in strides that grow [m].
  static constexpr Scalar first_stride = 2 * Tolerances<Scalar>{}.hit;
  static constexpr Scalar stride_growth = 16;
  static constexpr int most_strides = 5;

  /// Ways w with normal · w = bound, from the start.
  struct Line {
    V foot;
    V along;
    [[nodiscard]] V at(Scalar place) const noexcept { return foot + along * place; }
  };
  struct Part {
    Scalar from;
    Scalar to;
  };
  /// A place on a line, and which way one goes along it.
  struct Spot {
    const Line& line;
    Scalar direction;
    V way;  ///< From the start.
  };

  // What there is.

  /// Where a piece is while its mover is at the step's start, relative to where it was built.
  [[nodiscard]] V offset(PieceIndex piece) const noexcept {
    const MoverIndex mover = space_.scenery().pieces()[piece].mover;
    if (mover == no_mover) return V::Zero();
    return query_.movers[mover].from;
  }
  /// A position as a piece that has not moved would see it.
  [[nodiscard]] V local(PieceIndex piece, const V& p) const noexcept { return p - offset(piece); }
  [[nodiscard]] ColliderIndex collider_of(PieceIndex piece) const noexcept {
    return space_.scenery().pieces()[piece].collider;
  }
  /// Where the character was when a piece came over it, as that is seen when the step begins: it moved on with it.
  [[nodiscard]] std::optional<V> side_of(PieceIndex piece) const noexcept {
    for (const Presser<Scalar>& presser : query_.pressers) {
      if (presser.collider != collider_of(piece)) continue;
      const MoverMotion<Scalar>& course = query_.movers[space_.scenery().pieces()[piece].mover];
      return V(presser.from + (presser.gone - (course.to - course.from)));
    }
    return std::nullopt;
  }
  [[nodiscard]] bool solid(PieceIndex piece) const noexcept {
    return space_.info(piece).one_way_axis == ObstacleInfo::not_one_way;
  }
  [[nodiscard]] BestAxis<Scalar> best(PieceIndex piece, const V& p) const noexcept {
    return best_axis<Lanes>(space_, piece, local(piece, p));
  }
  [[nodiscard]] bool is_inside(PieceIndex piece, const V& p) const noexcept {
    return solid(piece) && best(piece, p).separation < Tolerances<Scalar>{}.certain &&
           overlaps_exactly(space_, piece, local(piece, p));
  }
  [[nodiscard]] bool is_inside_something(const V& p) const noexcept {
    return std::any_of(pieces_.begin(), pieces_.end(), [&](PieceIndex piece) { return is_inside(piece, p); });
  }

  /// The pieces of the colliders that the start is inside of: these may be passed.
  void put_colliders_inside_first() noexcept {
    for (std::size_t first = 0, end = 0; first < pieces_.size(); first = end) {
      bool inside = false;
      for (end = first; end < pieces_.size() && collider_of(pieces_[end]) == collider_of(pieces_[first]); ++end)
        inside = inside || is_inside(pieces_[end], query_.from);
      if (!inside) continue;
      for (std::size_t k = first; k < end; ++k) std::swap(pieces_[inside_++], pieces_[k]);
    }
  }

  // Which lines are looked along.

  void look_along_facets(PieceIndex piece) noexcept {
    const V from = local(piece, query_.from);
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis) {
      const V n = space_.normal(piece, axis);
      if (space_.covered(piece, axis) || (n.x() == 0 && n.y() == 0)) continue;
      const Scalar bound = query_.gap - space_.separation(piece, axis, from);
      if (!(std::abs(bound) < nearest_)) continue;
      const Line line{n * bound, {-n.y(), n.x()}};
      look_along(line, facet_on(line, piece, std::sqrt(nearest_ * nearest_ - bound * bound)));
    }
  }

  /// The part of the line of a facet where it bounds the obstacle, as far as `half` from its foot.
  [[nodiscard]] Part facet_on(const Line& line, PieceIndex piece, Scalar half) const noexcept {
    const V foot = local(piece, query_.from) + line.foot;
    Part part{-half, half};
    for (std::size_t axis = 0; axis < space_.axis_count(piece) && part.from <= part.to; ++axis) {
      const V n = space_.normal(piece, axis);
      const Scalar rate = n.x() * line.along.x() + n.y() * line.along.y();
      const Scalar depth = query_.gap - space_.separation(piece, axis, foot);
      if (std::abs(rate) < parallel) {
        if (depth < -slack) part.to = -2 * half;
      } else if (rate > 0) {
        part.to = std::min(part.to, depth / rate);
      } else {
        part.from = std::max(part.from, depth / rate);
      }
    }
    return part;
  }

  void look_along_tangents(PieceIndex piece, const V& place) noexcept {
    const std::optional<Tangents<Scalar>> tangents = tangents_at(piece, place);
    if (!tangents) return;
    for (const V& n : {tangents->left, tangents->right}) {
      if (n.x() == 0 && n.y() == 0) continue;
      const V back = place - query_.from;
      const Scalar bound = n.x() * back.x() + n.y() * back.y();
      if (!(std::abs(bound) < nearest_)) continue;
      const Scalar half = std::sqrt(nearest_ * nearest_ - bound * bound);
      look_along({n * bound, {-n.y(), n.x()}}, {-half, half});
    }
  }

  void look_along(const Line& line, const Part& part) noexcept {
    if (!(part.from <= part.to)) return;
    const Scalar begin = std::clamp(Scalar(0), part.from, part.to);
    look_along(line, begin, part.to, Scalar(1));
    look_along(line, begin, part.from, Scalar(-1));
  }

  /// Takes the first place on a line that is free and can be reached.
  void look_along(const Line& line, Scalar place, Scalar end, Scalar direction) noexcept {
    Scalar stride = first_stride;
    for (int tried = 0; tried <= most_strides; ++tried) {
      place = next_uncovered(line, place, end, direction);
      if (place * direction > end * direction || consider(line.at(place))) return;
      place += direction * stride;
      stride *= stride_growth;
    }
  }

  // What covers them.

  /// The next place on a line that no region covers, or one beyond the end. Every region is convex, so that what has
  /// been left is not entered again. The pieces are asked forwards and backwards in turns: mostly their order is that
  /// of their places, from one side or the other.
  [[nodiscard]] Scalar next_uncovered(const Line& line, Scalar place, Scalar end, Scalar direction) noexcept {
    // What covers one line often covers the next.
    place += direction * covered_from({line, direction, line.at(place)}, last_covering_);
    if (place * direction > end * direction) return place;
    for (bool forwards = true;; forwards = !forwards) {
      const Scalar before = place;
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const std::size_t index = forwards ? k : pieces_.size() - 1 - k;
        const Scalar beyond = covered_from({line, direction, line.at(place)}, index);
        if (!(beyond > 0)) continue;
        last_covering_ = index;
        place += direction * beyond;
        if (place * direction > end * direction) return place;
      }
      if (place == before) return place;
    }
  }

  /// How far on from a spot the regions of a piece reach; 0 where none covers it.
  [[nodiscard]] Scalar covered_from(const Spot& spot, std::size_t index) const noexcept {
    const PieceIndex piece = pieces_[index];
    const bool is_solid = solid(piece);
    if (!is_solid && query_.drops) return 0;
    Scalar reach = is_solid ? obstacle_from(spot, piece) : Scalar(0);
    if (index >= inside_) reach = std::max(reach, shadow_from(spot, piece, query_.from));
    if (query_.last_free) reach = std::max(reach, shadow_from(spot, piece, *query_.last_free));
    if (const std::optional<V> side = side_of(piece)) reach = std::max(reach, shadow_from(spot, piece, *side));
    return reach;
  }

  /// The same, of the obstacle with the gap.
  [[nodiscard]] Scalar obstacle_from(const Spot& spot, PieceIndex piece) const noexcept {
    const V at = local(piece, query_.from) + spot.way;
    if (best_axis<Lanes>(space_, piece, at).separation >= query_.gap - slack) return 0;
    Scalar reach = std::numeric_limits<Scalar>::infinity();
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      shorten(reach, spot, space_.normal(piece, axis), query_.gap - space_.separation(piece, axis, at));
    return reach;
  }

  static void shorten(Scalar& reach, const Spot& spot, const V& normal, Scalar depth) noexcept {
    const Scalar rate = (normal.x() * spot.line.along.x() + normal.y() * spot.line.along.y()) * spot.direction;
    if (rate > parallel) reach = std::min(reach, depth / rate);
  }

  /// The same, of what it hides from a place.
  [[nodiscard]] Scalar shadow_from(const Spot& spot, PieceIndex piece, const V& place) const noexcept {
    if (!may_block(piece, place)) return 0;
    const V from = local(piece, place);
    const V at = local(piece, query_.from) + spot.way;
    const Scalar start = best(piece, place).separation;
    const Scalar level = std::min(Tolerances<Scalar>{}.hit, start);
    const Scalar kept = solid(piece) ? level : query_.gap;
    Scalar reach = std::numeric_limits<Scalar>::infinity();
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis) {
      if (space_.separation(piece, axis, from) < level) continue;
      const Scalar depth = kept - space_.separation(piece, axis, at);
      if (depth <= slack) return 0;
      shorten(reach, spot, space_.normal(piece, axis), depth);
    }
    const V gone = at - from;
    if (!solid(piece)) {  // it blocks motion against its normal only
      const V n = space_.normal(piece, space_.info(piece).one_way_axis);
      const Scalar depth = -(n.x() * gone.x() + n.y() * gone.y());
      if (depth <= 0) return 0;
      shorten(reach, spot, n, depth);
    }
    const std::optional<Tangents<Scalar>> tangents = tangents_at(piece, place);
    if (!tangents) return reach;
    for (const V& n : {tangents->left, tangents->right}) {
      const Scalar depth = -(n.x() * gone.x() + n.y() * gone.y());
      if ((n.x() != 0 || n.y() != 0) && depth <= slack) return 0;
      shorten(reach, spot, n, depth);
    }
    return reach;
  }

  [[nodiscard]] bool may_block(PieceIndex piece, const V& from) const noexcept {
    return solid(piece) || (!query_.drops && is_above(space_, piece, local(piece, from), lost_by(from, offset(piece))));
  }

  [[nodiscard]] std::optional<Tangents<Scalar>> tangents_at(PieceIndex piece, const V& place) const noexcept {
    if (!may_block(piece, place)) return std::nullopt;
    const BestAxis<Scalar> facing = best(piece, place);
    const Scalar kept = std::clamp(facing.separation, Scalar(0), Tolerances<Scalar>{}.hit) * margin + 2 * slack;
    return tangents_from(space_, piece, local(piece, place), space_.normal(piece, facing.axis), kept);
  }

  // What is checked.

  /// @return true: the search along this line ends, as a way ends here or no place from here on is nearer than the
  /// best.
  [[nodiscard]] bool consider(const V& way) noexcept {
    const V q = query_.from + way;
    const Scalar distance = length_of(V(q - query_.from));
    if (!(distance < nearest_)) return true;
    if (!(q.cwiseAbs().maxCoeff() <= Tolerances<Scalar>{}.range) || !roomy(q)) return false;
    if (!clear(query_.from, q, pieces_.subspan(inside_))) return false;
    if (query_.last_free && !clear(*query_.last_free, q, pieces_)) return false;
    if (!stays_on_its_side(q)) return false;
    best_ = q;
    nearest_ = distance;
    return true;
  }

  [[nodiscard]] bool roomy(const V& q) const noexcept {
    return std::none_of(pieces_.begin(), pieces_.end(), [&](PieceIndex piece) {
      return solid(piece) && best(piece, q).separation < Tolerances<Scalar>{}.hit;
    });
  }

  [[nodiscard]] bool stays_on_its_side(const V& q) const noexcept {
    return std::all_of(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(inside_), [&](PieceIndex piece) {
      const std::optional<V> side = side_of(piece);
      return !side || leads_away(piece, *side, q);
    });
  }

  /// Whether a straight way stays clear of a piece that it may touch where it begins, whatever rounding did to that
  /// place.
  [[nodiscard]] bool leads_away(PieceIndex piece, const V& place, const V& end) const noexcept {
    constexpr Scalar certain = Tolerances<Scalar>{}.certain;
    const V from = local(piece, place);
    const V to = local(piece, end);
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      if (space_.separation(piece, axis, from) > -certain && space_.separation(piece, axis, to) >= certain) return true;
    return best(piece, place).separation >= certain && clear(piece, from, to);
  }

  /// Whether a straight way meets none of some pieces: no solid, and no one-way segment against its normal, unless it
  /// drops.
  [[nodiscard]] bool clear(const V& from, const V& to, std::span<const PieceIndex> pieces) const noexcept {
    return std::all_of(pieces.begin(), pieces.end(),
                       [&](PieceIndex piece) { return clear(piece, local(piece, from), local(piece, to)); });
  }

  [[nodiscard]] bool clear(PieceIndex piece, const V& from, const V& to) const noexcept {
    if (query_.drops && !solid(piece)) return true;
    const Motion<Lanes, Scalar> motion = make_motion<Lanes>(space_, from, V(to - from));
    if (!blocks(space_, motion, piece)) return true;
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      if (space_.separation(piece, axis, from) >= Tolerances<Scalar>{}.certain &&
          space_.separation(piece, axis, to) >= Tolerances<Scalar>{}.certain)
        return true;
    if (clear_of_exactly(space_, piece, from, to)) return true;
    const Clearance<Scalar> room = clearance(space_, motion, piece);
    if (room.start < Tolerances<Scalar>{}.certain) return false;
    return room.clear() || !sweep_piece(space_, motion, piece, room).hit;
  }

  const ConfigurationSpace<Scalar>& space_;
  std::span<PieceIndex> pieces_;
  const WayOutQuery<Scalar>& query_;
  std::size_t inside_ = 0;  ///< The first so many pieces may be passed.
  std::size_t last_covering_ = 0;
  Scalar nearest_;  ///< Longer ways are not looked for any more [m].
  std::optional<V> best_;
};

}  // namespace

template <std::size_t Lanes, class Scalar>
std::optional<Vec2<Scalar>> way_out(const ConfigurationSpace<Scalar>& space, std::span<PieceIndex> pieces,
                                    const WayOutQuery<Scalar>& query) noexcept {
  return Escape<Lanes, Scalar>{space, pieces, query}.find();
}

#define PAPERPROOF_INSTANTIATE(Lanes, Scalar)                                                                   \
  template std::optional<Vec2<Scalar>> way_out<Lanes>(const ConfigurationSpace<Scalar>&, std::span<PieceIndex>, \
                                                      const WayOutQuery<Scalar>&) noexcept;
PAPERPROOF_INSTANTIATE(8, float)
PAPERPROOF_INSTANTIATE(8, double)
PAPERPROOF_INSTANTIATE(12, float)
PAPERPROOF_INSTANTIATE(12, double)
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::octagon_sweep
