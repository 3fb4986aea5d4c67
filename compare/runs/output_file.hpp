/// A file that appears whole or not at all.
#pragma once

#include <fstream>
#include <string>

namespace paperproof::compare {

/// Writes beside the final name and renames on `commit`; what was never committed is removed. Not thread-safe.
class OutputFile {
 public:
  /// @throws std::runtime_error naming the path if it cannot be opened.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] std::ofstream& stream() noexcept { return stream_; }
  /// @throws std::runtime_error naming the path if anything could not be written.
  void commit();

 private:
  std::string path_;
  std::string beside_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace paperproof::compare
