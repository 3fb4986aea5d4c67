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
#include <stdexcept>
#include <thread>
#include <utility>

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

}  // namespace

PeerProcess::PeerProcess(const std::string& command) {
  std::array<int, 2> talk{};
  std::array<int, 2> said{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, talk.data()) != 0 || pipe2(said.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(fmt::format("no peer can be started: {}", std::strerror(errno)));
  child_ = fork();
  if (child_ < 0) throw std::runtime_error(fmt::format("no peer can be started: {}", std::strerror(errno)));
  if (child_ == 0) {
    setpgid(0, 0);  // what it starts ends with it
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
  if (child_ > 0) {
    const bool ended = wait_for_end().has_value();
    kill(-child_, SIGKILL);
    if (!ended) waitpid(child_, nullptr, 0);
  }
  if (said_ >= 0) close(said_);
}

std::string PeerProcess::ask(const std::string& line, std::chrono::milliseconds patience) {
  const Clock::time_point until = Clock::now() + patience;
  send(line + '\n', until);
  std::size_t end = std::string::npos;
  while ((end = unread_.find('\n')) == std::string::npos) {
    if (unread_.size() > longest_line) give_up("said a line that does not end");
    wait(POLLIN, until);
    std::array<char, 1U << 16U> part{};
    const ssize_t got = read(talk_, part.data(), part.size());
    if (got == 0 || (got < 0 && errno == ECONNRESET)) give_up("");
    if (got > 0) unread_.append(part.data(), static_cast<std::size_t>(got));
  }
  std::string answer = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  return answer;
}

void PeerProcess::send(const std::string& text, Clock::time_point until) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t put = ::send(talk_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
    if (put >= 0)
      done += static_cast<std::size_t>(put);
    else if (errno == EAGAIN)
      wait(POLLOUT, until);
    else if (errno == EPIPE || errno == ECONNRESET)
      return;  // it has ended, and may have answered before
    else if (errno != EINTR)
      give_up("");
  }
}

/// Until it has said or can take something; it must not wait for anyone to read its errors.
void PeerProcess::wait(short events, Clock::time_point until) {
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    if (left.count() <= 0) give_up("says nothing");
    std::array<pollfd, 2> ends{pollfd{talk_, events, 0}, pollfd{said_, POLLIN, 0}};
    const bool listens = said_ >= 0;
    if (poll(ends.data(), listens ? 2 : 1, static_cast<int>(left.count())) < 0) continue;
    if (listens && ends[1].revents != 0) read_errors();
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
  if (got == 0) {  // it has closed it
    close(said_);
    said_ = -1;
  }
}

/// @return its status, once it has ended by itself; nothing where it goes on.
std::optional<int> PeerProcess::wait_for_end() {
  int status = 0;
  for (const Clock::time_point until = Clock::now() + time_to_end; Clock::now() < until;) {
    if (waitpid(child_, &status, WNOHANG) == child_) return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return std::nullopt;
}

/// @param reason empty: its output has ended.
void PeerProcess::give_up(std::string reason) {
  if (reason.empty()) {
    const std::optional<int> status = wait_for_end();
    reason = status ? ending_of(*status) : "closed its output";
    if (status) kill(-std::exchange(child_, -1), SIGKILL);  // what it started
  }
  if (said_ >= 0) read_errors();
  throw std::runtime_error(one_line("the peer " + reason + (errors_.empty() ? "" : ": " + errors_)));
}

}  // namespace paperproof::compare
