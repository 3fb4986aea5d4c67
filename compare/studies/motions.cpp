#include "studies/motions.hpp"

#include "scenes/built_in.hpp"

#include <cmath>

namespace paperproof::compare {

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all = [] {
    std::vector<Motion> listed;
    for (const Json* text : texts_of("motions"))
      listed.push_back(
          {text->at("name").get<std::string>().substr(std::string("motion_").size()), text->at("duration")});
    return listed;
  }();
  return all;
}

Scene scene_of(const Motion& motion, double dt) {
  Scene scene = built_in_scene("motion_" + motion.name, {});
  scene.name = motion.name;
  scene.dt = dt;
  scene.steps = static_cast<int>(std::lround(motion.duration / dt));
  // Keys of steps of 1/60 s are given at the next longest step before.
  const int shorter = static_cast<int>(std::lround(longest_step / dt));
  for (InputEvent& event : scene.input) event.step = event.step / 4 * shorter;
  return scene;
}

}  // namespace paperproof::compare
