#include "runs/mover_motions.hpp"

#include "runs/contender.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

box2d::JointDef definition_of(const Joint& joint) {
  box2d::JointDef def{.body = joint.body,
                      .other = joint.other,
                      .point = joint.point,
                      .end = joint.end,
                      .axis = joint.axis,
                      .length = joint.length,
                      .stiffness = joint.stiffness,
                      .damping = joint.damping};
  switch (joint.kind) {
    case Joint::Kind::distance:
      def.kind = box2d::JointDef::Kind::distance;
      break;
    case Joint::Kind::revolute:
      def.kind = box2d::JointDef::Kind::revolute;
      break;
    case Joint::Kind::prismatic:
      def.kind = box2d::JointDef::Kind::prismatic;
      break;
  }
  return def;
}

std::optional<box2d::BodyWorld> world_of_bodies(const Scene& scene) {
  std::vector<std::optional<box2d::BodyDef>> bodies;
  for (const MoverDef& mover : scene.movers) {
    bodies.emplace_back();
    if (const auto& body = mover.body) bodies.back() = {body->mass, body->friction, body->restitution, body->velocity};
  }
  if (std::none_of(bodies.begin(), bodies.end(), [](const auto& body) { return body.has_value(); }))
    return std::nullopt;
  std::vector<box2d::JointDef> joints;
  for (const Joint& joint : scene.joints) joints.push_back(definition_of(joint));
  try {
    if (!(StepTimes(scene).shortest() >= box2d::least_step))
      throw box2d::InvalidDefinition("it takes no steps shorter than 1e-9 s");
    return box2d::BodyWorld(Scenery(scene.scenery), bodies, scene.gravity, joints);
  } catch (const box2d::InvalidDefinition& error) {
    throw NotApplicable(std::string("the scene's bodies are moved by Box2D, and ") + error.what());
  }
}

}  // namespace

MoverMotions::MoverMotions(const Scene& scene)
    : scene_(scene), bodies_(world_of_bodies(scene)), motions_(scene.movers.size()), turns_(scene.movers.size()) {}

void MoverMotions::advance(int step, const StepTimes& times) {
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    motions_[i] = motion_between(scene_.movers[i], times.begin(step), times.end(step));
    turns_[i] = turn_between(scene_.movers[i], times.begin(step), times.end(step));
  }
  if (!bodies_) return;
  body_turns_.clear();
  for (const TurnMotion& turn : turns_) body_turns_.push_back({turn.from, turn.to});
  bodies_->step(times.length(step), motions_, body_turns_);
}

}  // namespace paperproof::compare
