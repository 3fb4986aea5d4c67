#include "solid_union.hpp"

#include <cmath>
#include <polyclipping/clipper.hpp>

namespace paperproof::box2d {
namespace {

constexpr double units_per_metre = 4294967296.0;

ClipperLib::IntPoint to_grid(const b2Vec2& point) {
  return {static_cast<ClipperLib::cInt>(std::llround(static_cast<double>(point.x) * units_per_metre)),
          static_cast<ClipperLib::cInt>(std::llround(static_cast<double>(point.y) * units_per_metre))};
}

Vec2d from_grid(const ClipperLib::IntPoint& point) {
  return {static_cast<double>(point.X) / units_per_metre, static_cast<double>(point.Y) / units_per_metre};
}

/// Wound as asked, whatever the definition's winding.
ClipperLib::Path path_of(std::span<const Vec2d> points, bool counter_clockwise) {
  ClipperLib::Path path;
  path.reserve(points.size());
  for (const Vec2d& point : points) path.push_back(to_grid(rounded(point)));
  if (ClipperLib::Orientation(path) != counter_clockwise) ClipperLib::ReversePath(path);
  return path;
}

/// With every outer ring wound once around and every hole once back, "non-zero" is the union: a hole of one polygon
/// that another one fills counts as filled. What comes out is wound the same way.
ClipperLib::Paths paths_of(const SceneryDef& scenery) {
  ClipperLib::Paths paths;
  for (const ColliderDef& collider : scenery.colliders) {
    if (collider.shape != ColliderDef::Shape::polygon) continue;
    paths.push_back(path_of(collider.points, true));
    for (const std::vector<Vec2d>& hole : collider.holes) paths.push_back(path_of(hole, false));
  }
  return paths;
}

ClipperLib::Paths united_at_once(const ClipperLib::Paths& paths) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(paths, ClipperLib::ptSubject, true);
  ClipperLib::Paths outlines;
  clipper.Execute(ClipperLib::ctUnion, outlines, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return outlines;
}

/// Clipper's time grows faster than the number of paths: 45,000 tiles at once take four seconds. Maps come in rows, so
/// that neighbours in the list mostly are neighbours in the map, and most of a part's edges vanish in its own union.
/// A hole must stay with its polygon: alone it would be wound backwards around nothing, which non-zero counts as solid.
ClipperLib::Paths united(const ClipperLib::Paths& paths) {
  constexpr std::size_t part_size = 1000;
  if (paths.size() <= part_size) return united_at_once(paths);
  ClipperLib::Paths outlines;
  ClipperLib::Paths part;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    part.push_back(paths[i]);
    const bool next_is_hole = i + 1 < paths.size() && !ClipperLib::Orientation(paths[i + 1]);
    if ((part.size() < part_size || next_is_hole) && i + 1 < paths.size()) continue;
    const ClipperLib::Paths done = united_at_once(part);
    outlines.insert(outlines.end(), done.begin(), done.end());
    part.clear();
  }
  return united_at_once(outlines);
}

bool is_flat(const ColliderDef& collider) { return ClipperLib::Area(path_of(collider.points, true)) == 0; }

}  // namespace

std::vector<Ring> solid_union(const SceneryDef& scenery) {
  std::vector<Ring> loops;
  for (const ClipperLib::Path& outline : united(paths_of(scenery))) {
    std::vector<Vec2d> points;
    for (const ClipperLib::IntPoint& point : outline) points.push_back(from_grid(point));
    Ring loop = without_repeats(points, true);
    if (loop.size() >= 2) loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<ColliderIndex> flat_polygons(const SceneryDef& scenery) {
  std::vector<ColliderIndex> flat;
  for (ColliderIndex i = 0; i < scenery.colliders.size(); ++i) {
    const ColliderDef& collider = scenery.colliders[i];
    if (collider.shape == ColliderDef::Shape::polygon && is_flat(collider)) flat.push_back(i);
  }
  return flat;
}

Ring spaced(const Ring& loop) {
  const auto too_near = [](const b2Vec2& a, const b2Vec2& b) {
    return b2DistanceSquared(a, b) <= chain_spacing * chain_spacing;
  };
  Ring kept;
  for (const b2Vec2& vertex : loop) {
    if (kept.empty() || !too_near(kept.back(), vertex)) kept.push_back(vertex);
  }
  while (kept.size() > 1 && too_near(kept.back(), kept.front())) kept.pop_back();
  const bool same_winding = twice_area(kept) * twice_area(loop) > 0;
  return kept.size() >= 3 && same_winding ? kept : Ring{};
}

}  // namespace paperproof::box2d
