/// The article's primitive: the whole position is wound back along the movement, one unit at a time, until it is free.
///
/// Every collision point is tested, at the positions it looks at and nowhere between: paper is passed, and a chain,
/// which has no inside, is never met. There is one pass and no iteration; the knobs `pairs`, `response` and
/// `iterations` have no meaning here. A start that collides is where winding back ends: it stays there, and says that
/// it is stuck. As the whole vector is shortened, a walker sticks to the floor that gravity pulls it into.
///
/// A contact names the point that was inside last; its fraction is where the position was wound back to.
#include "techniques/article_response.hpp"
#include "techniques/knobs.hpp"
#include "techniques/registry.hpp"

namespace paperproof {
namespace {

using article::Parts;

template <class Scalar>
class WindBack final : public Technique<Scalar> {
 public:
  WindBack(const TechniqueDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character)
      : parts_(def, scenery, character) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "wind_back"; }
  [[nodiscard]] Scratch<Scalar> make_scratch() const override { return parts_.make_scratch(); }
  void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
            MoveResult<Scalar>& result) const noexcept override;

 private:
  void report(const NearbyScenery<Scalar>& nearby, const MoveRequest<Scalar>& request, const Vec2<Scalar>& collided,
              Scalar fraction, MoveResult<Scalar>& result) const noexcept;

  Parts<Scalar> parts_;
};

template <class Scalar>
void WindBack<Scalar>::move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
                            MoveResult<Scalar>& result) const noexcept {
  if (refuse(parts_, true, request, result)) return;
  result.clear();
  const Vec2<Scalar> end = request.position + request.displacement;
  const NearbyScenery<Scalar> nearby = parts_.near(request.position, end, scratch);
  const Scalar vector_length = article::length(request.displacement);
  Vec2<Scalar> position = end;
  Vec2<Scalar> collided = end;
  Scalar fraction = 1;
  bool inside = parts_.inside(nearby, position);
  const bool hit = inside;
  for (int units = 1; inside && fraction > 0; ++units) {
    const Scalar back = static_cast<Scalar>(units) * parts_.unit;
    fraction = back < vector_length ? 1 - back / vector_length : Scalar(0);
    collided = position;
    position = request.position + request.displacement * fraction;
    inside = parts_.inside(nearby, position);
  }
  result.status = inside ? MoveStatus::stuck : MoveStatus::moved;
  result.position = position;
  result.velocity = request.velocity;
  result.path.push_back({request.position, 0});
  result.path.push_back({position, 1});
  if (hit) report(nearby, request, collided, fraction, result);
}

/// Which side a point belongs to says the outline that it left backwards.
template <class Scalar>
void WindBack<Scalar>::report(const NearbyScenery<Scalar>& nearby, const MoveRequest<Scalar>& request,
                              const Vec2<Scalar>& collided, Scalar fraction,
                              MoveResult<Scalar>& result) const noexcept {
  if (request.displacement.isZero(0)) return;
  for (const Vec2<Scalar>& offset : parts_.points.offsets) {
    const Vec2<Scalar> point = collided + offset;
    const auto piece = nearby.containing(point);
    if (!piece) continue;
    const PointHit<Scalar> hit = nearby.way_out(*piece, point, -request.displacement);
    const Side side = side_of_normal(hit.normal.x(), hit.normal.y());
    result.velocity[article::component_of(side)] = 0;
    if (side == Side::bottom) result.grounded = true;
    if (!article::add_contact(*parts_.scenery, hit, side, fraction, result)) continue;
    const Vec2<Scalar> gap = result.position + offset - hit.point;
    result.contacts.back().separation = gap.dot(hit.normal);
  }
}

}  // namespace

TechniqueEntry wind_back_entry() {
  TechniqueEntry entry = entry_of<WindBack>("wind_back", {knob::unit, knob::points});
  entry.unit = knob::unit_of_search;
  return entry;
}

}  // namespace paperproof
