/// Reads a trace back, whichever program wrote it.
#pragma once

#include "records/trace.hpp"

#include <fstream>
#include <string>

namespace paperproof::compare {

/// A fault of a trace, as `FILE:LINE: step N: KEY: what was expected`. A fault of the header names no step.
class InvalidTrace : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads JSON Lines that hold to records/paperproof_trace.schema.json. What it leaves open is checked, too: ids are
/// known and unique, a step has the motion of every mover. Not thread-safe.
class TraceReader {
 public:
  /// A longer line is refused [bytes].
  static constexpr std::size_t longest_line = std::size_t{1} << 26;

  /// Reads the header.
  /// @throws InvalidTrace, also for a file that is not there, cannot be read or is no regular file.
  explicit TraceReader(const std::string& path);
  [[nodiscard]] const TraceHeader& header() const noexcept { return header_; }
  /// The next record; nothing behind the last.
  /// @throws InvalidTrace
  [[nodiscard]] std::optional<TraceStep> next();

 private:
  [[nodiscard]] bool read_line(std::string& line);
  [[noreturn]] void refuse(const std::string& what) const;

  std::string path_;
  std::ifstream stream_;
  std::size_t line_ = 0;
  TraceHeader header_;
};

}  // namespace paperproof::compare
