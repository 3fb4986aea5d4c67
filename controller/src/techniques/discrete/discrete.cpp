#include "techniques/discrete/discrete.hpp"

#include "techniques/article_response.hpp"
#include "techniques/discrete/solver.hpp"

namespace paperproof {
namespace {

using discrete::Body;
using discrete::Solver;

template <class Scalar>
struct Workplace final : OwnMemory {
  Solver<Scalar> solver{Tolerances<Scalar>{}.stop, Tolerances<Scalar>{}.touch};
  std::vector<Body<Scalar>> bodies;  ///< The character, then what is near.
};

template <class Scalar>
class Discrete final : public Technique<Scalar> {
 public:
  Discrete(const TechniqueDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character)
      : scenery_(&scenery),
        broad_phase_(make_broad_phase<Scalar>(def.broad_phase, scenery.static_boxes())),
        box_{character.shape.box().lower.cast<Scalar>(), character.shape.box().upper.cast<Scalar>()},
        iterations_(def.article.iterations) {
    for (const Vec2d& corner : character.shape.hull()) outline_.push_back(corner.cast<Scalar>());
  }

  [[nodiscard]] std::string_view name() const noexcept override { return name_of(TechniqueKind::discrete); }
  [[nodiscard]] Scratch<Scalar> make_scratch() const override;
  void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
            MoveResult<Scalar>& result) const noexcept override;

 private:
  [[nodiscard]] std::span<Body<Scalar>> gather(const Body<Scalar>& character, Scratch<Scalar>& scratch) const noexcept;
  [[nodiscard]] bool is_inside(const Vec2<Scalar>& position, Scratch<Scalar>& scratch) const noexcept;
  void report(std::span<const discrete::SolvedImpact<Scalar>> solved, std::span<const PieceIndex> pieces,
              MoveResult<Scalar>& result) const noexcept;
  void measure_gaps(MoveResult<Scalar>& result) const noexcept;

  const Scenery<Scalar>* scenery_;
  std::unique_ptr<BroadPhase<Scalar>> broad_phase_;
  FixedVector<Vec2<Scalar>, CharacterShape::max_points> outline_;
  Box2<Scalar> box_;
  int iterations_;
};

template <class Scalar>
Workplace<Scalar>& workplace_of(Scratch<Scalar>& scratch) noexcept {
  return static_cast<Workplace<Scalar>&>(*scratch.own);
}

template <class Scalar>
Scratch<Scalar> Discrete<Scalar>::make_scratch() const {
  const std::size_t pieces = scenery_->pieces().size();
  Scratch<Scalar> scratch;
  scratch.candidates.resize(pieces);
  auto own = std::make_unique<Workplace<Scalar>>();
  own->bodies.reserve(pieces + 1);
  own->solver.reserve(pieces + 1, pieces);  // the character with each piece; pieces do not meet each other
  scratch.own = std::move(own);
  return scratch;
}

template <class Scalar>
void Discrete<Scalar>::move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
                            MoveResult<Scalar>& result) const noexcept {
  if (article::refuse_out_of_range(request, result)) return;
  result.clear();
  Body<Scalar> character;
  character.outline = {outline_.begin(), outline_.end()};
  character.box = box_;
  character.position = request.position;
  character.movement = request.displacement;
  character.velocity = request.velocity;
  bool left_over = true;
  for (int iteration = 0; left_over && iteration < iterations_; ++iteration) {
    const std::span<Body<Scalar>> bodies = gather(character, scratch);
    Solver<Scalar>& solver = workplace_of(scratch).solver;
    left_over = solver.solve_once(bodies);
    character = bodies.front();
    report(solver.solved(), std::span(scratch.candidates).first(scratch.candidate_count), result);
  }
  result.position = character.expected();
  result.velocity = character.velocity;
  measure_gaps(result);
  result.path.push_back({request.position, 0});
  result.path.push_back({result.position, 1});
  if (left_over && is_inside(request.position, scratch) && is_inside(result.position, scratch)) {
    result.status = MoveStatus::stuck;
  }
}

/// The character and all pieces near its total box.
template <class Scalar>
std::span<Body<Scalar>> Discrete<Scalar>::gather(const Body<Scalar>& character,
                                                 Scratch<Scalar>& scratch) const noexcept {
  scratch.valid = false;
  scratch.candidate_count = broad_phase_->query(character.total_box(), scratch.candidates);
  std::vector<Body<Scalar>>& bodies = workplace_of(scratch).bodies;
  bodies.clear();  // keeps its memory
  bodies.push_back(character);
  for (const PieceIndex piece : std::span(scratch.candidates).first(scratch.candidate_count)) {
    Body<Scalar> body;
    body.outline = scenery_->vertices_of(piece);
    body.box = scenery_->box(piece);
    body.inverse_mass = 0;
    body.one_way = scenery_->pieces()[piece].one_way;
    bodies.push_back(body);
  }
  return bodies;
}

template <class Scalar>
bool Discrete<Scalar>::is_inside(const Vec2<Scalar>& position, Scratch<Scalar>& scratch) const noexcept {
  Body<Scalar> character;
  character.outline = {outline_.begin(), outline_.end()};
  character.box = box_;
  character.position = position;
  const std::span<const Body<Scalar>> bodies = gather(character, scratch);
  return std::any_of(bodies.begin() + 1, bodies.end(), [&](const Body<Scalar>& body) {
    return discrete::began_overlapping<Scalar>(bodies.front(), body, Tolerances<Scalar>{}.touch);
  });
}

template <class Scalar>
void Discrete<Scalar>::report(std::span<const discrete::SolvedImpact<Scalar>> solved,
                              std::span<const PieceIndex> pieces, MoveResult<Scalar>& result) const noexcept {
  for (const discrete::SolvedImpact<Scalar>& each : solved) {
    const discrete::Impact<Scalar>& impact = each.impact;
    const PieceIndex piece = pieces[each.bodies.second - 1];
    const Side side = side_of_normal(impact.normal.x(), impact.normal.y());
    article::add_contact(*scenery_, {piece, impact.point, impact.normal, impact.time}, side, impact.time, result);
    if (side == Side::bottom) result.grounded = true;
  }
}

/// Along each contact's normal, from the obstacle to the nearest corner of the character where it ended.
template <class Scalar>
void Discrete<Scalar>::measure_gaps(MoveResult<Scalar>& result) const noexcept {
  for (Contact<Scalar>& contact : result.contacts) {
    const auto height_of = [&](const Vec2<Scalar>& corner) {
      const Vec2<Scalar> from_point = result.position + corner - contact.point;
      return from_point.dot(contact.normal);
    };
    contact.separation = height_of(outline_[0]);
    for (const Vec2<Scalar>& corner : outline_) contact.separation = std::min(contact.separation, height_of(corner));
  }
}

}  // namespace

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_discrete(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                 const CharacterDef& character) {
  return std::make_unique<Discrete<Scalar>>(def, scenery, character);
}

template std::unique_ptr<Technique<float>> make_discrete(const TechniqueDef&, const Scenery<float>&,
                                                         const CharacterDef&);
template std::unique_ptr<Technique<double>> make_discrete(const TechniqueDef&, const Scenery<double>&,
                                                          const CharacterDef&);

}  // namespace paperproof
