#include "runs/input_cursor.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace paperproof::compare {
namespace {

box2d::JointDef definition_of(const Joint& joint) {
  constexpr std::array kinds{box2d::JointDef::Kind::distance, box2d::JointDef::Kind::revolute,
                             box2d::JointDef::Kind::prismatic};  // by `Joint::Kind`
  static_assert(kinds.size() == static_cast<std::size_t>(Joint::Kind::prismatic) + 1);
  return {.kind = kinds.at(static_cast<std::size_t>(joint.kind)),
          .body = joint.body,
          .other = joint.other,
          .point = joint.point,
          .end = joint.end,
          .axis = joint.axis,
          .length = joint.length,
          .stiffness = joint.stiffness,
          .damping = joint.damping};
}

std::optional<box2d::BodyWorld> world_of_bodies(const Scene& scene) {
  std::vector<std::optional<box2d::BodyDef>> bodies(scene.movers.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (const auto& body = scene.movers[i].body)
      bodies[i] = {body->mass, body->friction, body->restitution, body->velocity};
  if (std::ranges::none_of(bodies, [](const auto& body) { return body.has_value(); })) return std::nullopt;
  std::vector<box2d::JointDef> joints;
  std::ranges::transform(scene.joints, std::back_inserter(joints), definition_of);
  try {
    if (!(StepTimes(scene).shortest() >= box2d::least_step))
      throw box2d::InvalidDefinition("it takes no steps shorter than 1e-9 s");
    return box2d::BodyWorld(Scenery(scene.scenery), bodies, scene.gravity, joints);
  } catch (const box2d::InvalidDefinition& error) {
    throw NotApplicable(std::string("the scene's bodies are moved by Box2D, and ") + error.what());
  }
}

}  // namespace

InputCursor::InputCursor(const Scene& scene, const Script& script)
    : scene_(scene),
      script_(script),
      times_(scene),
      next_(script.size()),
      now_(script.size()),
      bodies_(world_of_bodies(scene)),
      motions_(scene.movers.size()) {}

StepInput InputCursor::at(int step) {
  for (std::size_t i = 0; i < motions_.size(); ++i)
    motions_[i] = motion_between(scene_.movers[i], times_.begin(step), times_.end(step));
  if (bodies_) bodies_->step(times_.length(step), motions_);
  for (std::size_t k = 0; k < script_.size(); ++k)
    for (; next_[k] < script_[k].size() && script_[k][next_[k]].step <= step; ++next_[k])
      apply(script_[k][next_[k]], now_[k]);
  return {times_.length(step), now_, motions_, scene_.gravity};
}

}  // namespace paperproof::compare
