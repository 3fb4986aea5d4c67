/// Which metrics a scene can need.
#pragma once

#include <paperproof/types.hpp>

namespace paperproof::compare {

/// `false`: the metric is absent from the scene's rows, because nothing in the scene could ever give it a value other
/// than the trivial one. Metrics that appear only with their cause (contacts, one-way chains, crushes, sensors) need no
/// choice.
struct Measured {
  bool rest = true;              ///< Rest jitter and toggles: something can rest.
  bool respawns = true;          ///< A map is left and begun anew.
  Vec2d gravity{Vec2d::Zero()};  ///< Of the scene [m/s²]: energy is measured in its field.
};

}  // namespace paperproof::compare
