#include "geometry/triangulation.hpp"

#include "geometry/exact.hpp"

namespace paperproof::geometry {
namespace {

using NodeIndex = std::uint32_t;

/// One visit of the outline to a vertex. A vertex at the end of a bridge is visited more than once.
struct Node {
  std::uint32_t vertex;
  NodeIndex previous;
  NodeIndex next;
  bool clipped;
};

/// A polygon as one closed outline, its inside on the left.
class Outline {
 public:
  explicit Outline(const DirectedRings& rings) : vertices_(rings.vertices) {
    nodes_.reserve(vertices_.size() + 2 * rings.first_vertex.size());
    for (std::size_t ring = 0; ring < rings.first_vertex.size(); ++ring) {
      const std::uint32_t first = rings.first_vertex[ring];
      const std::uint32_t size = rings.size_of(ring);
      for (std::uint32_t i = 0; i < size; ++i) {
        nodes_.push_back({first + i, first + (i + size - 1) % size, first + (i + 1) % size, false});
      }
    }
  }

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] const Node& node(NodeIndex i) const { return nodes_[i]; }
  [[nodiscard]] const Vec2d& at(NodeIndex i) const { return vertices_[nodes_[i].vertex]; }
  [[nodiscard]] const Vec2d& at_next(NodeIndex i) const { return at(nodes_[i].next); }
  [[nodiscard]] const Vec2d& at_previous(NodeIndex i) const { return at(nodes_[i].previous); }
  /// +1: a corner that sticks out, 0: straight, -1: reflex.
  [[nodiscard]] int turn(NodeIndex i) const { return orientation_sign(at_previous(i), at(i), at_next(i)); }

  /// Adds a bridge from `from` to `to` and back: the two rings become one.
  void bridge(NodeIndex from, NodeIndex to) {
    const auto from_again = static_cast<NodeIndex>(nodes_.size());
    const NodeIndex to_again = from_again + 1;
    nodes_.push_back({nodes_[from].vertex, to_again, nodes_[from].next, false});
    nodes_.push_back({nodes_[to].vertex, nodes_[to].previous, from_again, false});
    nodes_[nodes_[from].next].previous = from_again;
    nodes_[nodes_[to].previous].next = to_again;
    nodes_[from].next = to;
    nodes_[to].previous = from;
  }

  void clip(NodeIndex i) {
    nodes_[nodes_[i].previous].next = nodes_[i].next;
    nodes_[nodes_[i].next].previous = nodes_[i].previous;
    nodes_[i].clipped = true;
  }

 private:
  const std::vector<Vec2d>& vertices_;
  std::vector<Node> nodes_;
};

/// A side of the outline that passes above or below a point, directed to the right.
struct Passing {
  Vec2d left;
  Vec2d right;
  bool exists = false;

