/// The search for the nearest free position that a straight motion reaches.
///
/// In configuration space a piece is a convex obstacle; with a gap around it that is convex, too. So is its shadow: the
/// positions that a straight motion from a given start cannot reach without hitting the piece. A motion that takes time
/// is straight also as a moving piece sees it, from where the piece is at its begin to where the piece is at its end.
/// A position outside all obstacles and all shadows is free, and is reached. The nearest one lies on a line that bounds
/// one of these regions: at the foot of the perpendicular, or where the last of the other regions ends that cover the
/// line. So each line is searched from its foot to both sides for the first place that no region covers.
///
/// A motion that takes no time starts where the nearest position is wanted, inside the pieces that it may pass. It
/// never ends on the border of a shadow from there: only the facets of these pieces are searched. Where a straight
/// motion from the last free position must reach the end as well, the shadows from there are further regions, and their
/// tangents are searched, too. The same holds for pieces that must be left to a known side.
///
/// A circle's region is bounded by arcs, too, one around each corner of the hull: they are searched like the lines.
#include "step/free_position.hpp"

#include "step/certificate.hpp"
#include "step/narrow_phase.hpp"
#include "step/one_way.hpp"
#include "step/shadow.hpp"

#include <paperproof/tolerances.hpp>

#include <initializer_list>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {
namespace {

class Search {
 public:
  Search(const ConfigurationSpace& space, std::span<const PieceIndex> pieces, const FreePositionQuery& query) noexcept
      : space_(space),
        pieces_(pieces),
        passable_(pieces.first(query.passable)),
        query_(query),
        takes_time_(query.begin < query.end),
        nearest_(query.reach) {}

  [[nodiscard]] std::optional<Vec2> find() noexcept {
    if (query_.last_free && is_inside_something(*query_.last_free)) return std::nullopt;
    if (takes_time_) {
      if (starts_inside()) return std::nullopt;
      consider(Vec2::Zero());
    }
    for (const PieceIndex piece : passable_) {
      search_facets(piece);
      search_tangents(piece, Place::side);
    }
    if (!takes_time_ && !query_.last_free) return best_;
    for (const PieceIndex piece : pieces_) {
      if (takes_time_) search_tangents(piece, Place::from);
      if (query_.last_free) search_tangents(piece, Place::last_free);
      if (takes_time_ || !solid(piece)) search_facets(piece);
    }
    return best_;
  }

  /// Whether a position is free, and the straight motion to it.
  [[nodiscard]] bool reaches(const Vec2& q) const noexcept {
    const auto clear_from = [&](const Vec2& place, Real time) {
      return [&, time](PieceIndex piece) { return clear(piece, place, time, q); };
    };
    if (!(q.cwiseAbs().maxCoeff() <= tolerances.range) || !has_gaps(q)) return false;
    const std::span<const PieceIndex> others = pieces_.subspan(passable_.size());
    return std::all_of(others.begin(), others.end(), clear_from(query_.from, query_.begin)) &&
           (!query_.last_free ||
            std::all_of(pieces_.begin(), pieces_.end(), clear_from(*query_.last_free, query_.begin))) &&
           std::all_of(passable_.begin(), passable_.end(), [&](PieceIndex piece) { return keeps_side(piece, q); });
  }

 private:
  /// Rounding stays below this: a position this little inside a region counts as outside [m].
  static constexpr Real slack = tolerances.certain;
  /// A motion keeps this many times more from the corners that it passes than what would stop it, which is measured
  /// along axes: no two neighbouring ones are more than a right angle apart.
  static constexpr Real margin = Real(1.5);
  /// A line that an edge of a region leaves by less per metre does not leave it there.
  static constexpr Real parallel = std::numeric_limits<Real>::epsilon() * 64;
  /// Where rounding spoils a place, others beyond it are tried: first this far, then in strides that grow [m].
  static constexpr Real first_stride = 2 * tolerances.hit;
  static constexpr Real stride_growth = 16;
  static constexpr int most_strides = 5;
  /// So many tangents find where a curve leaves a circle: each about squares the distance that is left.
  static constexpr int most_tangents = 64;

