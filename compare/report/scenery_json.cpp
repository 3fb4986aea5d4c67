#include "report/scenery_json.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace paperproof::compare {
namespace {

std::string ring_json(const std::vector<Vec2d>& points, DisplayPoint last, const Quantum& quantum) {
  JsonArray ring;
  for (const Vec2d& point : points) {
    const DisplayPoint cell = quantum.round(point);
    ring.add(cell.x - last.x).add(cell.y - last.y);
    last = cell;
  }
  return std::move(ring).take();
}

std::string shape_json(const ColliderDef& collider, DisplayPoint origin, const Quantum& quantum) {
  JsonArray rings;
  rings.add_raw(ring_json(drawn_outline(collider), origin, quantum));
  for (const std::vector<Vec2d>& hole : collider.holes) rings.add_raw(ring_json(hole, origin, quantum));
  JsonArray shape;
  shape.add(collider.shape == ColliderDef::Shape::chain ? 1 : 0).add_raw(std::move(rings).take());
  if (collider.one_way) {
    JsonArray normal;
    normal.add_short(collider.one_way->x()).add_short(collider.one_way->y());
    shape.add_raw(std::move(normal).take());
  }
  return std::move(shape).take();
}

/// A number for each collider, as (number, how many in a row).
class Order {
 public:
  void add(std::int64_t number) {
    if (count_ > 0 && number == number_) {
      ++count_;
      return;
    }
    flush();
    number_ = number;
    count_ = 1;
  }
  [[nodiscard]] std::string take() && {
    flush();
    return std::move(list_).take();
  }

 private:
  void flush() {
    if (count_ > 0) list_.add(number_).add(count_);
  }
  JsonArray list_;
  std::int64_t number_ = 0;
  std::int64_t count_ = 0;
};

std::string ids_json(const std::vector<std::string>& ids, const std::set<ColliderIndex>& named) {
  JsonObject object;
  for (const ColliderIndex collider : named) {
    if (collider < ids.size()) object.put(std::to_string(collider), json_string(ids[collider]));
  }
  return std::move(object).take();
}

/// Tiles stand on a lattice: with its unit taken out, most differences are one digit.
std::string places_json(const std::vector<DisplayPoint>& steps, std::int64_t unit) {
  JsonArray at;
  for (const DisplayPoint& step : steps) at.add(step.x / unit).add(step.y / unit);
  return std::move(at).take();
}

std::int64_t lattice_unit(const std::vector<DisplayPoint>& steps) {
  std::int64_t unit = 0;
  for (const DisplayPoint& step : steps) unit = std::gcd(unit, std::gcd(step.x, step.y));
  return unit == 0 ? 1 : unit;
}

}  // namespace

std::vector<Vec2d> drawn_outline(const ColliderDef& collider) {
  constexpr int corners = 64;
  if (collider.shape != ColliderDef::Shape::circle) return collider.points;
  std::vector<Vec2d> outline;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    outline.emplace_back(collider.points.front() + collider.radius * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

std::string scenery_json(const SceneryDef& scenery, const std::vector<std::string>& ids,
                         const std::set<ColliderIndex>& named, const Quantum& quantum) {
  std::map<std::string, std::int64_t> known;
  JsonArray shapes;
  Order order;
  Order movers;
  JsonArray sensors;
  std::vector<DisplayPoint> steps;
  DisplayPoint last;
  for (const ColliderDef& collider : scenery.colliders) {
    const DisplayPoint origin = collider.points.empty() ? last : quantum.round(collider.points.front());
    const std::string shape = shape_json(collider, origin, quantum);
    const auto [entry, is_new] = known.try_emplace(shape, static_cast<std::int64_t>(known.size()));
    if (is_new) shapes.add_raw(shape);
    order.add(entry->second);
    movers.add(collider.mover == no_mover ? 0 : std::int64_t{collider.mover} + 1);
    if (collider.sensor) sensors.add(static_cast<std::int64_t>(&collider - scenery.colliders.data()));
    steps.push_back({origin.x - last.x, origin.y - last.y});
    last = origin;
  }
  const std::int64_t unit = lattice_unit(steps);
  JsonObject object;
  object.put("shapes", std::move(shapes).take()).put("order", std::move(order).take());
  object.put("unit", unit).put("at", places_json(steps, unit)).put("ids", ids_json(ids, named));
  const auto any = [&scenery](const auto& is) {
    return std::any_of(scenery.colliders.begin(), scenery.colliders.end(), is);
  };
  if (any([](const ColliderDef& c) { return c.mover != no_mover; })) object.put("movers", std::move(movers).take());
  if (any([](const ColliderDef& c) { return c.sensor; })) object.put("sensors", std::move(sensors).take());
  return std::move(object).take();
}

}  // namespace paperproof::compare
