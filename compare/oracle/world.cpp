#include "oracle/world.hpp"

#include "oracle/convex_parts.hpp"

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare::detail {
namespace {

template <class Number>
Sign turn_in(const Convert<Number>& number, const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const Point<Number> origin = convert(number, a);
  return sign_of(cross(convert(number, b) - origin, convert(number, c) - origin));
}

template <class Number>
Sign winding_in(const Convert<Number>& number, std::span<const Vec2d> ring) {
  const Point<Number> origin = convert(number, ring[0]);
  Number area = number(0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    area = area + cross(convert(number, ring[i]) - origin, convert(number, ring[i + 1]) - origin);
  }
  return sign_of(area);
}

int lowest_bit(std::span<const Vec2d> points) {
  int lowest = std::numeric_limits<int>::max();
  for (const Vec2d& point : points) lowest = std::min(lowest, detail::lowest_bit(point));
  return lowest;
}

Box2 box_around(std::span<const Vec2d> points) {
  Box2 box{points[0], points[0]};
  for (const Vec2d& point : points) box = box.merged({point, point});
  return box;
}

bool strictly_inside(std::span<const Vec2d> convex, const Vec2d& point) {
  for (std::size_t k = 0; k < convex.size(); ++k) {
    if (turn(convex[k], convex[(k + 1) % convex.size()], point) != Sign::positive) return false;
  }
  return true;
}

Vec2d find_witness(std::span<const Vec2d> points) {
  Vec2d sum = Vec2d::Zero();
  for (const Vec2d& point : points) sum += point;
  const Vec2d mean = sum / static_cast<double>(points.size());
  if (strictly_inside(points, mean)) return mean;
  throw std::invalid_argument("the character is not convex, or too thin for its coordinates");
}

}  // namespace

Sign turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const Sign quick = turn_in(Convert<Approximate>{}, a, b, c);
  if (quick != Sign::unknown) return quick;
  return turn_in(Convert<Integer>{std::min({detail::lowest_bit(a), detail::lowest_bit(b), detail::lowest_bit(c)})}, a,
                 b, c);
}

Sign winding(std::span<const Vec2d> ring) {
  const Sign quick = winding_in(Convert<Approximate>{}, ring);
  return quick != Sign::unknown ? quick : winding_in(Convert<Integer>{lowest_bit(ring)}, ring);
}

std::vector<Vec2d> normalised(std::vector<Vec2d> points) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  while (points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (points.size() < 3 || points.size() > max_points) {
    throw std::invalid_argument("the character needs 3 to 16 distinct hull points");
  }
  const Sign way = winding(points);
  if (way == Sign::zero) throw std::invalid_argument("the character's points have no area");
  if (way == Sign::negative) std::reverse(points.begin(), points.end());
  return points;
}

World::World(const SceneryDef& scenery, std::vector<Vec2d> points)
    : scenery_(scenery), points_(normalised(std::move(points))) {
  witness_ = find_witness(points_);
  points_box_ = box_around(points_);
  points_unit_ = std::min(lowest_bit(points_), detail::lowest_bit(witness_));
  for (ColliderIndex i = 0; i < scenery_.colliders.size(); ++i) {
    const ColliderDef& def = scenery_.colliders[i];
    solids_.push_back({.kind = Kind::polygon,
                       .group = find_group(def),
                       .first_edge = static_cast<std::uint32_t>(edges_.size()),
                       .edge_count = 0,
                       .unit = std::numeric_limits<int>::max(),
                       .box = box_around(def.points)});
    if (def.shape == ColliderDef::Shape::circle)
      add_disc(i);
    else if (def.one_way)
      add_one_way(i);
    else
      def.shape == ColliderDef::Shape::polygon ? add_polygon(i) : add_chain(i);
    groups_[solids_.back().group].colliders.push_back(i);
    if (def.mover != no_mover) mover_count_ = std::max(mover_count_, std::size_t{def.mover} + 1);
  }
  for (Group& group : groups_) build_trees(group);
  surfaces_ = surface_finder_.find(edges_);
}

