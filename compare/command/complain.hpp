/// What is said on standard error.
#pragma once

#include <string>

namespace paperproof::compare {

/// One line of at most `longest_message` bytes, whatever was typed or read.
void complain(const std::string& reason);

}  // namespace paperproof::compare
