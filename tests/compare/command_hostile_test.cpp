/// Calls that cannot be served, of every subcommand: each ends soon, with status 2 and one line that is ours.
#include "compare/command_workplace.hpp"
#include "compare/tiled_maps.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

namespace paperproof::compare {
namespace {

constexpr const char* header_line = "{\"paperproof_rows\":1,\"environment\":{\"compiler\":\"any\"}}\n";
constexpr const char* good_row =
    R"({"scene":"paper","contender":"mask","scalar":"double","mode":"free","steps":60,"verdict":"holds","tunnels":0})"
    "\n";

std::string rows_with(std::string_view from, std::string_view to) {
  return header_line + with(good_row, from, to) + good_row;
}

/// Makes the calls, and says what is wrong with them.
class Hostile {
 public:
  explicit Hostile(const Workplace& place) : place_(place) {}

  /// @param says what the line has to say, where that is known.
  void call(const std::string& arguments, const std::string& says = "") {
    if (!seen_.insert(arguments).second) ADD_FAILURE() << "called twice: " << arguments;
    const auto before = files();
    // One that hangs ends with status 124. The load of the machine is not its fault.
    const Finished finished = place_.run(arguments, "timeout -k 1 60");
    const std::string what = "paperproof " + arguments + "\n" + finished.err;
    EXPECT_EQ(finished.status, 2) << what;
    EXPECT_EQ(finished.out, "") << what;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << what;
    EXPECT_GT(finished.err.size(), 10U) << what;
    EXPECT_TRUE(holds(finished.err, says)) << what;
    for (const char* foreign :
         {"terminate", "std::", "json.exception", "basic_string", "what()", "vector", "filesystem", "bad_alloc", "CLI",
          "stoi", "Segmentation", "AddressSanitizer", "runtime error"})
      EXPECT_EQ(finished.err.find(foreign), std::string::npos) << what;
    EXPECT_EQ(files(), before) << "a file was touched by\n" << what;
  }

  [[nodiscard]] std::size_t calls() const { return seen_.size(); }

 private:
  /// Names, sizes and times: some are larger than memory.
  [[nodiscard]] std::set<std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>> files() const {
    std::set<std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>> all;
    for (const auto& entry : std::filesystem::directory_iterator(place_.path("")))
      if (std::filesystem::is_regular_file(entry.symlink_status()))
        all.emplace(entry.path().filename().string(), entry.file_size(), entry.last_write_time());
    return all;
  }