  /// A line, or an arc of at most half a turn. Positions are relative to `query.near`.
  struct Curve {
    Vec2 middle;             ///< The foot of a line, from which places are counted [m]; the centre of an arc.
    Vec2 along;              ///< Unit vector towards growing places; of an arc where the place is 0.
    Vec2 out{Vec2::Zero()};  ///< Unit vector from the centre of an arc to its place 0.
    Real radius = 0;         ///< Of an arc [m]. Its places are the tangents of half the angles.

    [[nodiscard]] bool is_arc() const noexcept { return radius > 0; }
    [[nodiscard]] Vec2 at(Real place) const noexcept {
      if (!is_arc()) return middle + along * place;
      const Real square = place * place;
      return middle + (out * (1 - square) + along * (2 * place)) * (radius / (1 + square));
    }
    /// One unit of place is at most so long [m].
    [[nodiscard]] Real pace() const noexcept { return is_arc() ? 2 * radius : Real(1); }
  };
  struct Part {
    Real from;
    Real to;
  };
  /// A place on a curve, and which way one goes along it.
  struct Spot {
    const Curve& curve;
    Real place;
    Real end;  ///< Where the search ends.
    Real direction;
    Vec2 position;  ///< Relative to `query.near`.

    /// A little beyond the end, from the place.
    [[nodiscard]] Real rest() const noexcept { return (end - place) * direction + first_stride / curve.pace(); }
    [[nodiscard]] Vec2 after(Real reach) const noexcept { return curve.at(place + direction * reach); }
    /// How far it goes until it is by `depth` > 0 further along a unit vector; infinity if it never is.
    [[nodiscard]] Real until(const Vec2& normal, Real depth) const noexcept {
      const Real turned = normal.x() * curve.along.x() + normal.y() * curve.along.y();
      if (!curve.is_arc()) return turned * direction > parallel ? depth / (turned * direction) : infinity;
      // The height over the centre is reached at the roots of a t^2 - 2 b t + c, and is less where that is positive.
      const Vec2 arm = position - curve.middle;
      const Real height = normal.x() * arm.x() + normal.y() * arm.y() + depth;
      if (!(height < curve.radius)) return infinity;
      const Real out = curve.radius * (normal.x() * curve.out.x() + normal.y() * curve.out.y());
      const Real b = curve.radius * turned;
      const Real larger = b + std::copysign(std::sqrt((curve.radius - height) * (curve.radius + height)), b);
      Real least = infinity;
      for (const Real root : {larger / (height + out), (height - out) / larger})
        if (const Real reach = (root - place) * direction; reach > 0) least = std::min(least, reach);
      return least;
    }
  };
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  /// Where a motion starts that must be clear of a piece.
  enum class Place : std::uint8_t { from, last_free, side };
  /// The shadow of a piece.
  struct View {
    bool blocks = false;  ///< There is one.
    Vec2 place;           ///< Where the motion starts, as the piece sees it.
    Real level;           ///< Gap that the motion keeps from the piece [m].
    Tangents tangents;
  };

  // Pieces and shadows.

  /// Calls `visit(axis)` for the axes of a piece. Of a circle for those, too, that are nearest at some places.
  template <class Visit>
  void for_each_axis(PieceIndex piece, std::initializer_list<Vec2> places, const Visit& visit) const noexcept {
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis) visit(axis);
    if (!space_.is_circle(piece)) return;
    for (const Vec2& place : places) visit(best(piece, place).axis);
  }

