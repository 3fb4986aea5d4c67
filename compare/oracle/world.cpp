#include "oracle/world.hpp"

#include "oracle/convex_parts.hpp"

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare::detail {
namespace {

template <class Number>
Sign side_in(const Convert<Number>& number, const Vec2d& start, const Vec2d& end, const Vec2d& from, const Vec2d& to) {
  return sign_of(cross(convert(number, end) - convert(number, start), convert(number, to) - convert(number, from)));
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

}  // namespace

Sign side(const Vec2d& start, const Vec2d& end, const Vec2d& from, const Vec2d& to) {
  const Sign quick = side_in(Convert<Approximate>{}, start, end, from, to);
  if (quick != Sign::unknown) return quick;
  const int unit = std::min({lowest_bit(start), lowest_bit(end), lowest_bit(from), lowest_bit(to)});
  return side_in(Convert<Integer>{unit}, start, end, from, to);
}

Sign winding(std::span<const Vec2d> ring) {
  const Sign quick = winding_in(Convert<Approximate>{}, ring);
  return quick != Sign::unknown ? quick : winding_in(Convert<Integer>{lowest_bit_of(ring)}, ring);
}

std::vector<Vec2d> normalised(std::vector<Vec2d> points) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  while (points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (points.size() < 3 || points.size() > max_points) {
    throw std::invalid_argument("the character needs 3 to 16 distinct hull points");
  }
  const Sign way = winding(points);
  if (way == Sign::zero) throw std::invalid_argument("the character's points have no area");
  if (way == Sign::negative) std::ranges::reverse(points);
  return points;
}

World::World(const SceneryDef& scenery, std::vector<Vec2d> points)
    : scenery_(scenery), points_(normalised(std::move(points))) {
  Vec2d sum = Vec2d::Zero();
  for (const Vec2d& point : points_) sum += point;
  witness_ = sum / static_cast<double>(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (turn(points_[k], points_[(k + 1) % points_.size()], witness_) != Sign::positive)
      throw std::invalid_argument("the character is not convex, or too thin for its coordinates");
  points_box_ = Box2::around(points_);
  points_unit_ = std::min(lowest_bit_of(points_), lowest_bit(witness_));
  for (ColliderIndex i = 0; i < scenery_.colliders.size(); ++i) {
    const ColliderDef& def = scenery_.colliders[i];
    solids_.push_back({.kind = Kind::polygon,
                       .group = find_group(def),
                       .first_edge = static_cast<std::uint32_t>(edges_.size()),
                       .edge_count = 0,
                       .unit = std::numeric_limits<int>::max(),
                       .box = Box2::around(def.points)});
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
  const auto known = std::ranges::find_if(
      groups_, [&](const Group& group) { return group.mover == def.mover && group.sensor == def.sensor; });
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
      edge_boxes.push_back(Box2::between(edges_[i].a, edges_[i].b));
      edge_names.push_back(i);
    }
  }
  group.solid_tree = BoxTree(solid_boxes, group.colliders);
  group.edge_tree = BoxTree(edge_boxes, edge_names);
}

void World::add_edge(ColliderIndex index, const Vec2d& a, const Vec2d& b) {
  if (a == b) return;
  Solid& solid = solids_[index];
  edges_.push_back({a, b, index});
  ++solid.edge_count;
  solid.unit = std::min({solid.unit, lowest_bit(a), lowest_bit(b)});
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
  solid.unit = std::min(lowest_bit(def.points.front()), lowest_bit(def.radius));
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
  const Box2 box = Box2::between(from, end) + points_box_;
  // At most eight roundings of numbers no larger than these.
  const double size = way.size() + points_box_.lower.cwiseAbs().maxCoeff() + points_box_.upper.cwiseAbs().maxCoeff();
  return box.inflated(size * 0x1p-49 + std::numeric_limits<double>::min());
}

template <class Number>
Frame<Number> Passage::frame(int unit) const {
  Frame<Number> frame = make_frame<Number>(world_, way_, unit);
  frame.known = sweep_hull(frame.octagon, frame.way, frame.hull);
  return frame;
}

template <class Question>
bool Passage::decide(int unit, const Question& question) const {
  Answer answer = question(quick_);
  if (answer == Answer::unknown) {
    world_.count_exact();
    answer = question(frame<Integer>(unit));
  }
  return answer == Answer::yes;
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
  const auto is_above = [&](const auto& frame) { return above(frame, asked); };
  known_above_.emplace(surface, decide(world_.unit_of(way_, asked), is_above));
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
    if (box_.overlaps(Box2::between(edge.a, edge.b))) candidates.push_back(i);
  }
  return entered(candidates);
}

bool Passage::inside(ColliderIndex collider) const {
  return world_.solids()[collider].kind == Kind::polygon &&
         decide(world_.unit_of(way_, collider), [&](const auto& frame) { return inside(frame, collider); });
}

template <class Number>
Answer Passage::enters_disc(const Frame<Number>& frame, ColliderIndex disc) const {
  if (!frame.known) return Answer::unknown;
  const ColliderDef& def = world_.scenery().colliders[disc];
  return disc_enters(frame.hull, frame.at(def.points.front()), frame.number(def.radius));
}

bool Passage::enters_disc(ColliderIndex disc) const {
  return decide(world_.unit_of(way_, disc), [&](const auto& frame) { return enters_disc(frame, disc); });
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
  const auto first = std::ranges::lower_bound(edges, solid.first_edge);
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
