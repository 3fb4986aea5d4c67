/// `paperproof convert`: a map or a built-in scene as a JSON scene.
#pragma once

#include <string>

namespace paperproof::compare {

/// @return 0.
/// @throws InputError for what cannot be used or said in the format; std::runtime_error if the output cannot be
/// written.
int convert_command(const std::string& from, const std::string& to);

}  // namespace paperproof::compare
