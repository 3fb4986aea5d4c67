/// What no scene file can say.
#pragma once

#include "scenes/json_text.hpp"
#include "scenes/scene.hpp"

namespace paperproof::compare {

/// - `pixel_hill`: the article's tile of 32 x 32 px, a hill. Its pixels also say how `pixel_tile` goes over them.
/// - `tiles`: rows of tiles of 1 m, from the top.
/// - `movers_first`: colliders are numbered from the movers on, and not from the scenery.
/// - `random_steps`: `dt_list` and `steps`, from the `shortest` length to the `longest`, for a `time`, by a `seed`.
/// - `random_input`: `random_script` of this seed.
void make_in_code(const Json& what, Scene& scene);

}  // namespace paperproof::compare
