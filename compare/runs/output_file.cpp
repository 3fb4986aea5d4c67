#include "runs/output_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace paperproof::compare {

OutputFile::OutputFile(std::string path) : path_(std::move(path)), beside_(path_ + ".part") {
  stream_.open(beside_, std::ios::binary | std::ios::trunc);
  if (!stream_) throw std::runtime_error(path_ + ": cannot be written: " + std::strerror(errno));
}

OutputFile::~OutputFile() {
  if (committed_) return;
  stream_.close();
  std::remove(beside_.c_str());
}

void OutputFile::commit() {
  stream_.close();
  if (!stream_) throw std::runtime_error(path_ + ": cannot be written whole: " + std::strerror(errno));
  if (std::rename(beside_.c_str(), path_.c_str()) != 0)
    throw std::runtime_error(path_ + ": cannot be replaced: " + std::strerror(errno));
  committed_ = true;
}

}  // namespace paperproof::compare
