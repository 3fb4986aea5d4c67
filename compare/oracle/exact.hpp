/// Exact answers about an octagon and solids, in rational arithmetic.
///
/// No geometry is shared with the controller. Overlap, passage and time of impact use the uncut outline, by other
/// algorithms than the controller's: a solid is overlapped where an edge of its boundary enters the open octagon
/// (Cyrus-Beck, strict) or the octagon lies wholly inside; a way is judged as the open hull of all its positions; the
/// time of impact is the earliest of all times at which a corner of one meets an edge of the other. Depth, separation,
/// near faces, room and ways out cut the outline into convex parts and look for separating axes, as the controller
/// does: there the code is independent, the method is not.
///
/// What goes along with a mover is judged in the frame of that mover, where the octagon makes the relative motion: a
/// sum of doubles and products of two, so it is exact as well.
///
/// Every decision is tried first in doubles that carry a rigorous bound of their own rounding errors, and is made in
/// unlimited integers (all doubles scaled by one power of two) where that bound leaves it open.
#pragma once

#include "oracle/fraction.hpp"

#include <paperproof/report.hpp>
#include <paperproof/scenery.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::compare {

/// A place of the octagon at a moment of a step: every mover is at from + fraction (to - from), unrounded. A position
/// alone stands for that position while every mover is at offset zero.
struct Place {
  Vec2d position;
  std::span<const MoverMotion> movers{};  ///< One for each mover, or none. Not copied.
  double fraction = 0;                    ///< Of the step, in [0, 1]; movers go on beyond 1 as before.

  template <class Derived>
  Place(const Eigen::MatrixBase<Derived>& at) : position(at) {}  // NOLINT(google-explicit-constructor): a place as well
  Place(double x, double y) : position(x, y) {}
  Place(const PathPoint& at, std::span<const MoverMotion> motions)
      : position(at.position), movers(motions), fraction(at.fraction) {}
  Place(const Vec2d& at, std::span<const MoverMotion> motions, double when)
      : position(at), movers(motions), fraction(when) {}

  /// Where a mover is, rounded.
  [[nodiscard]] Vec2d offset(MoverIndex mover) const;
};

/// When and where a translation first touches a collider on its way to overlapping it.
struct ExactImpact {
  ColliderIndex collider = 0;
  ExactFraction fraction;  ///< Of the way that was asked about, in [0, 1).
  /// Unit, from the obstacle towards the octagon, rounded. Where two facets meet at once it is the one more opposed to
  /// the motion.
  Vec2d normal{Vec2d::Zero()};
  Vec2d point{Vec2d::Zero()};  ///< On the obstacle at that moment, the middle of what touches, rounded.
  /// False where the normal is no side of the solids taken together: it belongs to an edge that an abutting collider
  /// covers all along the contact, or to a vertex that another collider passes on that side (a seam).
  bool exposed = true;
};

/// One side of a convex obstacle along which the octagon is apart from it.
struct NearFace {
  double separation = 0;        ///< Along the normal [m]; negative where they overlap.
  Vec2d normal{Vec2d::Zero()};  ///< Unit, from the obstacle towards the octagon, rounded.
};

/// A convex obstacle near the octagon: whatever moves against none of one face's normal keeps clear of it.
struct NearPart {
  ColliderIndex collider = 0;
  Vec2d moved{Vec2d::Zero()};   ///< By its mover in the whole step [m].
  std::vector<NearFace> faces;  ///< All along which they are apart, the farthest first; the best alone on overlap.
  double unsure = 0;            ///< So much farther than `moved` it may come along a normal [m]: of what turns,
  double unsure_along = 0;      ///< and so much farther it may go along the face.
  double rim = 0;               ///< So far the rim of a disc that turns goes along itself, counter-clockwise [m],
  double rim_unsure = 0;        ///< as far as that is known: the character goes round, and the centre on an arc [m].
};

/// The octagon's interior came to overlap a sensor's, or ceased to.
struct ExactSensorEvent {
  using Change = SensorEvent::Change;
  ColliderIndex sensor = 0;
  Change change = Change::enter;
  ExactFraction fraction;  ///< Of the step, in [0, 1].
};

/// Which straight ways to free places are asked for. What moves goes on meanwhile.
struct WayQuestion {
  Place from;
  Place end;  ///< The moment when the ways end. Its position does not matter.
  /// What the ways may pass, and only not end in.
  std::span<const ColliderIndex> may_pass{};
  /// What is on the far side of a collider, seen from a place, is no end.
  std::span<const std::pair<ColliderIndex, Place>> sides{};
  /// A shape around the octagon that the ways must be wide enough for, but beside what this shape overlaps where they
  /// begin. Empty: the octagon.
  std::span<const Vec2d> wider{};
};

