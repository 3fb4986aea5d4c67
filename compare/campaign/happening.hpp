/// What can happen to a character in a step. A campaign counts it.
#pragma once

#include "oracle/judge.hpp"
#include "records/trace.hpp"

#include <cstddef>
#include <span>
#include <string_view>

namespace paperproof::compare {

/// A step of one character in its run.
struct Moment {
  const TraceHeader& header;
  const TraceStep& record;
  const StepJudgement& judged;
  bool was_grounded = false;  ///< When the step began.
  bool launched = false;      ///< Just before it.
};

struct Happening {
  std::string_view name;     ///< `riding`, as tables have it.
  std::string_view meaning;  ///< In a few words.
  bool (*is_so)(const Moment&);
};

/// All that are counted, in the order of tables.
[[nodiscard]] std::span<const Happening> happenings();
/// The place of one among them. @throws std::logic_error where none has that name.
[[nodiscard]] std::size_t happening_named(std::string_view name);

}  // namespace paperproof::compare
