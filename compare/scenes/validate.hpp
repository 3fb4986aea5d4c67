/// What every loader asks before it hands a scene out.
#pragma once

#include "oracle/box_tree.hpp"
#include "scenes/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// "file: /pointer" or "file:line" of a collider.
using WhereIs = std::function<std::string(ColliderIndex)>;

/// The most colliders of a scene. Small: large levels do not fit. Large: a packed map of a few kilobytes takes all the
/// memory (each collider takes some kilobytes once all contenders and the judge have it).
inline constexpr std::size_t most_colliders = 1'000'000;

/// To be asked by what makes colliders out of a small file, before each. @throws InputError for more than that.
void check_collider_count(std::size_t count, const std::string& where);

/// The most corners of a polygon with its holes. Cutting it into convex pieces takes time with their square: seconds
/// for these, minutes for five times as many.
inline constexpr std::size_t most_corners = 10'000;

/// Builds the scenery once, for its checks. @throws InputError with the place and the id of a collider that is
/// unusable.
void check_scenery(const SceneryDef& scenery, const std::vector<std::string>& ids, const WhereIs& where);

/// Answers where a character can stand, exactly. Keeps a tree of the colliders, so that many places can be asked.
class FreePlaces {
 public:
  /// @param scenery must outlive this; all of it is taken as standing where its points are.
  FreePlaces(const SceneryDef& scenery, const CharacterShape& shape);

  /// The colliders that the character overlaps at `position`, by exact arithmetic. One-way chains and sensors are
  /// never listed.
  [[nodiscard]] std::vector<ColliderIndex> overlapped(const Vec2d& position) const;
  /// The colliders whose boxes meet this one; no sensors.
  [[nodiscard]] std::vector<ColliderIndex> near(const Box2& box) const { return solids_.meeting(box); }
  [[nodiscard]] bool is_free(const Vec2d& position) const { return overlapped(position).empty(); }

 private:
  const SceneryDef& scenery_;
  detail::BoxTree solids_;
  std::vector<Vec2d> hull_;
  Box2 character_box_;
};

/// Smallest box around a collider [m]. It has at least one point.
[[nodiscard]] Box2 box_of(const ColliderDef& collider);

/// Refuses a start inside a solid, where movers are when the scene begins, unless the scene asks to resolve it; and one
/// that overlaps a character of a lower index.
/// @param where of the start. @param remedy what the user can do about a solid; may be empty.
/// @throws InputError naming the solids, or the character.
void check_start(const Scene& scene, const std::string& where, const std::string& remedy = {},
                 std::size_t character = 0);

/// Both, of all colliders and characters. @throws InputError with the name.
void check_scene(const Scene& scene, const std::string& name);

}  // namespace paperproof::compare
