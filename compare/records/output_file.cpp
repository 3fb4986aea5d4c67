#include "records/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace paperproof::compare {

namespace {

/// Paths of the files that stand beside their final names, as a signal's handler can read them. More at a time than
/// these, which no command has, would stay behind.
std::array<std::atomic<const char*>, 16> unfinished{};
/// Children that were forked share the paths, but not the files.
std::atomic<pid_t> owner{};

void note_unfinished(const char* path) {
  for (std::atomic<const char*>& place : unfinished)
    if (const char* none = nullptr; place.compare_exchange_strong(none, path)) return;
}

void forget_unfinished(const char* path) {
  for (std::atomic<const char*>& place : unfinished)
    if (const char* own = path; place.compare_exchange_strong(own, nullptr)) return;
}

/// Calls only what a handler may call (POSIX, async-signal-safe).
void end_by(int signal) {
  if (getpid() == owner)
    for (const std::atomic<const char*>& place : unfinished)
      if (const char* path = place) unlink(path);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void remove_unfinished_on_signals() {
  owner = getpid();
  for (const int signal : {SIGTERM, SIGINT, SIGHUP})
    if (std::signal(signal, end_by) == SIG_IGN) std::signal(signal, SIG_IGN);  // `nohup` wants it to go on
}

OutputFile::OutputFile(std::string path, Appears appears) : path_(std::move(path)), target_(path_) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(target_, none);
  if (std::filesystem::is_directory(status)) throw std::runtime_error(path_ + ": cannot be written: it is a directory");
  in_place_ =
      appears != Appears::whole || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status));
  if (std::filesystem::is_regular_file(status)) target_ = std::filesystem::canonical(target_, none);
  beside_ = target_;
  if (!in_place_) {
    beside_ += ".part";
    note_unfinished(beside_.c_str());
  }
  // To open a pipe without a reader would wait for one, for ever.
  const int reader = std::filesystem::is_fifo(status) ? open(target_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC) : -1;
  if (std::filesystem::is_fifo(status) && reader < 0 && errno == ENXIO)
    throw std::runtime_error(path_ + ": cannot be written: nobody reads the pipe");
  stream_.open(beside_, std::ios::binary | (appears == Appears::continued ? std::ios::app : std::ios::trunc));
  if (reader >= 0) close(reader);
  if (stream_) return;
  if (!in_place_) forget_unfinished(beside_.c_str());
  fail("cannot be written");
}

OutputFile::~OutputFile() {
  if (committed_ || in_place_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
  forget_unfinished(beside_.c_str());
}

void OutputFile::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream_) fail("cannot be written whole");
}

void OutputFile::flush() {
  stream_.flush();
  if (!stream_) fail("cannot be written whole");
}

void OutputFile::commit() {
  stream_.close();
  if (!stream_) fail("cannot be written whole");
  std::error_code error;
  if (!in_place_) std::filesystem::rename(beside_, target_, error);
  if (error) throw std::runtime_error(path_ + ": cannot be replaced: " + error.message());
  if (!in_place_) forget_unfinished(beside_.c_str());
  committed_ = true;
}

void OutputFile::fail(const std::string& what) const {
  if (errno == EPIPE) throw ClosedPipe();
  throw std::runtime_error(path_ + ": " + what + ": " + std::strerror(errno));
}

void print_out(std::string_view text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) throw ClosedPipe();
  throw std::runtime_error(std::string("standard output: cannot be written: ") + std::strerror(errno));
}

}  // namespace paperproof::compare