std::uint32_t World::find_group(const ColliderDef& def) {
  const auto known = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
    return group.mover == def.mover && group.sensor == def.sensor;
  });
  const auto index = static_cast<std::uint32_t>(known - groups_.begin());
  if (known == groups_.end()) {
    groups_.emplace_back();
    groups_.back().mover = def.mover;
    groups_.back().sensor = def.sensor;
  }
  return index;
}

void World::build_trees(Group& group) const {
  std::vector<Box2> solid_boxes;
  std::vector<Box2> edge_boxes;
  std::vector<std::uint32_t> edge_names;
  group.box = solids_[group.colliders.front()].box;
  for (const ColliderIndex collider : group.colliders) {
    const Solid& solid = solids_[collider];
    group.box = group.box.merged(solid.box);
    solid_boxes.push_back(solid.box);
    for (std::uint32_t i = solid.first_edge; i < solid.first_edge + solid.edge_count; ++i) {
      edge_boxes.push_back({edges_[i].a.cwiseMin(edges_[i].b), edges_[i].a.cwiseMax(edges_[i].b)});
      edge_names.push_back(i);
    }
  }
  group.solid_tree = BoxTree(std::move(solid_boxes), group.colliders);
  group.edge_tree = BoxTree(std::move(edge_boxes), std::move(edge_names));
}

void World::add_edge(ColliderIndex index, const Vec2d& a, const Vec2d& b) {
  if (a == b) return;
  Solid& solid = solids_[index];
  edges_.push_back({a, b, index});
  ++solid.edge_count;
  solid.unit = std::min({solid.unit, detail::lowest_bit(a), detail::lowest_bit(b)});
}

void World::add_polygon(ColliderIndex index) {
  const auto add_ring = [&](const std::vector<Vec2d>& ring, Sign wanted) {
    const bool keep = winding(ring) == wanted;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2d& a = ring[i];
      const Vec2d& b = ring[(i + 1) % ring.size()];
      keep ? add_edge(index, a, b) : add_edge(index, b, a);
    }
  };
  const ColliderDef& def = scenery_.colliders[index];
  add_ring(def.points, Sign::positive);
  for (const std::vector<Vec2d>& hole : def.holes) add_ring(hole, Sign::negative);
}

void World::add_disc(ColliderIndex index) {
  const ColliderDef& def = scenery_.colliders[index];
  Solid& solid = solids_[index];
  solid.kind = Kind::disc;
  solid.unit = std::min(detail::lowest_bit(def.points.front()), detail::lowest_bit(def.radius));
  solid.box = box_of_disc(def.points.front(), def.radius);
}

void World::add_chain(ColliderIndex index) {
  const std::vector<Vec2d>& points = scenery_.colliders[index].points;
  solids_[index].kind = Kind::two_sided;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) add_edge(index, points[i], points[i + 1]);
}

void World::add_one_way(ColliderIndex index) {
  const ColliderDef& def = scenery_.colliders[index];
  solids_[index].kind = Kind::one_way;
  for (const std::vector<Vec2d>& line : one_way_lines_of(def)) {
    const auto first_edge = static_cast<std::uint32_t>(edges_.size());
    std::vector<Sign> sides;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Sign left = side_of(line[i], line[i + 1], *def.one_way);
      if (left == Sign::positive) add_edge(index, line[i], line[i + 1]);
      if (left == Sign::negative) add_edge(index, line[i + 1], line[i]);
      sides.push_back(left);
    }
    surface_finder_.add_line(def, line, sides, first_edge);
  }
}

Box2 World::box_of(const Way& way) const noexcept {
  const Vec2d from = way.from.rounded();
  const Vec2d end = way.rounded_end();
  const Box2 ends = Box2{from, from}.merged({end, end});
  const Box2 box{ends.lower + points_box_.lower, ends.upper + points_box_.upper};
  // At most eight roundings of numbers no larger than these.
  const double size = way.size() + points_box_.lower.cwiseAbs().maxCoeff() + points_box_.upper.cwiseAbs().maxCoeff();
  return box.inflated(size * 0x1p-49 + std::numeric_limits<double>::min());
}

