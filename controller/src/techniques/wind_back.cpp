#include "techniques/wind_back.hpp"

#include "techniques/article_response.hpp"

namespace paperproof {
namespace {

using article::Parts;

template <class Scalar>
class WindBack final : public Technique<Scalar> {
 public:
  WindBack(const TechniqueDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character)
      : parts_(def, scenery, character) {}

  [[nodiscard]] std::string_view name() const noexcept override { return name_of(TechniqueKind::wind_back); }
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

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_wind_back(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                  const CharacterDef& character) {
  return std::make_unique<WindBack<Scalar>>(def, scenery, character);
}

template std::unique_ptr<Technique<float>> make_wind_back(const TechniqueDef&, const Scenery<float>&,
                                                          const CharacterDef&);
template std::unique_ptr<Technique<double>> make_wind_back(const TechniqueDef&, const Scenery<double>&,
                                                           const CharacterDef&);

}  // namespace paperproof
