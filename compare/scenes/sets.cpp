#include "scenes/sets.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace paperproof::compare {

const std::vector<SceneSet>& scene_sets() {
  // Each technique of the article has a scene here that it is made for, and one that shows what it misses.
  static const std::vector<SceneSet> all = [] {
    std::istringstream gallery(
        "article_bullet article_bullet_slow article_bullet_fast thin_platform paper_1e-1 paper_1e-3 "
        "zero_thickness_paper gravity_10 flush_tiles flush_tiles_slide slope_joints slope_joints_no_snap "
        "skier spike_between_feet sloped_paper_walk sliver_drop ledge_hang false_ceiling jump_into_wall "
        "jump_into_overhang jump_into_corner stuck_points concave_corner wedge_60 parallel_pass grazing_wall "
        "rotated_wall corner_to_corner_hit exact_fit_shaft shaft_1um_wider one_way_from_below "
        "one_way_from_above tiles_1e3 sensor_gate lift_up lift_sideways sweeping_paper head_on");
    return std::vector<SceneSet>{
        {"technique_gallery", "a set: for each technique where it fails, and where it is the cheapest that does not",
         std::vector<std::string>(std::istream_iterator<std::string>(gallery), {})}};
  }();
  return all;
}

const SceneSet* find_set(const std::string& name) {
  const std::vector<SceneSet>& all = scene_sets();
  const auto found = std::find_if(all.begin(), all.end(), [&](const SceneSet& set) { return set.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace paperproof::compare
