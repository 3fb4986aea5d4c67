/// Bullets and paper: scenes 1, 2, 3 and 30.
#include "scenes/built_in.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

namespace {

constexpr double frames_per_second = 60;

/// The article's example: a character of one pixel, a platform 5 px thick that begins 30 px below it.
Scene bullet(const ParameterValues& values) {
  const double pixels_per_frame = values["speed"] / (pixel * frames_per_second);
  Scene scene = flight(0, 30.5 * pixel, 0, -values["speed"], 60);
  const std::vector<Vec2d> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.character.shape = CharacterShape::from_pixels(square, 1 / pixel);
  add_box(scene, "platform", -100 * pixel, -values["thickness"], 100 * pixel, 0);
  scene.answers = {contact(30 / pixels_per_frame, pixels_per_frame * pixel)};
  ends_at(scene, 0, 0.5 * pixel);
  return scene;
}

/// How high the middle of the article's character is over the origin where it touches a line through it from above.
double height_over(const Vec2d& along) {
  const Vec2d normal(-along.y(), along.x());
  const CharacterDef character;
  double reach = 0;
  for (const Vec2d& point : character.shape.points()) reach = std::max(reach, -normal.dot(point));
  return reach / normal.y();
}

/// A character falls onto paper below it.
Scene paper(const ParameterValues& values) {
  const double speed = values["speed"];
  const double height = values["height"];
  const double tilt = (90 - values["angle"]) * pi / 180;
  const Vec2d along(std::cos(tilt), std::sin(tilt));
  const double touching = tilt == 0 ? half_height : height_over(along);
  Scene scene = flight(0, touching, 0, -speed, 60);
  scene.gravity = {0, -values["gravity"]};
  scene.dt = values["dt"];
  const double last = std::ceil(steps_to_fall(scene, height, speed));
  const double way = height + values["phase"] * (speed - scene.gravity.y() * scene.dt * last) * scene.dt;
  scene.start.position.y() += way;
  // A second; and time enough behind the paper to get 2 m beyond it, or out of it where it is tilted.
  const double thickness = values["thickness"];
  const double beyond = tilt == 0 ? 2 : 2 * touching + (thickness + 0.1) / along.x();
  const double behind = std::max(0.5, beyond / speed) / scene.dt;
  const double most = std::max(std::round(1 / scene.dt), std::ceil(steps_to_fall(scene, way, speed) + behind));
  scene.steps = static_cast<int>(std::clamp(most, 4.0, 1e7));
  const Vec2d below(along.y() * thickness, -along.x() * thickness);
  const Vec2d half = std::max(4.0, 2 * touching) * along;
  if (thickness > 0)
    add_polygon(scene, "paper", {below - half, below + half, half, Vec2d::Zero() - half});
  else
    add_chain(scene, "paper", {Vec2d::Zero() - half, half});
  if (tilt != 0) return scene;
  scene.answers = {contact(steps_to_fall(scene, way, speed), speed * scene.dt)};
  ends_at(scene, 0, half_height);
  return scene;
}

const std::vector<ParameterDef>& paper_parameters() {
  static const std::vector<ParameterDef> all{{"speed", "m_s", 0.1, 1e5, 40, "downwards, at the start"},
                                             {"thickness", "m", 0, 10, 0.01, "of the paper; 0 is a segment"},
                                             {"angle", "deg", 1, 90, 90, "of the way to the paper; 90 is head-on"},
                                             {"height", "m", 0.01, 1e4, 3, "that it falls until it meets the paper"},
                                             {"phase", "", 0, 1, 0, "share of a step's way by which it begins higher"},
                                             {"gravity", "m_s2", 0, 1e6, 0, "straight down"},
                                             {"dt", "s", 1e-5, 1, 1.0 / 60, "length of a step"}};
  return all;
}

/// @param pixels per frame of a 60th of a second.
std::vector<ParameterSetting> at_pixels_per_frame(double pixels) {
  return {{"speed", pixels * pixel * frames_per_second}};
}
/// Falls as well.
std::vector<ParameterSetting> thick(double thickness) { return {{"thickness", thickness}, {"gravity", 30}}; }

Scene rest(const ParameterValues& values) {
  Scene scene = flight(0, half_height + 0.25, 0, 0, static_cast<int>(values["steps"]), 30);
  add_box(scene, "floor", -4, -1, 4, 0);
  const double landed = steps_to_fall(scene, 0.25);
  scene.answers = {contact(landed, fallen(scene, 1)), is(Answer::Of::in_the_air, std::floor(landed)).within(0)};
  ends_at(scene, 0, half_height);
  rests_after(scene, 60);
  return scene;
}

}  // namespace

std::vector<SceneFamily> paper_families() {
  return {{"paper", "a character falls onto paper: it is never passed", paper_parameters(), paper},
          {"bullet",
           "the article's: one pixel flies onto a platform 30 px below",
           {{"speed", "m_s", 0.1, 1e6, 50 * pixel * frames_per_second, "downwards; 50 px per frame are 93.75 m/s"},
            {"thickness", "m", 1e-6, 10, 5 * pixel, "of the platform; 5 px are 0.15625 m"}},
           bullet},
          {"rest",
           "a drop onto a floor, and rest: the position does not change",
           {{"steps", "", 100, 1e7, 1000, "that it lasts"}},
           rest}};
}

std::vector<BuiltInScene> paper_scenes() {
  return {
      {"article_bullet", "one pixel at 50 px per frame, platform 5 px thick 30 px below: first contact at t = 0.6",
       "bullet", at_pixels_per_frame(50)},
      {"article_bullet_slow", "the same at 1 px per frame: touches after 30 frames, at t = 1 of step 29", "bullet",
       at_pixels_per_frame(1)},
      {"article_bullet_fast", "the same at 1,000 px per frame: first contact at t = 0.03", "bullet",
       at_pixels_per_frame(1000)},
      {"article_bullet_extreme", "the same at 100,000 px per frame: first contact at t = 0.0003", "bullet",
       at_pixels_per_frame(1e5)},
      {"thin_platform", "fall at 40 m/s and more onto paper of 1 cm: it is never passed", "paper", thick(0.01)},
      {"paper_1e-1", "fall at 40 m/s and more onto paper of 10 cm: it is never passed", "paper", thick(1e-1)},
      {"paper_1e-3", "fall at 40 m/s and more onto paper of 1 mm: it is never passed", "paper", thick(1e-3)},
      {"paper_1e-6", "fall at 40 m/s and more onto paper of 1 micrometre: it is never passed", "paper", thick(1e-6)},
      {"zero_thickness_paper", "fall at 40 m/s and more onto a segment: it is never passed", "paper", thick(0)},
      {"long_rest", "a million steps at rest on a floor: the position does not change, one contact begins", "rest",
       with("steps", 1e6)},
  };
}

}  // namespace paperproof::compare
