/// What this adapter throws.
#pragma once

#include <stdexcept>

namespace paperproof::box2d {

/// A definition that Box2D must not see: it would abort, or build something else.
class InvalidDefinition : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace paperproof::box2d
