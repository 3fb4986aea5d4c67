/// Writes a trace as JSON Lines: everything needed to check a run without this project's code.
#pragma once

#include "records/output_file.hpp"
#include "records/trace.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// `STEM.<scene>.<contender>.<scalar>.jsonl`; what a file name cannot hold becomes `_`.
[[nodiscard]] std::string trace_path(const std::string& stem, std::string scene, const std::string& contender,
                                     std::string_view scalar);

/// The stem of the twin that runs in lockstep with a contender.
[[nodiscard]] std::string twin_stem(const std::string& stem, std::string_view contender);

/// The first line of a trace.
[[nodiscard]] nlohmann::ordered_json trace_header_json(const TraceHeader& header);

/// The further lines of a trace. Numbers are printed so that they read back to the same bits.
class TraceLines {
 public:
  explicit TraceLines(const TraceHeader& header);
  /// With the end of the line.
  [[nodiscard]] std::string line_of(const TraceStep& step) const;

 private:
  struct Moving {
    ColliderIndex collider = 0;
    MoverIndex mover = 0;
  };

  std::vector<std::string> ids_;  ///< As JSON strings.
  std::vector<Moving> moving_;
  bool path_exact_;
  bool several_;  ///< Characters.
};

/// A trace as a file. Not thread-safe.
class TraceWriter {
 public:
  /// Writes the header.
  /// @throws std::runtime_error naming the path.
  TraceWriter(const std::string& path, const TraceHeader& header);
  void write(const TraceStep& step) { file_.write(lines_.line_of(step)); }
  /// @throws std::runtime_error naming the path.
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
  TraceLines lines_;
};

}  // namespace paperproof::compare
