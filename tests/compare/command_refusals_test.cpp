/// Calls that cannot be served, of every subcommand: each ends soon, with status 2, one line that is ours, and no file
/// touched.
#include "compare/command_workplace.hpp"
#include "compare/tiled_maps.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

namespace paperproof::compare {
namespace {

constexpr const char* header_line = "{\"paperproof_rows\":1,\"environment\":{\"compiler\":\"any\"}}\n";
constexpr const char* good_row =
    R"({"scene":"paper","contender":"mask","scalar":"double","mode":"free","steps":60,"verdict":"holds","tunnels":0})"
    "\n";

std::string rows_with(std::string_view from, std::string_view to) {
  return header_line + with(good_row, from, to) + good_row;
}

class CommandRefuses : public CommandTest {
 protected:
  /// @param says what the line has to say, where that is known.
  void refused(const std::string& arguments, const std::string& says = "") {
    const auto before = files();
    // One that hangs ends with status 124. The load of the machine is not its fault.
    const Finished finished = place.run(arguments, "timeout -k 1 60");
    const std::string what = "paperproof " + arguments + "\n" + finished.err;
    EXPECT_EQ(finished.status, 2) << what;
    EXPECT_EQ(finished.out, "") << what;
    EXPECT_EQ(finished.err.find_first_of("\n\r"), finished.err.size() - 1) << "one line: " << what;
    EXPECT_GT(finished.err.size(), 10U) << what;
    EXPECT_LE(finished.err.size(), 300U) << what;
    EXPECT_TRUE(holds(finished.err, says)) << what;
    for (const char* foreign :
         {"terminate", "std::", "json.exception", "basic_string", "what()", "vector", "filesystem", "bad_alloc", "CLI",
          "stoi", "Segmentation", "AddressSanitizer", "runtime error"})
      EXPECT_EQ(finished.err.find(foreign), std::string::npos) << what;
    EXPECT_EQ(files(), before) << "a file was touched by\n" << what;
  }

