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
#include "step/curve.hpp"
#include "step/narrow_phase.hpp"
#include "step/one_way.hpp"
#include "step/shadow.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {
namespace {

class Search {
 public:
  Search(const ConfigurationSpace& space, std::span<const PieceIndex> pieces, const FreePositionQuery& query)
      : space_(space), pieces_(pieces), query_(query), takes_time_(query.begin < query.end), nearest_(query.reach) {}

  [[nodiscard]] std::optional<Vec2> find() {
    if (query_.last_free && is_inside_something(*query_.last_free)) return std::nullopt;
    if (takes_time_) {
      if (starts_inside()) return std::nullopt;
      consider(Vec2::Zero());
    }
    for (std::size_t index = 0; index < pieces_.size(); ++index) {
      const bool bounds = takes_time_ || is_passable(index);
      if (bounds || (query_.last_free && !solid(pieces_[index]))) search_facets(pieces_[index]);
      if (bounds) search_tangents(index, Place::start);
      search_tangents(index, Place::last_free);
    }
    return best_;
  }

 private:
  /// Rounding stays below this: a position this little inside a region counts as outside [m].
  static constexpr Real slack = tolerances.certain;
  /// A motion keeps this many times more from the corners that it passes than what would stop it, which is measured
  /// along axes: no two neighbouring ones are more than a right angle apart.
  static constexpr Real margin = Real(1.5);
  /// The same where the motion takes time.
  static constexpr Real margin_in_time = Real(1.25);
  /// Where rounding spoils a place, others beyond it are tried: first this far, then in strides that grow [m].
  static constexpr Real first_stride = 2 * tolerances.hit;
  static constexpr Real stride_growth = 16;
  static constexpr int most_strides = 5;
  /// So many tangents find where a curve leaves a circle: each about squares the distance that is left.
  static constexpr int most_tangents = 64;

  struct Part {
    Real from;
    Real to;
  };
  /// Where a motion starts that must be clear of a piece. The first is where the search starts, or for a piece that may
  /// be passed where the character was before.
  enum class Place : std::uint8_t { start, last_free };
  /// The shadow of a piece.
  struct View {
    Vec2 place;  ///< Where the motion starts, as the piece sees it.
    Real level;  ///< Gap that the motion keeps from the piece [m].
    Tangents tangents;
  };

  // Pieces and shadows.

  [[nodiscard]] bool is_passable(std::size_t index) const { return index < query_.passable; }
  /// Offset of the mover of a piece at a fraction of the step; zero for a piece that stands still.
  [[nodiscard]] Vec2 offset(PieceIndex piece, Real time) const {
    const MoverIndex mover = space_.info(piece).source.mover;
    return mover == no_mover ? Vec2(Vec2::Zero()) : Vec2(query_.movers[mover].at(time));
  }
  /// A position relative to the mover of a piece.
  [[nodiscard]] Vec2 seen(PieceIndex piece, const Vec2& p, Real time) const { return p - offset(piece, time); }
  [[nodiscard]] Vec2 seen_at_end(PieceIndex piece, const Vec2& p) const { return seen(piece, p, query_.end); }
  [[nodiscard]] Vec2 near(PieceIndex piece) const { return seen_at_end(piece, query_.near); }
  [[nodiscard]] bool solid(PieceIndex piece) const { return !space_.info(piece).is_one_way(); }
  [[nodiscard]] BestAxis best(PieceIndex piece, const Vec2& at) const { return best_axis(space_, piece, at); }
  /// Where the character was before it overlapped a piece that may be passed, as the piece sees it.
  [[nodiscard]] std::optional<Vec2> side_of(PieceIndex piece) const {
    const PieceInfo& info = space_.info(piece).source;
    for (const Crusher& crusher : query_.crushers)
      if (crusher.collider == info.collider)
        return Vec2(crusher.last_free + (crusher.displacement - query_.movers[info.mover].to));
    if (!query_.entered_from) return std::nullopt;
    return seen(piece, *query_.entered_from, Real(0));
  }
  [[nodiscard]] std::optional<Vec2> place_of(std::size_t index, Place place) const {
    const PieceIndex piece = pieces_[index];
    if (place == Place::start) return is_passable(index) ? side_of(piece) : seen(piece, query_.from, query_.begin);
    return query_.last_free ? std::optional(seen(piece, *query_.last_free, query_.begin)) : std::nullopt;
  }
  [[nodiscard]] bool is_inside_something(const Vec2& p) const {
    return std::ranges::any_of(pieces_, [&](PieceIndex piece) {
      return solid(piece) && overlaps_exactly(space_, piece, query_.movers, p, query_.begin);
    });
  }
  [[nodiscard]] bool starts_inside() const {
    const std::span<const PieceIndex> others = pieces_.subspan(query_.passable);
    return std::ranges::any_of(others, [&](PieceIndex piece) {
      return solid(piece) && best(piece, seen(piece, query_.from, query_.begin)).separation < 0;
    });
  }

