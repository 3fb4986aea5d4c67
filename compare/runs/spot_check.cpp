#include "runs/spot_check.hpp"

#include "contains.hpp"
#include "oracle/company.hpp"
#include "runs/contender.hpp"
#include "runs/run_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace paperproof::compare {
namespace {

constexpr int steps_around = 60;    ///< Of a passage that takes many. Few: it was inside before.
constexpr int places_of_step = 32;  ///< On the way of a passage. Few: it is between two of them.
constexpr int lower_places = 33;    ///< In all directions that lead down.

/// What the engine has at one place.
struct Asked {
  Vec2d place;
  std::vector<std::string> overlapped;
  [[nodiscard]] bool free() const { return overlapped.empty(); }
  [[nodiscard]] bool has(const std::string& id) const { return contains(overlapped, id); }
  [[nodiscard]] std::string words() const {
    return fmt::format("{} at ({:.4f}, {:.4f})",
                       free() ? "free" : fmt::format("overlaps {}", fmt::join(overlapped, ", ")), place.x(), place.y());
  }
};

class Engine {
 public:
  explicit Engine(const Case& one)
      : scene_(scene_of(one)),
        scenery_(scene_.scenery),
        contender_(make_contender(one.contender, ScalarKind::binary64, scene_, scenery_)) {}

  /// @param fraction of the step. @throws NotApplicable where it has no query.
  [[nodiscard]] Asked ask(const TraceStep& step, double fraction, const Vec2d& place) {
    std::vector<MoverMotion> movers;
    for (const MoverMotion& mover : step.movers) movers.push_back({mover.at(fraction), mover.at(fraction)});
    const std::optional<std::vector<std::string>> found = contender_->overlapped_at(place, movers);
    if (!found) throw NotApplicable("has no query of this kind");
    return {place, *found};
  }

 private:
  Scene scene_;
  Scenery scenery_;
  std::unique_ptr<Contender> contender_;
};

/// Free of the solid, then inside it, then free of it again. @param solid its id; an engine that joins solids may name
/// another one, and then any counts.
void ask_on_the_way(Engine& engine, const std::vector<TraceStep>& steps, const std::string& solid, SpotCheck& check) {
  std::vector<Asked> way;
  for (const TraceStep& step : steps) {
    if (step.step > check.step) break;
    const int places = step.step == check.step ? places_of_step : 1;
    for (int i = 0; i < places; ++i) {
      const double at = i / double{places_of_step};
      way.push_back(engine.ask(step, at, place_at(step.path, at)));
    }
    if (step.step == check.step) way.push_back(engine.ask(step, 1, step.path.back().position));
  }
  const bool is_named = std::ranges::any_of(way, [&](const Asked& asked) { return asked.has(solid); });
  const auto is_free = [&](const Asked& asked) { return is_named ? !asked.has(solid) : asked.free(); };
  const auto before = std::ranges::find_if(way, is_free);
  const auto within = std::find_if_not(before, way.end(), is_free);
  const auto last = way.empty() ? way.end() : way.end() - 1;
  check.confirmed = within != way.end() && is_free(*last) ? "yes" : "no";
  if (within != way.end())
    check.engine = fmt::format("{}, {}, {}", before->words(), within->words(), last->words());
  else
    check.engine = before == way.end() || before == last ? "no place before it is free" : "free to " + last->words();
}

/// Until it is free again. @param solid what the judge has it in; empty if it does not say.
void ask_at_ends(Engine& engine, const std::vector<TraceStep>& steps, const std::string& solid, SpotCheck& check) {
  check.confirmed = "no";
  for (const TraceStep& step : steps) {
    if (step.step < check.step) continue;
    const Asked asked = engine.ask(step, 1, step.path.back().position);
    check.engine = fmt::format("step {}: {}", step.step, asked.words());
    if (solid.empty() ? !asked.free() : asked.has(solid)) check.confirmed = "yes";
    if (asked.free() || check.confirmed == "yes") return;
  }
}

/// Where it hangs it could have gone down: straight, or along what it slides on.
void ask_below(Engine& engine, const std::vector<TraceStep>& steps, SpotCheck& check) {
  check.confirmed = "no";
  for (const TraceStep& step : steps) {
    if (step.step != check.step) continue;
    const double fall = -(step.requested.y());
    for (int i = 0; i < lower_places && check.confirmed == "no"; ++i) {
      const int side = i % 2 == 0 ? 1 : -1;  // straight down first
      const double angle = side * ((i + 1) / 2) * (std::numbers::pi / 2) / ((lower_places + 1) / 2);
      const Vec2d lower = step.path.back().position + fall * std::cos(angle) * Vec2d(std::sin(angle), -std::cos(angle));
      const Asked asked = engine.ask(step, 1, lower);
      check.engine = asked.words();
      if (asked.free()) check.confirmed = "yes";
    }
  }
}

}  // namespace

SpotCheck spot_check(const Case& one, ReportEvent::Kind hole) {
  SpotCheck check;
  const ReportScene excerpt = excerpt_of(one, steps_around);
  if (excerpt.runs.empty()) return {.engine = "the run cannot be made again: " + excerpt.rows.front().reason};
  const ReportRun& run = excerpt.runs.front();
  const auto event = std::ranges::find(run.events, hole, &ReportEvent::kind);
  if (event == run.events.end()) return {.engine = "nothing of the kind is in the record"};
  check.step = event->step;
  check.judge = event->words;
  try {
    Engine engine(one);
    const std::string solid = event->collider ? run.header.ids[*event->collider] : "";
    if (hole == ReportEvent::Kind::tunnel) ask_on_the_way(engine, run.steps, solid, check);
    if (hole == ReportEvent::Kind::inside) ask_at_ends(engine, run.steps, solid, check);
    if (hole == ReportEvent::Kind::hanging) ask_below(engine, run.steps, check);
  } catch (const std::exception& reason) {
    check.engine = reason.what();
    check.confirmed = "-";
  }
  return check;
}

}  // namespace paperproof::compare
