#include "oracle/turning_room.hpp"

#include "oracle/crush.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace paperproof::compare::detail {
double largest_motion(const VertexWay& way) {
  double largest = 0;
  for (std::size_t i = 0; i < way.vertices.front().size(); ++i) {
    double length = 0;
    for (std::size_t k = 1, last = 0; k < way.vertices.size(); ++k) {
      if (turns_at_once(way, k)) continue;
      length += (way.vertices[k][i] - way.vertices[last][i]).norm();
      last = k;
    }
    largest = std::max(largest, length);
  }
  return largest;
}

ColliderDef standing_at(ColliderDef def, const VertexWay& way, double fraction) {
  const std::vector<Vec2d> vertices = vertices_at(way, fraction);
  auto from = vertices.begin();
  const auto take = [&](std::vector<Vec2d>& ring) {
    std::copy_n(from, ring.size(), ring.begin());
    from += static_cast<std::ptrdiff_t>(ring.size());
  };
  take(def.points);
  for (std::vector<Vec2d>& hole : def.holes) take(hole);
  def.mover = no_mover;
  return def;
}

SceneryDef standing_at(const SceneryDef& scenery, const TraceStep& step, double fraction) {
  SceneryDef all = scenery;
  for (const VertexWay& way : step.vertex_ways)
    all.colliders[way.collider] = standing_at(std::move(all.colliders[way.collider]), way, fraction);
  return all;
}

RigidMotion::RigidMotion(std::span<const Vec2d> before, std::span<const Vec2d> after)
    : from_(before[0]), to_(after[0]) {
  const auto farther = [&](const Vec2d& a, const Vec2d& b) { return (a - from_).norm() < (b - from_).norm(); };
  const auto far = static_cast<std::size_t>(std::ranges::max_element(before, farther) - before.begin());
  if (before[far] != from_) turn_ = number(after[far] - to_) / number(before[far] - from_);
}

Vec2d RigidMotion::operator()(const Vec2d& at) const {
  const std::complex<double> place = number(to_) + turn_ * number(at - from_);
  return {place.real(), place.imag()};
}

const VertexWay& way_of(const TraceStep& step, ColliderIndex collider) {
  const VertexWay* way = find_way(step.vertex_ways, collider);
  if (way == nullptr) throw std::invalid_argument("a step needs the way of everything that turns");
  return *way;
}

std::vector<Vec2d> vertices_at(const VertexWay& way, double fraction) {
  const auto after = std::ranges::upper_bound(way.instants, fraction);
  const auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - way.instants.begin(), 1)) - 1;
  if (way.instants[k] == fraction || k + 1 == way.instants.size()) return way.vertices[k];
  const double share = (fraction - way.instants[k]) / (way.instants[k + 1] - way.instants[k]);
  std::vector<Vec2d> vertices = way.vertices[k];
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] += share * (way.vertices[k + 1][i] - vertices[i]);
  return vertices;
}

bool goes(const VertexWay& way) {
  return std::ranges::any_of(way.vertices,
                             [&](const std::vector<Vec2d>& vertices) { return vertices != way.vertices.front(); });
}

/// Whether a place lies on the right side of all that is given with where the octagon was when it was last free of it.
bool on_their_sides(const ExactScenery& standing, const Sides& sides, const Place& there) {
  return std::ranges::all_of(sides, [&](const auto& side) {
    return !standing.meets(Place(side.second, there.movers, there.fraction), there, side.first);
  });
}

bool has_way_out_at(const TraceHeader& header, const TraceStep& step, double moment, const Sides& sides,
                    const std::function<bool(const Vec2d&)>& accept) {
  const ExactScenery standing(standing_at(header.scenery, step, moment), header.points);
  const Vec2d& from = moment == 1 ? step.path.back().position : step.path.front().position;
  const std::optional<Vec2d> out = standing.way_out(Place(from, step.movers, moment), farthest_way_out);
  return out && accept(*out) && on_their_sides(standing, sides, Place(*out, step.movers, moment));
}

bool has_way_out(const TraceHeader& header, const TraceStep& step, const Sides& sides,
                 const std::function<bool(const Vec2d&)>& accept) {
  double turned = 0;
  for (const VertexWay& way : step.vertex_ways)
    if (way.instants.size() > 2) turned = way.instants[1];
  const std::array<double, 2> moments{0, turned};
  return std::ranges::all_of(moments, [&](double moment) {
    Sides then = sides;
    for (auto& [collider, side] : then) {
      const VertexWay& way = way_of(step, collider);
      side = RigidMotion(way.vertices.front(), vertices_at(way, moment))(side);
    }
    return has_way_out_at(header, step, moment, then, accept);
  });
}

std::optional<Vec2d> room_beside(const TraceHeader& header, const ExactScenery& rest, const TraceStep& step,
                                 const VertexWay& crusher, const Sides& sides,
                                 const std::function<bool(std::span<const PathPoint>)>& left_free) {
  const ExactScenery end(standing_at(header.scenery, step, 1), header.points);
  const ExactScenery wider(rest.scenery(), grown(header.points, least_clearance));
  const double reach = largest_motion(crusher) + push_beyond_motion - pushed_by(step);
  std::vector<PathPoint> way;
  for (const PathPoint& corner : step.path) {
    if (corner.fraction == 1) break;
    way.push_back(corner);
    const Place from(corner, step.movers);
    const std::vector<ColliderIndex> inside = rest.overlapped(from);
    const std::vector<ColliderIndex> near = wider.overlapped(from);
    const auto reached = [&](const Vec2d& position) {
      const Place there(position, step.movers, 1);
      std::vector<PathPoint> whole = way;
      whole.push_back({position, 1});
      return (position - step.path.back().position).norm() <= reach && on_their_sides(end, sides, there) &&
             rest.meets_only(from, there, inside) && wider.meets_only(from, there, near) && left_free(whole);
    };
    std::vector<ColliderIndex> may_pass = inside;
    for (const VertexWay& turning : step.vertex_ways) may_pass.push_back(turning.collider);
    const WayQuestion question{
        .from = from, .end = Place(corner.position, step.movers, 1), .may_pass = may_pass, .wider = wider.points()};
    if (const auto room = end.find_free(question, reach, least_clearance, reached)) return room;
  }
  return std::nullopt;
}

}  // namespace paperproof::compare::detail