  /// Offset of the mover of a piece at a fraction of the step; zero for a piece that stands still.
  [[nodiscard]] Vec2 offset(PieceIndex piece, Real time) const noexcept {
    const MoverIndex mover = space_.info(piece).source.mover;
    return mover == no_mover ? Vec2(Vec2::Zero()) : Vec2(query_.movers[mover].at(time));
  }
  /// A position relative to the mover of a piece.
  [[nodiscard]] Vec2 seen(PieceIndex piece, const Vec2& p, Real time) const noexcept { return p - offset(piece, time); }
  [[nodiscard]] Vec2 seen_at_end(PieceIndex piece, const Vec2& p) const noexcept { return seen(piece, p, query_.end); }
  [[nodiscard]] bool solid(PieceIndex piece) const noexcept { return !space_.info(piece).is_one_way(); }
  [[nodiscard]] BestAxis best(PieceIndex piece, const Vec2& at) const noexcept { return best_axis(space_, piece, at); }
  /// Where the character was before it overlapped a piece that may be passed, as the piece sees it.
  [[nodiscard]] std::optional<Vec2> side_of(PieceIndex piece) const noexcept {
    const PieceInfo& info = space_.info(piece).source;
    for (const Crusher& crusher : query_.crushers)
      if (crusher.collider == info.collider)
        return Vec2(crusher.last_free + (crusher.displacement - query_.movers[info.mover].to));
    if (!query_.entered_from) return std::nullopt;
    return seen(piece, *query_.entered_from, Real(0));
  }
  [[nodiscard]] bool is_inside_something(const Vec2& p) const noexcept {
    return std::any_of(pieces_.begin(), pieces_.end(), [&](PieceIndex piece) {
      return solid(piece) && best(piece, seen(piece, p, query_.begin)).separation < tolerances.certain &&
             overlaps_exactly(space_, piece, query_.movers, p, query_.begin);
    });
  }
  [[nodiscard]] bool starts_inside() const noexcept {
    return std::any_of(pieces_.begin() + static_cast<std::ptrdiff_t>(passable_.size()), pieces_.end(),
                       [&](PieceIndex piece) {
                         return solid(piece) && best(piece, seen(piece, query_.from, query_.begin)).separation < 0;
                       });
  }

  /// The same shadows are needed on many lines, and tangents are expensive: the last ones are kept.
  [[nodiscard]] const View& view(PieceIndex piece, Place place) noexcept {
    Kept& kept = kept_[(3 * std::size_t{piece} + static_cast<std::size_t>(place)) % kept_.size()];
    if (kept.piece != piece || kept.place != place) kept = {piece, place, view_from(piece, place)};
    return kept.view;
  }
  [[nodiscard]] View view_from(PieceIndex piece, Place place) const noexcept {
    const std::optional<Vec2> at = place == Place::from        ? seen(piece, query_.from, query_.begin)
                                   : place == Place::last_free ? seen(piece, *query_.last_free, query_.begin)
                                                               : side_of(piece);
    View view;
    if (!at || !may_block(piece, *at)) return view;
    const BestAxis facing = best(piece, *at);
    if (facing.separation < -slack) return view;
    const Real kept = std::clamp(facing.separation, Real(0), tolerances.hit);
    const Real width = takes_time_ ? kept * Real(least_gap) : kept * margin + 2 * slack;
    view.blocks = true;
    view.place = *at;
    view.level = std::min(tolerances.hit, facing.separation);
    view.tangents = tangents_from(space_, piece, *at, space_.normal(piece, facing.axis), width);
    return view;
  }
  /// @param at as the piece sees it.
  [[nodiscard]] bool may_block(PieceIndex piece, const Vec2& at) const noexcept {
    return solid(piece) || (!query_.drops && is_above(space_, piece, at, Vec2(Vec2::Zero())));
  }

  // The lines that are searched.

