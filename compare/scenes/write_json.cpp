#include "scenes/write_json.hpp"

#include "records/collider_json.hpp"
#include "scenes/input_error.hpp"

#include <nlohmann/json.hpp>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

/// From the middle of the box, y up, in metres, to the corner of the sprite, y down, in pixels.
ordered_json pixels_of(const Scene& scene) {
  const Box2& box = scene.character.shape.box();
  if (box.lower != Vec2d(-box.upper))
    refuse(scene.name, "expected a character whose position is the middle of its box: the format has no other");
  ordered_json list = ordered_json::array();
  for (const Vec2d& point : scene.character.shape.points())
    list.push_back(
        {(point.x() - box.lower.x()) * scene.pixels_per_metre, (box.upper.y() - point.y()) * scene.pixels_per_metre});
  return list;
}

void put_start(const Start& start, ordered_json& object) {
  object["position"] = point_json(start.position);
  if (start.velocity != Vec2d::Zero()) object["velocity"] = point_json(start.velocity);
  if (start.resolve_overlap) object["start_overlap"] = "resolve";
}

ordered_json character_json(const Scene& scene) {
  const CharacterDef& character = scene.character;
  ordered_json object{{"points_px", pixels_of(scene)}};
  put_start(scene.start, object);
  object["walk_speed"] = character.walk_speed;
  object["acceleration"] = character.acceleration;
  if (character.air_acceleration) object["air_acceleration"] = *character.air_acceleration;
  object["jump_speed"] = character.jump_speed;
  if (character.max_fall_speed) object["max_fall_speed"] = *character.max_fall_speed;
  object["max_climb_degrees"] = character.max_climb_degrees;
  if (character.snap > 0) object["snap"] = character.snap;
  if (character.step_height > 0) object["step_height"] = character.step_height;
  const JumpRules& rules = scene.jump_rules;
  if (rules.no_jump_toward_wall) object["no_jump_toward_wall"] = *rules.no_jump_toward_wall;
  if (rules.side_hit_ends_rise) object["side_hit_ends_rise"] = *rules.side_hit_ends_rise;
  if (!scene.sprite.empty()) object["sprite"] = scene.sprite;
  return object;
}

ordered_json input_json(const std::vector<InputEvent>& events) {
  ordered_json list = ordered_json::array();
  for (const InputEvent& event : events) {
    ordered_json& entry = list.emplace_back(ordered_json{{"step", event.step}});
    if (event.move) entry["move"] = *event.move;
    if (event.jump) entry["jump"] = *event.jump;
    if (event.drop) entry["drop"] = *event.drop;
  }
  return list;
}

void put_motion(const MoverDef& mover, ordered_json& object) {
  for (const MoverDef::Waypoint& waypoint : mover.path)
    object["path"].push_back({{"t", waypoint.time}, {"at", point_json(waypoint.at)}});
  for (const MoverDef::Turn& turn : mover.turns) object["angle"].push_back({{"t", turn.time}, {"at", turn.at}});
  if (mover.loop != MoverDef::Loop::once) object["loop"] = name_of(mover.loop);
}

void put_body(const Body& body, ordered_json& object) {
  object["mass"] = body.mass;
  object["friction"] = body.friction;
  object["restitution"] = body.restitution;
  object["velocity"] = point_json(body.velocity);
}

ordered_json joint_json(const Scene& scene, const Joint& joint) {
  ordered_json object{{"id", joint.id}};
  object["bodies"].push_back(scene.movers[joint.body].id);
  if (joint.other != no_mover) object["bodies"].push_back(scene.movers[joint.other].id);
  switch (joint.kind) {
    case Joint::Kind::distance:
      object["distance"] = {point_json(joint.point), point_json(joint.end)};
      object["length"] = joint.length;
      if (joint.stiffness > 0) object["stiffness"] = joint.stiffness;
      if (joint.damping > 0) object["damping"] = joint.damping;
      break;
    case Joint::Kind::revolute:
      object["revolute"] = point_json(joint.point);
      break;
    case Joint::Kind::prismatic:
      object["prismatic"] = point_json(joint.axis);
      break;
  }
  return object;
}

void put_scenery(const Scene& scene, ordered_json& file) {
  file["scenery"] = ordered_json::array();
  std::vector<int> colliders(scene.movers.size(), 0);
  for (std::size_t k = 0; k < scene.ids.size(); ++k) {
    const ColliderDef& collider = scene.scenery.colliders[k];
    ordered_json object = collider_json(scene.ids[k], collider);
    if (collider.mover == no_mover) {
      file["scenery"].push_back(std::move(object));
      continue;
    }
    const MoverDef& mover = scene.movers[collider.mover];
    if (!mover.body) {
      put_motion(mover, object);
      file["movers"].push_back(std::move(object));
      continue;
    }
    if (++colliders[collider.mover] > 1) refuse(scene.name, "expected bodies of one collider each: " + mover.id);
    put_body(*mover.body, object);
    file["bodies"].push_back(std::move(object));
  }
  for (const Decoration& each : scene.decoration)
    file["scenery"].push_back(ordered_json{{"id", each.id}, {"decoration", points_json(each.polygon)}});
  if (file["scenery"].empty()) file["empty"] = true;
  for (const Joint& joint : scene.joints) file["joints"].push_back(joint_json(scene, joint));
}

}  // namespace

ordered_json scene_json(const Scene& scene) {
  ordered_json file{{"paperproof_scene", 1}, {"name", scene.name}};
  if (!scene.description.empty()) file["description"] = scene.description;
  file["pixels_per_metre"] = scene.pixels_per_metre;
  file["gravity"] = point_json(scene.gravity);
  file["dt"] = scene.dt;
  if (!scene.dt_list.empty()) file["dt_list"] = scene.dt_list;
  file["steps"] = scene.steps;
  file["character"] = character_json(scene);
  const Script script = script_of(scene);
  for (std::size_t k = 0; k < scene.others.size(); ++k) {
    ordered_json& other = file["characters"].emplace_back();
    put_start(scene.others[k].start, other);
    other["input"] = input_json(script[k + 1]);
  }
  put_scenery(scene, file);
  if (!script.front().empty()) file["input"] = input_json(script.front());
  return file;
}

}  // namespace paperproof::compare
