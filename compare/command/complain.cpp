#include "command/complain.hpp"

#include "one_line.hpp"

#include <cstdio>

namespace paperproof::compare {

void complain(const std::string& reason) { std::fputs((one_line(reason) + '\n').c_str(), stderr); }

}  // namespace paperproof::compare
