#include "fixtures.hpp"

#include "solid_union.hpp"

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_fixture.h>

#include <algorithm>
#include <cmath>

namespace paperproof::box2d {
namespace {

/// What gives a fixture its friction and restitution: none, as for the character.
void add_fixture(b2Body& body, const b2Shape& shape, const FixtureSource& source, SceneryFixtures& made) {
  b2FixtureDef def;
  def.shape = &shape;
  def.friction = 0;
  def.restitution = 0;
  def.isSensor = source.sensor;
  def.userData.pointer = made.sources.size();
  body.CreateFixture(&def);
  made.sources.push_back(source);
  ++made.size.fixtures;
}

bool long_enough(const b2Vec2& a, const b2Vec2& b) { return b2Distance(a, b) > shortest_edge; }

void add_two_sided_edge(b2Body& body, const b2Vec2& a, const b2Vec2& b, const FixtureSource& source,
                        SceneryFixtures& made) {
  if (!long_enough(a, b)) return;
  b2EdgeShape edge;
  edge.SetTwoSided(a, b);
  add_fixture(body, edge, source, made);
  made.size.vertices += 2;
}

/// A ring of no area runs to and fro: an edge that was already added the other way round is left out.
void add_every_edge(b2Body& body, const Ring& ring, const FixtureSource& source, SceneryFixtures& made) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const b2Vec2& a = ring[i];
    const b2Vec2& b = ring[(i + 1) % ring.size()];
    bool known = false;
    for (std::size_t j = 0; j < i && !known; ++j) known = ring[j] == b && ring[j + 1] == a;
    if (!known) add_two_sided_edge(body, a, b, source, made);
  }
}

void add_loop(b2Body& body, const Ring& loop, const FixtureSource& source, SceneryFixtures& made) {
  const Ring chain_loop = spaced(loop);
  if (chain_loop.empty()) {
    const bool is_void = twice_area(loop) < 0;
    if (!is_void) add_every_edge(body, loop, source, made);
    return;
  }
  b2ChainShape chain;
  chain.CreateLoop(chain_loop.data(), static_cast<int32>(chain_loop.size()));
  add_fixture(body, chain, source, made);
  ++made.size.loops;
  made.size.vertices += chain_loop.size();
}

void add_polygon(b2Body& body, std::span<const b2Vec2> vertices, const FixtureSource& source, SceneryFixtures& made) {
  add_fixture(body, polygon_as_given(vertices), source, made);
  made.size.vertices += vertices.size();
}

