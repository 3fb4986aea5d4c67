/// The project's own technique, as the registry knows it: see <paperproof/octagon_sweep.hpp>.
#include "techniques/registry.hpp"

#include <paperproof/octagon_sweep.hpp>

namespace paperproof {
namespace {

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                        const CharacterDef& character) {
  return make_octagon_sweep(SweepDef{def.search, def.sweep_iterations}, scenery, character);
}

}  // namespace

TechniqueEntry octagon_sweep_entry() {
  return {.name = "octagon_sweep",
          .make_float = make<float>,
          .make_double = make<double>,
          .knobs = {{"iterations", "rounds per step, at least 1",
                     [](const std::string& value, TechniqueDef& def) { def.sweep_iterations = whole_in(value); }}},
          .knows_movers = true,
          .knows_circles = true,
          .moves_crowds = true};
}

}  // namespace paperproof
