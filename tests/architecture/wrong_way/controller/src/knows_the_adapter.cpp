#include <paperproof/box2d/reference_world.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>
