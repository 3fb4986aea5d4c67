/// How far the work is, on a terminal and in a log.
#pragma once

#include <chrono>
#include <fstream>
#include <memory>
#include <string>

namespace paperproof::compare {

/// One line on a terminal's stderr; nothing where stderr is no terminal. It is gone when the work ends. In a log, where
/// there is one, a line each time that a while has passed, and a last one; each with the time that is left, as far as
/// the work so far tells.
class Progress {
 public:
  /// @param wanted on a terminal. @param log_path empty: no log.
  /// @throws std::runtime_error where the log cannot be written.
  explicit Progress(bool wanted, const std::string& log_path = {});
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param share of the work that is done. Where it gets less another part of the work begins, and the time is that of
  /// this part.
  void show(const std::string& what, double share) const;
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Log {
    std::ofstream file;
    Clock::time_point begin = Clock::now();  ///< Of the part.
    Clock::time_point told{};
    double share = 0;
    void note(const std::string& what, double now);
  };
  bool shown_;
  std::unique_ptr<Log> log_;
};

}  // namespace paperproof::compare
