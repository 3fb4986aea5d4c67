/// Runs as tests want them, and how they look for what came of them.
#pragma once

#include "compare/scene_files.hpp"
#include "runs/contender.hpp"
#include "runs/input_cursor.hpp"
#include "runs/run.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {

inline Scene built_in(const std::string& name) { return load_scenes(name).front(); }

/// These contenders, or all of them, beside the reference, and so many steps of their replays.
inline RunOptions quick(std::vector<std::string> contenders = {}, int replay_steps = 0) {
  RunOptions options;
  options.contenders = std::move(contenders);
  options.measure_cost = false;
  options.max_replay_steps = replay_steps;
  return options;
}

/// One contender without its reference, and so many steps of its replay.
inline RunOptions alone(const std::string& contender, int replay_steps) {
  RunOptions options = quick({contender}, replay_steps);
  options.reference = false;
  return options;
}

inline const Row& row_of(const ReportScene& result, std::string_view contender) {
  static const Row none;
  for (const Row& row : result.rows)
    if (row.contender == contender) return row;
  ADD_FAILURE() << contender << " has no row";
  return none;
}

inline const ReportRun& run_of(const ReportScene& result, std::string_view contender) {
  static const ReportRun none;
  for (const ReportRun& run : result.runs)
    if (run.header.contender == contender) return run;
  ADD_FAILURE() << contender << " has no replay";
  return none;
}

/// Where a contender is at the end of each step. @param make_step calls it with what is so in a step, and its number.
inline std::vector<Vec2d> way_of(const Contender& contender, const Scene& scene, const auto& make_step) {
  const Script script = script_of(scene);
  InputCursor cursor(scene, script);
  std::vector<Vec2d> way;
  for (int step = 0; step < scene.steps; ++step) {
    make_step(cursor.at(step), static_cast<std::size_t>(step));
    way.push_back(contender.pose().position);
  }
  return way;
}

/// Nothing but a block that is never reached: whoever is here flies.
inline Scene empty_sky(int steps) {
  Scene scene;
  scene.name = "sky";
  scene.gravity = {0, -10};
  scene.steps = steps;
  scene.scenery.colliders.push_back({.points = {{500, 500}, {501, 500}, {501, 501}, {500, 501}}});
  scene.ids.emplace_back("far");
  return scene;
}

}  // namespace paperproof::compare
