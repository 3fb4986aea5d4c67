/// A program of somebody else's that answers line by line.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

namespace paperproof::compare {

/// Runs a command in a shell, and ends it with everything that it started; so does the end of this process, however it
/// comes. Not thread-safe.
class PeerProcess {
 public:
  /// @throws std::runtime_error where no process can be started.
  explicit PeerProcess(const std::string& command);
  ~PeerProcess();
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  /// Writes a line to its standard input. @return the next line of its standard output, without the line's end.
  /// @throws std::runtime_error in words where it has ended, says nothing for so long, or says too much; with the end
  /// of what it wrote to its standard error.
  [[nodiscard]] std::string ask(const std::string& line, std::chrono::milliseconds patience);

  /// Whether it has said more than it was asked for.
  [[nodiscard]] bool has_said_more() const;

 private:
  using Clock = std::chrono::steady_clock;

  void send(const std::string& text);
  void wait(short events);
  void read_errors();
  [[nodiscard]] bool ends_in_time();
  [[noreturn]] void give_up(std::string reason);

  pid_t guard_ = -1;  ///< Leads the group of all that the command starts.
  pid_t child_ = -1;
  std::optional<int> status_;  ///< Of the child, once it has ended.
  Clock::time_point asked_;
  std::chrono::milliseconds patience_{};
  int talk_ = -1;  ///< Its standard input and output.
  int said_ = -1;  ///< Its standard error.
  std::string unread_;
  std::string errors_;  ///< The end of them.
};

}  // namespace paperproof::compare
