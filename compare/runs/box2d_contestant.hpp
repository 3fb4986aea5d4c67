/// The Box2D twin as a contestant.
#pragma once

#include "runs/contestant.hpp"

#include <paperproof/box2d/reference_world.hpp>

namespace paperproof::compare {

[[nodiscard]] std::unique_ptr<Contestant> make_box2d_contestant(box2d::SceneryMode mode, const Scene& scene,
                                                                const Scenery<double>& scenery,
                                                                std::span<const KnobSetting> knobs);

}  // namespace paperproof::compare
