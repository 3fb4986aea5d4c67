/// Boxes and other bodies for the discrete solver.
#pragma once

#include "controller/article_support.hpp"
#include "techniques/discrete/solver.hpp"

#include <deque>
#include <vector>

namespace paperproof::article_tests {

/// Bodies, and the outlines that they refer to.
template <class Scalar>
class Bodies {
 public:
  using Body = discrete::Body<Scalar>;

  Body& add(std::vector<Vec2<Scalar>> outline, const Vec2<Scalar>& position, const Vec2<Scalar>& movement = {0, 0}) {
    outlines_.push_back(std::move(outline));
    Body body;
    body.outline = std::span<const Vec2<Scalar>>(outlines_.back());
    body.box = {outlines_.back().front(), outlines_.back().front()};
    for (const Vec2<Scalar>& vertex : outlines_.back()) body.box = body.box.merged({vertex, vertex});
    body.position = position;
    body.movement = movement;
    body.velocity = movement;
    all.push_back(body);
    return all.back();
  }

  /// A box by its centre.
  Body& add_box(const Vec2<Scalar>& size, const Vec2<Scalar>& position, const Vec2<Scalar>& movement = {0, 0}) {
    const Scalar x = size.x() / 2;
    const Scalar y = size.y() / 2;
    return add({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, position, movement);
  }

  Body& add_static_box(const Vec2<Scalar>& size, const Vec2<Scalar>& position) {
    Body& body = add_box(size, position);
    body.inverse_mass = 0;
    return body;
  }

  std::vector<Body> all;

 private:
  std::deque<std::vector<Vec2<Scalar>>> outlines_;  // their addresses stay
};

inline discrete::Solver<double> make_solver() { return {Tolerances<double>{}.stop, Tolerances<double>{}.touch}; }

}  // namespace paperproof::article_tests