  [[nodiscard]] int side_of(const Vec2d& point) const { return orientation_sign(left, right, point); }
};

/// Sides do not cross, so the left end of the second, or its right end if the left ends are one, tells which is above.
bool is_above(const Passing& second, const Passing& first) {
  if (left_of(second.left, first.left)) return !is_above(first, second);
  const int left_end = first.side_of(second.left);
  return (left_end != 0 ? left_end : first.side_of(second.right)) > 0;
}

/// Is `target`, seen from a node, in the angle between the sides that meet there? It is never along one of them.
bool looks_inwards(const Outline& outline, NodeIndex node, const Vec2d& target) {
  const bool left_of_next = orientation_sign(outline.at(node), outline.at_next(node), target) > 0;
  const bool left_of_previous = orientation_sign(outline.at_previous(node), outline.at(node), target) > 0;
  return outline.turn(node) > 0 ? left_of_next && left_of_previous : left_of_next || left_of_previous;
}

/// The node of the ring around `start` that `hole_vertex` can be bridged to: the one furthest to the right among those
/// left of it, between the side directly above it and the one directly below. No side can be in the way: it would have
/// a vertex further to the right, or cross one of the two sides. (The step of the sweep that splits a polygon into
/// monotone ones; it needs orientations only, no coordinates of intersections.)
NodeIndex bridge_end(const Outline& outline, NodeIndex start, const Vec2d& hole_vertex) {
  Passing above;
  Passing below;
  NodeIndex i = start;
  do {
    Passing side{outline.at(i), outline.at_next(i), true};
    if (left_of(side.right, side.left)) std::swap(side.left, side.right);
    if (left_of(side.left, hole_vertex) && left_of(hole_vertex, side.right)) {
      if (side.side_of(hole_vertex) > 0) {
        if (!below.exists || is_above(side, below)) below = side;
      } else {
        if (!above.exists || is_above(above, side)) above = side;
      }
    }
    i = outline.node(i).next;
  } while (i != start);

  const Vec2d nearest = left_of(above.left, below.left) ? below.left : above.left;
  NodeIndex best = start;
  bool found = false;
  do {
    const Vec2d& at = outline.at(i);
    const bool in_reach =
        !left_of(at, nearest) && left_of(at, hole_vertex) && (!found || !left_of(at, outline.at(best)));
    if (in_reach && above.side_of(at) <= 0 && below.side_of(at) >= 0 && looks_inwards(outline, i, hole_vertex)) {
      best = i;
      found = true;
    }
    i = outline.node(i).next;
  } while (i != start);
  if (!found) throw std::invalid_argument("a hole cannot be joined to the outline");
  return best;
}

/// Joins holes from left to right, so that everything on the left of a hole is one ring already.
void bridge_holes(Outline& outline, const DirectedRings& rings) {
  std::vector<NodeIndex> nodes;  // the leftmost one of each hole
  for (std::size_t hole = 1; hole < rings.first_vertex.size(); ++hole) {
    const std::uint32_t first = rings.first_vertex[hole];
    nodes.push_back(first + static_cast<NodeIndex>(leftmost(Ring(rings.vertices).subspan(first, rings.size_of(hole)))));
  }
  std::ranges::sort(nodes, [&](NodeIndex a, NodeIndex b) { return left_of(outline.at(a), outline.at(b)); });
  for (const NodeIndex node : nodes) outline.bridge(bridge_end(outline, 0, outline.at(node)), node);
}

/// Clips ears until nothing is left.
class EarClipper {
 public:
  explicit EarClipper(Outline& outline) : outline_(outline), is_reflex_(outline.size()) {
    for (NodeIndex i = 0; i < outline_.size(); ++i) {
      waiting_.push_back(i);
      is_reflex_[i] = outline_.turn(i) <= 0;
      if (is_reflex_[i]) reflex_.push_back(i);
    }
  }

  /// A node is tested once, and again when a neighbour is clipped: no other change can make it an ear.
  std::vector<Triangle> clip_all() {
    std::vector<Triangle> triangles;
    std::size_t left = outline_.size();
    for (std::size_t i = 0; i < waiting_.size() && left > 2; ++i) {
      const NodeIndex tip = waiting_[i];
      const Node ear = outline_.node(tip);
      if (ear.clipped || !is_ear(tip)) continue;
      triangles.push_back({outline_.node(ear.previous).vertex, ear.vertex, outline_.node(ear.next).vertex});
      outline_.clip(tip);
      --left;
      for (const NodeIndex neighbour : {ear.previous, ear.next}) {
        is_reflex_[neighbour] = outline_.turn(neighbour) <= 0;
        waiting_.push_back(neighbour);
      }
    }
    if (left != 2) throw std::invalid_argument("the polygon cannot be cut into triangles");
    return triangles;
  }

 private:
  /// Whether the node sticks out, with no vertex in its triangle. If any vertex is in the triangle, a reflex or
  /// straight one is as well. Visits to the triangle's own corners do not count: a side that runs from a corner into
  /// the triangle would have to end in the triangle or cross it.
  bool is_ear(NodeIndex tip) {
    if (is_reflex_[tip]) return false;
    const Vec2d& a = outline_.at_previous(tip);
    const Vec2d& b = outline_.at(tip);
    const Vec2d& c = outline_.at_next(tip);
    const Box2 box = Box2::between(a, b).with(c);
    // Clipping makes no node reflex: a node that is left out here stays out.
    std::erase_if(reflex_, [&](NodeIndex i) { return !is_reflex_[i]; });
    return std::ranges::none_of(reflex_, [&](NodeIndex i) {
      const Vec2d& p = outline_.at(i);
      return box.overlaps({p, p}) && p != a && p != b && p != c && orientation_sign(a, b, p) >= 0 &&
             orientation_sign(b, c, p) >= 0 && orientation_sign(c, a, p) >= 0;
    });
  }

  Outline& outline_;
  std::vector<char> is_reflex_;
  std::vector<NodeIndex> waiting_;
  std::vector<NodeIndex> reflex_;
};

}  // namespace

std::vector<Triangle> triangulate(const DirectedRings& rings) {
  Outline outline(rings);
  bridge_holes(outline, rings);
  return EarClipper(outline).clip_all();
}

}  // namespace paperproof::geometry
