#include "metrics/events.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

/// What may change, each with a number of its own.
enum class Kind : std::uint8_t { grounded, touches, meets, crushed, entered, left };

std::uint64_t mark(Kind kind, std::uint64_t which = 0, std::uint64_t side = 0) {
  return static_cast<std::uint64_t>(kind) | side << 8U | which << 16U;
}

/// Sorted, each once.
std::vector<std::uint64_t> marks_of(const TraceStep& step) {
  std::vector<std::uint64_t> marks;
  if (step.grounded) marks.push_back(mark(Kind::grounded));
  for (const Contact& contact : step.contacts)
    marks.push_back(mark(Kind::touches, contact.collider, static_cast<std::uint64_t>(contact.side)));
  for (const CrowdContact& contact : step.met)
    marks.push_back(mark(Kind::meets, contact.other, static_cast<std::uint64_t>(contact.side)));
  for (const ColliderIndex collider : step.crushed) marks.push_back(mark(Kind::crushed, collider));
  for (const SensorEvent& event : step.sensors)
    marks.push_back(mark(event.change == SensorEvent::Change::enter ? Kind::entered : Kind::left, event.sensor));
  std::ranges::sort(marks);
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
  return marks;
}

}  // namespace

/// Fowler, Noll, Vo (1991), by words of 64 bits.
void Events::add(const TraceStep& step) {
  std::vector<std::uint64_t> marks = marks_of(step);
  std::vector<std::uint64_t>& last = last_[step.character];
  if (marks == last) return;
  last = std::move(marks);
  ++count_;
  const auto mix = [this](std::uint64_t word) { hash_ = (hash_ ^ word) * 1099511628211ULL; };
  mix(~std::uint64_t{step.character});
  for (const std::uint64_t each : last) mix(each);
}

void Events::write(Row& row) const {
  row.events = count_;
  row.event_sequence = fmt::format("{:016x}", hash_);
}

}  // namespace paperproof::compare
