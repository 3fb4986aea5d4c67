#include "runs/run.hpp"
