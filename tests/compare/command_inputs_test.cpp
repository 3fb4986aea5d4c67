/// What the command reads: maps without a script, many inputs of which some are bad, and inputs that never end. Traces
/// that it wrote are in tables/calls.json.
#include "compare/command_workplace.hpp"
#include "compare/png_files.hpp"
#include "one_line.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

using CommandInputs = CommandTest;

constexpr const char* map_text =
    R"(<map version="1.5" orientation="orthogonal" width="20" height="3" tilewidth="32" tileheight="32" infinite="0">
<objectgroup id="1" name="solid"><object id="1" x="0" y="64" width="640" height="32"/></objectgroup></map>)";

TEST_F(CommandInputs, maps_without_a_script_move_by_themselves_and_say_so_in_one_line) {
  place.write("map.tmx", map_text);
  // A floor of white pixels below black air.
  PngFile picture{.width = 320, .height = 96, .samples = std::vector<std::uint16_t>(std::size_t{64} * 320)};
  picture.samples.resize(std::size_t{96} * 320, 255);
  place.write("picture.png", picture.bytes());
  const std::string run = "compare --no-timing --contender octagon_sweep --steps 300 --trace t ";
  const auto trace = [&](const std::string& scene) {
    return content(place.path("t." + scene + ".octagon_sweep.double.jsonl"));
  };
  for (const std::string scene : {"map", "picture"}) {
    const std::string file = scene == "map" ? "map.tmx" : "picture.png";
    EXPECT_TRUE(begins(place.run(run + file).out,
                       scene + ": its character climbs kerbs up to a pixel of the map (0.03125 m); a map without a "
                               "script, so it moves by random:1\n"));
    const std::string own = trace(scene);
    const std::vector<nlohmann::json> lines = json_lines(own);
    EXPECT_TRUE(std::any_of(lines.begin() + 1, lines.end(), [&](const nlohmann::json& line) {
      return std::abs(line["path"].back()[0].get<double>() - lines[1]["path"][0][0].get<double>()) > 1;
    })) << file;
    EXPECT_EQ(place.run(run + file + " --input random:1").out.find("without a script"), std::string::npos);
    EXPECT_EQ(trace(scene), own);
    EXPECT_EQ(load_scenes(place.path(file)).front().character.max_fall_speed, 25) << file;
  }
  EXPECT_TRUE(holds(place.run("check map.tmx").out, "random:1, as a map has no script"));
}

TEST_F(CommandInputs, a_message_is_not_cut_within_a_character) {
  for (std::size_t before = 0; before < 4; ++before) {
    std::string text(before, 'a');
    for (int i = 0; i < 400; ++i) text += "é";
    const std::string line = one_line(text);
    EXPECT_LT(line.size(), longest_message);
    EXPECT_GT(line.size(), longest_message - 6);
    const auto firsts = std::count(line.begin(), line.end(), '\xc3');
    EXPECT_EQ(firsts, std::count(line.begin(), line.end(), '\xa9')) << line;
    EXPECT_GT(firsts, 140);
  }
}

/// Before a command: ends it once it has said something, or after a minute.
constexpr const char* until_it_speaks =
    R"(sh -c '"$@" & i=0; while [ $i -lt 600 ] && ! [ -s /dev/fd/2 ]; do sleep 0.1; i=$((i+1)); done; kill $!' sh)";

TEST_F(CommandInputs, long_work_says_how_long_it_takes_before_it_has_taken_long) {
  const std::string run = "compare article_bullet --steps 1000000000 --no-timing --contender octagon_sweep";
  EXPECT_TRUE(holds(place.run(run, until_it_speaks).err, " for 1000000000 steps, as the first "));
  EXPECT_EQ(place.run(run + " --quiet", "timeout 3").err, "");
  std::string beams;
  for (int i = 1; i <= 8000; ++i)
    beams += std::string("{\"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1.") + std::to_string(i) + "]]},";
  place.write("beams.json", good_with("{ \"id\": \"floor\"", beams + "{ \"id\": \"floor\""));
  EXPECT_TRUE(begins(place.run("compare beams.json --no-timing", until_it_speaks).err, "good: about "));
}

}  // namespace
}  // namespace paperproof::compare