/// The solids of one run with the exact questions that can be asked of them. The octagon at position p is the exact sum
/// of p and each point, unrounded. Sensors are no solids. Immutable after construction; may be shared between threads.
///
/// Wherever a place is asked for, it brings the motion of every mover of the scenery, or of none.
/// @throws std::invalid_argument from every question that brings fewer.
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
  [[nodiscard]] std::vector<ColliderIndex> overlapped(const Place& at) const;

  /// The colliders that the open octagon meets anywhere on the way from `from` to `to`, which is straight in the frame
  /// of every mover: so it is within a step, and from a place in one step to a place in a later one it is the shortest.
  /// A one-way segment counts where it blocks: for a way that begins above its surface. Chains of equal `one_way` that
  /// go along with one mover, or stand, are joined where one ends and one begins, and cut where they do not go on
  /// across `one_way`; the ends of each part are thought on straight. Above is an octagon whose open interior lies
  /// wholly on the `one_way` side of that line.
  [[nodiscard]] std::vector<ColliderIndex> met(const Place& from, const Place& to) const;

  /// Whether the open octagon meets `collider` anywhere on the straight way, as `met`.
  [[nodiscard]] bool meets(const Place& from, const Place& to, ColliderIndex collider) const;
  /// Whether the way meets nothing but some colliders, which are ascending.
  [[nodiscard]] bool meets_only(const Place& from, const Place& to, std::span<const ColliderIndex> colliders) const;
  /// Whether `collider` is overlapped, as `overlapped`.
  [[nodiscard]] bool overlaps(const Place& at, ColliderIndex collider) const;

  /// The first impact with `collider` when moving by `displacement` (unrounded) while its mover makes the motion of a
  /// whole step, beginning at the offset of `from`; or none. Where the octagon overlaps it at once the fraction is 0
  /// and the normal that of the shortest way out.
  [[nodiscard]] std::optional<ExactImpact> time_of_impact(const Place& from, const Vec2d& displacement,
                                                          ColliderIndex collider) const;
  /// The impacts with all colliders that the displacement meets, each as if it were alone; by index. A collider that is
  /// not convex may be met in several places (the two sides of a wedge): after its first impact follow those with each
  /// of its edges that are met, each as if it were alone.
  [[nodiscard]] std::vector<ExactImpact> impacts(const Place& from, const Vec2d& displacement) const;
  /// The same on the way from one place to another, as `met`; the fractions are of that way.
  [[nodiscard]] std::vector<ExactImpact> impacts_between(const Place& from, const Place& to) const;
  [[nodiscard]] std::optional<ExactImpact> impact_between(const Place& from, const Place& to,
                                                          ColliderIndex collider) const;
  /// The earliest impact over all colliders (ties: larger normal.y, then lower index).
  [[nodiscard]] std::optional<ExactImpact> first_impact(const Place& from, const Vec2d& displacement) const;

  /// How deep the octagon is in `collider` [m]: the largest, over its convex parts, of the shortest translation that
  /// frees the part. 0 where it does not overlap. Rounded from the exact value.
  [[nodiscard]] double penetration(const Place& at, ColliderIndex collider) const;

  /// Separation along the best axis [m], for the nearest part of `collider`; negative where it overlaps.
  [[nodiscard]] double separation(const Place& at, ColliderIndex collider) const;

  /// Colliders whose boxes come within `within` metres of the box of the octagon, wherever it is in the box of the two
  /// positions while they go from the one moment to the other.
  [[nodiscard]] std::vector<ColliderIndex> near(const Place& from, const Place& to, double within) const;

  /// The convex parts of solids whose best axis leaves no more than `within` metres, with the faces that separate.
  /// Polygons are cut into parts, chains are their segments, of which one-way ones count from both sides.
  [[nodiscard]] std::vector<NearPart> near_parts(const Place& at, double within) const;

  /// What happens to the sensors on a way, corner by corner, in order of time (ties: sensor, exit first). A sensor that
  /// is overlapped where the way begins was entered before.
  [[nodiscard]] std::vector<ExactSensorEvent> sensor_events(std::span<const Place> path) const;

  /// Where a straight way ends, not farther than `reach` from where it begins, that keeps at least `clearance` [m] from
  /// every solid at its end, along its best axis (exactly), and that `accept` takes; or none. It asks `accept` the
  /// nearest first. Where only what the question bars is in the way, it misses none but by rounding, and beside a
  /// circle: that counts as a polygon that encloses it and reaches 0.12 % of its radius beyond it.
  [[nodiscard]] std::optional<Vec2d> find_free(const WayQuestion& question, double reach, double clearance,
                                               const std::function<bool(const Vec2d&)>& accept) const;

  /// Where the shortest straight way out ends of all colliders that are `overlapped` at `at`; or none within `reach`
  /// [m], or where nothing is overlapped. Everything stays where it is at that moment. The way
  /// - meets no collider but those that are overlapped (a one-way segment where it blocks, as `met`), nor does it where
  ///   its end is 1e-6 m to either side: narrower openings count as closed;
  /// - ends with a clearance of at least 1e-7 m to every solid, along its best axis.
  /// Both are exact, so that a character that says "stuck" with such a way is refuted. That it is the shortest is not:
  /// of the places where it must be looked for, which are computed in doubles, it is the first that passes these
  /// checks.
  ///
  /// It looks near first: at what is within one size of the octagon, then within twice that, and so on, until a way is
  /// found, or everything within `reach`, or as far as the overlapped colliders reach, has been looked at. One round
  /// costs the facets of the overlapped colliders times the convex parts of all that may not be passed: 40 ms
  /// in a gear of 500 teeth. A character that is stuck mostly stays where it is: ask once for each place.
  [[nodiscard]] std::optional<Vec2d> way_out(const Place& at, double reach) const;

  [[nodiscard]] const SceneryDef& scenery() const noexcept;
  /// The hull of the character.
  [[nodiscard]] std::span<const Vec2d> points() const noexcept;

  /// How many decisions the floating-point filter could not make for certain and exact arithmetic had to.
  [[nodiscard]] std::uint64_t rational_decisions() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace paperproof::compare