 private:
  /// Names, sizes and times: some are larger than memory.
  [[nodiscard]] std::set<std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>> files() const {
    std::set<std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>> all;
    for (const auto& entry : std::filesystem::directory_iterator(place.path("")))
      if (std::filesystem::is_regular_file(entry.symlink_status()))
        all.emplace(entry.path().filename().string(), entry.file_size(), entry.last_write_time());
    return all;
  }
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

TEST_F(CommandRefuses, scenes_that_are_none) {
  for (const std::string end : {".json", ".tmx", ".tmj", ".stl", ".png"})
    for (const auto& [name, says] : inputs_ending_in(place, end)) {
      refused("check " + name, says);
      if (end != ".json") continue;
      refused("plan " + name, says);
      refused("compare " + name + " --no-timing --rows o.json", says);
      refused("convert " + name + " o.json", says);
      refused("sweep " + name + " --vary dt=0.01,0.02 --rows o.jsonl", says);
    }
  for (const auto& [name, says] : inputs_ending_in(place, "")) {
    refused("compare --files-from " + name, says);
    refused("check " + name);
  }
}

/// What a JSON scene may hold is tested without the command.
TEST_F(CommandRefuses, scenes_with_a_fault) {
  const std::string map = tmx(csv_layer(floor_csv) + spawn);
  const auto instead = [](const std::string& shape) {
    return good_with("\"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1]]", shape);
  };
  std::string ring;
  for (int i = 0; i < 10'001; ++i)
    ring += (i == 0 ? "[" : ",[") + std::to_string(i) + "," + std::to_string(i % 2) + "]";
  for (const auto& [name, text, says] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"behind.json", good_scene + std::string("\0{}", 3), "behind.json:5: expected text; a byte of zero"},
           {"behind.tmx", map + std::string("\0<map/>", 7), "behind.tmx:6: expected text; a byte of zero"},
           {"behind.stl", std::string("(supertux-level)\0", 17), "behind.stl:1: expected text; a byte of zero"},
           {"deep.tmx", tmx(std::string(100'000, '<')), "deep.tmx:"},
           {"tiled.json", instead("\"tiled\": \"/dev/zero\""), "this is a device"},
           {"picture.json", instead("\"picture\": \"/dev/zero\""), "/scenery/0/picture: /dev/zero: expected a regular"},
           {"set.tmx", with(map, "<layer", "<tileset firstgid=\"20\" source=\"/dev/zero\"/><layer"),
            "tileset /dev/zero: expected a regular file; this is a device"},
           {"corners.json", instead("\"polygon\": [" + ring + "]"), "\"floor\": expected at most 10000 corners"},
           {"wide.tmx", with(map, " width=\"4\" height=\"3\"", " width=\"2000000000\" height=\"2000000000\""),
            "at most"},
           {"wide2.tmx", with(csv_layer(floor_csv) + spawn, "width=\"4\"", "width=\"1e300\""), ""},
           {"round.tmx",
            tmx(objects("solid", R"(<object id="3" x="0" y="0" width="1e9" height="2e9"><ellipse/></object>)") + spawn),
            "26,000 px"},
           {"scale.tmj", R"({"layers": [], "tilewidth": -1, "tileheight": 16, "width": 1, "height": 1})",
            "tile size"}}) {
    place.write(name, text);
    refused("check " + name, says);
  }
}

TEST_F(CommandRefuses, one_bad_scene_with_every_output_and_says_the_same_to_everyone) {
  place.write("good.json", good_scene);
  place.write("rows.json", "rows of an earlier run");
  for (const std::string quiet : {"", "--quiet", "--json"})
    for (const std::string bad : {"bad.json", "good.json bad.json", "article_bullet --knob unit=-1"})
      refused("compare --no-timing --rows rows.json --report page.html --trace t " + bad + " " + quiet,
              bad.ends_with("bad.json") ? "bad.json: expected a file that exists" : "--knob unit=-1: unit: must be");
}

/// What rows may hold is tested without the command, too; the rest is here.
TEST_F(CommandRefuses, rows_that_are_none) {
  place.write("good.jsonl", header_line + std::string(good_row));
  const auto read = [&](const std::string& name, const std::string& says) {
    refused("merge good.jsonl " + name + " --rows o.jsonl", says);
    refused("diff " + name + " good.jsonl", says);
    refused("report o.html good.jsonl " + name, says);
  };
  for (const auto& [name, says] : inputs_ending_in(place, ".jsonl")) {
    read(name, says);
    if (!name.starts_with("empty") && !name.starts_with("missing"))  // with these a sweep begins
      refused("sweep paper --vary speed=1,2 --contender mask --resume --rows " + name,
              name.starts_with("loop") ? "cannot be written" : says);
  }
  refused("diff good.jsonl pipe.jsonl", "pipe.jsonl: expected a regular file; this is a pipe");
  const std::vector<std::pair<std::string, std::string>> faults{
      {rows_with("\"holds\"", "\"fine\""), "2: /verdict: expected failed, not_applicable, violates"},
      {rows_with("\"tunnels\":0", "\"tunnels\":0,\"tunnels\":1"),
       "2: /tunnels: expected each key once; this one stands twice"},
      {rows_with("\"tunnels\":0", "\"tunnels\":1e999"), "2: /tunnels: expected a finite number, not '1e999'"},
      {rows_with("\"tunnels\":0", "\"case\":\"../../etc\""), "2: /case: expected a text like"},
      {rows_with("\"mask\"", "\"mask\xff\""), "2:35: expected JSON"},
      {std::string(header_line) + std::string(100'000, '[') + "\n" + good_row, "2: expected at most 100 levels"},
      {header_line + std::string(good_row).substr(0, 40) + "\n" + good_row, "2:41: expected JSON"},
      {header_line + with(good_row, "}\n", std::string("}\0\n", 3)) + good_row, "2: expected text; a byte of zero"},
      {header_line + std::string(good_row) + std::string(good_row).substr(0, 40), "3: expected a whole row; this last"},
      {header_line + std::string(good_row) + std::string(50, '\0'), "3: expected a whole row; this last"},
      {header_line + std::string(5'000'000, ' '), "2: expected lines of at most 4 MB"},
      {std::string("{\"paperproof_rows\":2}\n") + good_row, " expected rows as JSON Lines"},
      {std::string("{\"paperproof_rows\":1,\"rows\":[]}\n"), " expected rows as JSON Lines"},
      {std::string("{\"paperproof_rows\":1,\"sweep\":{\"id\":\"a\",\"cases\":-4,\"shard\":[1,2]}}\n"),
       "1: /sweep/cases: expected 0 or more"}};
  int fault = 0;
  for (const auto& [text, says] : faults) {
    const std::string name = "fault" + std::to_string(fault++) + ".jsonl";
    place.write(name, text);
    read(name, name + ":" + says);
  }
  // The parts of sweeps that were never run.
  for (const std::string shard : {"[1,1000000000000000]", "[7,2]", "[1,2]"}) {
    place.write("shard.jsonl",
                "{\"paperproof_rows\":1,\"sweep\":{\"id\":\"a\",\"cases\":4,\"shard\":" + shard + "}}\n");
    refused("merge shard.jsonl --rows o.jsonl", "shards of the sweep, each once");
  }
}

TEST_F(CommandRefuses, pages_and_json_files_of_rows_that_are_none) {
  for (const std::string end : {".json", ".html"})
    for (const auto& [name, says] : inputs_ending_in(place, end)) refused("report o.html " + name, says);
  const auto page = [](const std::string& index) {
    return "<script type=\"application/json\" id=\"index\">" + index + "</script>";
  };
  const auto file = [](const std::string& row) { return "{\"paperproof_rows\": 1, \"rows\": [\n" + row + "]}"; };
  for (const auto& [name, text, says] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"a.html", page("{}"), "expected a page that paperproof wrote"},
           {"e.html", "<script type=\"application/json\" id=\"index\">{}", "expected a page that paperproof wrote"},
           {"a.json", file(with(good_row, "holds", "fine")), "a.json: /rows/0/verdict: expected failed"},
           {"c.json", file(good_row) + "x", "c.json:3:3: expected JSON"},
           {"d.json", file(good_row) + std::string("\0", 1), "d.json:3: expected text; a byte of zero"},
           {"rows.csv", "scene,contender\r\npaper,mask\r\n", "rows.csv:1:1: expected JSON"}}) {
    place.write(name, text);
    refused("report o.html " + name, says);
  }
}

TEST_F(CommandRefuses, outputs_that_cannot_be_before_anything_runs) {
  place.write("good.json", good_scene);
  place.write("good.jsonl", header_line + std::string(good_row));
  for (const char* folder : {"folder.json", "folder.html", "folder.jsonl"})
    std::filesystem::create_directory(place.path(folder));
  for (const char* pipe : {"pipe.json", "pipe.html"}) ASSERT_EQ(mkfifo(place.path(pipe).c_str(), 0600), 0);
  place.write("a.json", good_with("\"good\"", "\"a/b\""));
  place.write("b.json", good_with("\"good\"", "\"a_b\""));
  const std::string compare = "compare good.json --no-timing --contender mask ";
  const std::string sweep = "sweep paper --vary speed=1,2 --contender mask ";
  for (const auto& [arguments, says] : std::vector<std::pair<std::string, std::string>>{
           {compare + "--rows out --report ./out", "--report ./out: expected another file than --rows"},
           {compare + "--rows good.json", "--rows good.json: expected another file than the scene good.json"},
           {compare + "--trace t --rows t.good.mask.double.jsonl", "expected another file than a trace"},
           {"compare a.json b.json --no-timing --trace t", "b.json: expected another name than a_b"},
           {"study scale --grid 100 --rows out --report ./out", "--report ./out: expected another file than --rows"},
           {compare + "--rows folder.json", "it is a directory"},
           {compare + "--rows nowhere/o.json", "nowhere/o.json: cannot be written"},
           {compare + "--rows o.txt", "expected a name that ends in .json, .jsonl or .csv, not o.txt"},
           {compare + "--rows pipe.json", "pipe.json: cannot be written: nobody reads the pipe"},
           {compare + "--report pipe.html", "pipe.html: cannot be written: nobody reads the pipe"},
           {compare + "--rows ''", "expected a file name"},
           {compare + "--report o.txt", "expected a name that ends in .html, not o.txt"},
           {compare + "--trace nowhere/t", "cannot be written"},
           {compare + "--strip o.png", "expected a name that ends in .svg, not o.png"},
           {compare + "a.json --strip o.svg", "--strip: expected one scene"},
           {sweep + "--log nowhere/log", "nowhere/log"},
           {sweep + "--rows o.jsonl --log ./o.jsonl", "expected another file"},
           {sweep + "--resume", "expected --rows FILE.jsonl"},
           {"merge good.jsonl --rows o.csv", "expected a name that ends in .jsonl, not o.csv"},
           {"merge good.jsonl --rows good.jsonl", "expected another file"},
           {"report o.txt good.jsonl", "expected a name that ends in .html, not o.txt"},
           {"convert good.json o.tmx", "expected an output that ends in .json"},
           {"convert good.json good.json", "expected another file"},
           {"convert good.json folder.json", "it is a directory"}})
    refused(arguments, says);
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

TEST_F(CommandRefuses, numbers_that_make_no_sense_in_words) {
  for (std::string word :
       words_of("-1 -5 0 x nan inf 1e3 1e9 1.5 2.5 many +7 0x10 99999999999999999999 1000000001 5,5 ''")) {
    const std::string call = "compare article_bullet --steps " + word;
    std::replace(word.begin(), word.end(), '\'', '"');
    refused(call, "paperproof: --steps: expected a whole number from 1 to 1000000000, in digits, not " + word +
                      "; see paperproof compare --help\n");
  }
  for (const std::string& word : words_of("-5 0 7 150 nan 1e3 100.5 few 10000100 18446744073709551600"))
    for (const std::string before : {"", "100,"})
      refused("study scale --grid " + before + word,
              "paperproof: --grid: expected a multiple of 100 from 100 to 10000000, in digits, not " + word +
                  "; see paperproof study scale --help\n");
  refused("study scale --grid", "paperproof: --grid: expected N,... behind it; see paperproof study scale --help\n");
}

TEST_F(CommandRefuses, options_that_cannot_be) {
  const std::string sweep = "sweep paper --contender mask --quiet ";
  const std::string compare = "compare article_bullet --no-timing --quiet ";
  for (
      const auto& [before, words, says] : std::vector<std::tuple<std::string, std::string, std::string>>{
          {sweep + "--vary ",
           "speed speed= =1,2 speed=x speed=1,x speed=1:2 speed=1:2:lin speed=1:2:lin0 speed=1:2:lin1x speed=1:2:log-3 "
           "speed=0:2:log3 speed=1:2:lin99999999999999999999 speed=nan,1 speed=1:inf:lin3 speed=1e999,2 sped=1,2 '' "
           "speed=1,,2 speed=-1e300,2 speed=1:2:cubic3 unit=0.5,1 continuous=maybe,on height=-1 gravity=1e9 phase=fast",
           ""},
          {"sweep paper --quiet --contender wind_back --vary ", "unit=a,1", ""},
          {sweep + "--vary speed=1,2 ", "--vary=speed=3,4 --set=speed=1 --find-border=speed", ""},
          {sweep + "--vary speed=1,2 --shard ", "'' 0/2 3/2 1 1/ /2 a/b 1/2/3 -1/2 1/0 1.5/2 1/99999999999999999999999",
           "--shard"},
          {sweep + "--find-border ", "sped speed=1 speed=2:1 speed=x:y '' speed=1:2:lin3 height=0.001:1", ""},
          {sweep + "--vary speed=1,2 --jobs ", "0 -1 x 99999999999999999999 ''", "--jobs"},
          {sweep + "--vary speed=1,2 --limit ", "0 -1 1e3 ''", "--limit"},
          {compare + "--set ", "dt dt= =1 dt=x dt=-1 dt=0 dt=nan dt=1e999 spede=1 '' dt=1,2 gravity=1e300", ""},
          {compare + "--knob ",
           "unit unit= =1 unit=x unit=-1 unit=0 unit=nan units=1 '' iterations=0 iterations=1e9 points=5 response=both",
           "--knob"},
          {compare + "--knob ", "width=1", "--knob width=1: expected NAME=VALUE"},
          {compare + "--contender grid --knob ", "unit=1", "--knob unit=1: expected a knob of grid"},
          {compare + "--knob unit=1 --knob ", "unit=2", "--knob unit=2: expected unit once"},
          {compare + "--input ", "random random: random:-1 random:x random:1:2 '' script fixed:1",
           ": expected random:SEED with a whole number from 0 to 18446744073709551615, such as random:1\n"},
          {compare + "--scalar ", "half", "paperproof: --scalar"},
          {compare + "--mode ", "sideways", "paperproof: --mode: expected free or lockstep, not sideways"},
          {compare + "--mode free --mode ", "lockstep", "paperproof: --mode: expected once, not 2 times"},
          {compare + "--mode lockstep ", "--no-reference --contender=box2d", ""},
          {compare + "--plan ", "none", "paperproof: --plan: expected full, not none"},
          {compare, "--no-reference=no", "paperproof: --no-reference: expected nothing behind it"},
          {compare, "--quiet=yes --unknown -x --stepps", ""},
          {compare + "--contender ", "'' nobody", ""},
          {compare + "--set dt=0.01 ", "--set", ""}})
    for (const std::string& word : words_of(words)) refused(before + word, says);
}

TEST_F(CommandRefuses, names_of_nothing_and_says_which_are_near) {
  const std::string scenes =
      ": expected the name of a built-in scene (see `paperproof list scenes`), or a file that ends in .json, .tmx, "
      ".tmj, .stl or .png";
  const std::string contenders = ": expected grid, pixel_colour, ";
  const std::string commands =
      "paperproof: expected one of compare, study, work-precision, stability, sweep, merge, diff, judge, campaign, "
      "replay, report, export, convert, check, plan, demo, list; see paperproof --help\n";
  for (const auto& [arguments, says] : std::vector<std::pair<std::string, std::string>>{
           {"compare article_bulet", "article_bulet" + scenes + "; did you mean article_bullet?\n"},
           {"compare Corner-Hit", "Corner-Hit" + scenes + "; did you mean corner_to_corner_hit?\n"},
           {"plan sawtooth", "sawtooth" + scenes + "; did you mean sawtooth_1, sawtooth_4 or sawtooth_11?\n"},
           {"check nothing", "nothing" + scenes + "\n"},
           {"compare article_bullet ''", "\"\"" + scenes + "\n"},
           {"compare article_bullet --contender octagon_swep",
            "box2d or box2d_pieces (see `paperproof list contenders`); did you mean octagon_sweep?\n"},
           {"compare article_bullet --contender grid,nobody", "--contender nobody" + contenders},
           {"", commands},
           {"frobnicate", commands},
           {"study bullets",
            "paperproof study: expected one of scale, bullet, corner, seam, squeeze, field, disagreement; see paperproof "
            "study --help\n"},
           {"list scene",
            "paperproof: WHAT: expected scenes, contenders, families, knobs, metrics, parameters or schema, not scene; "
            "see "
            "paperproof "
            "list --help\n"},
           {"check", "paperproof: SCENE is required; see paperproof check --help\n"},
           {"judge nowhere.jsonl", "nowhere.jsonl: expected a file that exists; there is none\n"},
           {"compare article_bullet --files-from -", "--files-from -: expected the names of scenes"}})
    refused(arguments, says);
  for (const std::string& command : words_of("plan convert sweep merge report list")) refused(command);
  for (const char* arguments : {"check 'a\nb'", "list 'a\rb\n'", "compare article_bullet --contender 'a\nb'",
                                "convert '' ''", "compare --quiet --files-from ''", "demo nobody", "demo octagon_swep",
                                "demo mask mask", "diff one", "stability --grid=huge", "stability --contender=nobody",
                                "study bullet --grid=x", "study bullet --shard=''", "study disagreement no_such_scene",
                                "work-precision nothing", "plan article_bullet --input x", "diff one two three"})
    refused(arguments);
}

/// At most 300 bytes.
TEST_F(CommandRefuses, long_texts_in_a_line_that_keeps_file_and_place) {
  const std::string digits(100'000, '9');
  place.write("digits.json", with(good_scene, "0.016", digits));
  place.write("line.tmj", "{\"layers\":[1,oops" + std::string(8000, '\'') + "]}");
  place.write("key.json", with(good_scene, "\"dt\"", "\"" + std::string(9000, 'k') + "\": 1, \"dt\""));
  for (const auto& [arguments, says] : {std::pair{"check digits.json", "digits.json: /dt: "},
                                        {"check line.tmj", "line.tmj:1:1"},
                                        {"check key.json", "key.json: /kkk"}})
    refused(arguments, says);
  refused("compare article_bullet --steps " + digits);
}

}  // namespace
}  // namespace paperproof::compare
