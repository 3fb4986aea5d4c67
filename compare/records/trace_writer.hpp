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

/// The colliders of a header, as a list.
[[nodiscard]] std::string colliders_in_json(const TraceHeader& header);

/// The first line of a trace.
[[nodiscard]] nlohmann::ordered_json trace_header_json(const TraceHeader& header);

/// The lines of a trace: trace_fields.hpp has what stands in them. Numbers are printed so that they read back to the
/// same bits.
class TraceLines {
 public:
  explicit TraceLines(const TraceHeader& header);
  /// With the end of the line. @param colliders as `colliders_in_json`, or what stands for them.
  [[nodiscard]] std::string header_line(const TraceHeader& header, std::string_view colliders) const;
  [[nodiscard]] std::string line_of(const TraceStep& step) const;

  struct Moving {
    ColliderIndex collider = 0;
    MoverIndex mover = 0;
  };
  [[nodiscard]] const std::vector<Moving>& moving() const noexcept { return moving_; }
  /// Of a collider, as JSON.
  [[nodiscard]] const std::string& id(ColliderIndex collider) const { return ids_[collider]; }
  [[nodiscard]] std::size_t characters() const noexcept { return characters_; }

 private:
  std::vector<std::string> ids_;  ///< As JSON strings.
  std::vector<Moving> moving_;
  std::optional<bool> exact_;  ///< False: paths hold sampled positions.
  std::size_t characters_;
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
