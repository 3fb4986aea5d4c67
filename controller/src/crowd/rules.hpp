/// What a crowd knows before the first step.
#pragma once

#include "crowd/pair_space.hpp"
#include "step/octagon_sweep.hpp"

#include <paperproof/plan.hpp>

namespace paperproof::crowd {

template <class Scalar>
struct CrowdRules {
  PairSpace<Scalar> space;
  Scalar walkable_cosine;  ///< Least upward component of a normal that is stood on.
  int most_impacts;        ///< Of one character in one step before it gives up its own motion; after twice as many it
                           ///< stays.
  Stages stages;           ///< What was not left out.
  const octagon_sweep::SweepInParts<Scalar>* sweep;  ///< Null for a joint technique.
};

}  // namespace paperproof::crowd
