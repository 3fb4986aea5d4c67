#include "studies/prepared_sweeps.hpp"

namespace paperproof::compare {

const std::vector<PreparedSweep>& prepared_sweeps() {
  static const std::vector<PreparedSweep> all{
      {"corner",
       "Falls into wedges from 60 to 1 degrees: who ends inside",
       "wedge",
       {"angle=1:60:log8", "dt=0.016666666666666666"},
       {"angle=1:60:log30", "dt=0.004166666666666667,0.008333333333333333,0.016666666666666666,0.03333333333333333"},
       {"angle=1:120:log120", "dt=0.001:0.1:log12"}},
      {"seam",
       "Walks over flush tiles at many speeds: who snags at their seams",
       "tiles",
       {"speed=0.5:12:lin12"},
       {"speed=0.12:12:lin100"},
       {"speed=0.012:12:lin1000"}},
      {"squeeze",
       "Falls down shafts as wide as the character and a little more: who gets stuck or inside",
       "shaft",
       {"clearance=0,1e-9,1e-6,1e-3,0.05", "dt=0.016666666666666666"},
       {"clearance=0,1e-12,1e-9,2e-7,1e-6,1e-5,1e-4,1e-3,0.01,0.02,0.05", "dt=0.001:0.1:log7"},
       {"clearance=1e-9:0.1:log60", "dt=0.0001:0.1:log16"}}};
  return all;
}

}  // namespace paperproof::compare
