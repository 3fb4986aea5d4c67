/// octagon_sweep answers questions of first contact: `Controller::cast`.
///
///     queries_sweep double|float QUERIES.jsonl > ANSWERS.jsonl
///
/// Its tolerance is the gap at which it stops a motion. That is the separation along an axis: from corner to corner the
/// distance is up to 1.42 times as large.
#include "answers.hpp"

#include <paperproof/in_float.hpp>
#include <paperproof/paperproof.hpp>

#include <memory>

using namespace paperproof;
using queries::Json;

int main(int, char** arguments) {
  const bool as_float = arguments[1] == std::string("float");
  const auto point = as_float ? &queries::point<Vec2d, float> : &queries::point<Vec2d, double>;
  const auto points = as_float ? &queries::points<Vec2d, float> : &queries::points<Vec2d, double>;
  const auto prepare = [&](const Json& question) {
    const auto from = as_float ? question["position"].get<queries::Point>() : queries::Point{0, 0};
    SceneryDef def;
    for (const Json& solid : question["solids"]) {
      const bool is_chain = solid.contains("chain");
      ColliderDef collider{.shape = is_chain ? ColliderDef::Shape::chain : ColliderDef::Shape::polygon,
                           .points = points(solid[is_chain ? "chain" : "polygon"], from)};
      for (const Json& hole : solid.value("holes", Json::array())) collider.holes.push_back(points(hole, from));
      def.colliders.push_back(std::move(collider));
    }
    const CharacterDef character{.shape = CharacterShape(points(question["points"], {0, 0}))};
    const auto scenery = std::make_shared<const Scenery>(def);
    const auto controller = std::make_shared<const Controller>(as_float ? make_controller_in_float(*scenery, character)
                                                                        : Controller(*scenery, character));
    const Vec2d position = point(question["position"], from);
    const Vec2d way = point(question["displacement"], {0, 0});
    const auto scratch = std::make_shared<Scratch>(controller->make_scratch());
    return [=, kept = scenery] {
      const auto contact = controller->cast(position, way, {.dt = 1}, *scratch);
      return contact ? std::optional(contact->fraction) : std::nullopt;
    };
  };
  const double tolerance = 1.42 * (as_float ? tolerances_in_float : Tolerances{}).stop;
  queries::answer_all(
      arguments[2],
      {{"method", std::string("octagon_sweep, ") + arguments[1]}, {"tolerance", tolerance}, {"float", as_float}},
      prepare);
}
