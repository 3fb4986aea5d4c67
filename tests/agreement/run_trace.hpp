/// Writes the runs of a random test as traces, for the checker that shares no code with this project.
#pragma once

#include "records/trace_writer.hpp"

#include <cstdlib>
#include <optional>
#include <string>

namespace paperproof::test {

/// One run. It writes nothing unless PAPERPROOF_GUARANTEE_TRACES names a folder.
class RunTrace {
 public:
  /// @param header of octagon_sweep in double. @param run names the file.
  RunTrace(compare::TraceHeader header, const std::string& run) {
    const char* folder = std::getenv("PAPERPROOF_GUARANTEE_TRACES");
    if (folder == nullptr) return;
    header.scene = run;
    header.contender = "octagon_sweep";
    header.scalar = "double";
    for (std::size_t i = 0; i < header.scenery.colliders.size(); ++i) header.ids.push_back(std::to_string(i));
    writer_.emplace(std::string(folder) + "/" + run + ".jsonl", header);
  }
  ~RunTrace() {
    if (writer_) writer_->commit();
  }
  RunTrace(const RunTrace&) = delete;
  RunTrace& operator=(const RunTrace&) = delete;

  /// @param start_overlap what the character overlapped when the step began.
  void write(compare::TraceStep step, const std::vector<ColliderIndex>& start_overlap) {
    if (!writer_) return;
    step.step = steps_++;
    step.start_overlap = start_overlap;
    writer_->write(step);
  }

 private:
  std::optional<compare::TraceWriter> writer_;
  int steps_ = 0;
};

}  // namespace paperproof::test
