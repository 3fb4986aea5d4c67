/// `paperproof demo`: the article's bullet, one technique at a time, in the terminal.
#pragma once

#include <string>

namespace paperproof::compare {

/// @param technique empty: all, in the order of the article.
/// @return 0.
/// @throws InputError naming the techniques that there are.
int demo_command(const std::string& technique);

}  // namespace paperproof::compare
