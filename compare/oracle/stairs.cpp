#include "oracle/stairs.hpp"

#include "oracle/contacts.hpp"
#include "oracle/met_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace paperproof::compare::detail {
namespace {

/// Ways to ground pass it by this, on both sides [m].
constexpr double passes_by = 2 * contact_reach;

/// Of the points of the octagon the one that reaches farthest.
Vec2d farthest(std::span<const Vec2d> points, const Vec2d& direction) {
  return *std::ranges::max_element(points, {}, [&](const Vec2d& point) { return point.dot(direction); });
}

/// Whether ways in no time, one after another, are free, and the next one, straight down, ends at walkable ground.
bool leads_to_ground(const StepView& step, Place at, std::initializer_list<Vec2d> legs, double down) {
  for (const Vec2d& leg : legs) {
    Place next = at;
    next.position += leg;
    if (!step.scenery.met(at, next).empty()) return false;
    at = next;
  }
  Place below = at;
  below.position -= down * step.up;
  const std::vector<ExactImpact> impacts = step.scenery.impacts_between(at, below);
  const auto first = std::ranges::min_element(impacts, {}, &ExactImpact::fraction);
  return first != impacts.end() && is_walked_on(first->normal, step.header, step.up);
}

}  // namespace

bool is_stair(const StepView& step, const Vec2d& carried, const Place& at, const NearPart& part) {
  const Vec2d& up = step.up;
  const CharacterDef& character = step.header.character;
  if (character.snap == 0 && character.step_height == 0) return false;
  const ColliderDef& collider = step.solid(part.collider);
  const Vec2d offset = at.offset(collider.mover);
  const std::span<const Vec2d> points = step.scenery.points();
  const double risen = (at.position - step.step.path.front().position - carried * at.fraction).dot(up);
  const double climb = character.max_climb_degrees * std::numbers::pi / 180;
  return std::ranges::any_of(part.faces, [&](const NearFace& face) {
    if (!(face.normal.dot(up) > 0) || is_walked_on(face.normal, step.header, up)) return false;
    const double side = std::copysign(1.0, -face.normal.dot(step.right));
    const Vec2d ahead = side * step.right;
    const Vec2d steepest = std::cos(climb) * up - std::sin(climb) * ahead;
    // The part of the collider that it touches, from its lowest point to its highest.
    const Vec2d rests_at = farthest(points, -face.normal) + at.position - offset;
    std::optional<Vec2d> low;
    double high = -HUGE_VAL;
    for (const Vec2d& vertex : collider.points) {
      const Vec2d point = vertex + collider.radius * face.normal;
      if (std::abs(face.normal.dot(rests_at - point) - face.separation) > guaranteed_touch) continue;
      if (!low || point.dot(up) < low->dot(up)) low = point;
      high = std::max(high, point.dot(up));
    }
    if (!low) return false;
    const double height = high - low->dot(up);
    const auto leads_up = [&](const Vec2d& vertex) {
      const Vec2d foothold = offset + vertex + collider.radius * steepest - farthest(points, -steepest);
      const double up_by = (foothold - at.position).dot(up);
      const double over = (foothold - at.position).dot(ahead);
      return up_by + std::max(risen, 0.0) <= character.step_height + contact_reach && over > -contact_reach &&
             over * std::tan(climb) <= up_by + passes_by &&
             leads_to_ground(step, at, {(up_by + 2 * passes_by) * up, (over + passes_by) * ahead}, 4 * passes_by);
    };
    if (character.step_height > 0 && height <= character.step_height && std::ranges::any_of(collider.points, leads_up))
      return true;
    const double down = character.snap + std::min(risen, 0.0);
    const double back = (at.position + farthest(points, ahead) - offset - *low).dot(ahead);
    return character.snap > 0 && risen <= contact_reach && height <= character.snap && down > 0 &&
           leads_to_ground(step, at, {-(back + passes_by) * ahead}, down + contact_reach);
  });
}

}  // namespace paperproof::compare::detail
