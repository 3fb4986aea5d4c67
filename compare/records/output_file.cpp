#include "records/output_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace paperproof::compare {

OutputFile::OutputFile(std::string path, Appears appears) : path_(std::move(path)), target_(path_) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(target_, none);
  if (std::filesystem::is_directory(status)) throw std::runtime_error(path_ + ": cannot be written: it is a directory");
  in_place_ =
      appears != Appears::whole || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status));
  if (std::filesystem::is_regular_file(status)) target_ = std::filesystem::canonical(target_, none);
  beside_ = target_;
  if (!in_place_) beside_ += ".part";
  stream_.open(beside_, std::ios::binary | (appears == Appears::continued ? std::ios::app : std::ios::trunc));
  if (!stream_) fail("cannot be written");
}

OutputFile::~OutputFile() {
  if (committed_ || in_place_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
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
