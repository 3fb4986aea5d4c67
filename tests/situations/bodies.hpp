/// The bodies of a situation of heroes. README.md has the notation.
#pragma once

#include "box2d_adapter/hero_world.hpp"
#include "support/expected.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace paperproof::box2d::hero_test {

using nlohmann::json;

template <class Vector>
Vector vector_of(const json& two) {
  return Vector(two.at(0), two.at(1));
}

/// What one of a few words of a file stands for.
template <class Value>
Value named(const std::string& word, const std::map<std::string, Value>& words) {
  const auto found = words.find(word);
  if (found == words.end()) throw std::invalid_argument("no such word: " + word);
  return found->second;
}

inline const std::map<std::string, b2BodyType> types{
    {"static", b2_staticBody}, {"kinematic", b2_kinematicBody}, {"dynamic", b2_dynamicBody}};
inline const std::map<std::string, Blocking> blockings{{"as_in_box2d", Blocking::as_in_box2d},
                                                       {"from_above", Blocking::from_above},
                                                       {"from_everywhere", Blocking::from_everywhere},
                                                       {"not_at_all", Blocking::not_at_all}};

[[nodiscard]] inline std::unique_ptr<b2Shape> shape_of(const json& body) {
  std::vector<b2Vec2> points;
  for (const char* kind : {"polygon", "edge", "chain", "loop"})
    for (const json& each : body.value(kind, json::array())) points.push_back(vector_of<b2Vec2>(each));
  const int count = static_cast<int>(points.size());
  if (body.contains("circle")) {
    auto circle = std::make_unique<b2CircleShape>();
    circle->m_radius = body["circle"];
    return circle;
  }
  if (body.contains("polygon")) {
    auto polygon = std::make_unique<b2PolygonShape>();
    if (count == 4 && points[0] == -points[2] && points[0].x == points[3].x)
      polygon->SetAsBox(points[2].x, points[2].y);  // its corners in Box2D's own order
    else
      polygon->Set(points.data(), count);
    return polygon;
  }
  const b2Vec2 before = points.at(0) + points[0] - points.at(1);
  const b2Vec2 after = points.back() + points.back() - points[points.size() - 2];
  if (body.contains("edge")) {
    auto edge = std::make_unique<b2EdgeShape>();
    edge->SetTwoSided(points[0], points[1]);
    if (body.value("one_sided", false)) edge->SetOneSided(before, points[0], points[1], after);
    return edge;
  }
  auto chain = std::make_unique<b2ChainShape>();
  if (body.contains("loop")) chain->CreateLoop(points.data(), count);
  if (body.contains("chain")) chain->CreateChain(points.data(), count, before, after);
  return chain;
}

class Bodies {
 public:
  explicit Bodies(World& world) : world_(world) {}

  /// All bodies and joints of a scene.
  void build(const json& scene) {
    for (const json& body : scene.at("bodies")) add(body);
    for (const json& joint : scene.value("joints", json::array())) {
      b2RevoluteJointDef def;
      def.Initialize(&body(joint.at("bodies").at(0)), &body(joint.at("bodies").at(1)),
                     vector_of<b2Vec2>(joint.at("at")));
      def.enableMotor = joint.contains("motor");
      def.maxMotorTorque = joint.value("motor", 0.0F);
      world_.world.CreateJoint(&def);
    }
  }

  void add(const json& text) {
    test::refuse_other_keys(text,
                            " id type at angle velocity spin surface_speed polygon edge chain loop circle one_sided "
                            "density sensor bullet weightless angular_damping blocks ",
                            "a body");
    b2Fixture& made =
        world_.add(named(text.value("type", "static"), types), vector_of<b2Vec2>(text.value("at", json{0, 0})),
                   *shape_of(text), text.value("density", 1.0F));
    made.SetSensor(text.value("sensor", false));
    made.GetBody()->SetBullet(text.value("bullet", false));
    if (text.value("weightless", false)) made.GetBody()->SetGravityScale(0);
    made.GetBody()->SetAngularDamping(text.value("angular_damping", 0.0F));
    surfaces_[&made] = {.blocks = named(text.value("blocks", "as_in_box2d"),
                                        blockings)};  // a new fixture may have the address of a destroyed one
    const std::string id = text.at("id");
    fixtures[id] = &made;
    json put_so = json::object();
    for (const char* key : {"angle", "velocity", "spin", "surface_speed"})
      if (text.contains(key)) put_so[key] = text[key];
    put({{id, put_so}});
  }

  /// Bodies come to be somewhere at once, or get another speed.
  void put(const json& bodies) {
    for (const auto& [id, text] : bodies.items()) {
      test::refuse_other_keys(text, " at angle velocity spin surface_speed motor ", "what is set");
      b2Body& one = body(id);
      if (text.contains("at") || text.contains("angle"))
        one.SetTransform(text.contains("at") ? vector_of<b2Vec2>(text["at"]) : one.GetPosition(),
                         text.value("angle", one.GetAngle()));
      if (text.contains("velocity")) one.SetLinearVelocity(vector_of<b2Vec2>(text["velocity"]));
      if (text.contains("spin")) one.SetAngularVelocity(text["spin"]);
      if (text.contains("surface_speed")) surfaces_[&fixture(id)].speed = text["surface_speed"];
      if (text.contains("motor"))
        static_cast<b2RevoluteJoint*>(one.GetJointList()->joint)->SetMotorSpeed(text["motor"]);
    }
  }

  b2Body& body(const std::string& id) { return *fixture(id).GetBody(); }
  [[nodiscard]] Surface surface_of(const b2Fixture& fixture) { return surfaces_[&fixture]; }

  std::map<std::string, b2Fixture*> fixtures;  ///< By the ids of their bodies.

 private:
  b2Fixture& fixture(const std::string& id) {
    const auto found = fixtures.find(id);
    if (found == fixtures.end()) throw std::invalid_argument("no such body: " + id);
    return *found->second;
  }

  World& world_;
  std::map<const b2Fixture*, Surface> surfaces_;
};

}  // namespace paperproof::box2d::hero_test
