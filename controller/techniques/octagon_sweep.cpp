/// The project's own technique, as the registry knows it: `Controller` is it.
#include "techniques/registry.hpp"

namespace paperproof {

TechniqueEntry octagon_sweep_entry() {
  return {.name = "octagon_sweep",
          .knobs = {{"iterations", "rounds per step, at least 1",
                     [](const std::string& value, TechniqueDef& def) { def.sweep_iterations = whole_in(value); }}},
          .knows_movers = true,
          .knows_circles = true,
          .moves_crowds = true};
}

}  // namespace paperproof
