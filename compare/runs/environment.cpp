#include "runs/environment.hpp"

#include "runs/build_info.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <fmt/format.h>
#include <Eigen/Core>
#include <boost/version.hpp>

#include <fstream>

namespace paperproof::compare {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const std::size_t colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown";
}

}  // namespace

Environment environment() {
  return {{"paperproof", build_info.version},
          {"box2d", box2d::box2d_version()},
          {"box2d_build", box2d::box2d_build()},
          {"box2d_asserts", box2d::box2d_asserts()},
          {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"boost", BOOST_LIB_VERSION},
          {"compiler", build_info.compiler},
          {"flags", build_info.flags},
          {"cpu", processor()},
          {"build", build_info.build_type}};
}

}  // namespace paperproof::compare