  /// The same shadows are needed on many lines, and tangents are expensive: the last ones are kept.
  [[nodiscard]] const std::optional<View>& view(std::size_t index, Place place) {
    const std::size_t key = 2 * index + static_cast<std::size_t>(place);
    Kept& kept = kept_[key % kept_.size()];
    if (kept.key != key) kept = {key, view_from(index, place)};
    return kept.view;
  }
  [[nodiscard]] std::optional<View> view_from(std::size_t index, Place place) const {
    const PieceIndex piece = pieces_[index];
    const std::optional<Vec2> at = place_of(index, place);
    if (!at || (!solid(piece) && (query_.drops || !is_above(space_, piece, *at, Vec2(Vec2::Zero())))))
      return std::nullopt;
    const BestAxis facing = best(piece, *at);
    if (facing.separation < -slack) return std::nullopt;
    const Real kept = std::clamp(facing.separation, Real(0), tolerances.hit);
    const Real width = takes_time_ ? kept * margin_in_time : kept * margin + 2 * slack;
    return View{*at, std::min(tolerances.hit, facing.separation),
                tangents_from(space_, piece, *at, space_.normal(piece, facing.axis), width)};
  }

  // The curves that are searched. Positions on them are relative to `query.near`.

  void search_facets(PieceIndex piece) {
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      if (!space_.hidden(piece, axis))
        search_line(space_.normal(piece, axis), query_.gap - space_.separation(piece, axis, near(piece)), piece);
    if (space_.is_circle(piece)) search_arcs(piece);
  }

  void search_tangents(std::size_t index, Place place) {
    const std::optional<View> view = this->view(index, place);
    if (!view) return;
    for (const Vec2& n : {view->tangents.left, view->tangents.right})
      search_line(n, dot(n, Vec2(view->place - near(pieces_[index]))), std::nullopt);
  }

  /// Searches the line of all w with n·w = bound.
  /// @param facet_of the line bounds this piece.
  void search_line(const Vec2& n, Real bound, std::optional<PieceIndex> facet_of) {
    if ((n.x() == 0 && n.y() == 0) || !(std::abs(bound) < nearest_)) return;
    const Curve line{n * bound, {-n.y(), n.x()}};
    const Real half = std::sqrt(nearest_ * nearest_ - bound * bound);
    const Part part = facet_of ? facet_on(line, *facet_of, half) : Part{-half, half};
    if (part.from <= part.to) sweep_along(line, std::clamp(Real(0), part.from, part.to), part);
  }

