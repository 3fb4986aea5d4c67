#include "techniques/octagon_sweep/escape.hpp"

#include "techniques/octagon_sweep/certificate.hpp"
#include "techniques/octagon_sweep/narrow_phase.hpp"
#include "techniques/octagon_sweep/one_way.hpp"
#include "techniques/octagon_sweep/open_facets.hpp"

#include <paperproof/tolerances.hpp>

namespace paperproof::octagon_sweep {
namespace {

/// Pieces that the octagon is inside of at once; a start inside more of them looks at the first ones only.
constexpr std::size_t max_inside = 64;

template <std::size_t Lanes, class Scalar>
class Escape {
 public:
  Escape(const ConfigurationSpace<Scalar>& space, std::span<const PieceIndex> candidates,
         const MoveRequest<Scalar>& request, const Vec2<Scalar>& from) noexcept
      : space_(space),
        candidates_(candidates),
        movers_(request.movers),
        from_(from),
        last_free_(request.has_last_free ? &request.last_free : nullptr),
        drops_(request.drop),
        facets_(space, from, Tolerances<Scalar>{}.stop) {}

  std::optional<Vec2<Scalar>> find() noexcept {
    collect_solids();
    collect_facets();
    facets_.for_each_position([this](const Vec2<Scalar>& q) { consider(q); });
    if (same_side_) return same_side_;
    return any_side_;
  }

 private:
  void collect_solids() noexcept {
    for (const PieceIndex piece : candidates_)
      if (solid(piece) && near(piece, from_) && overlaps_exactly(space_, piece, local(piece, from_)))
        inside_.push_back(piece);
  }

  /// Where a piece is while its mover is at the step's start, relative to where it was built.
  [[nodiscard]] Vec2<Scalar> offset(PieceIndex piece) const noexcept {
    const MoverIndex mover = space_.scenery().pieces()[piece].mover;
    if (mover == no_mover) return Vec2<Scalar>::Zero();
    return movers_[mover].from;
  }
  /// A position as a piece that has not moved would see it.
  [[nodiscard]] Vec2<Scalar> local(PieceIndex piece, const Vec2<Scalar>& p) const noexcept { return p - offset(piece); }

  [[nodiscard]] bool solid(PieceIndex piece) const noexcept {
    return space_.info(piece).one_way_axis == ObstacleInfo::not_one_way;
  }

  [[nodiscard]] bool near(PieceIndex piece, const Vec2<Scalar>& p) const noexcept {
    return best_axis<everything>(space_, piece, local(piece, p)).separation < Tolerances<Scalar>{}.certain;
  }

  /// Whether a piece belongs to a collider that the start is inside of: such a one may be passed on the way out.
  [[nodiscard]] bool may_pass(PieceIndex piece) const noexcept {
    const std::span<const PieceInfo> pieces = space_.scenery().pieces();
    return std::any_of(inside_.begin(), inside_.end(),
                       [&](PieceIndex other) { return pieces[other].collider == pieces[piece].collider; });
  }

  void collect_facets() noexcept {
    for (const PieceIndex piece : candidates_)
      if (solid(piece) && may_pass(piece)) facets_.add(piece, offset(piece));
  }

  void consider(const Vec2<Scalar>& q) noexcept {
    const Scalar distance = length_of(Vec2<Scalar>(q - from_));
    if (!(distance < same_side_distance_)) return;
    const bool best_of_any = distance < any_side_distance_;
    if (!best_of_any && last_free_ == nullptr) return;
    if (!roomy(q) || !reachable(q)) return;
    if (best_of_any) {
      any_side_ = q;
      any_side_distance_ = distance;
    }
    if (last_free_ != nullptr && clear(*last_free_, q, false)) {
      same_side_ = q;
      same_side_distance_ = distance;
    }
  }

  [[nodiscard]] bool roomy(const Vec2<Scalar>& q) const noexcept {
    for (const PieceIndex piece : candidates_)
      if (solid(piece) && best_axis<everything>(space_, piece, local(piece, q)).separation < Tolerances<Scalar>{}.hit)
        return false;
    return true;
  }

  [[nodiscard]] bool reachable(const Vec2<Scalar>& q) const noexcept { return clear(from_, q, true); }

  /// Whether the straight way meets nothing but, where allowed, the solids that the start is inside of; and no one-way
  /// segment against its normal, unless it drops.
  [[nodiscard]] bool clear(const Vec2<Scalar>& from, const Vec2<Scalar>& to, bool leaving) const noexcept {
    for (const PieceIndex piece : candidates_)
      if (!(leaving && solid(piece) && may_pass(piece)) && !clear(piece, local(piece, from), local(piece, to)))
        return false;
    return true;
  }

  [[nodiscard]] bool clear(PieceIndex piece, const Vec2<Scalar>& from, const Vec2<Scalar>& to) const noexcept {
    if (drops_ && !solid(piece)) return true;
    const Motion<Lanes, Scalar> motion = make_motion<everything>(space_, from, Vec2<Scalar>(to - from));
    if (!blocks<everything>(space_, motion, piece)) return true;
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      if (space_.separation(piece, axis, from) >= Tolerances<Scalar>{}.certain &&
          space_.separation(piece, axis, to) >= Tolerances<Scalar>{}.certain)
        return true;
    if (clear_of_exactly(space_, piece, from, to)) return true;
    const Clearance<Scalar> room = clearance<everything>(space_, motion, piece);
    if (room.start < Tolerances<Scalar>{}.certain) return false;
    return room.clear() || !sweep_piece<everything>(space_, motion, piece, room).hit;
  }

  static constexpr Variant everything{.lanes = Lanes};
  const ConfigurationSpace<Scalar>& space_;
  std::span<const PieceIndex> candidates_;
  std::span<const MoverMotion<Scalar>> movers_;
  Vec2<Scalar> from_;
  const Vec2<Scalar>* last_free_;
  bool drops_;
  FixedVector<PieceIndex, max_inside> inside_;
  OpenFacets<Scalar> facets_;
  std::optional<Vec2<Scalar>> any_side_;
  std::optional<Vec2<Scalar>> same_side_;
  Scalar any_side_distance_ = std::numeric_limits<Scalar>::infinity();
  Scalar same_side_distance_ = std::numeric_limits<Scalar>::infinity();
};

}  // namespace

template <std::size_t Lanes, class Scalar>
std::optional<Vec2<Scalar>> way_out(const ConfigurationSpace<Scalar>& space, std::span<const PieceIndex> candidates,
                                    const MoveRequest<Scalar>& request, const Vec2<Scalar>& from) noexcept {
  return Escape<Lanes, Scalar>{space, candidates, request, from}.find();
}

#define PAPERPROOF_INSTANTIATE(Lanes, Scalar)                                                                         \
  template std::optional<Vec2<Scalar>> way_out<Lanes>(const ConfigurationSpace<Scalar>&, std::span<const PieceIndex>, \
                                                      const MoveRequest<Scalar>&, const Vec2<Scalar>&) noexcept;
PAPERPROOF_INSTANTIATE(8, float)
PAPERPROOF_INSTANTIATE(8, double)
PAPERPROOF_INSTANTIATE(12, float)
PAPERPROOF_INSTANTIATE(12, double)
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::octagon_sweep
