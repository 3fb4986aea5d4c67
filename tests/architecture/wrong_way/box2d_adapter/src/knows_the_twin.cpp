#include <paperproof/box2d/world_scenery.hpp>
#include <paperproof/box2d/reference_world.hpp>
#include <polyclipping/clipper.hpp>
