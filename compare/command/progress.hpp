/// How far the work is, on a terminal.
#pragma once

#include <string>

namespace paperproof::compare {

/// One line on a terminal's stderr; nothing where stderr is no terminal. It is gone when the work ends.
class Progress {
 public:
  explicit Progress(bool wanted);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& what, double share) const;
  void clear() const;

 private:
  bool shown_;
};

}  // namespace paperproof::compare
