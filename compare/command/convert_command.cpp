#include "command/commands.hpp"

#include "command/claimed_files.hpp"
#include "command/complain.hpp"
#include "records/output_file.hpp"
#include "scenes/load.hpp"
#include "scenes/write_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace paperproof::compare {

int convert_command(const Given& given) {
  const std::string& to = given.to;
  if (!to.ends_with(".json")) throw InputError("convert: expected an output that ends in .json, not " + to);
  ClaimedFiles files;
  files.claim(given.what, "the scene " + given.what);
  files.claim_for_option("convert", to);
  const std::vector<Scene> scenes = load_scenes(given.what);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    // A level of several sectors is as many scenes.
    const std::string path =
        k == 0 ? to : fmt::format("{}.{}.json", to.substr(0, to.size() - std::string(".json").size()), k + 1);
    OutputFile file(path);
    file.write(scene_json(scenes[k]).dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
    file.commit();
    if (scenes[k].respawn_box) complain(path + ": the format does not put characters back that leave the map");
  }
  return 0;
}

}  // namespace paperproof::compare
