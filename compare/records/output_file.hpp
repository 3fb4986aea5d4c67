/// Where results go: files, and standard output.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// The pipe that was written to has no reader: the work ends, and there is nothing to say.
class ClosedPipe : public std::runtime_error {
 public:
  ClosedPipe() : std::runtime_error("nobody reads the pipe") {}
};

/// Writes beside the final name and renames on `commit`; what was never committed is removed. A link keeps pointing to
/// where it points; a device, or a pipe that somebody reads, is written to directly, as nothing can stand beside it.
/// Not thread-safe. What a signal removes: see `remove_unfinished_on_signals`. Everything that fails throws ClosedPipe,
/// or std::runtime_error naming the path and why it cannot be written.
class OutputFile {
 public:
  enum class Appears : std::uint8_t {
    whole,       ///< At the end, or not at all.
    as_written,  ///< From the first line on, and what is flushed stays when the command is killed.
    continued,   ///< As `as_written`, but appended to what the file has.
  };
  /// Opens at once, so that a path that cannot be written is known before the work that is to be written.
  explicit OutputFile(std::string path, Appears appears = Appears::whole);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// What was written so far is in the file afterwards.
  void flush();
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

/// From now on SIGTERM, SIGINT and SIGHUP, where they are not ignored, remove what stands beside a final name before
/// they end this process. To be called once.
void remove_unfinished_on_signals();

/// Prints and flushes. @throws ClosedPipe; std::runtime_error where standard output cannot be written (a full disk).
void print_out(std::string_view text);

}  // namespace paperproof::compare
