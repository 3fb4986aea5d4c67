/// Colliders as JSON, as scenes and traces have them.
#pragma once

#include <paperproof/scenery.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace paperproof::compare {

/// `[x, y]`.
[[nodiscard]] Vec2d point_of(const nlohmann::ordered_json& json);
[[nodiscard]] nlohmann::ordered_json point_json(const Vec2d& point);

/// `[[x, y], …]`.
[[nodiscard]] std::vector<Vec2d> points_of(const nlohmann::ordered_json& json);
[[nodiscard]] nlohmann::ordered_json points_json(const std::vector<Vec2d>& points);

/// Id, shape, and those properties that are not the usual ones.
[[nodiscard]] nlohmann::ordered_json collider_json(const std::string& id, const ColliderDef& collider);

/// The collider of such an object, without a mover. @param object holds to the schema of scenes or traces.
[[nodiscard]] ColliderDef collider_of(const nlohmann::ordered_json& object);

}  // namespace paperproof::compare
