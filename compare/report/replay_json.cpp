#include "report/replay_json.hpp"

#include "report/run_json.hpp"
#include "report/scenery_json.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

void grow(Vec2d& extent, const Vec2d& point) {
  if (!point.allFinite()) return;
  const Vec2d size = point.cwiseAbs();
  extent = extent.cwiseMax(size);
}

double extent_of_character(const ReportScene& scene) {
  if (scene.runs.empty() || scene.runs.front().header.points.empty()) return 1;
  const std::vector<Vec2d>& points = scene.runs.front().header.points;
  Vec2d lower = points.front();
  Vec2d upper = points.front();
  for (const Vec2d& point : points) {
    lower = lower.cwiseMin(point).eval();
    upper = upper.cwiseMax(point).eval();
  }
  return (upper - lower).maxCoeff();
}

/// Of every character.
template <class Visit>
void for_each_step(const ReportRun& run, const Visit& visit) {
  std::for_each(run.steps.begin(), run.steps.end(), visit);
  for (const std::vector<TraceStep>& steps : run.others) std::for_each(steps.begin(), steps.end(), visit);
}

double farthest_coordinate(const ReportScene& scene) {
  Vec2d extent = Vec2d::Zero();
  for (const ReportRun& run : scene.runs) {
    Vec2d farthest_offset = Vec2d::Zero();
    for (const TraceStep& step : run.steps) {
      for (const MoverMotion& mover : step.movers) grow(farthest_offset, mover.to);
    }
    for (const ColliderDef& collider : run.header.scenery.colliders) {
      for (const Vec2d& point : collider.points)
        grow(extent, collider.mover == no_mover ? point : Vec2d(point.cwiseAbs() + farthest_offset));
    }
    for_each_step(run, [&extent](const TraceStep& step) {
      for (const PathPoint& corner : step.path) grow(extent, corner.position);
    });
  }
  return extent.maxCoeff();
}

std::set<ColliderIndex> colliders_to_name(const ReportScene& scene) {
  std::set<ColliderIndex> named;
  const auto add_contacts = [&named](const std::vector<Contact>& contacts) {
    for (const Contact& contact : contacts) named.insert(contact.collider);
  };
  for (const ReportRun& run : scene.runs) {
    for_each_step(run, [&](const TraceStep& step) {
      add_contacts(step.contacts);
      named.insert(step.start_overlap.begin(), step.start_overlap.end());
      named.insert(step.crushed.begin(), step.crushed.end());
      named.insert(step.dropped_through.begin(), step.dropped_through.end());
    });
  }
  for (const Disagreement& disagreement : scene.disagreements) {
    for (const Disagreement::Statement& statement : disagreement.statements) add_contacts(statement.contacts);
    if (disagreement.exact) add_contacts(*disagreement.exact);
  }
  return named;
}

bool same(const ColliderDef& a, const ColliderDef& b) {
  return a.shape == b.shape && a.points == b.points && a.holes == b.holes && a.one_way == b.one_way &&
         a.mover == b.mover && a.sensor == b.sensor;
}

bool same_scenery(const TraceHeader& a, const TraceHeader& b) {
  return a.ids == b.ids && std::equal(a.scenery.colliders.begin(), a.scenery.colliders.end(),
                                      b.scenery.colliders.begin(), b.scenery.colliders.end(), same);
}

/// The sceneries of a scene without repetition, and which one each run has.
struct Sceneries {
  std::vector<std::string> json;
  std::vector<std::size_t> of_run;
};

Sceneries sceneries_of(const ReportScene& scene, const Quantum& quantum) {
  const std::set<ColliderIndex> named = colliders_to_name(scene);
  Sceneries sceneries;
  for (std::size_t run = 0; run < scene.runs.size(); ++run) {
    const TraceHeader& header = scene.runs[run].header;
    const auto twin = std::find_if(scene.runs.begin(), scene.runs.begin() + static_cast<std::ptrdiff_t>(run),
                                   [&header](const ReportRun& other) { return same_scenery(other.header, header); });
    const auto twin_index = static_cast<std::size_t>(twin - scene.runs.begin());
    if (twin_index < run) {
      sceneries.of_run.push_back(sceneries.of_run[twin_index]);
      continue;
    }
    // Geometry that differs only by the rounding of float reads the same after rounding for display.
    const std::string json = scenery_json(header.scenery, header.ids, named, quantum);
    const auto known = std::find(sceneries.json.begin(), sceneries.json.end(), json);
    sceneries.of_run.push_back(static_cast<std::size_t>(known - sceneries.json.begin()));
    if (known == sceneries.json.end()) sceneries.json.push_back(json);
  }
  return sceneries;
}

std::string position_json(const Vec2d& position, const Quantum& quantum) {
  return std::move(JsonArray().add(quantum.round(position.x())).add(quantum.round(position.y()))).take();
}

std::string statement_json(const Disagreement::Statement& statement, const Quantum& quantum) {
  JsonObject object;
  object.put("run", static_cast<std::int64_t>(statement.run));
  object.put("from", position_json(statement.from, quantum)).put("to", position_json(statement.to, quantum));
  object.put("contacts", plain_contacts_json(statement.contacts, quantum));
  return std::move(object).take();
}

std::string disagreement_json(const Disagreement& disagreement, std::size_t runs, const Quantum& quantum) {
  JsonArray statements;
  for (const Disagreement::Statement& statement : disagreement.statements) {
    if (statement.run < runs) statements.add_raw(statement_json(statement, quantum));
  }
  JsonObject object;
  object.put("step", disagreement.step).put("who_is_right", json_string(disagreement.who_is_right));
  object.put("statements", std::move(statements).take());
  if (disagreement.exact) object.put("exact", plain_contacts_json(*disagreement.exact, quantum));
  return std::move(object).take();
}

std::string lengths_json(const std::vector<double>& seconds) {
  JsonArray list;
  for (const double length : seconds) list.add_raw(short_number(length, 9));
  return std::move(list).take();
}

}  // namespace

std::string replay_json(const ReportScene& scene, const ReportOptions& options) {
  const Quantum quantum(extent_of_character(scene), farthest_coordinate(scene));
  const Sceneries sceneries = sceneries_of(scene, quantum);

  std::vector<std::string> runs;
  for (std::size_t run = 0; run < scene.runs.size(); ++run) {
    runs.push_back(run_json(scene.runs[run], sceneries.of_run[run], quantum));
  }
  const auto shown =
      std::min(scene.disagreements.size(), static_cast<std::size_t>(std::max(options.max_disagreements, 0)));
  std::vector<std::string> disagreements;
  for (std::size_t i = 0; i < shown; ++i) {
    disagreements.push_back(disagreement_json(scene.disagreements[i], scene.runs.size(), quantum));
  }

  JsonObject object;
  object.put("quantum", short_number(quantum.metres())).put("sceneries", list_of(sceneries.json));
  object.put("runs", list_of(runs)).put("disagreements", list_of(disagreements));
  object.put("disagreements_in_all", static_cast<std::int64_t>(scene.disagreements.size()));
  if (!scene.dt_list.empty()) object.put("dt_list", lengths_json(scene.dt_list));
  return std::move(object).take();
}

}  // namespace paperproof::compare
