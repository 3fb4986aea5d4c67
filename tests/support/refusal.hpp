/// What is said where something is refused.
#pragma once

#include <string>

namespace paperproof::test {

/// What the exception says that `make` throws. @param otherwise the answer where it throws none.
template <class Error>
std::string refusal_by(const auto& make, std::string otherwise = "") {
  try {
    make();
  } catch (const Error& refused) {
    return refused.what();
  }
  return otherwise;
}

}  // namespace paperproof::test