  void search_facets(PieceIndex piece) noexcept {
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis) search_facet(piece, axis);
    if (space_.is_circle(piece)) search_arcs(piece);
  }

  void search_facet(PieceIndex piece, std::size_t axis) noexcept {
    const Vec2 n = space_.normal(piece, axis);
    if (space_.covered(piece, axis) || (n.x() == 0 && n.y() == 0)) return;
    const Real bound = query_.gap - space_.separation(piece, axis, seen_at_end(piece, query_.near));
    if (!(std::abs(bound) < nearest_)) return;
    const Curve line{n * bound, {-n.y(), n.x()}};
    sweep_along(line, facet_on(line, piece, std::sqrt(nearest_ * nearest_ - bound * bound)));
  }

  /// The part of a facet's line that bounds the obstacle, at most `half` from its foot.
  [[nodiscard]] Part facet_on(const Curve& line, PieceIndex piece, Real half) const noexcept {
    const Vec2 foot = seen_at_end(piece, query_.near) + line.middle;
    Part part{-half, half};
    for (std::size_t axis = 0; axis < space_.axis_count(piece) && part.from <= part.to; ++axis) {
      const Vec2 n = space_.normal(piece, axis);
      const Real rate = n.x() * line.along.x() + n.y() * line.along.y();
      const Real depth = query_.gap - space_.separation(piece, axis, foot);
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

  /// The arcs on which a corner of the hull touches a circle, with the gap.
  void search_arcs(PieceIndex piece) noexcept {
    const Circle& circle = space_.circle(piece);
    const Vec2 centre = circle.centre - seen_at_end(piece, query_.near);
    const Real radius = circle.radius + query_.gap;
    const std::span<const Vec2d> hull = space_.hull();
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2 corner = hull[k];
      const Vec2 before = unit(Vec2(corner - hull[(k + hull.size() - 1) % hull.size()]));
      const Vec2 after = unit(Vec2(hull[(k + 1) % hull.size()] - corner));
      // The normals of both edges, inwards: between them the arc lies.
      const Vec2 from{-before.y(), before.x()};
      const Vec2 to{-after.y(), after.x()};
      const Vec2 out = unit(Vec2(from + to));
      const Curve arc{centre - corner, {-out.y(), out.x()}, out, radius};
      if (!(std::abs(length_of(arc.middle) - radius) < nearest_)) continue;
      const Real end = half_tangent(arc, to);
      const Part part{-end, end};
      const Vec2 foot = -arc.middle;
      if (foot.x() * out.x() + foot.y() * out.y() > 0) {
        const Real begin = std::clamp(half_tangent(arc, unit(foot)), part.from, part.to);
        sweep_along(arc, begin, part);
      } else {
        sweep_along(arc, part.from, part);
        sweep_along(arc, part.to, part);
      }
    }
  }

  [[nodiscard]] static Vec2 unit(const Vec2& v) noexcept { return v / length_of(v); }
  /// The place of a direction, less than half a turn from the middle of an arc.
  [[nodiscard]] static Real half_tangent(const Curve& arc, const Vec2& direction) noexcept {
    return (direction.x() * arc.along.x() + direction.y() * arc.along.y()) /
           (1 + (direction.x() * arc.out.x() + direction.y() * arc.out.y()));
  }

  void search_tangents(PieceIndex piece, Place place) noexcept {
    const View view = this->view(piece, place);
    if (!view.blocks) return;
    const Vec2 back = view.place - seen_at_end(piece, query_.near);
    for (const Vec2& n : {view.tangents.left, view.tangents.right}) {
      if (n.x() == 0 && n.y() == 0) continue;
      const Real bound = n.x() * back.x() + n.y() * back.y();
      if (!(std::abs(bound) < nearest_)) continue;
      const Real half = std::sqrt(nearest_ * nearest_ - bound * bound);
      sweep_along({n * bound, {-n.y(), n.x()}}, {-half, half});
    }
  }

  void sweep_along(const Curve& line, const Part& part) noexcept {
    if (part.from <= part.to) sweep_along(line, std::clamp(Real(0), part.from, part.to), part);
  }

  /// Both ways: the positions must get further away.
  void sweep_along(const Curve& curve, Real begin, const Part& part) noexcept {
    sweep_along(curve, begin, part.to, Real(1));
    sweep_along(curve, begin, part.from, Real(-1));
  }

  /// Takes the first place on a curve that is free and reached.
  void sweep_along(const Curve& curve, Real place, Real end, Real direction) noexcept {
    Real stride = first_stride / curve.pace();
    for (int tried = 0; tried <= most_strides; ++tried) {
      place = next_uncovered(curve, place, end, direction);
      if (place * direction > end * direction || consider(curve.at(place))) return;
      place += direction * stride;
      stride *= stride_growth;
    }
  }

  // The regions that cover them.

  /// The next place on a curve that no region covers, or one beyond the end. A region is convex: once left, it is not
  /// entered again by a line. The pieces are looked at forwards and backwards in turns, as they are mostly in order of
  /// place. A piece has three regions at most, so no line takes more rounds; of an arc the place is tried as it is
  /// then.
  [[nodiscard]] Real next_uncovered(const Curve& curve, Real place, Real end, Real direction) noexcept {
    const auto spot = [&] { return Spot{curve, place, end, direction, curve.at(place)}; };
    // A piece that covers one line often covers the next.
    place += direction * covered_from(spot(), last_covering_);
    if (place * direction > end * direction) return place;
    for (std::size_t round = 0; round <= 3 * pieces_.size(); ++round) {
      const Real before = place;
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const std::size_t index = round % 2 == 0 ? k : pieces_.size() - 1 - k;
        const Real beyond = covered_from(spot(), index);
        if (!(beyond > 0)) continue;
        last_covering_ = index;
        place += direction * beyond;
        if (place * direction > end * direction) return place;
      }
      if (place == before) break;
    }
    return place;
  }

  /// How far the regions of a piece reach from a spot; 0 if none covers it.
  [[nodiscard]] Real covered_from(const Spot& spot, std::size_t index) noexcept {
    const PieceIndex piece = pieces_[index];
    const bool is_solid = solid(piece);
    if (!is_solid && query_.drops) return 0;
    Real reach = is_solid ? obstacle_from(spot, piece) : Real(0);
    if (index >= passable_.size()) reach = std::max(reach, shadow_from(spot, piece, Place::from));
    if (query_.last_free) reach = std::max(reach, shadow_from(spot, piece, Place::last_free));
    if (index < passable_.size()) reach = std::max(reach, shadow_from(spot, piece, Place::side));
    return reach;
  }

  /// How far the obstacle reaches, with the gap.
  [[nodiscard]] Real obstacle_from(const Spot& spot, PieceIndex piece) const noexcept {
    const Vec2 at = seen_at_end(piece, query_.near) + spot.position;
    if (best(piece, at).separation >= query_.gap - slack) return 0;
    Real reach = infinity;
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      shorten(reach, spot, space_.normal(piece, axis), query_.gap - space_.separation(piece, axis, at));
    return space_.is_circle(piece) ? tangents_until(spot, piece, at, reach, query_.gap).reach : reach;
  }

  static void shorten(Real& reach, const Spot& spot, const Vec2& normal, Real depth) noexcept {
    reach = std::min(reach, spot.until(normal, depth));
  }

  /// Where a curve leaves a circle, and the axis of the tangent there; infinity where it does not, and 0 where it is
  /// beyond that tangent already.
  struct WayOut {
    Real reach;
    std::size_t axis;
  };
  /// From where the curve is beyond the circle, the tangent there shortens the way, again and again.
  [[nodiscard]] WayOut tangents_until(const Spot& spot, PieceIndex piece, const Vec2& at, Real reach,
                                      Real level) const noexcept {
    WayOut out{std::min(reach, spot.rest()), 0};
    for (int tangent = 0; tangent < most_tangents; ++tangent) {
      const BestAxis there = best(piece, at + (spot.after(out.reach) - spot.position));
      out.axis = there.axis;
      if (tangent == 0 && there.separation < level - slack) return {infinity, there.axis};
      const Real depth = level - space_.separation(piece, there.axis, at);
      const Real before = out.reach;
      if (!(depth > slack)) return {0, there.axis};
      shorten(out.reach, spot, space_.normal(piece, there.axis), depth);
      if (!(out.reach < before)) return out;
    }
    return out;
  }

  /// How far a shadow reaches.
  [[nodiscard]] Real shadow_from(const Spot& spot, PieceIndex piece, Place place) noexcept {
    const View& view = this->view(piece, place);
    if (!view.blocks) return 0;
    const Vec2 at = seen_at_end(piece, query_.near) + spot.position;
    const Vec2 travelled = at - view.place;
    const Real kept = solid(piece) ? view.level : query_.gap;
    Real reach = infinity;
    bool is_before = false;
    for_each_axis(piece, {view.place, at}, [&](std::size_t axis) {
      if (is_before || space_.separation(piece, axis, view.place) < view.level) return;
      const Real depth = kept - space_.separation(piece, axis, at);
      is_before = depth <= slack;
      if (!is_before) shorten(reach, spot, space_.normal(piece, axis), depth);
    });
    if (is_before) return 0;
    if (!solid(piece)) {  // it blocks only motion against its normal
      const Vec2 n = space_.normal(piece, space_.info(piece).one_way_axis);
      const Real depth = -(n.x() * travelled.x() + n.y() * travelled.y());
      if (depth <= 0) return 0;
      shorten(reach, spot, n, depth);
    }
    for (const Vec2& n : {view.tangents.left, view.tangents.right}) {
      if (n.x() == 0 && n.y() == 0) continue;
      const Real depth = -(n.x() * travelled.x() + n.y() * travelled.y());
      if (depth <= slack) return 0;
      shorten(reach, spot, n, depth);
    }
    if (!space_.is_circle(piece)) return reach;
    // The shadow of a circle begins at its arc.
    const WayOut front = tangents_until(spot, piece, at, reach, kept);
    return space_.separation(piece, front.axis, view.place) >= view.level ? std::min(reach, front.reach) : reach;
  }

  // The checks of a position.

  /// @return true where the search along this line ends: a position was taken, or all others on it are further away.
  bool consider(const Vec2& w) noexcept {
    const Vec2 q = query_.near + w;
    const Real distance = length_of(Vec2(q - query_.near));
    if (!(distance < nearest_)) return true;
    if (!reaches(q)) return false;
    best_ = q;
    nearest_ = distance;
    return true;
  }

  [[nodiscard]] bool has_gaps(const Vec2& q) const noexcept {
    return std::none_of(pieces_.begin(), pieces_.end(), [&](PieceIndex piece) {
      return solid(piece) && best(piece, seen_at_end(piece, q)).separation < tolerances.hit;
    });
  }

  /// Whether a position is on the side of a piece from which the character came: the straight motion from there is
  /// clear of the piece. It may touch the piece at its start, by rounding.
  [[nodiscard]] bool keeps_side(PieceIndex piece, const Vec2& q) const noexcept {
    constexpr Real certain = tolerances.certain;
    const std::optional<Vec2> from = side_of(piece);
    if (!from) return true;
    const Vec2 to = seen_at_end(piece, q);
    bool separates = false;
    for_each_axis(piece, {*from, to}, [&](std::size_t axis) {
      separates = separates ||
                  (space_.separation(piece, axis, *from) > -certain && space_.separation(piece, axis, to) >= certain);
    });
    if (separates) return true;
    return best(piece, *from).separation >= certain && passes(make_motion(space_, *from, Vec2(to - *from)), piece);
  }

  /// Whether a straight motion to a position hits no solid, and no one-way segment against its normal.
  /// @param time when it begins.
  [[nodiscard]] bool clear(PieceIndex piece, const Vec2& place, Real time, const Vec2& q) const noexcept {
    if (query_.drops && !solid(piece)) return true;
    const Vec2 from = seen(piece, place, time);
    const Vec2 to = seen_at_end(piece, q);
    Motion motion = make_motion(space_, from, Vec2(to - from));
    motion.lost = lost_by(place, offset(piece, time));
    if (!blocks(space_, motion, piece)) return true;
    if (one_axis_separates(space_, piece, from, to)) return true;
    if (clear_of_exactly(space_, piece, query_.movers, place, time, q, query_.end)) return true;
    return best(piece, from).separation >= tolerances.certain && passes(motion, piece);
  }

  [[nodiscard]] bool passes(const Motion& motion, PieceIndex piece) const noexcept {
    const Clearance room = clearance(space_, motion, piece);
    return room.clear() || !sweep_piece(space_, motion, piece, room).hit;
  }

  struct Kept {
    PieceIndex piece = ~PieceIndex{0};
    Place place = Place::from;
    View view{};
  };

  const ConfigurationSpace& space_;
  std::span<const PieceIndex> pieces_;
  std::span<const PieceIndex> passable_;
  const FreePositionQuery& query_;
  bool takes_time_;
  std::array<Kept, 64> kept_{};
  std::size_t last_covering_ = 0;
  Real nearest_;  ///< Distance of the best position so far [m].
  std::optional<Vec2> best_;
};

}  // namespace

std::optional<Vec2> nearest_free(const ConfigurationSpace& space, std::span<const PieceIndex> pieces,
                                 const FreePositionQuery& query) noexcept {
  return Search{space, pieces, query}.find();
}

bool reaches(const ConfigurationSpace& space, std::span<const PieceIndex> pieces, const FreePositionQuery& query,
             const Vec2& q) noexcept {
  return Search{space, pieces, query}.reaches(q);
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
