#include "oracle/one_way.hpp"

#include "oracle/world.hpp"

#include <algorithm>
#include <set>

namespace paperproof::compare::detail {

Sign side_of(const Vec2d& a, const Vec2d& b, const Vec2d& one_way) {
  const Convert<Integer> number{std::min({lowest_bit(a), lowest_bit(b), lowest_bit(one_way)})};
  return sign_of(cross(convert(number, b) - convert(number, a), convert(number, one_way)));
}

std::vector<std::vector<Vec2d>> one_way_lines_of(const ColliderDef& def) {
  if (def.shape == ColliderDef::Shape::chain) return {def.points};
  std::vector<Vec2d> ring = def.points;
  if (winding(ring) == Sign::negative) std::ranges::reverse(ring);
  // Counter-clockwise: an edge faces to its right.
  std::vector<bool> faces;
  for (std::size_t i = 0; i < ring.size(); ++i)
    faces.push_back(side_of(ring[i], ring[(i + 1) % ring.size()], *def.one_way) == Sign::negative);
  const auto start = std::ranges::find(faces, false) - faces.begin();
  std::rotate(faces.begin(), faces.begin() + start, faces.end());
  std::rotate(ring.begin(), ring.begin() + start, ring.end());
  std::vector<std::vector<Vec2d>> lines;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if (!faces[i]) continue;
    if (!faces[i - 1]) lines.push_back({ring[i]});
    lines.back().push_back(ring[(i + 1) % ring.size()]);
  }
  return lines;
}

void SurfaceFinder::add_line(const ColliderDef& def, std::span<const Vec2d> line, std::span<const Sign> sides,
                             std::uint32_t first_edge) {
  std::uint32_t edge = first_edge;
  const auto note_end = [&](const Vec2d& at, bool begins) {
    Ends& ends = ends_[{def.mover, def.one_way->x(), def.one_way->y(), at.x(), at.y()}];
    (begins ? ends.beginning : ends.ending).push_back(edge);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] == Sign::zero) continue;
    const bool forwards = sides[i] == Sign::positive;
    one_way_of_[edge] = *def.one_way;
    if (i > 0 && sides[i - 1] == sides[i]) next_[forwards ? edge - 1 : edge] = forwards ? edge : edge - 1;
    if (i == 0) note_end(line.front(), forwards);
    if (i + 1 == sides.size()) note_end(line.back(), !forwards);
    ++edge;
  }
}

std::vector<Surface> SurfaceFinder::find(std::vector<Edge>& edges) const {
  std::map<std::uint32_t, std::uint32_t> next = next_;
  for (const auto& [place, ends] : ends_) {
    if (ends.ending.size() == 1 && ends.beginning.size() == 1) next[ends.ending[0]] = ends.beginning[0];
  }
  std::set<std::uint32_t> goes_on;
  for (const auto& [before, after] : next) goes_on.insert(after);
  std::vector<Surface> surfaces;
  for (const auto& [first, one_way] : one_way_of_) {
    if (goes_on.contains(first)) continue;
    Surface surface{.one_way = one_way, .edges = {}, .begins = {}, .unit = std::numeric_limits<int>::max()};
    std::optional<std::uint32_t> edge = first;
    while (edge) {
      Edge& of = edges[*edge];
      of.surface = static_cast<std::uint32_t>(surfaces.size());
      surface.edges.push_back(*edge);
      surface.begins.push_back((of.a.x() * one_way.y() - of.a.y() * one_way.x()) / one_way.norm());
      surface.unit = std::min({surface.unit, lowest_bit(of.a), lowest_bit(of.b)});
      const auto after = next.find(*edge);
      edge = after == next.end() ? std::nullopt : std::optional(after->second);
    }
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace paperproof::compare::detail
