#include "records/collider_json.hpp"

#include <nlohmann/json.hpp>

namespace paperproof::compare {

using nlohmann::ordered_json;

Vec2d point_of(const ordered_json& json) { return {json.at(0).get<double>(), json.at(1).get<double>()}; }

std::vector<Vec2d> points_of(const ordered_json& json) {
  std::vector<Vec2d> points;
  for (const ordered_json& point : json) points.push_back(point_of(point));
  return points;
}

ordered_json point_json(const Vec2d& point) { return ordered_json{point.x(), point.y()}; }

ordered_json points_json(const std::vector<Vec2d>& points) {
  ordered_json list = ordered_json::array();
  for (const Vec2d& point : points) list.push_back(point_json(point));
  return list;
}

ordered_json collider_json(const std::string& id, const ColliderDef& collider) {
  ordered_json object{{"id", id}};
  if (collider.shape == ColliderDef::Shape::circle)
    object["circle"] = {collider.points.front().x(), collider.points.front().y(), collider.radius};
  else
    object[collider.shape == ColliderDef::Shape::chain ? "chain" : "polygon"] = points_json(collider.points);
  for (const std::vector<Vec2d>& hole : collider.holes) object["holes"].push_back(points_json(hole));
  if (collider.one_way) object["one_way"] = point_json(*collider.one_way);
  if (collider.sensor) object["sensor"] = true;
  if (collider.surface_speed != 0) object["surface_speed"] = collider.surface_speed;
  return object;
}

ColliderDef collider_of(const ordered_json& object) {
  ColliderDef collider;
  if (const auto circle = object.find("circle"); circle != object.end()) {
    collider.shape = ColliderDef::Shape::circle;
    collider.points = {point_of(*circle)};
    collider.radius = circle->at(2).get<double>();
  } else if (const auto chain = object.find("chain"); chain != object.end()) {
    collider.shape = ColliderDef::Shape::chain;
    collider.points = points_of(*chain);
  } else {
    collider.points = points_of(object.at("polygon"));
  }
  if (const auto holes = object.find("holes"); holes != object.end())
    for (const ordered_json& hole : *holes) collider.holes.push_back(points_of(hole));
  if (const auto normal = object.find("one_way"); normal != object.end()) collider.one_way = point_of(*normal);
  collider.sensor = object.value("sensor", false);
  collider.surface_speed = object.value("surface_speed", 0.0);
  return collider;
}

}  // namespace paperproof::compare
