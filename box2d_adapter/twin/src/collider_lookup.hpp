/// Whose edge is at a point: maps a contact with the common outline back to a collider.
#pragma once

#include <paperproof/scenery.hpp>

#include <box2d/b2_dynamic_tree.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::box2d {

class ColliderLookup {
 public:
  /// @param as_run polygons only are looked at; the caller keeps nothing. @param names what each collider is called in
  ///   an answer.
  ColliderLookup(const SceneryDef& as_run, std::span<const ColliderIndex> names);
  ColliderLookup(const ColliderLookup&) = delete;  // Box2D's tree owns raw memory and copies it shallowly.
  ColliderLookup& operator=(const ColliderLookup&) = delete;

  /// The polygon whose boundary is nearest to `point`, within `reach` [m]; the lowest index of those that are equally
  /// near up to `same_distance`. Absent where there is none.
  [[nodiscard]] std::optional<ColliderIndex> nearest(const Vec2d& point, double reach);

  /// Two boundaries are equally near up to this [m]: colliders that share an edge are, apart from the rounding of the
  /// contact point in float. Zero: rounding picks one of them. Large: the index would beat the geometry.
  static constexpr double same_distance = 1e-4;

 private:
  struct Edge {
    Vec2d a;
    Vec2d b;
    ColliderIndex collider = 0;
  };
  struct Candidate {
    double distance = 0;
    ColliderIndex collider = 0;
  };
  void add_ring(const std::vector<Vec2d>& ring, ColliderIndex collider);

  std::vector<Edge> edges_;
  b2DynamicTree tree_;
  std::vector<std::size_t> edge_of_proxy_;
  std::vector<Candidate> found_;  ///< Kept between calls, so that a step does not allocate.
};

}  // namespace paperproof::box2d
