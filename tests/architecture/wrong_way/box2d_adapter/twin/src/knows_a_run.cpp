#include "runs/run.hpp"
#include <paperproof/box2d/reference_world.hpp>
#include <polyclipping/clipper.hpp>
