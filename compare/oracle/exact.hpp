/// Exact answers about an octagon and solids, in rational arithmetic.
///
/// No geometry is shared with the controller, and the algorithms differ on purpose: nothing is cut into convex pieces
/// and nothing is moved to configuration space. A solid is overlapped where an edge of its uncut boundary enters the
/// open octagon (Cyrus-Beck, strict) or the octagon lies wholly inside; a way is judged as the open hull of all its
/// positions; the time of impact is the earliest of all times at which a corner of one meets an edge of the other.
///
/// Every decision is tried first in doubles that carry a rigorous bound of their own rounding errors, and is made in
/// unlimited integers (all doubles scaled by one power of two) where that bound leaves it open.
#pragma once

#include <paperproof/scenery.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::compare {

using Rational = boost::multiprecision::cpp_rational;

/// When and where a translation first touches a collider on its way to overlapping it.
struct ExactImpact {
  ColliderIndex collider = 0;
  Rational fraction;  ///< in [0, 1)
  /// Unit, from the obstacle towards the octagon, rounded. Where two facets meet at once it is the one more opposed to
  /// the motion.
  Vec2d normal{Vec2d::Zero()};
  Vec2d point{Vec2d::Zero()};  ///< On the obstacle, the middle of what touches, rounded.
  /// False where the normal is no side of the solids taken together: it belongs to an edge that an abutting collider
  /// covers all along the contact, or to a vertex that another collider passes on that side (a seam).
  bool exposed = true;
};

/// The solids of one run with the exact questions that can be asked of them. The octagon at position p is the exact sum
/// of p and each point, unrounded. Immutable after construction; may be shared between threads.
class ExactScenery {
 public:
  /// @param scenery as run; every double is taken as the rational it is. Copied.
  /// @param points the hull of the character, in order, relative to its position.
  /// @throws std::invalid_argument for a character without area, with more than 16 points, or not convex.
  ExactScenery(const SceneryDef& scenery, std::vector<Vec2d> points);
  ~ExactScenery();
  ExactScenery(const ExactScenery&) = delete;
  ExactScenery& operator=(const ExactScenery&) = delete;

  /// The colliders whose interior (polygons) or line (two-sided chains) meets the octagon's open interior. One-way
  /// chains may be overlapped and are never listed.
  [[nodiscard]] std::vector<ColliderIndex> overlapped(const Vec2d& position) const;

  /// The colliders that the open octagon meets anywhere on the straight way from `from` to `to`. A one-way segment
  /// counts where it blocks: the whole octagon on the side of its normal at `from`, and motion against the normal.
  [[nodiscard]] std::vector<ColliderIndex> met(const Vec2d& from, const Vec2d& to) const;

  /// Whether the open octagon meets `collider` anywhere on the straight way, as `met`.
  [[nodiscard]] bool meets(const Vec2d& from, const Vec2d& to, ColliderIndex collider) const;
  /// Whether `collider` is overlapped, as `overlapped`.
  [[nodiscard]] bool overlaps(const Vec2d& position, ColliderIndex collider) const;

  /// The first impact with `collider` when moving from `position` by `displacement` (`from + displacement` unrounded),
  /// or none. Where the octagon overlaps it at once the fraction is 0 and the normal that of the shortest way out.
  [[nodiscard]] std::optional<ExactImpact> time_of_impact(const Vec2d& position, const Vec2d& displacement,
                                                          ColliderIndex collider) const;
  /// The impacts with all colliders that the displacement meets, each as if it were alone; by index. A collider that is
  /// not convex may be met in several places (the two sides of a wedge): after its first impact follow those with each
  /// of its edges that are met, each as if it were alone.
  [[nodiscard]] std::vector<ExactImpact> impacts(const Vec2d& position, const Vec2d& displacement) const;
  /// The earliest impact over all colliders (ties: larger normal.y, then lower index).
  [[nodiscard]] std::optional<ExactImpact> first_impact(const Vec2d& position, const Vec2d& displacement) const;

  /// How deep the octagon is in `collider` [m]: the largest, over its convex parts, of the shortest translation that
  /// frees the part. 0 where it does not overlap. Rounded from the exact value.
  [[nodiscard]] double penetration(const Vec2d& position, ColliderIndex collider) const;

  /// Separation along the best axis [m], for the nearest part of `collider`; negative where it overlaps.
  [[nodiscard]] double separation(const Vec2d& position, ColliderIndex collider) const;

  /// Colliders whose boxes come within `within` metres of the box of the octagon's way from `from` to `to`.
  [[nodiscard]] std::vector<ColliderIndex> near(const Vec2d& from, const Vec2d& to, double within) const;

  [[nodiscard]] const SceneryDef& scenery() const noexcept;

  /// How many decisions the floating-point filter could not make for certain and exact arithmetic had to.
  [[nodiscard]] std::uint64_t rational_decisions() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace paperproof::compare
