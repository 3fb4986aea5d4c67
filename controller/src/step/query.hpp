/// What is around a character, without a step.
#pragma once

#include "step/neighbourhood.hpp"

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

/// See `Controller::cast`.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::optional<Contact<Scalar>> cast(Surroundings<Scalar>& around, const Vec2<Scalar>& position,
                                                  const Vec2<Scalar>& displacement) noexcept;

/// See `Controller::overlaps`.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::size_t overlaps(Surroundings<Scalar>& around, const Vec2<Scalar>& position,
                                   std::span<ColliderIndex> found) noexcept;

/// See `Controller::contacts_at`.
template <std::size_t Lanes, class Scalar>
[[nodiscard]] std::size_t contacts_at(Surroundings<Scalar>& around, const Vec2<Scalar>& position, Scalar within,
                                      std::span<Contact<Scalar>> found) noexcept;

}  // namespace paperproof::octagon_sweep
