/// What the command reads: maps without a script, many inputs of which some are bad, and inputs that never end.
#include "compare/command_workplace.hpp"
#include "compare/png_files.hpp"
#include "one_line.hpp"
#include "support/steps_wanted.hpp"

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace paperproof::compare {
namespace {

constexpr const char* map_text =
    R"(<map version="1.5" orientation="orthogonal" width="20" height="3" tilewidth="32" tileheight="32" infinite="0">
<objectgroup id="1" name="solid"><object id="1" x="0" y="64" width="640" height="32"/></objectgroup></map>)";

/// A floor of white pixels below black air.
std::string picture_of_a_floor() {
  PngFile picture{.width = 320, .height = 96};
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column)
      picture.samples.push_back(row < 64 ? std::uint16_t{0} : std::uint16_t{255});
  return picture.bytes();
}

std::vector<nlohmann::json> json_lines(const std::string& text) {
  std::vector<nlohmann::json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

double farthest_to_the_side(const std::string& trace) {
  double farthest = 0;
  const std::vector<nlohmann::json> lines = json_lines(trace);
  for (std::size_t i = 1; i < lines.size(); ++i)
    farthest = std::max(farthest,
                        std::abs(lines[i]["path"].back()[0].get<double>() - lines[1]["path"].front()[0].get<double>()));
  return farthest;
}

TEST(CommandInputs, a_map_without_a_script_moves_by_itself_and_says_so_in_one_line) {
  const Workplace place;
  place.write("map.tmx", map_text);
  place.write("picture.png", picture_of_a_floor());
  place.write("good.json", good_scene);
  const std::string run = "compare --no-timing --contender octagon_sweep --steps 300 --trace t ";
  for (const std::string map : {"map.tmx", "picture.png"}) {
    const Finished finished = place.run(run + map);
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_TRUE(begins(finished.out, map.substr(0, map.find('.')) +
                                         ": its character climbs kerbs up to a pixel of the map (0.03125 "
                                         "m); a map without a script, so it moves by random:1\n"));
    const std::string own = place.files().at("t." + map.substr(0, map.find('.')) + ".octagon_sweep.double.jsonl");
    EXPECT_GT(farthest_to_the_side(own), 1) << map;
    EXPECT_EQ(place.run(run + map + " --input random:1").out.find("without a script"), std::string::npos);
    EXPECT_EQ(place.files().at("t." + map.substr(0, map.find('.')) + ".octagon_sweep.double.jsonl"), own);
    EXPECT_TRUE(holds(place.run("check " + map).out, "random:1, as a map has no script"));
  }
  EXPECT_EQ(place.run(run + "good.json").out.find("without a script"), std::string::npos);
  EXPECT_EQ(farthest_to_the_side(place.files().at("t.good.octagon_sweep.double.jsonl")), 0) << "JSON scenes stay";
  const Finished both =
      place.run("compare --no-timing --contender octagon_sweep --steps 20 map.tmx picture.png good.json");
  EXPECT_TRUE(holds(both.out, "2 maps without a script: moved by random:1\n"));
}

TEST(CommandInputs, maps_without_a_scene_fall_no_faster_than_25_metres_per_second) {
  const SceneFiles files;
  for (const std::string& map : {files.write("map.tmx", map_text), files.write("picture.png", picture_of_a_floor())}) {
    const Scene scene = load_scenes(map).front();
    EXPECT_EQ(scene.character.max_fall_speed, 25) << map;
    EXPECT_EQ(scene.moves_at_random, 1U) << map;
  }
}

TEST(CommandInputs, keep_going_runs_the_others_and_ends_with_status_2) {
  const Workplace place;
  place.write("good.json", good_scene);
  place.write("bad.json", "{}");
  const std::string run =
      "compare bad.json good.json nowhere.tmx --no-timing --contender octagon_sweep --no-reference ";
  const Finished strict = place.run(run + "--rows strict.jsonl");
  EXPECT_EQ(strict.status, 2);
  EXPECT_TRUE(begins(strict.err, "bad.json: "));
  EXPECT_EQ(place.files().count("strict.jsonl"), 0U) << "nothing runs";

  const Finished finished = place.run(run + "--quiet --keep-going --rows rows.jsonl");
  EXPECT_EQ(finished.status, 2);
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 2) << finished.err;
  EXPECT_TRUE(begins(finished.err, "bad.json: "));
  EXPECT_TRUE(holds(finished.err, "\nnowhere.tmx: "));
  const auto lines = json_lines(place.files().at("rows.jsonl"));
  ASSERT_EQ(lines.size(), 4U) << "a header, two that failed, and the one that ran";
  EXPECT_EQ(lines[0].at("paperproof_rows"), 1);
  EXPECT_TRUE(lines[0].contains("environment"));
  for (const std::size_t failed : {std::size_t{1}, std::size_t{2}}) {
    EXPECT_EQ(lines[failed].at("verdict"), "failed");
    EXPECT_TRUE(begins(lines[failed].at("reason"), lines[failed].at("scene").get<std::string>() + ": "));
  }
  EXPECT_EQ(lines[3].at("scene"), "good");
  EXPECT_EQ(lines[3].at("verdict"), "holds");
  EXPECT_EQ(place.run("compare good.json --keep-going --no-timing --quiet").status, 0);
  EXPECT_TRUE(holds(place.run(run + "--keep-going").out, "2 of 3 inputs could not be used\n"));
}

