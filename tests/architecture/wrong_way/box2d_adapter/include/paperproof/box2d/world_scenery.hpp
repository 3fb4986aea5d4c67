#include <box2d/b2_math.h>
