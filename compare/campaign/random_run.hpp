/// A random run: a scene that a seed draws, and what happens in it beside what a scene can say.
#pragma once

#include "scenes/scene.hpp"

#include <paperproof/together.hpp>

#include <span>
#include <vector>

namespace paperproof::compare {

/// Before a step a character gets another velocity, and keeps all else.
struct Launch {
  int step = 0;
  CharacterIndex character = 0;
  Vec2d velocity{Vec2d::Zero()};  ///< [m/s]
};

struct RandomRun {
  Scene scene;
  std::vector<Launch> launches{};  ///< In order of steps.
  /// Which way is up, by step: unit vectors. Gravity turns along. Empty: +y in all of them.
  std::vector<Vec2d> ups{};
  Vec2d centre{Vec2d::Zero()};    ///< [m]
  double reach = 1e9;             ///< The run ends once a character is farther than this from `centre` in x or y [m].
  bool may_begin_inside = false;  ///< If not, a run that would is none.

  /// Those before a step.
  [[nodiscard]] std::span<const Launch> launches_before(int step) const;
};

/// What the players of a run do, noted as it is drawn.
class InputNotes {
 public:
  explicit InputNotes(std::vector<InputEvent>& events) : events_(&events) {}
  /// From this step on.
  void note(int step, const Input& input);

 private:
  std::vector<InputEvent>* events_;
  Input last_;
};

}  // namespace paperproof::compare
