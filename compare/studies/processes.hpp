/// Jobs in child processes: whatever a job does, abort or hang, is a result that says so.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace paperproof::compare {

struct ProcessOptions {
  int workers = 1;                 ///< Child processes at a time.
  std::chrono::seconds limit{60};  ///< A job that takes longer is killed.
};

/// @param wanted 0: one for each core.
[[nodiscard]] int processes_for(int wanted);

/// What the jobs are, and who gets what they give.
struct Jobs {
  std::size_t count = 0;
  std::function<std::string(std::size_t)> run;  ///< In a child. It must not throw.
  /// In the parent, for a job whose child ended or was killed. @param reason in words.
  std::function<std::string(std::size_t, const std::string& reason)> lost;
  std::function<void(std::size_t, const std::string&)> take;  ///< In the parent, in the order of the jobs.
};

/// Runs all jobs. Results do not depend on the number of workers. Memory does not grow with the number of jobs. To be
/// called while the process has one thread.
/// @throws std::runtime_error where no child can be started; what `take` throws, after the children are ended.
void run_in_processes(const Jobs& jobs, const ProcessOptions& options);

}  // namespace paperproof::compare
