/// Writes a trace as JSON Lines: everything needed to check a run without this project's code.
#pragma once

#include "records/output_file.hpp"
#include "records/trace.hpp"

#include <fmt/format.h>

namespace paperproof::compare {

/// `STEM.<scene>.<contender>.<scalar>.jsonl`; what a file name cannot hold becomes `_`.
[[nodiscard]] std::string trace_path(const std::string& stem, std::string scene, const std::string& contender,
                                     std::string_view scalar);

/// The stem of the twin that runs in lockstep with a contender.
[[nodiscard]] std::string twin_stem(const std::string& stem, std::string_view contender);

/// Numbers are printed so that they read back to the same bits. Not thread-safe.
class TraceWriter {
 public:
  /// Writes the header.
  /// @throws std::runtime_error naming the path.
  TraceWriter(const std::string& path, const TraceHeader& header);
  void write(const TraceStep& step);
  /// @throws std::runtime_error naming the path.
  void commit() { file_.commit(); }

 private:
  struct Moving {
    ColliderIndex collider = 0;
    MoverIndex mover = 0;
  };
  void write_refused(const TraceStep& step, fmt::memory_buffer& out);

  OutputFile file_;
  std::vector<std::string> ids_;  ///< As JSON strings.
  std::vector<Moving> moving_;
  bool path_exact_;
  bool several_;  ///< Characters.
};

}  // namespace paperproof::compare
