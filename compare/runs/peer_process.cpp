#include "runs/peer_process.hpp"

#include "one_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <thread>

namespace paperproof::compare {
namespace {

/// Of one line [bytes].
constexpr std::size_t longest_line = std::size_t{1} << 24U;
/// Kept of what it wrote to its standard error [bytes].
constexpr std::size_t most_errors = 400;
/// Who is asked to end has so long for it.
constexpr std::chrono::milliseconds time_to_end{500};

/// How a process ended, in words.
std::string ending_of(int status) {
  if (WIFSIGNALED(status)) return fmt::format("ended by {}", strsignal(WTERMSIG(status)));
  return fmt::format("ended with status {}", WEXITSTATUS(status));
}

/// Leads a group of processes, and ends it with itself once nobody reads what the group writes to its standard error:
/// who started it has ended, perhaps by a signal that nothing catches.
[[noreturn]] void end_group_with_reader(int errors) {
  setpgid(0, 0);
  dup2(errors, STDIN_FILENO);
  close_range(STDIN_FILENO + 1, std::numeric_limits<unsigned>::max(), 0);  // other peers are to read their end
  pollfd reader{STDIN_FILENO, 0, 0};
  while (poll(&reader, 1, -1) < 0) continue;
  kill(0, SIGKILL);
  _exit(0);
}

}  // namespace

PeerProcess::PeerProcess(const std::string& command) {
  std::array<int, 2> talk{};
  std::array<int, 2> said{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, talk.data()) != 0 || pipe2(said.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(fmt::format("no peer can be started: {}", std::strerror(errno)));
  guard_ = fork();
  if (guard_ == 0) end_group_with_reader(said[1]);
  setpgid(guard_, guard_);
  child_ = guard_ < 0 ? guard_ : fork();
  if (child_ < 0) throw std::runtime_error(fmt::format("no peer can be started: {}", std::strerror(errno)));
  if (child_ == 0) {
    if (setpgid(0, guard_) != 0) _exit(127);
    dup2(talk[1], STDIN_FILENO);
    dup2(talk[1], STDOUT_FILENO);
    dup2(said[1], STDERR_FILENO);
    std::signal(SIGPIPE, SIG_DFL);
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(talk[1]);
  close(said[1]);
  talk_ = talk[0];
  said_ = said[0];
  for (const int end : {talk_, said_}) fcntl(end, F_SETFL, O_NONBLOCK);
}

PeerProcess::~PeerProcess() {
  close(talk_);  // it reads the end of its input
  const bool ended = ends_in_time();
  kill(-guard_, SIGKILL);
  if (!ended) waitpid(child_, nullptr, 0);
  waitpid(guard_, nullptr, 0);
  close(said_);
}

std::string PeerProcess::ask(const std::string& line, std::chrono::milliseconds patience) {
  asked_ = Clock::now();
  patience_ = patience;
  send(line + '\n');
  std::size_t end = std::string::npos;
  while ((end = unread_.find('\n')) == std::string::npos) {
    if (unread_.size() > longest_line) give_up("said a line that does not end");
    wait(POLLIN);
    std::array<char, 1U << 16U> part{};
    const ssize_t got = read(talk_, part.data(), part.size());
    if (got == 0 || (got < 0 && errno == ECONNRESET)) give_up("");
    if (got > 0) unread_.append(part.data(), static_cast<std::size_t>(got));
  }
  std::string answer = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  return answer;
}

bool PeerProcess::has_said_more() const {
  char next = 0;
  return !unread_.empty() || recv(talk_, &next, 1, MSG_PEEK) > 0;
}

void PeerProcess::send(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t put = ::send(talk_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
    if (put >= 0)
      done += static_cast<std::size_t>(put);
    else if (errno == EAGAIN)
      wait(POLLOUT);
    else if (errno == EPIPE || errno == ECONNRESET)
      return;  // it has ended, and may have answered before
    else if (errno != EINTR)
      give_up("");
  }
}

/// Until it has said or can take something; it must not wait for anyone to read its errors.
void PeerProcess::wait(short events) {
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(asked_ + patience_ - Clock::now());
    if (left.count() <= 0)
      give_up(fmt::format("says nothing for {:g} s", patience_ / std::chrono::duration<double>(1)));
    std::array<pollfd, 2> ends{pollfd{talk_, events, 0}, pollfd{said_, POLLIN, 0}};
    if (poll(ends.data(), ends.size(), static_cast<int>(left.count())) < 0) continue;
    if (ends[1].revents != 0) read_errors();
    if (ends[0].revents != 0) return;
  }
}

void PeerProcess::read_errors() {
  std::array<char, 4096> part{};
  ssize_t got = 0;
  while ((got = read(said_, part.data(), part.size())) > 0) {
    errors_.append(part.data(), static_cast<std::size_t>(got));
    if (errors_.size() > most_errors) errors_.erase(0, errors_.size() - most_errors);
  }
}

/// @return whether it has ended by itself.
bool PeerProcess::ends_in_time() {
  int status = 0;
  for (const Clock::time_point until = Clock::now() + time_to_end; !status_ && Clock::now() < until;)
    if (waitpid(child_, &status, WNOHANG) == child_)
      status_ = status;
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return status_.has_value();
}

/// @param reason empty: its output has ended.
void PeerProcess::give_up(std::string reason) {
  if (reason.empty()) reason = ends_in_time() ? ending_of(*status_) : "closed its output";
  read_errors();
  throw std::runtime_error(one_line("the peer " + reason + (errors_.empty() ? "" : ": " + errors_)));
}

}  // namespace paperproof::compare
