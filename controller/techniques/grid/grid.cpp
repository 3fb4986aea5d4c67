/// The article's grid, as in the games of 1983: the level is a two-dimensional array of squares, and the character is
/// in exactly one of them.
///
/// In each step the square that the wanted motion leads to is looked up, for either component; where it is solid the
/// motion that way is prevented before it begins. Of what is left the larger component moves the character into the
/// next square, in one of the four directions and by exactly one square, once half a square has been wanted. Until then
/// the motion is kept in the state's `technique_memory`: a game draws its character at position + technique_memory, and
/// nothing collides there. Where no motion is wanted along a component what is drawn glides to the middle of the
/// square, at the character's walking speed (or a square per second, if that is more): a move ends exactly in a square,
/// for the eye too. More than one square in a step cannot be made; what is over is dropped.
///
/// `position` puts the feet of the character on the lower edge of its square, and its box in the middle between left
/// and right (for a character as large as its square: the centre). What sticks out of the square is drawn and not
/// tested: a character that is taller than its square has its head in what is above. The first step moves it from
/// wherever it starts into the square that holds its middle and whose lower edge is nearest to its feet.
///
/// The knob is `square`, the side of the squares; the others have no meaning here. A contact's fraction is 0, its point
/// the middle of the square's edge.
#include "techniques/article_response.hpp"
#include "techniques/grid/squares.hpp"
#include "techniques/knobs.hpp"
#include "techniques/registry.hpp"
#include "techniques/rounding.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof {
namespace {

using grid::Square;
using grid::Squares;

class Grid final : public Technique {
 public:
  Grid(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character)
      : squares_(scenery.as_run(), def.article.square, Tolerances{}.touch),
        box_(character.shape.box()),
        glide_speed_(std::max(character.walk_speed, def.article.square)) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "grid"; }
  [[nodiscard]] Scratch make_scratch() const override { return {}; }
  [[nodiscard]] std::size_t memory_bytes() const noexcept override { return squares_.memory_bytes(); }
  void move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept override;

 private:
  [[nodiscard]] Vec2d glided(const MoveRequest& request) const noexcept;
  [[nodiscard]] Square square_of(const Vec2d& position) const noexcept;
  [[nodiscard]] Vec2d position_in(const Square& square) const noexcept;
  void prevent(const Square& square, const MoveRequest& request, MoveResult& result) const noexcept;
  void meet(const Square& square, ColliderIndex collider, Side side, MoveResult& result) const noexcept;
  [[nodiscard]] Square step_from(const Square& square, MoveResult& result) const noexcept;

  Squares squares_;
  Box2 box_;            ///< Of the character.
  double glide_speed_;  ///< [m/s]
};

Square next_to(Square square, Eigen::Index component, bool forwards) noexcept {
  (component == 0 ? square.column : square.row) += forwards ? 1 : -1;
  return square;
}

void Grid::move(const MoveRequest& request, Scratch&, MoveResult& result) const noexcept {
  if (article::refuse_out_of_range(request, result)) return;
  result.clear();
  result.velocity = request.velocity;
  result.technique_memory = glided(request) + request.displacement;
  const Square start = square_of(request.position);
  result.position = position_in(start);
  prevent(start, request, result);
  const Square end = step_from(start, result);
  result.position = position_in(end);
  if (squares_.collider_at(start) && squares_.collider_at(end)) result.status = StepStatus::stuck;
  result.path.push_back({request.position, 0});
  result.path.push_back({result.position, 1});
}

/// What is left of the motion that was kept: where nothing is wanted, what is drawn goes on to its square.
Vec2d Grid::glided(const MoveRequest& request) const noexcept {
  const double way = glide_speed_ * request.dt;
  Vec2d left = request.technique_memory;
  for (const Eigen::Index i : {0, 1})
    if (request.displacement[i] == 0) left[i] -= std::clamp(left[i], -way, way);
  return left;
}

Square Grid::square_of(const Vec2d& position) const noexcept {
  const double middle = position.x() + (box_.lower.x() + box_.upper.x()) / 2;
  const double feet = position.y() + box_.lower.y();
  return {static_cast<std::int64_t>(std::floor(middle / squares_.side())),
          static_cast<std::int64_t>(std::floor(feet / squares_.side() + 0.5))};
}

/// The feet are never below the edge by rounding.
Vec2d Grid::position_in(const Square& square) const noexcept {
  const double middle = (static_cast<double>(square.column) + 0.5) * squares_.side();
  const double bottom = static_cast<double>(square.row) * squares_.side();
  return {middle - (box_.lower.x() + box_.upper.x()) / 2, difference_rounded_up(bottom, box_.lower.y())};
}

/// Takes away the motion that leads into a solid square. Only a motion that was wanted in this step makes a contact.
void Grid::prevent(const Square& square, const MoveRequest& request, MoveResult& result) const noexcept {
  for (const Eigen::Index component : {1, 0}) {
    double& wanted = result.technique_memory[component];
    if (wanted == 0) continue;
    const bool forwards = wanted > 0;
    const auto collider = squares_.collider_at(next_to(square, component, forwards));
    if (!collider) continue;
    wanted = 0;
    const double now = request.displacement[component];
    if (forwards ? now > 0 : now < 0) meet(square, *collider, article::side_ahead(component, forwards), result);
  }
}

void Grid::meet(const Square& square, ColliderIndex collider, Side side, MoveResult& result) const noexcept {
  const Eigen::Index component = article::component_of(side);
  const auto outwards = static_cast<double>(article::outwards(side));
  const double half = squares_.side() / 2;
  Vec2d point{(static_cast<double>(square.column) + 0.5) * squares_.side(),
              (static_cast<double>(square.row) + 0.5) * squares_.side()};
  point[component] += outwards * half;
  const double reach = outwards < 0 ? box_.lower[component] : box_.upper[component];
  const double gap = (point[component] - result.position[component] - reach) * outwards;
  Contact contact{.collider = collider, .point = point, .separation = gap};
  contact.normal[component] = -outwards;
  contact.side = side;
  result.contacts.push_back(contact);
  result.velocity[component] = 0;
  if (side == Side::bottom) result.grounded = true;
}

/// One square in the direction of the larger component, where half a square of it is wanted.
Square Grid::step_from(const Square& square, MoveResult& result) const noexcept {
  const auto side = squares_.side();
  Vec2d& wanted = result.technique_memory;
  const Eigen::Index component = std::abs(wanted.x()) > std::abs(wanted.y()) ? 0 : 1;
  Square end = square;
  if (std::abs(wanted[component]) >= side / 2) {
    const bool forwards = wanted[component] > 0;
    end = next_to(square, component, forwards);
    wanted[component] -= forwards ? side : -side;
  }
  if (wanted.cwiseAbs().maxCoeff() > side) {
    wanted = wanted.cwiseMax(-side).cwiseMin(side);
    result.status = StepStatus::dropped;
  }
  return end;
}

}  // namespace

TechniqueEntry grid_entry() {
  TechniqueEntry entry = entry_of<Grid>(
      "grid", {{"square", "side of a square [m]",
                [](const std::string& value, TechniqueDef& def) { def.article.square = real_in(value); }}});
  entry.unit = [](const ArticleKnobs& knobs) { return knobs.square; };
  return entry;
}

}  // namespace paperproof
