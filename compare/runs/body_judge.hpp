/// Judges the dynamic bodies of a scene like characters: what Box2D pushes through a floor is a finding of Box2D.
#pragma once

#include "oracle/judge.hpp"
#include "records/row.hpp"
#include "runs/body_energy.hpp"
#include "scenes/scene.hpp"

#include <memory>

namespace paperproof::compare {

/// Each convex part of a body is judged as a character that goes along with its mover, among everything else that
/// stands or moves. Feed it every step of one run in order. Not thread-safe.
class BodyJudge {
 public:
  /// @param scene must outlive this. @param header of a run in which Box2D moves the bodies.
  BodyJudge(const Scene& scene, const TraceHeader& header);
  [[nodiscard]] bool any() const noexcept { return !bodies_.empty(); }
  void add(const TraceStep& step);
  /// Numbers and faults.
  void write(Row& row) const;

 private:
  struct Body {
    MoverIndex mover = 0;
    std::string id;
    std::unique_ptr<Judge> judge;
  };
  std::vector<std::string> ids_;
  std::vector<Body> bodies_;
  BodyEnergy energy_;
  int steps_inside_ = 0;
  int tunnels_ = 0;
  double deepest_ = 0;
  std::string first_tunnel_;  ///< In words; empty where there is none.
};

}  // namespace paperproof::compare
