#include "records/scene_result.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

namespace paperproof::compare {
namespace {

/// Steps that must stay whatever the stride is, the most telling first.
std::vector<int> telling_steps(const ReportRun& run) {
  std::vector<int> steps;
  const auto contact = std::ranges::find_if(run.steps, [](const TraceStep& step) { return !step.contacts.empty(); });
  if (contact != run.steps.end()) steps.push_back(contact->step);
  for (const ReportEvent& event : run.events) steps.push_back(event.step);
  return steps;
}

int step_that_matters(const ReportRun& run) {
  using Kind = ReportEvent::Kind;
  for (const Kind kind : {Kind::tunnel, Kind::one_way, Kind::inside, Kind::hanging, Kind::crush})
    for (const ReportEvent& event : run.events)
      if (event.kind == kind) return event.step;
  for (const TraceStep& step : run.steps)
    if (!step.contacts.empty()) return step.step;
  return run.steps.front().step;
}

/// How many steps from the first one on stay whole.
std::size_t length_of_beginning(const ReportRun& run, std::size_t room) {
  const auto matters = static_cast<std::size_t>(step_that_matters(run) + 2 - run.steps.front().step);  // and one more
  return matters > room / 4 && matters <= room / 2 ? matters : room / 4;
}

/// The beginning, then telling steps with their neighbours, as many as fit into three quarters of the room.
std::set<int> steps_to_keep(const ReportRun& run, std::size_t room) {
  std::set<int> keep{run.steps.front().step, run.steps.back().step};
  for (std::size_t i = 0; i < length_of_beginning(run, room); ++i) keep.insert(run.steps[i].step);
  for (const int step : telling_steps(run)) {
    if (keep.size() + 3 > room * 3 / 4) break;
    keep.insert({step - 1, step, step + 1});
  }
  return keep;
}

/// Of all characters.
void keep_only(const std::vector<std::size_t>& kept, ReportRun& run) {
  const auto keep = [&](std::vector<TraceStep>& steps) {
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i] != i) steps[i] = std::move(steps[kept[i]]);
    steps.resize(kept.size());
  };
  keep(run.steps);
  std::ranges::for_each(run.others, keep);
}

}  // namespace

void thin_for_replay(ReportRun& run, int max_steps) {
  const auto limit = static_cast<std::size_t>(std::max(max_steps, 8));
  if (run.steps.size() <= limit) return;
  const std::set<int> keep = steps_to_keep(run, limit);
  const std::size_t room = limit - keep.size();
  const std::size_t stride = (run.steps.size() + room - 1) / room;

  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < run.steps.size(); ++i)
    if (i % stride == 0 || keep.contains(run.steps[i].step)) kept.push_back(i);
  keep_only(kept, run);
  run.every *= static_cast<int>(stride);
}

void cut_to_excerpt(ReportRun& run, int around, std::optional<int> middle) {
  if (run.steps.empty()) return;
  const int matters = middle.value_or(step_that_matters(run));
  const auto is_near = [&](int step) { return std::abs(step - matters) <= around; };
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < run.steps.size(); ++i)
    if (is_near(run.steps[i].step)) kept.push_back(i);
  keep_only(kept, run);
  std::erase_if(run.events, [&](const ReportEvent& event) { return !is_near(event.step); });
}

}  // namespace paperproof::compare
