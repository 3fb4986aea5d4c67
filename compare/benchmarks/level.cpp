#include "level.hpp"

#include "box2d_adapter/twin/src/fixtures.hpp"
#include "scenes/scene.hpp"

#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>

#include <algorithm>
#include <cmath>

namespace paperproof::benchmarks {
namespace {

constexpr int section_width = 16;    ///< [m]
constexpr int section_height = 24;   ///< From one storey to the next [m].
constexpr int tile_rows = 6;         ///< Rows of tiles.
constexpr int section_pieces = 108;  ///< 96 tiles of ground, 2 on a hill, 4 slopes and 6 platforms.
constexpr double half_of_a_character = 20.0 / 32;

ColliderDef rectangle(double left, double bottom, double width, double height) {
  return {.points = {{left, bottom}, {left + width, bottom}, {left + width, bottom + height}, {left, bottom + height}}};
}
/// @param top where it is a metre high: at its right end or at its left.
ColliderDef slope(double left, double bottom, double top) {
  return {.points = {{left, bottom}, {left + 1, bottom}, {top, bottom + 1}}};
}

/// The surface of the ground is at `y`.
void add_section(double x, double y, std::vector<ColliderDef>& colliders) {
  for (int row = 1; row <= tile_rows; ++row)
    for (int column = 0; column < section_width; ++column) colliders.push_back(rectangle(x + column, y - row, 1, 1));
  colliders.push_back(slope(x + 2, y, x + 3));
  colliders.push_back(rectangle(x + 3, y, 1, 1));
  colliders.push_back(rectangle(x + 4, y, 1, 1));
  colliders.push_back(slope(x + 5, y, x + 5));
  colliders.push_back(slope(x + 10, y, x + 11));
  colliders.push_back(slope(x + 11, y, x + 11));
  for (int i = 0; i < 6; ++i) colliders.push_back(rectangle(x + 5 * (i % 3), y + 3 + 2.5 * (i / 3) + i % 3, 3, 0.25));
}

}  // namespace

Vec2d Level::origin(int section) const {
  return {section % sections_per_storey * double{section_width},
          section / sections_per_storey * double{section_height}};
}

Vec2d Level::start(int section) const { return origin(section) + Vec2d(0.25, half_of_a_character + 0.02); }

Vec2d Level::start() const {
  const int storeys = (sections + sections_per_storey - 1) / sections_per_storey;
  return start(storeys / 2 * sections_per_storey + sections_per_storey / 2);
}

Level make_level(std::int64_t pieces) {
  Level level;
  level.sections = static_cast<int>((pieces + section_pieces - 1) / section_pieces);
  const int storeys = std::max(1, static_cast<int>(std::sqrt(level.sections * section_width / section_height)));
  level.sections_per_storey = (level.sections + storeys - 1) / storeys;
  for (int i = 0; i < level.sections; ++i)
    add_section(level.origin(i).x(), level.origin(i).y(), level.scenery.colliders);
  const double height = storeys * section_height;
  for (const double x : {-1.0, double(level.sections_per_storey) * section_width})
    level.scenery.colliders.push_back(rectangle(x, -tile_rows, 1, height));
  return level;
}

Level make_level_with_sensors(std::int64_t pieces, std::int64_t sensors) {
  Level level = make_level(pieces);
  for (std::int64_t i = 0; i < sensors; ++i) {
    const Vec2d corner = level.origin(static_cast<int>(i % level.sections));
    const auto place = static_cast<double>(i / level.sections);
    level.scenery.colliders.push_back(
        rectangle(corner.x() + std::fmod(place, section_width), corner.y() + std::floor(place / section_width), 1, 1));
    level.scenery.colliders.back().sensor = true;
  }
  return level;
}

std::unique_ptr<b2World> make_box2d_level(const Level& level) {
  auto world = std::make_unique<b2World>(b2Vec2(0, 0));
  const b2BodyDef definition;
  b2Body* const ground = world->CreateBody(&definition);
  for (const ColliderDef& collider : level.scenery.colliders) {
    std::vector<b2Vec2> vertices;
    for (const Vec2d& p : collider.points) vertices.push_back(box2d::rounded(p));
    b2PolygonShape shape;
    shape.Set(vertices.data(), static_cast<int32>(vertices.size()));
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.isSensor = collider.sensor;
    ground->CreateFixture(&fixture);
  }
  world->SetAllowSleeping(false);
  return world;
}

b2Body& add_box2d_character(b2World& world, const CharacterDef& character, const Vec2d& position) {
  const b2PolygonShape shape = box2d::character_polygon(character.shape.hull());
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  definition.position = box2d::rounded(position);
  definition.fixedRotation = definition.bullet = true;
  definition.allowSleep = false;
  b2Body& body = *world.CreateBody(&definition);
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.density = 1;
  fixture.friction = fixture.restitution = 0;
  fixture.filter.groupIndex = -1;
  body.CreateFixture(&fixture);
  return body;
}

std::vector<Input> random_walk(std::uint64_t seed, int steps) {
  const std::vector<compare::InputEvent> events = compare::random_input(seed, steps);
  std::vector<Input> inputs;
  for (int i = 0; i < steps; ++i) inputs.push_back(compare::input_at(events, i));
  return inputs;
}

}  // namespace paperproof::benchmarks
