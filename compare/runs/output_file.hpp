/// A file that appears whole or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// Writes beside the final name and renames on `commit`; what was never committed is removed. A link keeps pointing to
/// where it points; a device or a pipe is written to directly, as nothing can stand beside it. Not thread-safe.
class OutputFile {
 public:
  /// Opens at once, so that a path that cannot be written is known before the work that is to be written.
  /// @throws std::runtime_error naming the path and why it cannot be written.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// @throws std::runtime_error naming the path.
  void write(std::string_view text);
  /// @throws std::runtime_error naming the path if anything could not be written.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;  ///< As the user gave it.
  std::filesystem::path target_;
  std::filesystem::path beside_;
  std::ofstream stream_;
  bool in_place_ = false;
  bool committed_ = false;
};

}  // namespace paperproof::compare