/// A fan around the first vertex in parts that Box2D can hold.
void add_convex_piece(b2Body& body, const Ring& ring, const FixtureSource& source, SceneryFixtures& made) {
  constexpr std::size_t most = b2_maxPolygonVertices;
  for (std::size_t first = 1; first + 1 < ring.size(); first += most - 2) {
    const std::size_t last = std::min(first + most - 2, ring.size() - 1);
    Ring part{ring[0]};
    part.insert(part.end(), ring.begin() + static_cast<std::ptrdiff_t>(first),
                ring.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    if (twice_area(part) > 0) {
      add_polygon(body, part, source, made);
    } else {
      add_every_edge(body, part, source, made);
    }
  }
}

void add_polygon_piece(b2Body& body, std::span<const Vec2d> vertices, const FixtureSource& source,
                       SceneryFixtures& made) {
  const Ring ring = without_repeats(vertices, true);
  if (ring.size() == 2) add_two_sided_edge(body, ring[0], ring[1], source, made);
  add_convex_piece(body, ring, source, made);
}

/// Polygons have pieces of three vertices and more.
bool is_chain(const PieceInfo& piece) { return piece.vertex_count == 2; }

void add_pieces(b2Body& body, const Scenery& scenery, const Part& part, SceneryFixtures& made) {
  for (PieceIndex i = 0; i < scenery.pieces().size(); ++i) {
    const PieceInfo& piece = scenery.pieces()[i];
    if (piece.mover == part.mover && !piece.sensor && !is_chain(piece) && !piece.is_circle())
      add_polygon_piece(body, scenery.vertices_of(i), {.collider = piece.collider, .mover = part.mover}, made);
  }
}

void add_circle(b2Body& body, const Vec2d& centre, double radius, const FixtureSource& source, SceneryFixtures& made) {
  b2CircleShape circle;
  circle.m_p = rounded(centre);
  circle.m_radius = static_cast<float>(radius);
  add_fixture(body, circle, source, made);
  ++made.size.vertices;
}

void add_loops(b2Body& body, const Part& part, SceneryFixtures& made) {
  const FixtureSource several{.collider = std::nullopt, .mover = part.mover};
  for (const Ring& loop : solid_union(part.solids)) add_loop(body, loop, several, made);
  for (const ColliderIndex i : flat_polygons(part.solids)) {
    const FixtureSource one{.collider = part.colliders[i], .mover = part.mover};
    add_every_edge(body, without_repeats(part.solids.colliders[i].points, true), one, made);
  }
}

b2Vec2 right_normal(const b2Vec2& from, const b2Vec2& to) {
  b2Vec2 normal = b2Cross(to - from, 1.0F);
  normal.Normalize();
  return normal;
}

enum class Blocks : std::uint8_t { nothing, right, left };

/// Which side of the segment, seen along the chain, a one-way segment blocks.
Blocks blocked_side(const b2Vec2& a, const b2Vec2& b, const Vec2d& one_way) {
  const double along_right = widened(b2Cross(b - a, 1.0F)).dot(one_way);
  if (!long_enough(a, b) || along_right == 0) return Blocks::nothing;
  return along_right > 0 ? Blocks::right : Blocks::left;
}

/// Box2D's one-sided edges block on the right, looking from the first vertex to the second.
void add_one_way_segment(b2Body& body, const Ring& chain, std::size_t i, const Vec2d& one_way, FixtureSource source,
                         SceneryFixtures& made) {
  const Blocks side = blocked_side(chain[i], chain[i + 1], one_way);
  if (side == Blocks::nothing) return;
  b2Vec2 before = chain[i] - (chain[i + 1] - chain[i]);
  b2Vec2 after = chain[i + 1] + (chain[i + 1] - chain[i]);
  if (i > 0 && blocked_side(chain[i - 1], chain[i], one_way) == side) before = chain[i - 1];
  if (i + 2 < chain.size() && blocked_side(chain[i + 1], chain[i + 2], one_way) == side) after = chain[i + 2];

  b2EdgeShape edge;
  if (side == Blocks::right) {
    edge.SetOneSided(before, chain[i], chain[i + 1], after);
  } else {
    edge.SetOneSided(after, chain[i + 1], chain[i], before);
  }
  const Vec2d normal = widened(right_normal(edge.m_vertex1, edge.m_vertex2));
  source.one_way = FixtureSource::OneWay{widened(chain[i]), widened(chain[i + 1]), normal};
  add_fixture(body, edge, source, made);
  made.size.vertices += 2;
}

void add_chain(b2Body& body, const ColliderDef& def, const FixtureSource& source, SceneryFixtures& made) {
  const Ring chain = without_repeats(def.points, false);
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    if (def.one_way) {
      add_one_way_segment(body, chain, i, *def.one_way, source, made);
    } else {
      add_two_sided_edge(body, chain[i], chain[i + 1], source, made);
    }
  }
}

void check_colliders(const SceneryDef& as_run) {
  for (std::size_t i = 0; i < as_run.colliders.size(); ++i) {
    const std::vector<Vec2d>& points = as_run.colliders[i].points;
    const std::string name = "collider " + std::to_string(i);
    for (const Vec2d& point : points) (void)checked(point, name);
    if (as_run.colliders[i].shape == ColliderDef::Shape::circle) {
      if (!(static_cast<float>(as_run.colliders[i].radius) > 0))
        throw InvalidDefinition(name + " has no radius in Box2D's single precision");
      continue;
    }
    const Ring ring = without_repeats(points, true);
    const bool has_extent = std::any_of(ring.begin(), ring.end(),
                                        [&ring](const b2Vec2& vertex) { return long_enough(vertex, ring.front()); });
    if (!has_extent) throw InvalidDefinition(name + " is a single point in Box2D's single precision");
  }
}

}  // namespace

