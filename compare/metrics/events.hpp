/// What happened to the characters of a run, in order.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"

#include <cstdint>
#include <vector>

namespace paperproof::compare {

/// The sequence of events of a run. An event is a step that ends with another set of reported (collider, side), of
/// contacts with characters, or another `grounded` than the step before; crushes and sensors count as well. When it
/// comes is no part of it: runs that begin a little aside, or far away, have the same sequence.
/// - `events`: how many there are.
/// - `event_sequence`: 16 hexadecimal digits that say which (FNV-1a, 64 bit). Equal for equal sequences.
class Events {
 public:
  explicit Events(std::size_t characters) : last_(characters) {}
  void add(const TraceStep& step);
  void write(Row& row) const;

 private:
  std::vector<std::vector<std::uint64_t>> last_;  ///< By character: what its last step ended with.
  std::uint64_t hash_ = 14695981039346656037ULL;
  int count_ = 0;
};

}  // namespace paperproof::compare
