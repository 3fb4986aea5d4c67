/// Answers to questions about the surroundings of a character, without a step.
#pragma once

#include "step/certificate.hpp"
#include "step/contact_geometry.hpp"
#include "step/neighbourhood.hpp"
#include "step/one_way.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace paperproof::octagon_sweep {

/// The colliders around one character. Movers that a filter leaves out are left out here.
template <class Scalar>
struct Surroundings {
  const ConfigurationSpace<Scalar>& space;
  Neighbourhood<Scalar> neighbourhood;
  const MoverPhases<Scalar>& phases;
  std::span<const MoverMotion<Scalar>> movers;  ///< One for each mover.
  const ColliderFilter* filter;                 ///< Null: all colliders are there.
  UpFrame<Scalar> up;                           ///< See `StepContext::up`.
};

template <class Scalar>
[[nodiscard]] Contact<Scalar> contact_with(const Surroundings<Scalar>& around, PieceIndex piece, std::size_t axis,
                                           const Vec2<Scalar>& position, const Vec2<Scalar>& offset,
                                           Scalar fraction) noexcept {
  const ConfigurationSpace<Scalar>& space = around.space;
  const Vec2<Scalar> normal = space.normal(piece, axis);
  const ContactPlace<Scalar> place = contact_place(space, piece, axis, normal, Vec2<Scalar>(position - offset));
  return {.collider = space.scenery().pieces()[piece].collider,
          .point = place.point + offset,
          .normal = normal,
          .fraction = fraction,
          .separation = place.separation,
          .side = around.up.side_of(normal)};
}

/// Calls `look(piece, motion)` for the pieces that may be touched from positions in a box, with the motion of each.
/// @param box_of is asked before the pieces of one motion are looked at: for the positions relative to them.
template <class Scalar, class BoxOf, class Look>
void for_each_around(Surroundings<Scalar>& around, const BoxOf& box_of, const Look& look) noexcept {
  const MoverMotion<Scalar> stands{};
  for (const PieceIndex piece : around.neighbourhood.around(box_of(stands))) look(piece, stands);
  const Scenery<Scalar>& scenery = around.space.scenery();
  for (MoverIndex mover = 0; mover < around.phases.size(); ++mover) {
    const MoverMotion<Scalar>& motion = around.movers[mover];
    const Box2<Scalar> box = around.space.touched_from(box_of(motion));
    if (!box.overlaps(around.phases.whole(mover))) continue;
    for (const PieceIndex piece : around.phases.query(mover, box, around.neighbourhood.memory().of_mover))
      if (around.filter == nullptr || (*around.filter)(scenery, scenery.pieces()[piece].collider)) look(piece, motion);
  }
}

/// See `Controller::cast`.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::optional<Contact<Scalar>> cast(Surroundings<Scalar>& around, const Vec2<Scalar>& position,
                                                  const Vec2<Scalar>& displacement) noexcept {
  const ConfigurationSpace<Scalar>& space = around.space;
  const auto motion_seen_by = [&](const MoverMotion<Scalar>& mover) {
    Motion<Lanes, Scalar> seen = make_motion<Lanes>(space, Vec2<Scalar>(position - mover.from),
                                                    Vec2<Scalar>(displacement - (mover.to - mover.from)));
    seen.lost = lost_by(position, mover.from);
    return seen;
  };
  std::optional<Contact<Scalar>> first;
  Motion<Lanes, Scalar> motion;
  for_each_around(
      around,
      [&](const MoverMotion<Scalar>& mover) {
        motion = motion_seen_by(mover);
        return motion.box();
      },
      [&](PieceIndex piece, const MoverMotion<Scalar>& mover) {
        if (kept_by_box(space, motion, piece) >= Tolerances<Scalar>{}.hit || !blocks(space, motion, piece)) return;
        const Clearance<Scalar> clear = clearance(space, motion, piece);
        if (clear.clear()) return;
        const PieceHit<Scalar> hit = sweep_piece(space, motion, piece, clear, around.up);
        if (!hit.hit) return;
        const Scalar fraction = time_of_impact(space, motion.from, motion.displacement, piece, hit.axes);
        const Scalar up = around.up.up_of(space.normal(piece, hit.axes.normal));
        if (first &&
            (fraction > first->fraction || (fraction == first->fraction && up <= around.up.up_of(first->normal))))
          return;
        first = contact_with(around, piece, hit.axes.normal, Vec2<Scalar>(position + displacement * fraction),
                             mover.at(fraction), fraction);
      });
  return first;
}

/// See `Controller::overlaps`.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::size_t overlaps(Surroundings<Scalar>& around, const Vec2<Scalar>& position,
                                   std::span<ColliderIndex> found) noexcept {
  const ConfigurationSpace<Scalar>& space = around.space;
  std::size_t count = 0;
  ColliderIndex last = no_collider;
  for_each_around(
      around,
      [&](const MoverMotion<Scalar>& mover) {
        const Vec2<Scalar> at = position - mover.from;
        return Box2<Scalar>{at, at};
      },
      [&](PieceIndex piece, const MoverMotion<Scalar>& mover) {
        const PieceInfo& info = space.scenery().pieces()[piece];
        if (info.collider == last || info.one_way) return;  // the pieces of a collider are consecutive
        const Vec2<Scalar> at = position - mover.from;
        if (best_axis<Lanes>(space, piece, at).separation >= Tolerances<Scalar>{}.certain) return;
        const bool inside = info.mover == no_mover
                                ? overlaps_exactly(space, piece, at)
                                : overlaps_exactly(space, piece, ExactPosition(position, mover, Scalar(0)));
        if (!inside) return;
        last = info.collider;
        if (count < found.size()) found[count] = last;
        ++count;
      });
  return count;
}

/// Inserts a contact, nearest first. Of one surface the nearest contact stays. Without room the furthest is lost.
/// @param found not empty. @return the number of contacts.
template <class Scalar>
[[nodiscard]] std::size_t insert_contact(const Contact<Scalar>& contact, std::span<Contact<Scalar>> found,
                                         std::size_t count) noexcept {
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
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::size_t contacts_at(Surroundings<Scalar>& around, const Vec2<Scalar>& position, Scalar within,
                                      std::span<Contact<Scalar>> found) noexcept {
  const ConfigurationSpace<Scalar>& space = around.space;
  if (found.empty()) return 0;
  std::size_t count = 0;
  for_each_around(
      around,
      [&](const MoverMotion<Scalar>& mover) {
        const Vec2<Scalar> at = position - mover.from;
        return Box2<Scalar>{at, at}.inflated(within);
      },
      [&](PieceIndex piece, const MoverMotion<Scalar>& mover) {
        const Vec2<Scalar> at = position - mover.from;
        const BestAxis<Scalar> best = best_axis<Lanes>(space, piece, at);
        if (best.separation > within) return;
        // No contact has the normal of a seam. From further away the side of one piece may hide that of another.
        if (std::abs(best.separation) <= Tolerances<Scalar>{}.touch && space.covered(piece, best.axis)) return;
        if (space.scenery().pieces()[piece].one_way && !is_above(space, piece, at, lost_by(position, mover.from)))
          return;
        const Contact<Scalar> contact = contact_with(around, piece, best.axis, position, mover.from, Scalar(0));
        count = insert_contact(contact, found, count);
      });
  return count;
}

}  // namespace paperproof::octagon_sweep