template <class Number>
Passage::Frame<Number> Passage::frame(int unit) const {
  Frame<Number> frame{.number = {unit}, .from = {}, .way = {}, .octagon = {}, .hull = {}, .known = false};
  frame.from = way_.from.in(frame.number);
  frame.way = way_.displacement(frame.number);
  frame.octagon = convert_octagon(frame.number, world_.points());
  frame.known = sweep_hull(frame.octagon, frame.way, frame.hull);
  return frame;
}

template <class Number>
Answer Passage::enters(const Frame<Number>& frame, const Edge& edge) const {
  if (!frame.known) return Answer::unknown;
  return segment_enters(frame.hull, frame.at(edge.a), frame.at(edge.b));
}

template <class Number>
Answer Passage::above(const Frame<Number>& frame, const Surface& surface) const {
  const Point<Number> up = convert(Convert<Number>{lowest_bit(surface.one_way)}, surface.one_way);
  // Edges that are beside the octagon for certain say nothing.
  const auto place_of = [&](const Vec2d& v) {
    return (v.x() * surface.one_way.y() - v.y() * surface.one_way.x()) / surface.one_way.norm();
  };
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec2d& point : world_.points()) {
    const double place = place_of(way_.from.rounded() + point);
    low = std::min(low, place);
    high = std::max(high, place);
  }
  const double rounding =
      (way_.from.size() + world_.points_box().upper.cwiseAbs().maxCoeff() + std::abs(low)) * 0x1p-44;
  const auto beyond = std::lower_bound(surface.begins.begin() + 1, surface.begins.end(), low - rounding);
  Answer above = Answer::yes;
  for (auto i = static_cast<std::size_t>(beyond - surface.begins.begin()) - 1; i < surface.edges.size(); ++i) {
    if (i > 0 && surface.begins[i] > high + rounding) break;
    const bool last = i + 1 == surface.edges.size();
    const Edge& edge = world_.edges()[surface.edges[i]];
    const Point<Number> b = frame.at(edge.b);
    above = both(above, is_not(corner_below(frame.octagon, up, frame.at(edge.a), b, i == 0, last)));
    if (!last) above = both(above, is_not(vertex_above_rim(frame.octagon, up, b)));
    if (above == Answer::no) break;
  }
  return above;
}

bool Passage::above(std::uint32_t surface) const {
  if (known_above_ && known_above_->first == surface) return known_above_->second;
  const Surface& asked = world_.surfaces()[surface];
  Answer answer = above(quick_, asked);
  if (answer == Answer::unknown) {
    world_.count_exact();
    answer = above(frame<Integer>(world_.unit_of(way_, asked)), asked);
  }
  known_above_.emplace(surface, answer == Answer::yes);
  return known_above_->second;
}

template <class Number>
Answer Passage::inside(const Frame<Number>& frame, ColliderIndex collider) const {
  const Point<Number> witness = convert(frame.number, world_.witness());
  bool odd = false;
  for (const Edge& edge : world_.edges_of(collider)) {
    const Answer crosses = crosses_ray(witness, frame.at(edge.a), frame.at(edge.b));
    if (crosses == Answer::unknown) return Answer::unknown;
    odd = odd != (crosses == Answer::yes);
  }
  return odd ? Answer::yes : Answer::no;
}

Passage::Passage(const World& world, const Group& group, const Way& way)
    : world_(world), group_(group), way_(way), box_(world.box_of(way)), quick_(frame<Approximate>(0)) {}

std::vector<std::uint32_t> Passage::entered(const std::vector<std::uint32_t>& candidates) const {
  std::vector<std::uint32_t> found;
  std::optional<Frame<Integer>> exact;
  for (const std::uint32_t i : candidates) {
    const Edge& edge = world_.edges()[i];
    Answer answer = enters(quick_, edge);
    if (answer == Answer::unknown) {
      world_.count_exact();
      const int unit = world_.unit_of(way_, edge.collider);
      if (!exact || exact->number.unit != unit) exact = frame<Integer>(unit);
      answer = enters(*exact, edge);
    }
    if (answer == Answer::yes && (edge.surface == Edge::no_surface || above(edge.surface))) found.push_back(i);
  }
  return found;
}

std::vector<std::uint32_t> Passage::entered_edges() const { return entered(group_.edge_tree.meeting(box_)); }

