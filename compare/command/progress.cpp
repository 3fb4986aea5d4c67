#include "command/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace paperproof::compare {

Progress::Progress(bool wanted) : shown_(wanted && isatty(STDERR_FILENO) != 0) {}

void Progress::show(const std::string& what, double share) const {
  if (shown_) std::fputs(fmt::format("\r\x1b[K{} {:.0f} %", what, 100 * share).c_str(), stderr);
}

void Progress::clear() const {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

}  // namespace paperproof::compare
