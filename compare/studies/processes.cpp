#include "studies/processes.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace paperproof::compare {
namespace {

using Clock = std::chrono::steady_clock;

/// Results that wait for an earlier one. Many: a slow job holds up no other. Few: memory stays small.
constexpr std::size_t most_waiting = 1024;

bool read_all(int from, void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = read(from, at, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool write_all(int to, const void* data, std::size_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t put = write(to, at, size);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += put;
    size -= static_cast<std::size_t>(put);
  }
  return true;
}

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  }
};

/// A child process that runs one job after the other.
class Worker {
 public:
  explicit Worker(const std::function<std::string(std::size_t)>& run) {
    const Pipe to;
    const Pipe from;
    const Pipe said;
    child_ = fork();
    if (child_ < 0) throw std::runtime_error(std::string("no child process: ") + std::strerror(errno));
    if (child_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      dup2(said.ends[1], STDERR_FILENO);
      close(to.ends[1]);
      close(from.ends[0]);
      serve(to.ends[0], from.ends[1], run);
    }
    to_ = to.ends[1];
    from_ = from.ends[0];
    said_ = said.ends[0];
    close(to.ends[0]);
    close(from.ends[1]);
    close(said.ends[1]);
    fcntl(said_, F_SETFL, O_NONBLOCK);
  }
  ~Worker() {
    for (const int end : {to_, from_, said_}) close(end);
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  [[nodiscard]] bool give(std::size_t job, Clock::time_point deadline) {
    job_ = job;
    deadline_ = deadline;
    const std::uint64_t number = job;
    return write_all(to_, &number, sizeof number);
  }
  [[nodiscard]] std::optional<std::size_t> job() const { return job_; }
  [[nodiscard]] Clock::time_point deadline() const { return deadline_; }
  [[nodiscard]] int from() const { return from_; }

  /// Nothing: the child is gone.
  [[nodiscard]] std::optional<std::string> result() {
    std::uint64_t size = 0;
    if (!read_all(from_, &size, sizeof size)) return std::nullopt;
    std::string text(size, '\0');
    if (!read_all(from_, text.data(), size)) return std::nullopt;
    job_.reset();
    return text;
  }

  /// Ends it. @return how it ended by itself, in words.
  [[nodiscard]] std::string end(bool late) {
    if (late) kill(child_, SIGKILL);
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    std::string reason = late ? "took too long and was killed" : "ended unasked";
    if (!late && WIFSIGNALED(status)) reason = std::string("ended by ") + strsignal(WTERMSIG(status));
    const std::string words = last_words();
    return words.empty() ? reason : reason + ": " + words;
  }

 private:
  [[noreturn]] static void serve(int jobs, int results, const std::function<std::string(std::size_t)>& run) {
    std::uint64_t job = 0;
    while (read_all(jobs, &job, sizeof job)) {
      const std::string text = run(job);
      const std::uint64_t size = text.size();
      if (!write_all(results, &size, sizeof size) || !write_all(results, text.data(), text.size())) break;
    }
    _exit(0);
  }

  /// The last line that it wrote to its standard error.
  [[nodiscard]] std::string last_words() const {
    constexpr std::size_t most = 200;
    std::string all;
    std::array<char, 512> part{};
    for (ssize_t got = 0; (got = read(said_, part.data(), part.size())) > 0;)
      all.append(part.data(), static_cast<std::size_t>(got));
    while (!all.empty() && all.back() == '\n') all.pop_back();
    all = all.substr(all.rfind('\n') + 1);
    return all.substr(0, most);
  }

  pid_t child_ = -1;
  int to_ = -1;
  int from_ = -1;
  int said_ = -1;
  std::optional<std::size_t> job_;
  Clock::time_point deadline_;
};

class Pool {
 public:
  Pool(const Jobs& jobs, const ProcessOptions& options)
      : jobs_(jobs), options_(options), workers_(static_cast<std::size_t>(std::max(1, options.workers))) {}

  void run() {
    while (taken_ < jobs_.count) {
      for (std::unique_ptr<Worker>& worker : workers_) keep_busy(worker);
      wait();
      for (auto first = waiting_.find(taken_); first != waiting_.end(); first = waiting_.find(taken_)) {
        jobs_.take(taken_++, first->second);
        waiting_.erase(first);
      }
    }
  }

 private:
  void keep_busy(std::unique_ptr<Worker>& worker) {
    if (next_ == jobs_.count || next_ >= taken_ + most_waiting) return;
    if (worker && worker->job()) return;
    const Clock::time_point deadline = Clock::now() + options_.limit;
    if (!worker || !worker->give(next_, deadline)) {  // there is none yet, or it ended while it was idle
      worker = std::make_unique<Worker>(jobs_.run);
      if (!worker->give(next_, deadline)) throw std::runtime_error("a child process ended at once");
    }
    ++next_;
  }

  void wait() {
    std::vector<pollfd> polled;
    std::vector<std::unique_ptr<Worker>*> busy;
    Clock::time_point soonest = Clock::time_point::max();
    for (std::unique_ptr<Worker>& worker : workers_) {
      if (!worker || !worker->job()) continue;
      polled.push_back({worker->from(), POLLIN, 0});
      busy.push_back(&worker);
      soonest = std::min(soonest, worker->deadline());
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(soonest - Clock::now()).count();
    poll(polled.data(), polled.size(), static_cast<int>(std::clamp<long long>(left + 1, 0, 60'000)));
    for (std::size_t i = 0; i < busy.size(); ++i) {
      std::unique_ptr<Worker>& worker = *busy[i];
      const std::size_t job = *worker->job();
      if (polled[i].revents != 0) {
        if (std::optional<std::string> text = worker->result())
          waiting_[job] = std::move(*text);
        else
          lose(worker, job, false);
      } else if (Clock::now() >= worker->deadline()) {
        lose(worker, job, true);
      }
    }
  }

  void lose(std::unique_ptr<Worker>& worker, std::size_t job, bool late) {
    waiting_[job] = jobs_.lost(job, "the process that ran it " + worker->end(late));
    worker.reset();
  }

  const Jobs& jobs_;
  const ProcessOptions& options_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::map<std::size_t, std::string> waiting_;
  std::size_t next_ = 0;
  std::size_t taken_ = 0;
};

}  // namespace

int processes_for(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void run_in_processes(const Jobs& jobs, const ProcessOptions& options) { Pool(jobs, options).run(); }

}  // namespace paperproof::compare
