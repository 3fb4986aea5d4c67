#include "command/progress.hpp"

#include "command/complain.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace paperproof::compare {
namespace {

/// Between two lines of a log. Small: a night of work is a long log. Large: who looks does not see it go on.
constexpr std::chrono::seconds log_every{5};
/// What takes less is not announced [s]: people wait that long without asking.
constexpr double long_work = 10;
/// As long is measured before anything is said [s]. Small: the first steps are cold. Large: who waits wonders.
constexpr double measured_for = 1;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Progress::Progress(bool wanted, const std::string& log_path)
    : shown_(wanted && isatty(STDERR_FILENO) != 0), foretells_(wanted) {
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
  const double took = seconds_since(begin);
  const std::string left = now > 0 && now < 1 ? ", about " + duration_in_words(took / now * (1 - now)) + " left" : "";
  file << fmt::format("{} {:.1f} % in {}{}", what, 100 * now, duration_in_words(took), left) << std::endl;
}

void Progress::foretell(double pieces, std::string noun) {
  pieces_ = pieces;
  noun_ = std::move(noun);
  begin_ = Clock::now();
}

void Progress::prepare(const std::string& what, double seconds, const std::string& why) const {
  if (foretells_ && seconds >= long_work)
    complain(fmt::format("{}: about {} until the first step: {}", what, duration_in_words(seconds), why));
}

void Progress::show(const std::string& what, double share) {
  if (log_) log_->note(what, share);
  if (shown_) std::fputs(fmt::format("\r\x1b[K{} {:.0f} %", what, 100 * share).c_str(), stderr);
  if (share == 0) begin_ = Clock::now();
  if (!foretells_ || pieces_ == 0 || share == 0) return;
  const double took = seconds_since(begin_);
  const double left = took / share * (1 - share);
  if (took < measured_for || left < long_work) return;
  foretells_ = false;
  complain(fmt::format("about {} for {:.0f} {}, as the first {:.0f} took {:.1f} s", duration_in_words(took + left),
                       pieces_, noun_, std::max(1.0, share * pieces_), took));
}

void Progress::clear() const {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

std::string duration_in_words(double seconds) {
  struct Unit {
    double seconds;
    const char* name;
  };
  constexpr Unit units[] = {{86'400, "days"}, {3'600, "hours"}, {60, "minutes"}};
  for (const Unit& unit : units)
    if (seconds >= 2 * unit.seconds) return fmt::format("{:.0f} {}", seconds / unit.seconds, unit.name);
  return fmt::format("{:.0f} seconds", std::ceil(seconds));
}

}  // namespace paperproof::compare
