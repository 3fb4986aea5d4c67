#include "records/collider_json.hpp"

#include <nlohmann/json.hpp>

namespace paperproof::compare {

using nlohmann::ordered_json;

ordered_json point_json(const Vec2d& point) { return ordered_json{point.x(), point.y()}; }

ordered_json points_json(const std::vector<Vec2d>& points) {
  ordered_json list = ordered_json::array();
  for (const Vec2d& point : points) list.push_back(point_json(point));
  return list;
}

ordered_json collider_json(const std::string& id, const ColliderDef& collider) {
  ordered_json object{{"id", id}};
  switch (collider.shape) {
    case ColliderDef::Shape::polygon:
      object["polygon"] = points_json(collider.points);
      break;
    case ColliderDef::Shape::chain:
      object["chain"] = points_json(collider.points);
      break;
    case ColliderDef::Shape::circle:
      object["circle"] = {collider.points.front().x(), collider.points.front().y(), collider.radius};
      break;
  }
  for (const std::vector<Vec2d>& hole : collider.holes) object["holes"].push_back(points_json(hole));
  if (collider.one_way) object["one_way"] = point_json(*collider.one_way);
  if (collider.sensor) object["sensor"] = true;
  if (collider.surface_speed != 0) object["surface_speed"] = collider.surface_speed;
  return object;
}

}  // namespace paperproof::compare
