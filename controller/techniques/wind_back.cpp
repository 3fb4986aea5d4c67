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

class WindBack final : public Technique {
 public:
  WindBack(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character)
      : parts_(def, scenery, character) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "wind_back"; }
  [[nodiscard]] Scratch make_scratch() const override { return parts_.make_scratch(); }
  void move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept override;

 private:
  void report(const NearbyScenery& nearby, const MoveRequest& request, const Vec2d& collided, double fraction,
              MoveResult& result) const noexcept;

  Parts parts_;
};

void WindBack::move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept {
  if (refuse(parts_, true, request, result)) return;
  result.clear();
  const Vec2d end = request.position + request.displacement;
  const NearbyScenery nearby = parts_.near(request.position, end, scratch);
  const double vector_length = request.displacement.norm();
  Vec2d position = end;
  Vec2d collided = end;
  double fraction = 1;
  bool inside = parts_.inside(nearby, position);
  const bool hit = inside;
  for (int units = 1; inside && fraction > 0; ++units) {
    const double back = static_cast<double>(units) * parts_.unit;
    fraction = back < vector_length ? 1 - back / vector_length : 0.0;
    collided = position;
    position = request.position + request.displacement * fraction;
    inside = parts_.inside(nearby, position);
  }
  result.status = inside ? StepStatus::stuck : StepStatus::moved;
  result.position = position;
  result.velocity = request.velocity;
  result.path.push_back({request.position, 0});
  result.path.push_back({position, 1});
  if (hit) report(nearby, request, collided, fraction, result);
}

/// Which side a point belongs to says the outline that it left backwards.
void WindBack::report(const NearbyScenery& nearby, const MoveRequest& request, const Vec2d& collided, double fraction,
                      MoveResult& result) const noexcept {
  if (request.displacement.isZero(0)) return;
  for (const Vec2d& offset : parts_.points.offsets) {
    const Vec2d point = collided + offset;
    const auto piece = nearby.containing(point);
    if (!piece) continue;
    const PointHit hit = nearby.way_out(*piece, point, -request.displacement);
    const Side side = side_of_normal(hit.normal.x(), hit.normal.y());
    result.velocity[article::component_of(side)] = 0;
    if (side == Side::bottom) result.grounded = true;
    if (!article::add_contact(*parts_.scenery, hit, side, fraction, result)) continue;
    const Vec2d gap = result.position + offset - hit.point;
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