std::vector<std::uint32_t> Passage::entered_edges(ColliderIndex collider) const {
  std::vector<std::uint32_t> candidates;
  const Solid& solid = world_.solids()[collider];
  for (std::uint32_t i = solid.first_edge; i < solid.first_edge + solid.edge_count; ++i) {
    const Edge& edge = world_.edges()[i];
    if (box_.overlaps({edge.a.cwiseMin(edge.b), edge.a.cwiseMax(edge.b)})) candidates.push_back(i);
  }
  return entered(candidates);
}

bool Passage::inside(ColliderIndex collider) const {
  if (world_.solids()[collider].kind != Kind::polygon) return false;
  Answer answer = inside(quick_, collider);
  if (answer == Answer::unknown) {
    world_.count_exact();
    answer = inside(frame<Integer>(world_.unit_of(way_, collider)), collider);
  }
  return answer == Answer::yes;
}

template <class Number>
Answer Passage::enters_disc(const Frame<Number>& frame, ColliderIndex disc) const {
  if (!frame.known) return Answer::unknown;
  const ColliderDef& def = world_.scenery().colliders[disc];
  return disc_enters(frame.hull, frame.at(def.points.front()), frame.number(def.radius));
}

bool Passage::enters_disc(ColliderIndex disc) const {
  Answer answer = enters_disc(quick_, disc);
  if (answer == Answer::unknown) {
    world_.count_exact();
    answer = enters_disc(frame<Integer>(world_.unit_of(way_, disc)), disc);
  }
  return answer == Answer::yes;
}

std::vector<ColliderIndex> Passage::met_discs() const {
  std::vector<ColliderIndex> found;
  for (const ColliderIndex collider : group_.solid_tree.meeting(box_))
    if (world_.solids()[collider].kind == Kind::disc && enters_disc(collider)) found.push_back(collider);
  return found;
}

bool Passage::meets_disc(ColliderIndex disc, double until) const {
  const auto enters = [&]<class Number>(Frame<Number> part, const Point<Number>& way) {
    part.way = way;
    part.known = sweep_hull(part.octagon, part.way, part.hull = {});
    return enters_disc(part, disc);
  };
  const Approximate share{until, 0};
  const Answer quick = enters(quick_, Point<Approximate>{quick_.way.x * share, quick_.way.y * share});
  if (quick != Answer::unknown) return quick == Answer::yes;
  world_.count_exact();
  // In units so much finer, the way counts the share as often as there are of its own units in 1.
  const int unit = world_.unit_of(way_, disc);
  const int bit = until == 0 ? 0 : std::min(0, lowest_bit(until));
  const Point<Integer> whole = way_.displacement(Convert<Integer>{unit});
  const Integer count = Convert<Integer>{bit}(until);
  return enters(frame<Integer>(unit + bit), Point<Integer>{whole.x * count, whole.y * count}) == Answer::yes;
}

bool Passage::meets(ColliderIndex collider) const {
  if (!world_.solids()[collider].box.overlaps(box_)) return false;
  if (world_.solids()[collider].kind == Kind::disc) return enters_disc(collider);
  return !entered_edges(collider).empty() || inside(collider);
}

std::span<const std::uint32_t> Passage::of_collider(std::span<const std::uint32_t> edges,
                                                    ColliderIndex collider) const {
  const Solid& solid = world_.solids()[collider];
  const auto first = std::lower_bound(edges.begin(), edges.end(), solid.first_edge);
  return {first, std::lower_bound(first, edges.end(), solid.first_edge + solid.edge_count)};
}

std::vector<ColliderIndex> Passage::met() const {
  const std::vector<std::uint32_t> near = group_.solid_tree.meeting(box_);
  std::vector<ColliderIndex> found;
  if (near.empty()) return found;
  const std::vector<std::uint32_t> entered = entered_edges();
  for (const ColliderIndex collider : near) {
    const bool is_disc = world_.solids()[collider].kind == Kind::disc;
    if (is_disc ? enters_disc(collider) : !of_collider(entered, collider).empty() || inside(collider))
      found.push_back(collider);
  }
  return found;
}

}  // namespace paperproof::compare::detail
