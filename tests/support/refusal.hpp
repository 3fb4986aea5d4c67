/// The message of a refusal.
#pragma once

#include <string>

namespace paperproof::test {

/// The message of the exception that `make` throws. @param otherwise the answer where it throws none.
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
