/// What tests of the report share: a folder of their own, and a run to show.
#pragma once

#include "report/report.hpp"

#include "campaign/shapes.hpp"
#include "compare/command_workplace.hpp"

namespace paperproof::compare {

using nlohmann::json;

struct Report {
  ReportFacts facts;
  std::vector<ReportScene> scenes;
};

inline void write_report(const std::string& path, const Report& report, const ReportOptions& options = {}) {
  ReportWriter writer(path, options);
  for (const ReportScene& scene : report.scenes) writer.add(scene);
  writer.finish(report.facts);
}

/// A folder of its own for each test, and a page in it.
class ReportTest : public SceneFilesTest {
 protected:
  [[nodiscard]] std::string path() const { return files.path("report.html"); }

  [[nodiscard]] std::string page(const Report& report, const ReportOptions& options = {}) const {
    write_report(path(), report, options);
    return content(path());
  }

  [[nodiscard]] std::size_t files_left() const {
    const std::filesystem::directory_iterator all(files.path(""));
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }
};

inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

inline Report report_of(const ReportScene& scene) { return {{}, {scene}}; }

inline TraceStep step_of(int number, std::vector<PathPoint> path, const Vec2d& velocity = {0, 0}) {
  TraceStep step;
  step.step = number;
  step.path = std::move(path);
  step.velocity = velocity;
  return step;
}

/// A run of the article's character over tiles of a metre, with so many steps of 60 mm and a contact in each.
inline ReportScene walk_of(int steps) {
  ReportRun run;
  run.header.scene = "walk";
  run.header.contender = "octagon_sweep";
  run.header.scalar = "double";
  run.header.dt = 1.0 / 60;
  const std::span<const Vec2d> points = CharacterShape::article(32).points();
  run.header.points.assign(points.begin(), points.end());
  for (int tile = 0; tile < 6; ++tile) {
    run.header.scenery.colliders.push_back(box(tile, -1, tile + 1, 0));
    run.header.ids.push_back("tile_" + std::to_string(tile));
  }
  for (int i = 0; i < steps; ++i) {
    const Vec2d to{0.06 * (i + 1), half_height};
    TraceStep step = step_of(i, {{{0.06 * i, half_height}, 0}, {to, 1}}, {3.6, 0});
    step.grounded = true;
    step.contacts = {{2, {to.x(), 0}, {0, 1}, 0, 5e-7, Side::bottom}};
    run.steps.push_back(step);
  }
  ReportScene scene;
  scene.name = "walk";
  scene.runs = {run};
  scene.rows.resize(1);
  scene.rows[0].contender = "octagon_sweep";
  return scene;
}

/// With a second character, which does the same 2 m higher.
inline ReportScene pair_of(int steps) {
  ReportScene scene = walk_of(steps);
  ReportRun& run = scene.runs[0];
  run.header.characters = 2;
  run.others = {run.steps};
  for (TraceStep& step : run.others[0]) {
    step.character = 1;
    for (PathPoint& corner : step.path) corner.position.y() += 2;
  }
  return scene;
}

}  // namespace paperproof::compare
