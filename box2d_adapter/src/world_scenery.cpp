#include <paperproof/box2d/world_scenery.hpp>

#include "shapes.hpp"

#include <box2d/b2_body.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace paperproof::box2d {
namespace {

/// Box2D puts new bodies and fixtures in front of its lists.
template <class Node>
std::vector<Node*> in_order_of_creation(Node* newest) {
  std::vector<Node*> nodes;
  for (Node* node = newest; node != nullptr; node = node->GetNext()) nodes.push_back(node);
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

bool is_solid(const b2Fixture& fixture) { return !fixture.IsSensor(); }

}  // namespace

Filter filter_of(const b2Fixture& fixture) noexcept {
  const b2Filter& bits = fixture.GetFilterData();
  Filter filter{.category = bits.categoryBits, .mask = bits.maskBits, .group = bits.groupIndex};
  if (bits.maskBits == b2Filter().maskBits) filter.mask = Filter{}.mask;  // all kinds
  return filter;
}

WorldScenery scenery_of(b2World& world, const WorldSceneryDef& def) {
  const auto& wanted = def.filter ? def.filter : is_solid;
  WorldScenery result;
  for (b2Body* body : in_order_of_creation(world.GetBodyList())) {
    if (!body->IsEnabled() || body->GetType() != b2_staticBody) continue;
    for (b2Fixture* fixture : in_order_of_creation(body->GetFixtureList())) {
      if (!wanted(*fixture)) continue;
      ColliderDef collider = collider_of(*fixture->GetShape(), body->GetTransform());
      collider.sensor = fixture->IsSensor();
      collider.filter = filter_of(*fixture);
      result.scenery.colliders.push_back(std::move(collider));
      result.fixtures.push_back(fixture);
    }
  }
  return result;
}

}  // namespace paperproof::box2d
