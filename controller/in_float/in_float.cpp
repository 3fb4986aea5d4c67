// The sources of the step, with another number.
#include "real_in_float.hpp"

#include <paperproof/in_float.hpp>

#include "step/certificate.cpp"
#include "step/configuration_space.cpp"
#include "step/free_position.cpp"
#include "step/octagon_sweep.cpp"

namespace paperproof {

Controller make_controller_in_float(const Scenery& scenery, const CharacterDef& character, const SweepDef& sweep) {
  return Controller(scenery, character, octagon_sweep::in_float::make_sweep(sweep, scenery, character), sweep.search);
}

}  // namespace paperproof
