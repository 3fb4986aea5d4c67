/// Bullets and paper: scenes 1, 2, 3 and 30.
#include "scenes/built_in.hpp"

#include <cmath>

namespace paperproof::compare {

namespace {

constexpr double frames_per_second = 60;

/// The article's example: a character of one pixel, a platform 5 px thick that begins 30 px below it.
Scene article_bullet_at(double pixels_per_frame) {
  Scene scene = flight(0, 30.5 * pixel, 0, -pixels_per_frame * pixel * frames_per_second, 60);
  const std::vector<Vec2d> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.character.shape = CharacterShape::from_pixels(square, 1 / pixel);
  add_box(scene, "platform", -100 * pixel, -5 * pixel, 100 * pixel, 0);
  scene.answers = {contact(30 / pixels_per_frame, pixels_per_frame * pixel)};
  ends_at(scene, 0, 0.5 * pixel);
  return scene;
}

/// A character falls at 40 m/s onto paper 3 m below its feet.
Scene paper_of(double thickness) {
  Scene scene = flight(0, 3 + half_height, 0, -40, 60);
  scene.gravity = {0, -30};
  add_box(scene, "paper", -4, -thickness, 4, 0);
  scene.answers = {contact(steps_to_fall(scene, 3, 40), 40 * scene.dt)};
  ends_at(scene, 0, half_height);
  return scene;
}

Scene article_bullet() { return article_bullet_at(50); }
Scene article_bullet_slow() { return article_bullet_at(1); }
Scene article_bullet_fast() { return article_bullet_at(1000); }
Scene article_bullet_extreme() { return article_bullet_at(1e5); }
Scene thin_platform() { return paper_of(0.01); }
Scene paper_tenth() { return paper_of(1e-1); }
Scene paper_thousandth() { return paper_of(1e-3); }
Scene paper_millionth() { return paper_of(1e-6); }

Scene zero_thickness_paper() {
  Scene scene = paper_of(1);
  scene.scenery.colliders.clear();
  scene.ids.clear();
  add_chain(scene, "paper", {{-4, 0}, {4, 0}});
  return scene;
}

Scene long_rest() {
  Scene scene = flight(0, half_height + 0.25, 0, 0, 1'000'000);
  scene.gravity = {0, -30};
  add_box(scene, "floor", -4, -1, 4, 0);
  const double landed = steps_to_fall(scene, 0.25);
  scene.answers = {contact(landed, fallen(scene, 1)), is(Answer::Of::in_the_air, std::floor(landed)).within(0)};
  ends_at(scene, 0, half_height);
  rests_after(scene, 60);
  return scene;
}

}  // namespace

std::vector<BuiltInScene> paper_scenes() {
  return {
      {"article_bullet", "one pixel at 50 px per frame, platform 5 px thick 30 px below: first contact at t = 0.6",
       article_bullet},
      {"article_bullet_slow", "the same at 1 px per frame: touches after 30 frames, at t = 1 of step 29",
       article_bullet_slow},
      {"article_bullet_fast", "the same at 1,000 px per frame: first contact at t = 0.03", article_bullet_fast},
      {"article_bullet_extreme", "the same at 100,000 px per frame: first contact at t = 0.0003",
       article_bullet_extreme},
      {"thin_platform", "fall at 40 m/s and more onto paper of 1 cm: it is never passed", thin_platform},
      {"paper_1e-1", "fall at 40 m/s and more onto paper of 10 cm: it is never passed", paper_tenth},
      {"paper_1e-3", "fall at 40 m/s and more onto paper of 1 mm: it is never passed", paper_thousandth},
      {"paper_1e-6", "fall at 40 m/s and more onto paper of 1 micrometre: it is never passed", paper_millionth},
      {"zero_thickness_paper", "fall at 40 m/s and more onto a segment: it is never passed", zero_thickness_paper},
      {"long_rest", "a million steps at rest on a floor: the position does not change, one contact begins", long_rest},
  };
}

}  // namespace paperproof::compare