  const Workplace& place_;
  std::set<std::string> seen_;
};

/// A file, and what is to be said about it; empty where that depends on who reads it.
struct Input {
  std::string name;
  std::string says;
};

/// Whatever ends in `end` and is no file of that kind.
std::vector<Input> inputs_ending_in(const Workplace& place, const std::string& end) {
  EXPECT_EQ(mkfifo(place.path("pipe" + end).c_str(), 0600), 0);
  std::filesystem::create_directory(place.path("folder" + end));
  std::filesystem::create_symlink("/dev/zero", place.path("zeros" + end));
  std::filesystem::create_symlink("loop" + end, place.path("loop" + end));
  place.write("empty" + end, "");
  place.write("noise" + end, "\x7f\x45LF\x02\xff\xfe \x80");
  place.write("zero_bytes" + end, std::string(100, '\0'));
  place.write("huge" + end, "");
  std::filesystem::resize_file(place.path("huge" + end), 5'000'000'000);  // sparse
  return {{"pipe" + end, "expected a regular file; this is a pipe"},
          {"folder" + end, "expected a file; this is a directory"},
          {"zeros" + end, "expected a regular file; this is a device"},
          {"loop" + end, "expected a file that exists; there is none"},
          {"missing" + end, "expected a file that exists; there is none"},
          {"huge" + end, "expected at most "},
          {"empty" + end, ""},
          {"noise" + end, ""},
          {"zero_bytes" + end, ""}};
}

TEST(CommandHostile, scenes_that_are_none) {
  const Workplace place;
  Hostile hostile(place);
  for (const std::string end : {".json", ".tmx", ".tmj", ".stl", ".png"})
    for (const auto& [name, says] : inputs_ending_in(place, end)) {
      hostile.call("check " + name, says);
      hostile.call("plan " + name, says);
      hostile.call("compare " + name + " --no-timing --rows o.json", says);
      hostile.call("convert " + name + " o.json", says);
      hostile.call("sweep " + name + " --vary dt=0.01,0.02 --rows o.jsonl", says);
    }
  for (const auto& [name, says] : inputs_ending_in(place, "")) {
    hostile.call("compare --files-from " + name, says);
    hostile.call("check " + name);
  }
  EXPECT_EQ(hostile.calls(), 5U * 9 * 5 + 2 * 9);
}

TEST(CommandHostile, scenes_with_a_fault) {
  const Workplace place;
  Hostile hostile(place);
  const std::string map = tmx(csv_layer(floor_csv) + spawn);
  const auto polygon = [](const std::string& points) { return good_with("[[-4,0],[4,0],[4,-1],[-4,-1]]", points); };
  for (const auto& [name, text, says] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"behind.json", good_scene + std::string("\0{}", 3), "behind.json:5: expected text; a byte of zero"},
           {"behind.tmx", map + std::string("\0<map/>", 7), "behind.tmx:6: expected text; a byte of zero"},
           {"behind.stl", std::string("(supertux-level)\0", 17), "behind.stl:1: expected text; a byte of zero"},
           {"deep.json", std::string(100'000, '['), "levels of nesting"},
           {"deep.tmx", tmx(std::string(100'000, '<')), "deep.tmx:"},
           {"deep.stl", std::string(100'000, '('), "deep.stl:"},
           {"steps.json", good_with("\"steps\": 20", "\"steps\": 1e300"), "/steps"},
           {"steps2.json", good_with("\"steps\": 20", "\"steps\": \"many\""), "/steps"},
           {"dt.json", good_with("0.016", "1e999"), "finite"},
           {"dt2.json", good_with("0.016", "-1e-320"), "/dt"},
           {"dt3.json", good_with("0.016", "null"), "/dt"},
           {"name.json", good_with("\"good\"", "\"a\\u0000b\""), "/name"},
           {"name2.json", good_with("\"good\"", "{}"), "/name"},
           {"far.json", polygon("[[-4e300,0],[4e300,0],[4,-1e300]]"), "floor"},
           {"line.json", polygon("[[0,0],[1,1]]"), "/scenery/0/polygon"},
           {"bow.json", polygon("[[0,0],[1,1],[1,0],[0,1]]"), "floor"},
           {"list.json", polygon("7"), "/scenery/0"},
           {"self.json", polygon("[[0,0],[1,1],[1]]"), "/scenery/0"},
           {"two.json", good_with("\"polygon\"", "\"chain\": [[0,0],[1,0]], \"polygon\""), "/scenery/0"},
           {"circle.json", good_with("\"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1]]", "\"circle\": [0,0,-1]"), "floor"},
           {"tiled.json", good_with("\"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1]]", "\"tiled\": \"/dev/zero\""),
            "this is a device"},
           {"picture.json", good_with("\"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1]]", "\"picture\": \"/dev/zero\""),
            "this is a device"},
           {"tiles.json", good_with("\"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1]]", "\"pixel_tiles\": \"/dev/zero\""),
            "this is a device"},
           {"set.tmx", with(map, "<layer", "<tileset firstgid=\"20\" source=\"/dev/zero\"/><layer"),
            "this is a device"},
           {"wide.tmx", with(map, " width=\"4\" height=\"3\"", " width=\"2000000000\" height=\"2000000000\""),
            "at most"},
           {"wide2.tmx", with(csv_layer(floor_csv) + spawn, "width=\"4\"", "width=\"1e300\""), ""},
           {"round.tmx",
            tmx(objects("solid", R"(<object id="3" x="0" y="0" width="1e9" height="2e9"><ellipse/></object>)") + spawn),
            "26,000 px"},
           {"scale.tmj", R"({"layers": [], "tilewidth": -1, "tileheight": 16, "width": 1, "height": 1})", "tile size"},
           {"layers.tmj", R"({"layers": 7, "tilewidth": 16, "tileheight": 16, "width": 1, "height": 1})", "/layers"}}) {
    place.write(name, text);
    hostile.call("check " + name, says);
  }
  EXPECT_EQ(hostile.calls(), 29U);
}

TEST(CommandHostile, rows_that_are_none) {
  const Workplace place;
  Hostile hostile(place);
  place.write("good.jsonl", header_line + std::string(good_row));
  const auto read = [&](const std::string& name, const std::string& says) {
    hostile.call("merge good.jsonl " + name + " --rows o.jsonl", says);
    hostile.call("diff " + name + " good.jsonl", says);
    hostile.call("report o.html good.jsonl " + name, says);
  };
  for (const auto& [name, says] : inputs_ending_in(place, ".jsonl")) {
    read(name, says);
    if (!name.starts_with("empty") && !name.starts_with("missing"))  // with these a sweep begins
      hostile.call("sweep paper --vary speed=1,2 --contender mask --resume --rows " + name,
                   name.starts_with("loop") ? "cannot be written" : says);
  }
  hostile.call("diff good.jsonl pipe.jsonl", "pipe.jsonl: expected a regular file; this is a pipe");
  const std::vector<std::pair<std::string, std::string>> faults{
      {rows_with("\"holds\"", "\"fine\""), "2: /verdict: expected failed, not_applicable, violates"},
      {rows_with("\"holds\"", "7"), "2: /verdict: expected a text, not 7"},
      {rows_with("\"tunnels\":0", "\"tunnels\":-1"), "2: /tunnels: expected 0 or more, not -1"},
      {rows_with("\"tunnels\":0", "\"tunnels\":0.5"), "2: /tunnels: expected a whole number, not 0.5"},
      {rows_with("\"tunnels\":0", "\"tunnels\":null"), "2: /tunnels: expected a whole number, not null"},
      {rows_with("\"tunnels\":0", "\"tunels\":0"), "2: /tunels: unknown key; did you mean tunnels?"},
      {rows_with("\"tunnels\":0", "\"tunnels\":0,\"tunnels\":1"),
       "2: expected each key once; \"tunnels\" stands twice"},
      {rows_with("\"tunnels\":0", "\"tunnels\":1e999"), "2: expected finite numbers"},
      {rows_with("\"tunnels\":0", "\"max_penetration_m\":-1"), "2: /max_penetration_m: expected 0 or more"},
      {rows_with("\"tunnels\":0", "\"exempted\":{\"hover\":-3}"), "2: /exempted/hover: expected 0 or more"},
      {rows_with("\"tunnels\":0", "\"exempted\":[]"), "2: /exempted: expected an object, not []"},
      {rows_with("\"tunnels\":0", "\"parameters\":{\"dt_s\":\"slow\"}"), "2: /parameters/dt_s: expected a number"},
      {rows_with("\"tunnels\":0", "\"findings\":[1]"), "2: /findings/0: expected a text, not 1"},
      {rows_with("\"tunnels\":0", "\"first_tunnel\":{\"step\":1,\"speed\":1}"), "2: /first_tunnel/speed: unknown key"},
      {rows_with("\"tunnels\":0", "\"first_tunnel\":{}"), "2: /first_tunnel/step: expected this key, which is missing"},
      {rows_with("\"tunnels\":0", "\"case\":\"../../etc\""), "2: /case: expected a text like"},
      {rows_with("\"steps\":60", "\"steps\":\"60\""), "2: /steps: expected a whole number, not \"60\""},
      {rows_with("\"scene\":\"paper\",", ""), "2: /scene: expected this key, which is missing"},
      {rows_with("\"double\"", "\"half\""), "2: /scalar: expected double, float or \"\", not \"half\""},
      {rows_with("\"mode\":\"free\"", "\"mode\":true"), "2: /mode: expected a text, not true"},
      {rows_with("\"mask\"", "\"mask\xff\""), "2: expected JSON"},
      {std::string(header_line) + "[1]\n" + good_row, "2: /: expected an object, not [1]"},
      {std::string(header_line) + "\n" + good_row, "2: expected JSON"},
      {std::string(header_line) + std::string(100'000, '[') + "\n" + good_row, "2: expected at most 100 levels"},
      {header_line + std::string(good_row).substr(0, 40) + "\n" + good_row, "2: expected JSON"},
      {header_line + with(good_row, "}\n", std::string("}\0\n", 3)) + good_row, "2: expected text; a byte of zero"},
      {header_line + std::string(good_row) + std::string(good_row).substr(0, 40), "3: expected a whole row; this last"},
      {header_line + std::string(good_row) + std::string(50, '\0'), "3: expected a whole row; this last"},
      {header_line + std::string(5'000'000, ' '), "2: expected lines of at most 4 MB"},
      {std::string("{\"paperproof_rows\":2}\n") + good_row, " expected rows as JSON Lines"},
      {std::string("{\"paperproof_rows\":1,\"rows\":[]}\n"), " expected rows as JSON Lines"},
      {std::string("{\"paperproof_rows\":1,\"rows_\":[]}\n"), "1: /rows_: unknown key"},
      {std::string("{\"paperproof_rows\":1,\"environment\":{\"cpu\":7}}\n"), "1: /environment/cpu: expected a text"},
      {std::string("{\"paperproof_rows\":1,\"sweep\":{\"id\":\"a\",\"cases\":4,\"shard\":[1]}}\n"),
       "1: /sweep/shard: expected 2 to 2 entries, not 1"},
      {std::string("{\"paperproof_rows\":1,\"sweep\":{\"id\":\"a\",\"cases\":-4,\"shard\":[1,2]}}\n"),
       "1: /sweep/cases: expected 0 or more"}};
  for (std::size_t k = 0; k < faults.size(); ++k) {
    const std::string name = "fault" + std::to_string(k) + ".jsonl";
    place.write(name, faults[k].first);
    read(name, name + ":" + faults[k].second);
  }
  // The parts of sweeps that were never run.
  for (const char* shard : {"[1,1000000000000000]", "[7,2]", "[1,2]"}) {
    const std::string name = "shard" + std::to_string(hostile.calls()) + ".jsonl";
    place.write(name,
                "{\"paperproof_rows\":1,\"sweep\":{\"id\":\"a\",\"cases\":4,\"shard\":" + std::string(shard) + "}}\n");
    hostile.call("merge " + name + " --rows o.jsonl", "shards of the sweep, each once");
  }
  EXPECT_EQ(hostile.calls(), 9U * 3 + 7 + 1 + faults.size() * 3 + 3);
}

TEST(CommandHostile, pages_and_json_files_of_rows_that_are_none) {
  const Workplace place;
  Hostile hostile(place);
  for (const std::string end : {".json", ".html"})
    for (const auto& [name, says] : inputs_ending_in(place, end)) hostile.call("report o.html " + name, says);
  const auto page = [](const std::string& index) {
    return "<script type=\"application/json\" id=\"index\">" + index + "</script>";
  };
  const auto file = [](const std::string& row) { return "{\"paperproof_rows\": 1, \"rows\": [\n" + row + "]}"; };
  for (const auto& [name, text, says] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"a.html", page("{}"), "expected a page that paperproof wrote"},
           {"b.html", page("{\"environment\": 7, \"tolerances\": []}"), "expected a page that paperproof wrote"},
           {"c.html", page("[]"), "expected a page that paperproof wrote"},
           {"d.html", page("{"), "expected a page that paperproof wrote"},
           {"e.html", "<script type=\"application/json\" id=\"index\">{}", "expected a page that paperproof wrote"},
           {"a.json", file(with(good_row, "holds", "fine")), "a.json: /rows/0/verdict: expected failed"},
           {"b.json", file(with(good_row, "\"steps\"", "\"stepps\"")), "b.json: /rows/0/steps: expected this key"},
           {"c.json", file(good_row) + "x", "c.json:3: expected JSON"},
           {"d.json", file(good_row) + std::string("\0", 1), "d.json:3: expected text; a byte of zero"},
           {"e.json", "{\"paperproof_rows\": 1}", "expected rows as JSON"},
           {"f.json", "{\"paperproof_rows\": 1, \"rows\": 7}", "f.json: /rows: expected a list, not 7"},
           {"g.json", good_scene, "expected rows as JSON"},
           {"h.json", std::string(100'000, '['), "levels of nesting"},
           {"rows.csv", "scene,contender\r\npaper,mask\r\n", "rows.csv:1: expected JSON"}}) {
    place.write(name, text);
    hostile.call("report o.html " + name, says);
  }
  EXPECT_EQ(hostile.calls(), 2U * 9 + 14);
}

TEST(CommandHostile, outputs_that_cannot_be) {
  const Workplace place;
  Hostile hostile(place);
  place.write("good.json", good_scene);
  place.write("good.jsonl", header_line + std::string(good_row));
  std::filesystem::create_directory(place.path("folder.json"));
  std::filesystem::create_directory(place.path("folder.html"));
  std::filesystem::create_directory(place.path("folder.jsonl"));
  for (const char* pipe : {"pipe.json", "pipe.html"}) ASSERT_EQ(mkfifo(place.path(pipe).c_str(), 0600), 0);
  const std::string compare = "compare good.json --no-timing --quiet --contender mask ";
  const std::string sweep = "sweep paper --vary speed=1,2 --contender mask --quiet ";
  for (const auto& [arguments, says] : std::vector<std::pair<std::string, std::string>>{
           {compare + "--rows folder.json", "it is a directory"},
           {compare + "--rows nowhere/o.json", "nowhere/o.json: cannot be written"},
           {compare + "--rows good.json/o.json", "cannot be written"},
           {compare + "--rows o.txt", "expected a name that ends in .json, .jsonl or .csv, not o.txt"},
           {compare + "--rows /dev/full", "/dev/full: cannot be written"},
           {compare + "--rows pipe.json", "pipe.json: cannot be written: nobody reads the pipe"},
           {compare + "--report pipe.html", "pipe.html: cannot be written: nobody reads the pipe"},
           {"convert bullet pipe.json", "pipe.json: cannot be written: nobody reads the pipe"},
           {compare + "--rows ''", "expected a file name"},
           {compare + "--rows good.json", "expected another file"},
           {compare + "--report o.txt", "expected a name that ends in .html, not o.txt"},
           {compare + "--report folder.html", "it is a directory"},
           {compare + "--report nowhere/o.html", "cannot be written"},
           {compare + "--report /dev/full", "/dev/full: cannot be written"},
           {compare + "--trace nowhere/t", "cannot be written"},
           {compare + "--trace ''", "expected a file name"},
           {compare + "--svg good.json", "good.json"},
           {compare + "--svg ''", "expected a file name"},
           {sweep + "--rows folder.jsonl", "it is a directory"},
           {sweep + "--rows o.html", "expected a name that ends in"},
           {sweep + "--report o.jsonl", "expected a name that ends in .html"},
           {sweep + "--log nowhere/log", "nowhere/log"},
           {sweep + "--rows o.jsonl --log ./o.jsonl", "expected another file"},
           {sweep + "--resume", "expected --rows FILE.jsonl"},
           {sweep + "--resume --rows o.csv", "expected --rows FILE.jsonl"},
           {sweep + "--resume --rows folder.jsonl", "this is a directory"},
           {"merge good.jsonl --rows o.csv", "expected a name that ends in .jsonl, not o.csv"},
           {"merge good.jsonl --rows folder.jsonl", "it is a directory"},
           {"merge good.jsonl --rows nowhere/o.jsonl", "cannot be written"},
           {"merge good.jsonl --rows good.jsonl", "expected another file"},
           {"merge good.jsonl --rows ''", "expected a file name"},
           {"merge good.jsonl", "--rows is required"},
           {"report o.txt good.jsonl", "expected a name that ends in .html, not o.txt"},
           {"report good.jsonl o.html", "expected a name that ends in .html, not good.jsonl"},
           {"report folder.html good.jsonl", "it is a directory"},
           {"report nowhere/o.html good.jsonl", "cannot be written"},
           {"report '' good.jsonl", "expected a file name"},
           {"report o.html", "ROWS is required"},
           {"convert good.json o.tmx", "expected an output that ends in .json"},
           {"convert good.json good.json", "expected another file"},
           {"convert good.json nowhere/o.json", "cannot be written"},
           {"convert good.json folder.json", "it is a directory"},
           {"convert good.json", "OUT is required"}})
    hostile.call(arguments, says);
  EXPECT_EQ(hostile.calls(), 43U);
}

TEST(CommandHostile, options_that_cannot_be) {
  const Workplace place;
  Hostile hostile(place);
  const std::string sweep = "sweep paper --contender mask --quiet --vary ";
  const std::string compare = "compare article_bullet --no-timing --quiet ";
  for (const std::string vary : {"speed",
                                 "speed=",
                                 "=1,2",
                                 "speed=x",
                                 "speed=1,x",
                                 "speed=1:2",
                                 "speed=1:2:lin",
                                 "speed=1:2:lin0",
                                 "speed=1:2:lin1x",
                                 "speed=1:2:log-3",
                                 "speed=0:2:log3",
                                 "speed=1:2:lin99999999999999999999",
                                 "speed=nan,1",
                                 "speed=1:inf:lin3",
                                 "speed=1e999,2",
                                 "sped=1,2",
                                 "''",
                                 "speed=1,,2",
                                 "speed=-1e300,2",
                                 "speed=1:2:cubic3",
                                 "unit=-1,2",
                                 "continuous=maybe,on"})
    hostile.call(sweep + vary);
  hostile.call(sweep + "speed=1,2 --vary speed=3,4");
  for (const std::string shard : {"''", "0/2", "3/2", "1", "1/", "/2", "a/b", "1/2/3", "-1/2", "1/0", "' 1/2'", "1.5/2",
                                  "1/99999999999999999999999"})
    hostile.call(sweep + "speed=1,2 --shard " + shard, "--shard");
  for (const std::string border : {"sped", "speed=1", "speed=2:1", "speed=x:y", "''", "speed=1:2:lin3"})
    hostile.call("sweep paper --contender mask --quiet --find-border " + border);
  for (const std::string set :
       {"dt", "dt=", "=1", "dt=x", "dt=-1", "dt=0", "dt=nan", "dt=1e999", "spede=1", "''", "dt=1,2", "gravity=1e300"})
    hostile.call(compare + "--set " + set);
  for (const std::string knob : {"unit", "unit=", "=1", "unit=x", "unit=-1", "unit=0", "unit=nan", "units=1", "''",
                                 "iterations=0", "iterations=1e9", "points=5", "response=both"})
    hostile.call(compare + "--knob " + knob, "--knob");
  for (const std::string steps : {"0", "-1", "x", "1e9", "99999999999", "''", "1.5"})
    hostile.call(compare + "--steps " + steps, "--steps");
  for (const std::string input : {"random", "random:", "random:-1", "random:x", "random:1:2", "''", "script"})
    hostile.call(compare + "--input " + input, "--input");
  for (const std::string jobs : {"0", "-1", "x", "99999999999999999999", "''"})
    hostile.call(sweep + "speed=1,2 --jobs " + jobs, "--jobs");
  for (const std::string limit : {"0", "-1", "1e3", "''"})
    hostile.call(sweep + "speed=1,2 --limit " + limit, "--limit");
  for (const std::string rest :
       {"--contender ''", "--contender nobody", "--scalar half", "--mode sideways", "--plan none",
        "--mode lockstep --no-reference", "--mode lockstep --contender box2d", "--quiet=yes", "--unknown", "-x",
        "--set dt=0.01 --set", "--files-from ''", "no_such_scene"})
    hostile.call(compare + rest);
  for (const std::string line : {"",
                                 "frobnicate",
                                 "compare",
                                 "check",
                                 "plan",
                                 "convert",
                                 "sweep",
                                 "study",
                                 "study nothing",
                                 "merge",
                                 "diff",
                                 "report",
                                 "list",
                                 "list everything",
                                 "demo nobody",
                                 "demo mask mask",
                                 "work-precision nothing",
                                 "stability --grid huge",
                                 "stability --contender nobody",
                                 "study bullet --grid x",
                                 "study scale --grid 7",
                                 "study scale --grid 99999999999999",
                                 "study disagreement no_such_scene",
                                 "study bullet --shard ''",
                                 "diff one",
                                 "diff one two three",
                                 "check ''",
                                 "plan article_bullet --input x",

                                 "compare article_bullet ''",
                                 "convert '' ''"})
    hostile.call(line);
  EXPECT_GE(hostile.calls(), 130U);
}

}  // namespace
}  // namespace paperproof::compare
