/// How far the work is, on a terminal and in a log; and how long it will take, said before it has taken long.
#pragma once

#include <chrono>
#include <fstream>
#include <memory>
#include <string>

namespace paperproof::compare {

/// One line on a terminal's stderr; nothing where stderr is no terminal. It is gone when the work ends. In a log, where
/// there is one, a line each time that a while has passed, and a last one; each with the time that is left, as far as
/// the work so far tells. Of work that will take long it says once how long, terminal or not: who waits for hours wants
/// to know from the start.
class Progress {
 public:
  /// @param wanted that anything is said. @param log_path empty: no log.
  /// @throws std::runtime_error where the log cannot be written.
  explicit Progress(bool wanted, const std::string& log_path = {});
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The work begins now; `show` foretells its time. @param pieces it has so many. @param noun their name.
  void foretell(double pieces, std::string noun);
  /// Says that the first step comes late, where it comes late. @param seconds until then. @param why in words.
  void prepare(const std::string& what, double seconds, const std::string& why) const;
  /// @param share of the work that is done. Zero says that it begins now. Where it gets less another part of the work
  /// begins, and the time in the log is that of this part.
  void show(const std::string& what, double share);
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
  bool foretells_;  ///< Until it has been said once.
  double pieces_ = 0;
  std::string noun_;
  Clock::time_point begin_{};
};

/// "40 seconds", "3 minutes", "5 hours", "12 days".
[[nodiscard]] std::string duration_in_words(double seconds);

}  // namespace paperproof::compare
