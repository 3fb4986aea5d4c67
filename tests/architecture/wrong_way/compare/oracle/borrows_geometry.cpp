#include "geometry.hpp"
#include <paperproof/techniques.hpp>
