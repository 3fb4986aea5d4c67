/// Answers to questions about the surroundings of a character, without a step.
#pragma once

#include "step/certificate.hpp"
#include "step/contact_geometry.hpp"
#include "step/octagon_sweep.hpp"
#include "step/one_way.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// The colliders around one character.
struct Surroundings : Around {
  const ConfigurationSpace& space;
  Nearby near;
};

/// Calls `look(piece, motion)` for the pieces that may be touched from positions in a box, with the motion of each.
template <class Look>
void for_each_around(Surroundings& around, const Box2& box, const Look& look) {
  around.near.for_each_group(box, Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
    const MoverMotion motion = around.moving.motion_of(mover);
    for (const PieceIndex piece : pieces) look(piece, motion);
  });
}

/// See `Controller::cast`.
[[nodiscard]] inline std::optional<Contact> cast(Surroundings& around, const Vec2& position, const Vec2& displacement) {
  const ConfigurationSpace& space = around.space;
  std::optional<Contact> first;
  const Box2 box = make_motion(space, position, displacement).box();
  around.near.for_each_group(box, Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex index) {
    const MoverMotion mover = around.moving.motion_of(index);
    const Vec2 seen = displacement - (mover.to - mover.from);
    const Motion motion = make_motion(space, Vec2(position - mover.from), seen, lost_by(position, mover.from));
    for (const PieceIndex piece : pieces) {
      if (kept_by_box(space, motion, piece) >= tolerances.hit || !blocks(space, motion, piece)) continue;
      const PieceHit hit = find_hit(space, motion, piece, around.up);
      if (!hit.hit) continue;
      const Real fraction = time_of_impact(space, motion.from, motion.displacement, piece, hit.axes);
      const Real up = around.up.up_of(space.normal(piece, hit.axes.normal));
      const bool later = first && (fraction > first->fraction ||
                                   (fraction == first->fraction && up <= around.up.up_of(first->normal)));
      if (later) continue;
      const Vec2 offset = mover.at(fraction);
      first = contact_with(space, around.up, piece, hit.axes.normal, Vec2(position + displacement * fraction - offset),
                           offset, fraction);
    }
  });
  return first;
}

/// See `Controller::overlaps`.
[[nodiscard]] inline std::size_t overlaps(Surroundings& around, const Vec2& position, std::span<ColliderIndex> found) {
  const ConfigurationSpace& space = around.space;
  std::size_t count = 0;
  ColliderIndex last = no_collider;
  for_each_around(around, {position, position}, [&](PieceIndex piece, const MoverMotion&) {
    const PieceInfo& info = space.info(piece).source;
    if (info.collider == last || info.one_way) return;  // the pieces of a collider are consecutive
    if (!overlaps_exactly(space, piece, around.moving.motions, position, Real(0))) return;
    last = info.collider;
    if (count < found.size()) found[count] = last;
    ++count;
  });
  return count;
}

/// Inserts a contact, nearest first. Of one surface the nearest contact stays. Without room the furthest is lost.
/// @param found not empty. @return the number of contacts.
[[nodiscard]] inline std::size_t insert_contact(const Contact& contact, std::span<Contact> found, std::size_t count) {
  std::size_t k = 0;
  while (k < count && !(found[k].collider == contact.collider && found[k].normal == contact.normal)) ++k;
  if (k == found.size()) --k;
  if (k < count && found[k].separation <= contact.separation) return count;
  count = std::max(count, k + 1);
  for (; k > 0 && found[k - 1].separation > contact.separation; --k) found[k] = found[k - 1];
  found[k] = contact;
  return count;
}

/// See `Controller::contacts_at`.
[[nodiscard]] inline std::size_t contacts_at(Surroundings& around, const Vec2& position, Real within,
                                             std::span<Contact> found) {
  const ConfigurationSpace& space = around.space;
  if (found.empty()) return 0;
  std::size_t count = 0;
  const Box2 box = Box2{position, position}.inflated(within);
  for_each_around(around, box, [&](PieceIndex piece, const MoverMotion& mover) {
    const Vec2 at = position - mover.from;
    const BestAxis best = best_axis(space, piece, at);
    if (best.separation > within) return;
    // No contact has the normal of a seam. From further away the side of one piece may hide that of another.
    if (std::abs(best.separation) <= tolerances.touch && space.covered(piece, best.axis)) return;
    if (space.info(piece).source.one_way && !is_above(space, piece, at, lost_by(position, mover.from))) return;
    const Contact contact = contact_with(space, around.up, piece, best.axis, at, mover.from, Real(0));
    count = insert_contact(contact, found, count);
  });
  return count;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