TEST(CommandInputs, names_come_from_a_file_or_from_standard_input) {
  const Workplace place;
  place.write("good.json", good_scene);
  place.write("list", "good.json\r\n\narticle_bullet\n");
  const std::string run = "compare wedge_60 --no-timing --json --contender octagon_sweep --no-reference --files-from ";
  const auto scenes_of = [](const Finished& finished) {
    std::vector<std::string> scenes;
    const nlohmann::json document = nlohmann::json::parse(finished.out, nullptr, false);
    if (!document.is_discarded())
      for (const auto& row : document["rows"]) scenes.push_back(row["scene"]);
    return scenes;
  };
  const std::vector<std::string> all{"wedge_60", "good", "article_bullet"};
  EXPECT_EQ(scenes_of(place.run(run + "list")), all);
  EXPECT_EQ(scenes_of(place.run(run + "- <list")), all);
  EXPECT_TRUE(holds(place.run(run + "-").err, "--files-from -: expected the names of scenes"));
  EXPECT_TRUE(begins(place.run(run + "nowhere").err, "nowhere: expected a file that exists"));
  EXPECT_TRUE(begins(place.run("compare --quiet").err, "paperproof: SCENE is required"));
  EXPECT_TRUE(holds(place.run(run + "list --rows list").err, "--rows list: expected another file than --files-from"));
}

TEST(CommandInputs, only_regular_files_are_read) {
  const Workplace place;
  for (const std::string name : {"pipe.json", "pipe.tmx", "pipe.stl", "pipe.png"}) {
    ASSERT_EQ(mkfifo(place.path(name).c_str(), 0600), 0);
    const Finished finished = place.run("check " + name);
    EXPECT_EQ(finished.status, 2);
    EXPECT_EQ(finished.err, name + ": expected a regular file; this is a pipe\n");
  }
  std::filesystem::create_symlink("/dev/zero", place.path("zero.json"));
  EXPECT_EQ(place.run("check zero.json").err, "zero.json: expected a regular file; this is a device\n");
  place.write("tileset.tmx",
              with(map_text, "<objectgroup", "<tileset firstgid=\"1\" source=\"pipe.tmx\"/><objectgroup"));
  EXPECT_TRUE(holds(place.run("check tileset.tmx").err, "tileset pipe.tmx: expected a regular file"));
  place.write("picture.json",
              with(good_scene, "\"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1]]", "\"picture\": \"pipe.png\""));
  EXPECT_TRUE(holds(place.run("check picture.json").err, "/scenery/0/picture: pipe.png: expected a regular file"));
}

TEST(CommandInputs, what_is_too_large_is_refused_with_the_bound) {
  const Workplace place;
  std::filesystem::resize_file(place.write("big.json", ""), 70'000'000);
  EXPECT_TRUE(begins(place.run("check big.json").err, "big.json: expected at most 64 MB"));
  std::string ring;
  for (int i = 0; i < 10'001; ++i)
    ring += (i == 0 ? "[" : ",[") + std::to_string(i) + "," + std::to_string(i % 2) + "]";
  place.write("corners.json", with(good_scene, "[-4,0],[4,0],[4,-1],[-4,-1]", ring));
  EXPECT_TRUE(begins(place.run("check corners.json").err,
                     "corners.json: /scenery/0/polygon: \"floor\": expected at most 10000 corners"));
}

TEST(CommandInputs, a_message_is_one_line_of_at_most_300_bytes_that_keeps_file_and_place) {
  const Workplace place;
  const std::string digits(paperproof::test::sampled(100'000), '9');
  place.write("digits.json", with(good_scene, "0.016", digits));
  place.write("line.tmj", "{\"layers\":[1,oops" + std::string(8000, '\'') + "]}");
  place.write("key.json", with(good_scene, "\"dt\"", "\"" + std::string(9000, 'k') + "\": 1, \"dt\""));
  place.write("accents.json", with(good_scene, "\"gravity\"", "\"" + std::string(299, 'x') + "éééé\": 1, \"gravity\""));
  for (const auto& [arguments, front, back] : {std::tuple{"check digits.json", "digits.json:2:", "9\n"},
                                               {"check line.tmj", "line.tmj:1:1", "\n"},
                                               {"check key.json", "key.json: /kkk", "steps\n"},
                                               {"check accents.json", "accents.json: /xxx", "steps\n"}}) {
    const Finished finished = place.run(arguments);
    EXPECT_EQ(finished.status, 2) << arguments;
    EXPECT_LE(finished.err.size(), 300U) << finished.err;
    EXPECT_EQ(finished.err.find('\n'), finished.err.size() - 1);
    EXPECT_TRUE(begins(finished.err, front));
    EXPECT_TRUE(finished.err.ends_with(back) || back == std::string("steps\n")) << finished.err;
  }
  EXPECT_LE(place.run("compare article_bullet --steps " + digits).err.size(), 300U);
  EXPECT_LE(place.run("check " + digits).err.size(), 300U);
}

TEST(CommandInputs, a_message_is_not_cut_within_a_character) {
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

TEST(CommandInputs, long_work_says_how_long_it_takes_before_it_has_taken_long) {
  const Workplace place;
  const std::string run = "compare article_bullet --steps 1000000000 --no-timing --contender octagon_sweep";
  EXPECT_TRUE(holds(place.run(run, until_it_speaks).err, " for 1000000000 steps, as the first "));
  EXPECT_EQ(place.run(run + " --quiet", "timeout 3").err, "");
  std::string beams;
  for (int i = 0; i < 8000; ++i)
    beams +=
        (i == 0 ? "" : ",") + std::string("{\"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1.") + std::to_string(i + 1) + "]]}";
  place.write("beams.json",
              with(good_scene, "{ \"id\": \"floor\", \"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1]] }", beams));
  EXPECT_TRUE(begins(place.run("compare beams.json --no-timing", until_it_speaks).err, "good: about "));
}

}  // namespace
}  // namespace paperproof::compare
