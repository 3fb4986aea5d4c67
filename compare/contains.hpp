#pragma once

#include <algorithm>

namespace paperproof::compare {

/// Whether a range has an equal value.
template <class Range, class Value>
[[nodiscard]] bool contains(const Range& range, const Value& value) {
  return std::find(range.begin(), range.end(), value) != range.end();
}

}  // namespace paperproof::compare