b2PolygonShape polygon_as_given(std::span<const b2Vec2> vertices) {
  b2PolygonShape shape;
  shape.m_count = static_cast<int32>(vertices.size());
  Vec2d weighted = Vec2d::Zero();
  const Vec2d origin = widened(vertices[0]);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    shape.m_vertices[i] = vertices[i];
    shape.m_normals[i] = right_normal(vertices[i], vertices[(i + 1) % vertices.size()]);
    const Vec2d a = widened(vertices[i]) - origin;
    const Vec2d b = widened(vertices[(i + 1) % vertices.size()]) - origin;
    weighted += (a.x() * b.y() - a.y() * b.x()) * (a + b);
  }
  shape.m_centroid = rounded(Vec2d(origin + weighted / (3 * twice_area(vertices))));
  return shape;
}

std::vector<Part> parts_of(const SceneryDef& as_run, std::size_t mover_count) {
  check_colliders(as_run);
  std::vector<Part> parts(mover_count + 1);
  for (MoverIndex mover = 0; mover < mover_count; ++mover) parts[mover + 1].mover = mover;
  for (ColliderIndex i = 0; i < as_run.colliders.size(); ++i) {
    const ColliderDef& collider = as_run.colliders[i];
    if (collider.sensor) continue;
    Part& part = parts[collider.mover == no_mover ? 0 : collider.mover + 1];
    const auto add = [&](const ColliderDef& solid) {
      part.solids.colliders.push_back(solid);
      part.colliders.push_back(i);
    };
    if (collider.shape == ColliderDef::Shape::chain || !collider.one_way) {
      add(collider);
      continue;
    }
    for (std::vector<Vec2d>& line : one_way_lines(collider)) {
      ColliderDef chain{.shape = ColliderDef::Shape::chain, .points = std::move(line), .one_way = collider.one_way};
      chain.mover = collider.mover;
      add(chain);
    }
  }
  return parts;
}

void add_solids(b2Body& body, const Scenery& scenery, const Part& part, SceneryMode mode, SceneryFixtures& made) {
  switch (mode) {
    case SceneryMode::chain_loops:
      add_loops(body, part, made);
      break;
    case SceneryMode::pieces:
      add_pieces(body, scenery, part, made);
      break;
  }
  for (std::size_t i = 0; i < part.colliders.size(); ++i) {
    const ColliderDef& collider = part.solids.colliders[i];
    const FixtureSource source{.collider = part.colliders[i], .mover = part.mover};
    if (collider.shape == ColliderDef::Shape::chain) add_chain(body, collider, source, made);
    if (collider.shape == ColliderDef::Shape::circle)
      add_circle(body, collider.points.front(), collider.radius, source, made);
  }
}

void add_sensors(std::span<b2Body* const> bodies, const Scenery& scenery, const SceneryDef& as_run,
                 SceneryFixtures& made) {
  for (PieceIndex i = 0; i < scenery.pieces().size(); ++i) {
    const PieceInfo& piece = scenery.pieces()[i];
    if (!piece.sensor) continue;
    const MoverIndex mover = as_run.colliders[piece.collider].mover;
    b2Body& body = *bodies[mover == no_mover ? 0 : mover + 1];
    const FixtureSource source{.collider = piece.collider, .mover = mover, .sensor = true};
    const PieceVertices vertices = scenery.vertices_of(i);
    if (piece.is_circle()) {
      const Circle circle = scenery.circle(i);
      add_circle(body, circle.centre, circle.radius, source, made);
    } else if (is_chain(piece)) {
      add_two_sided_edge(body, rounded(vertices[0]), rounded(vertices[1]), source, made);
    } else {
      add_polygon_piece(body, vertices, source, made);
    }
  }
}

}  // namespace paperproof::box2d
