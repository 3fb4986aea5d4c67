/// What CMake knew of this executable.
#pragma once

namespace paperproof::compare {

struct BuildInfo {
  const char* version;
  const char* compiler;
  const char* flags;
  const char* build_type;
  int core_lines;  ///< Lines of code of the controller, without its techniques.
};

extern const BuildInfo build_info;

}  // namespace paperproof::compare
