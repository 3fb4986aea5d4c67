#include "studies/stability.hpp"

#include <array>
#include <utility>

namespace paperproof::compare {
namespace {

struct Region {
  const char* name;
  const char* question;
  const char* scene;
  std::vector<const char*> axes;
};

const std::vector<Region>& regions() {
  static const std::vector<Region> all{
      {"origin and speed",
       "Paper of 1 cm, far from the origin, hit fast.",
       "paper",
       {"origin=0,1e3,1e4,1e5,1e6,1.9e6", "speed=10,100,1e3,1e4,1e5"}},
      {"far origin and step",
       "Walk, wall and jump, far from the origin: in float a step may be less than what can be told apart there.",
       "far",
       {"origin=16,1e3,1e4,1e5,1e6", "dt=1e-3,0.008333333333333333,0.016666666666666666"}},
      {"gravity and step",
       "A drop of 0.25 m that has to come to rest.",
       "drop",
       {"gravity=10,100,1e3,1e4,1e5,1e6", "dt=1e-4,1e-3,0.01,0.1,1"}},
      {"scale and thickness",
       "Paper in other sizes of the world: the character is as large as the scale says.",
       "paper",
       {"scale=1e-4,1e-2,1,1e2,1e4", "thickness=0,1e-6,1e-3,0.1"}},
      {"speed and thickness",
       "Paper of any thickness at any speed.",
       "paper",
       {"speed=10,30,100,300,1e3,1e4,1e5", "thickness=0,1e-6,1e-3,1e-2,0.1,1"}},
      {"mass ratio and step",
       "A heavy box on four light ones, and the character on top.",
       "stack",
       {"mass_ratio=1,10,100,1e3,1e4", "dt=0.0041666666666666666,0.016666666666666666,0.03333333333333333"}},
      {"wedge and step",
       "A fall into a V.",
       "wedge",
       {"angle=60,30,10,5,2,1", "dt=1e-3,0.01,0.016666666666666666,0.1"}},
      {"slope and step",
       "A character on a slope: it stands up to its climb limit of 50 degrees, and slides down beyond it.",
       "ramp",
       {"angle=10,49,51,70,85,89,89.9", "dt=1e-3,0.016666666666666666,0.1"}},
      {"clearance and step",
       "A fall down a shaft that fits.",
       "shaft",
       {"clearance=0,1e-9,1e-6,1e-3,0.05", "dt=1e-3,0.016666666666666666,0.1"}},
      {"perturbed start",
       "Walk, jump and wall, begun a little aside: the same sequence of events.",
       "replica_of",
       {"aside=0,1e-12,1e-9,1e-6,1e-3", "dt=0.016666666666666666"}},
  };
  return all;
}

}  // namespace

std::vector<StabilityRegion> stability_regions(const std::vector<std::string>& contenders) {
  std::vector<StabilityRegion> made;
  for (const Region& region : regions()) {
    Sweep sweep;
    sweep.scene = region.scene;
    for (const char* axis : region.axes) sweep.axes.push_back(parse_axis(axis));
    sweep.contenders = contenders.empty() ? std::vector<std::string>{"octagon_sweep", "box2d"} : contenders;
    sweep.scalars = {"double", "float"};
    made.push_back({region.name, region.question, std::move(sweep)});
  }
  return made;
}

}  // namespace paperproof::compare
