#include "command/progress.hpp"

#include "command/forecast.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

namespace paperproof::compare {
namespace {

/// Between two lines of a log. Small: a night of work is a long log. Large: who looks does not see it go on.
constexpr std::chrono::seconds log_every{5};

}  // namespace

Progress::Progress(bool wanted, const std::string& log_path) : shown_(wanted && isatty(STDERR_FILENO) != 0) {
  if (log_path.empty()) return;
  log_ = std::make_unique<Log>();
  log_->file.open(log_path);
  if (!log_->file) throw std::runtime_error(log_path + ": cannot be written");
}

void Progress::Log::note(const std::string& what, double now) {
  const Clock::time_point time = Clock::now();
  if (now < share) begin = time;
  share = now;
  if (now < 1 && time - told < log_every) return;
  told = time;
  const double took = std::chrono::duration<double>(time - begin).count();
  const std::string left = now > 0 && now < 1 ? ", about " + duration_in_words(took / now * (1 - now)) + " left" : "";
  file << fmt::format("{} {:.1f} % in {}{}", what, 100 * now, duration_in_words(took), left) << std::endl;
}

void Progress::show(const std::string& what, double share) const {
  if (log_) log_->note(what, share);
  if (shown_) std::fputs(fmt::format("\r\x1b[K{} {:.0f} %", what, 100 * share).c_str(), stderr);
}

void Progress::clear() const {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

}  // namespace paperproof::compare
