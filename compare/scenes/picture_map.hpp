/// A PNG picture alone as a scene.
#pragma once

#include "scenes/scene.hpp"

#include <string>

namespace paperproof::compare {

/// White pixels are solid, 32 to a metre, as in a JSON scene that says nothing else; the character begins above the
/// first ground. @throws InputError
[[nodiscard]] Scene read_picture_map(const std::string& path, const std::string& given);

}  // namespace paperproof::compare
