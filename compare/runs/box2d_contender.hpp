/// The Box2D twin as a contender.
#pragma once

#include "runs/contender.hpp"

#include <paperproof/box2d/reference_world.hpp>

namespace paperproof::compare {

[[nodiscard]] std::unique_ptr<Contender> make_box2d_contender(box2d::SceneryMode mode, const Scene& scene,
                                                              const Scenery& scenery,
                                                              std::span<const KnobSetting> knobs);

}  // namespace paperproof::compare
