#include "scenes/scene.hpp"
#include "geometry.hpp"
