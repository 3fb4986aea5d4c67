#include "runs/gallery.hpp"

#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

namespace paperproof::compare {
namespace {

constexpr double most_wrong = 0.1;  ///< Of the contacts.
constexpr double most_snag = 0.01;
constexpr double most_jitter = 1e-3;  // [m]
constexpr double most_gap = 0.0201;   // [m]: Box2D touches from 20 mm away by design

using Kind = Failure::Kind;

/// Written so that NaN fails.
std::optional<Failure> mild_failure_of(const Row& row) {
  if (row.contact_recall && !(*row.contact_recall >= 1 - most_wrong))
    return Failure{Kind::missed, fmt::format("misses {:.3g} % of the contacts that exact arithmetic has",
                                             100 * (1 - *row.contact_recall))};
  if (!(row.ghost_speed_loss.value_or(0) <= most_snag))
    return Failure{Kind::snag,
                   fmt::format("loses {:.3g} % of its speed in one step to nothing", 100 * *row.ghost_speed_loss)};
  if (row.contact_precision && !(*row.contact_precision >= 1 - most_wrong))
    return Failure{Kind::false_alarm, fmt::format("{:.3g} % of the contacts that it reports are none",
                                                  100 * (1 - *row.contact_precision))};
  if (!(row.rest_peak_to_peak_m.value_or(0) <= most_jitter))
    return Failure{Kind::jitter, fmt::format("moves by {:.3g} m at rest", *row.rest_peak_to_peak_m)};
  if (!(row.max_contact_gap_m.value_or(0) <= most_gap))
    return Failure{Kind::gap, fmt::format("stops {:.3g} m away from what it hits", *row.max_contact_gap_m)};
  return std::nullopt;
}

/// A run that did not fail, with what a step cost.
struct Timed {
  std::string contender;
  double ns_per_step = 0;
};

using TimedByScene = std::map<std::string, std::vector<Timed>>;

TimedByScene cheapest_first(const std::vector<Row>& rows) {
  TimedByScene scenes;
  for (const Row& row : rows)
    if (row.ns_per_step && !failure_of(row)) scenes[row.scene].push_back({called(row), *row.ns_per_step});
  for (auto& [scene, timed] : scenes) std::ranges::sort(timed, {}, &Timed::ns_per_step);
  return scenes;
}

double lead_of(const GalleryEntry::Cheapest& one) {
  return one.next.empty() ? std::numeric_limits<double>::infinity() : one.next_ns_per_step / one.ns_per_step;
}

void note_cheapest(const TimedByScene& scenes, GalleryEntry& entry) {
  for (const auto& [scene, timed] : scenes) {
    if (timed.front().contender != entry.contender) continue;
    GalleryEntry::Cheapest here{scene, timed.front().ns_per_step, {}, 0};
    if (timed.size() > 1) {
      here.next = timed[1].contender;
      here.next_ns_per_step = timed[1].ns_per_step;
    }
    if (!entry.cheapest || lead_of(here) > lead_of(*entry.cheapest)) entry.cheapest = here;
  }
}

std::string failure_in_words(const GalleryEntry& entry) {
  if (entry.fails) return fmt::format("fails on {} ({})", entry.fails->scene, entry.fails->failure.words);
  return fmt::format("the search over {} found none on which it fails", counted(entry.scenes, "scene"));
}

std::string cost_in_words(const GalleryEntry& entry) {
  if (!entry.cheapest) return "on none it is the cheapest of those that do not fail";
  const auto& [scene, ns_per_step, next, next_ns_per_step] = *entry.cheapest;
  if (next.empty())
    return fmt::format("on {} it is the only one that does not fail ({:.0f} ns per step)", scene, ns_per_step);
  return fmt::format("on {} it is the cheapest of those that do not fail ({:.0f} ns per step, then {} with {:.0f})",
                     scene, ns_per_step, next, next_ns_per_step);
}

}  // namespace

std::optional<Failure> failure_of(const Row& row) {
  switch (row.verdict) {
    case Verdict::not_applicable:
      return std::nullopt;
    case Verdict::violates:
    case Verdict::failed:
      return Failure{Kind::failed, row.reason};
    case Verdict::tunnels:
      return Failure{Kind::tunnels, row.reason};
    case Verdict::flagged:
      if (row.steps_ending_inside.value_or(0) > 0) return Failure{Kind::inside, row.reason};
      if (row.one_way_violations.value_or(0) > 0) return Failure{Kind::one_way, row.reason};
      return Failure{row.hanging_steps.value_or(0) > 0 ? Kind::hangs : Kind::flagged, row.reason};
    case Verdict::holds:
      return mild_failure_of(row);
  }
  return std::nullopt;
}

std::vector<GalleryEntry> gallery_of(const std::vector<Row>& rows) {
  std::vector<GalleryEntry> gallery;
  for (const Row& row : rows) {
    const std::string name = called(row);
    auto entry = std::ranges::find(gallery, name, &GalleryEntry::contender);
    if (entry == gallery.end())
      entry = gallery.insert(gallery.end(), GalleryEntry{.contender = name, .fails = {}, .cheapest = {}});
    entry->scenes += row.verdict != Verdict::not_applicable;
    const std::optional<Failure> failure = failure_of(row);
    if (failure && (!entry->fails || failure->kind < entry->fails->failure.kind)) entry->fails = {row.scene, *failure};
  }
  const TimedByScene scenes = cheapest_first(rows);
  for (GalleryEntry& entry : gallery) note_cheapest(scenes, entry);
  return gallery;
}

std::vector<std::string> gallery_lines(const std::vector<GalleryEntry>& gallery) {
  const bool timed = std::ranges::any_of(gallery, [](const GalleryEntry& entry) { return entry.cheapest.has_value(); });
  std::vector<std::string> lines;
  for (const GalleryEntry& entry : gallery) {
    if (entry.scenes == 0)
      lines.push_back(entry.contender + ": can express none of the scenes.");
    else
      lines.push_back(
          fmt::format("{}: {}{}.", entry.contender, failure_in_words(entry), timed ? "; " + cost_in_words(entry) : ""));
  }
  if (!timed) lines.emplace_back("Nothing was timed, so that none is named as the cheapest.");
  return lines;
}

}  // namespace paperproof::compare
