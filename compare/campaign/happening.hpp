/// What can happen to a character in a step: counted over random runs, so that a campaign shows what it met.
#pragma once

#include "oracle/judge.hpp"
#include "records/trace.hpp"

#include <span>
#include <string_view>

namespace paperproof::compare {

/// A step of one character in its run.
struct Moment {
  const TraceHeader& header;
  const TraceStep& record;
  const TraceStep* before;  ///< The same character's last step; null in its first one.
  const StepJudgement& judged;
  bool launched = false;  ///< Just before it.
};

struct Happening {
  std::string_view name;     ///< `riding`, as tables have it.
  std::string_view meaning;  ///< In a few words.
  bool (*is_so)(const Moment&);
};

/// All that are counted, in the order of tables.
[[nodiscard]] std::span<const Happening> happenings();

}  // namespace paperproof::compare
