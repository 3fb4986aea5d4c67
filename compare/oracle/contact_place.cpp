#include "oracle/contact_place.hpp"

#include "oracle/exemptions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::compare {
namespace {

/// How far a point may be from what it is on [m]: §6 of the guarantee knows no smaller length.
constexpr double beside_face = 1e-6;
/// What a separation that was computed in another order is off [m], beside a few ulps of the coordinates.
constexpr double rounding_of_separation = 1e-8;

double distance(const Vec2d& point, const Vec2d& a, const Vec2d& b) {
  const Vec2d along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0;
  return (point - a - share * along).norm();
}

double distance_from_line(const Vec2d& point, const std::vector<Vec2d>& line, bool closed) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + (closed ? 0 : 1) < line.size(); ++k)
    least = std::min(least, distance(point, line[k], line[(k + 1) % line.size()]));
  return least;
}

/// @param point while the offset of the collider's mover is zero.
double distance_from_outline(const Vec2d& point, const ColliderDef& def) {
  if (def.shape == ColliderDef::Shape::circle) return std::abs((point - def.points.front()).norm() - def.radius);
  double least = distance_from_line(point, def.points, def.shape == ColliderDef::Shape::polygon);
  for (const std::vector<Vec2d>& hole : def.holes) least = std::min(least, distance_from_line(point, hole, true));
  return least;
}

/// The face of the character, relative to its position, that looks farthest against a normal.
struct Face {
  double below = std::numeric_limits<double>::infinity();  ///< Along the normal [m].
  double left = std::numeric_limits<double>::infinity();   ///< Across the normal, where it begins and ends [m].
  double right = -std::numeric_limits<double>::infinity();
};

Face face_against(const Vec2d& normal, const std::vector<Vec2d>& hull) {
  Face face;
  for (const Vec2d& corner : hull) face.below = std::min(face.below, normal.dot(corner));
  for (const Vec2d& corner : hull) {
    if (normal.dot(corner) > face.below + beside_face) continue;
    const double across = corner.dot(Vec2d(normal.y(), -normal.x()));
    face.left = std::min(face.left, across);
    face.right = std::max(face.right, across);
  }
  return face;
}

}  // namespace

std::optional<PlaceFault> place_fault(const TraceHeader& header, const TraceStep& step, const Contact& contact) {
  const ColliderDef& def = header.scenery.colliders[contact.collider];
  const Vec2d across(contact.normal.y(), -contact.normal.x());
  const Face face = face_against(contact.normal, header.points);
  bool on_both = false;
  for (const PathPoint& at : step.path) {
    const Vec2d offset = Place(at, step.movers).offset(def.mover);
    if (!(distance_from_outline(contact.point - offset, def) <= beside_face)) continue;
    const Vec2d from = contact.point - at.position;
    const double side = from.dot(across);
    const double gap = face.below - from.dot(contact.normal);
    const bool on_face =
        side >= face.left - beside_face && side <= face.right + beside_face && std::abs(gap) <= 2 * beside_face;
    on_both = on_both || on_face;
    const double rounding = rounding_of_separation + 16 * ulp_at(header, at.position) + 16 * ulp_at(header, offset);
    if (on_face && std::abs(gap - contact.separation) <= rounding) return std::nullopt;
  }
  const std::string whom = "`" + header.ids[contact.collider] + "`";
  if (on_both) return PlaceFault{Clause::gap, "is as far from " + whom + " as a contact says at no corner of its way"};
  return PlaceFault{Clause::contact_invented, "has a contact with " + whom + " in a point where they do not touch"};
}

}  // namespace paperproof::compare