  /// The part of a facet's line that bounds the obstacle, at most `half` from its foot.
  [[nodiscard]] Part facet_on(const Curve& line, PieceIndex piece, Real half) const {
    const Vec2 foot = near(piece) + line.middle;
    Part part{-half, half};
    for (std::size_t axis = 0; axis < space_.axis_count(piece) && part.from <= part.to; ++axis) {
      const Real rate = dot(space_.normal(piece, axis), line.along);
      const Real depth = query_.gap - space_.separation(piece, axis, foot);
      if (std::abs(rate) < Spot::parallel) {
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
  void search_arcs(PieceIndex piece) {
    const Circle& circle = space_.circle(piece);
    const Vec2 centre = circle.centre - near(piece);
    const Real radius = circle.radius + query_.gap;
    const std::span<const Vec2d> hull = space_.hull();
    // The arc of a corner lies between the normals of its two edges.
    const auto inwards = [&](std::size_t edge) {
      const Vec2 along = unit(Vec2(hull[(edge + 1) % hull.size()] - hull[edge % hull.size()]));
      return Vec2{-along.y(), along.x()};
    };
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2 corner = hull[k];
      const Vec2 from = inwards(k + hull.size() - 1);
      const Vec2 to = inwards(k);
      const Vec2 out = unit(Vec2(from + to));
      const Curve arc{centre - corner, {-out.y(), out.x()}, out, radius};
      if (!(std::abs(length_of(arc.middle) - radius) < nearest_)) continue;
      const Real end = arc.place_towards(to);
      const Part part{-end, end};
      const Vec2 foot = -arc.middle;
      if (dot(foot, out) > 0) {
        sweep_along(arc, std::clamp(arc.place_towards(unit(foot)), part.from, part.to), part);
      } else {
        sweep_along(arc, part.from, part);
        sweep_along(arc, part.to, part);
      }
    }
  }

  /// Takes the first place on a curve that is free and reached, both ways: the positions must get further away.
  void sweep_along(const Curve& curve, Real begin, const Part& part) {
    for (const Real direction : {Real(1), Real(-1)}) {
      Spot spot(curve, begin, direction > 0 ? part.to : part.from, direction);
      Real stride = first_stride / curve.pace();
      for (int tried = 0; tried <= most_strides; ++tried) {
        leave_regions(spot);
        if (spot.is_beyond_end() || consider(spot.position)) break;
        spot.go(stride);
        stride *= stride_growth;
      }
    }
  }

  // The regions that cover them.

  /// Goes to the next place on a curve that no region covers, or to one beyond the end. A region is convex: once left,
  /// it is not entered again by a line. The pieces are looked at forwards and backwards in turns, as they are mostly in
  /// order of place. A piece has three regions at most, so no line takes more rounds; of an arc the place is tried as
  /// it is then.
  void leave_regions(Spot& spot) {
    // A piece that covers one line often covers the next.
    spot.go(covered_from(spot, last_covering_));
    for (std::size_t round = 0; round <= 3 * pieces_.size() && !spot.is_beyond_end(); ++round) {
      const Real before = spot.place;
      for (std::size_t k = 0; k < pieces_.size() && !spot.is_beyond_end(); ++k) {
        const std::size_t index = round % 2 == 0 ? k : pieces_.size() - 1 - k;
        const Real beyond = covered_from(spot, index);
        if (!(beyond > 0)) continue;
        last_covering_ = index;
        spot.go(beyond);
      }
      if (spot.place == before) return;
    }
  }

  /// How far the regions of a piece reach from a spot; 0 if none covers it.
  [[nodiscard]] Real covered_from(const Spot& spot, std::size_t index) {
    const bool is_solid = solid(pieces_[index]);
    if (!is_solid && query_.drops) return 0;
    const Real obstacle = is_solid ? obstacle_from(spot, pieces_[index]) : Real(0);
    return std::max({obstacle, shadow_from(spot, index, Place::start), shadow_from(spot, index, Place::last_free)});
  }

  /// How far the obstacle reaches, with the gap.
  [[nodiscard]] Real obstacle_from(const Spot& spot, PieceIndex piece) const {
    const Vec2 at = near(piece) + spot.position;
    if (best(piece, at).separation >= query_.gap - slack) return 0;
    Real reach = Spot::infinity;
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      cut(reach, spot, space_.normal(piece, axis), query_.gap - space_.separation(piece, axis, at));
    return space_.is_circle(piece) ? tangents_until(spot, piece, at, reach, query_.gap).reach : reach;
  }

  /// Cuts off what of a region is beyond a line. @param depth of the spot behind the line; at `least` it is outside.
  static void cut(Real& reach, const Spot& spot, const Vec2& normal, Real depth, Real least = slack) {
    reach = depth > least ? std::min(reach, spot.until(normal, depth)) : Real(0);
  }

  /// Where a curve leaves a circle, and the axis of the tangent there; infinity where it does not, and 0 where it is
  /// beyond that tangent already.
  struct WayOut {
    Real reach;
    std::size_t axis;
  };
  /// From where the curve is beyond the circle, the tangent there shortens the way, again and again.
  [[nodiscard]] WayOut tangents_until(const Spot& spot, PieceIndex piece, const Vec2& at, Real reach,
                                      Real level) const {
    // A little beyond the end.
    const Real rest = (spot.end - spot.place) * spot.direction + first_stride / spot.curve.pace();
    WayOut out{std::min(reach, rest), 0};
    for (int tangent = 0; tangent < most_tangents; ++tangent) {
      const BestAxis there = best(piece, at + (spot.after(out.reach) - spot.position));
      out.axis = there.axis;
      if (tangent == 0 && there.separation < level - slack) return {Spot::infinity, there.axis};
      const Real before = out.reach;
      cut(out.reach, spot, space_.normal(piece, there.axis), level - space_.separation(piece, there.axis, at));
      if (out.reach == 0 || !(out.reach < before)) return out;
    }
    return out;
  }

  /// How far a shadow reaches.
  [[nodiscard]] Real shadow_from(const Spot& spot, std::size_t index, Place place) {
    const std::optional<View>& view = this->view(index, place);
    if (!view) return 0;
    const PieceIndex piece = pieces_[index];
    const Vec2 at = near(piece) + spot.position;
    const Vec2 travelled = at - view->place;
    const Real kept = solid(piece) ? view->level : query_.gap;
    const auto faces = [&](std::size_t axis) { return space_.separation(piece, axis, view->place) >= view->level; };
    Real reach = Spot::infinity;
    const auto begin_behind = [&](std::size_t axis) {
      if (faces(axis)) cut(reach, spot, space_.normal(piece, axis), kept - space_.separation(piece, axis, at));
    };
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis) begin_behind(axis);
    if (space_.is_circle(piece))
      for (const Vec2& from : {view->place, at}) begin_behind(best(piece, from).axis);
    if (!solid(piece)) {  // it blocks only motion against its normal
      const Vec2 n = space_.normal(piece, space_.info(piece).one_way_axis);
      cut(reach, spot, n, -dot(n, travelled), Real(0));
    }
    for (const Vec2& n : {view->tangents.left, view->tangents.right})
      if (n.x() != 0 || n.y() != 0) cut(reach, spot, n, -dot(n, travelled));
    if (!space_.is_circle(piece)) return reach;
    // The shadow of a circle begins at its arc.
    const WayOut front = tangents_until(spot, piece, at, reach, kept);
    return faces(front.axis) ? std::min(reach, front.reach) : reach;
  }

  // The checks of a position.

  /// Whether a position is free, and the straight motion to it.
  [[nodiscard]] bool reaches(const Vec2& q) const {
    if (!(q.cwiseAbs().maxCoeff() <= tolerances.range)) return false;
    for (std::size_t index = 0; index < pieces_.size(); ++index) {
      const PieceIndex piece = pieces_[index];
      if (solid(piece) && best(piece, seen_at_end(piece, q)).separation < tolerances.hit) return false;
      if (!(is_passable(index) ? keeps_side(piece, q) : clear(piece, query_.from, q))) return false;
      if (query_.last_free && !clear(piece, *query_.last_free, q)) return false;
    }
    return true;
  }

  /// @return true where the search along this line ends: a position was taken, or all others on it are further away.
  bool consider(const Vec2& w) {
    const Vec2 q = query_.near + w;
    const Real distance = length_of(Vec2(q - query_.near));
    if (!(distance < nearest_)) return true;
    if (!reaches(q)) return false;
    best_ = q;
    nearest_ = distance;
    return true;
  }

  /// Whether a position is on the side of a piece from which the character came: the straight motion from there is
  /// clear of the piece. It may touch the piece at its start, by rounding.
  [[nodiscard]] bool keeps_side(PieceIndex piece, const Vec2& q) const {
    const std::optional<Vec2> from = side_of(piece);
    if (!from) return true;
    const Vec2 to = seen_at_end(piece, q);
    return one_axis_separates(space_, piece, *from, to, -tolerances.certain) ||
           passes(make_motion(space_, *from, Vec2(to - *from)), piece);
  }

  /// Whether a straight motion to a position hits no solid, and no one-way segment against its normal.
  [[nodiscard]] bool clear(PieceIndex piece, const Vec2& place, const Vec2& q) const {
    if (query_.drops && !solid(piece)) return true;
    const Vec2 from = seen(piece, place, query_.begin);
    const Vec2 to = seen_at_end(piece, q);
    const Motion motion = make_motion(space_, from, Vec2(to - from), lost_by(place, offset(piece, query_.begin)));
    return !blocks(space_, motion, piece) || one_axis_separates(space_, piece, from, to) ||
           clear_of_exactly(space_, piece, query_.movers, place, query_.begin, q, query_.end) || passes(motion, piece);
  }

  [[nodiscard]] bool passes(const Motion& motion, PieceIndex piece) const {
    return best(piece, motion.from).separation >= tolerances.certain && !find_hit(space_, motion, piece).hit;
  }

  struct Kept {
    std::size_t key = ~std::size_t{0};
    std::optional<View> view{};
  };

  const ConfigurationSpace& space_;
  std::span<const PieceIndex> pieces_;
  const FreePositionQuery& query_;
  bool takes_time_;
  std::array<Kept, 256> kept_{};  // of 128 pieces; with more, some are looked at again and again
  std::size_t last_covering_ = 0;
  Real nearest_;  ///< Distance of the best position so far [m].
  std::optional<Vec2> best_;
};

}  // namespace

std::optional<Vec2> nearest_free(const ConfigurationSpace& space, std::span<const PieceIndex> pieces,
                                 const FreePositionQuery& query) {
  return Search{space, pieces, query}.find();
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
