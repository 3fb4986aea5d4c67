#include "records/verdict.hpp"

#include <algorithm>
#include <array>

namespace paperproof::compare {
namespace {

constexpr std::array worst_first{Verdict::failed,  Verdict::not_applicable, Verdict::violates,
                                 Verdict::tunnels, Verdict::flagged,        Verdict::holds};

}  // namespace

void add_fault(Row& row, Axis axis, Verdict verdict, std::string words) {
  row.faults.push_back({axis, verdict, std::move(words)});
}

void settle(Row& row) {
  if (!was_judged(row)) return;
  row.verdict = Verdict::holds;
  row.reason.clear();
  for (const Axis axis : {Axis::safety, Axis::progress, Axis::answer, Axis::validity}) {
    bool named = false;
    for (const AxisFault& fault : row.faults) {
      if (fault.axis != axis) continue;
      row.verdict = *std::ranges::find_first_of(worst_first, std::array{fault.verdict, row.verdict});
      if (!named && !row.reason.empty()) row.reason += "; ";
      row.reason += named ? ", " : std::string(name_of(axis)) + ": ";
      row.reason += fault.words;
      named = true;
    }
  }
}

bool falls_short(const Row& row, Axis axis) {
  const std::string named = std::string(name_of(axis)) + ": ";
  return row.reason.starts_with(named) || row.reason.find("; " + named) != std::string::npos;
}

}  // namespace paperproof::compare
