#include "oracle/one_way.hpp"

#include "oracle/world.hpp"

#include <set>

namespace paperproof::compare::detail {

void SurfaceFinder::add_chain(const ColliderDef& chain, std::span<const Sign> sides, std::uint32_t first_edge) {
  std::uint32_t edge = first_edge;
  const auto note_end = [&](const Vec2d& at, bool begins) {
    Ends& ends = ends_[{chain.mover, chain.one_way->x(), chain.one_way->y(), at.x(), at.y()}];
    (begins ? ends.beginning : ends.ending).push_back(edge);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] == Sign::zero) continue;
    const bool forwards = sides[i] == Sign::positive;
    one_way_of_[edge] = *chain.one_way;
    if (i > 0 && sides[i - 1] == sides[i]) next_[forwards ? edge - 1 : edge] = forwards ? edge : edge - 1;
    if (i == 0) note_end(chain.points.front(), forwards);
    if (i + 1 == sides.size()) note_end(chain.points.back(), !forwards);
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
