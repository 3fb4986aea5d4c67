/// What the command refuses: one line, status 2, and no file touched.
#include "compare/command_workplace.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

/// Runs one unusable input with every kind of output asked for, and checks all that is promised of it.
void expect_refused(const Workplace& place, const std::string& arguments, const std::string& begin,
                    const std::string& part = "") {
  place.write("rows.json", "rows of an earlier run");
  for (const char* quiet : {"", " --quiet", " --json"}) {
    const auto before = place.files();
    const Finished finished =
        place.run("compare --no-timing --rows rows.json --report report.html --trace trace " + arguments + quiet);
    EXPECT_EQ(finished.status, 2) << arguments;
    EXPECT_TRUE(begins(finished.err, begin)) << arguments;
    EXPECT_TRUE(holds(finished.err, part)) << arguments;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << "one line:\n" << finished.err;
    EXPECT_EQ(finished.out, "") << arguments;
    EXPECT_EQ(place.files(), before) << arguments << ": an output file was touched";
  }
}

TEST(Command, refuses_a_scene_file_that_cannot_be_used) {
  struct Case {
    std::string file;
    std::string text;
    std::string begin;
    std::string part;
  };
  const Workplace place;
  for (const Case& bad : {
           Case{"json.json", "{ \"paperproof_scene\": 1,\n oops", "json.json:2:", "expected JSON"},
           Case{"xml.tmx", "<map><layer></map>", "xml.tmx:1", ""},
           Case{"level.stl", "(supertux-level\n (version 2)", "level.stl:", ""},
           Case{"key.json", good_with("\"gravity\"", "\"gravitas\": 1, \"gravity\""), "key.json: /gravitas",
                "unknown key"},
           Case{"twice.json", good_with("\"dt\"", "\"steps\": 3, \"dt\""), "twice.json: /steps", "once"},
           Case{"bow.json", good_with("[4,0],[4,-1]", "[4,-1],[4,0]"), "bow.json: /scenery/0", "floor"},
           Case{"flat.json", good_with("[[-4,0],[4,0],[4,-1],[-4,-1]]", "[[-4,0],[0,0],[4,0]]"),
                "flat.json: /scenery/0", "floor"},
           Case{"huge.json", good_with("[0, -30]", "[0, 1e999]"), "huge.json:2", "finite"},
           Case{"nan.json", good_with("[0, -30]", "[0, NaN]"), "nan.json:2", ""},
           Case{"still.json", good_with("0.016", "0"), "still.json: /dt", "greater than 0"},
           Case{"back.json", good_with("0.016", "-0.016"), "back.json: /dt", "greater than 0"},
           Case{"never.json", good_with("\"steps\": 20", "\"steps\": -1"), "never.json: /steps", "whole number"},
           Case{"missing.json", good_with("\"dt\": 0.016, ", ""), "missing.json: /dt", "missing"},
           Case{"empty.json", good_with("{ \"id\": \"floor\", \"polygon\": [[-4,0],[4,0],[4,-1],[-4,-1]] }", ""),
                "empty.json: /scenery", "empty"},
           Case{"inside.json", good_with("[0, 3]", "[0, 0.5]"), "inside.json: /character", "floor"},
           Case{"type.json", good_with("0.016", "\"fast\""), "type.json: /dt", "number"},
           Case{"name.png", "not a scene", "name.png: ", "expected"},
       }) {
    place.write(bad.file, bad.text);
    expect_refused(place, bad.file, bad.begin, bad.part);
  }
}

TEST(Command, refuses_a_map_without_a_solid) {
  const Workplace place;
  place.write("air.tmx",
              "<?xml version=\"1.0\"?>\n<map version=\"1.5\" orientation=\"orthogonal\" width=\"2\" height=\"1\" "
              "tilewidth=\"16\" tileheight=\"16\" infinite=\"0\">\n<layer id=\"1\" name=\"solid\" width=\"2\" "
              "height=\"1\"><data encoding=\"csv\">0,0</data></layer>\n</map>\n");
  expect_refused(place, "air.tmx", "air.tmx", "solid");
}

TEST(Command, refuses_what_is_not_there) {
  const Workplace place;
  expect_refused(place, "nowhere.json", "nowhere.json: ");
  expect_refused(place, "nowhere.tmx", "nowhere.tmx: ");
  expect_refused(place, "nowhere.stl", "nowhere.stl: ");
  place.write("good.json", good_scene);
  expect_refused(place, "good.json nowhere.json", "nowhere.json: ");
}

TEST(Command, refuses_options_that_cannot_be) {
  const Workplace place;
  expect_refused(place, "article_bullet --scalar half", "paperproof: --scalar", "half");
  expect_refused(place, "article_bullet --input fixed:1", "--input fixed:1: ", "random:SEED");
  expect_refused(place, "article_bullet --input random:x", "--input random:x: ", "random:SEED");
  expect_refused(place, "article_bullet --input random:-1", "--input random:-1: ", "from 0 to 18446744073709551615");
  expect_refused(place, "article_bullet --input ''", "--input \"\": ", "random:SEED");
  expect_refused(place, "article_bullet --mode sideways",
                 "paperproof: --mode: expected free or lockstep, not sideways");
  expect_refused(place, "article_bullet --plan some", "paperproof: --plan: expected full, not some");
  expect_refused(place, "article_bullet --stepps 5", "paperproof: ", "--stepps");
  expect_refused(place, "article_bullet --mode free --mode lockstep", "paperproof: --mode: expected once, not 2 times");
  expect_refused(place, "article_bullet --no-reference=no", "paperproof: --no-reference: expected nothing behind it");
}

TEST(Command, points_to_the_names_there_are_and_says_which_is_near) {
  const Workplace place;
  const std::string scenes =
      ": expected the name of a built-in scene (see `paperproof list scenes`), or a file that ends in .json, .tmx, "
      ".tmj, .stl or .png";
  expect_refused(place, "article_bulet", "article_bulet" + scenes + "; did you mean article_bullet?\n");
  expect_refused(place, "Corner-Hit", "Corner-Hit" + scenes + "; did you mean corner_to_corner_hit?\n");
  expect_refused(place, "gallary", "gallary" + scenes + "; did you mean technique_gallery?\n");
  expect_refused(place, "sawtooth", "sawtooth" + scenes + "; did you mean sawtooth_1, sawtooth_4 or sawtooth_11?\n");
  expect_refused(place, "nothing", "nothing" + scenes + "\n");
  expect_refused(place, "''", "\"\"" + scenes + "\n");
  const std::string contenders = ": expected grid, pixel_colour, ";
  expect_refused(place, "article_bullet --contender octagon_swep", "--contender octagon_swep" + contenders,
                 "box2d or box2d_pieces (see `paperproof list contenders`); did you mean octagon_sweep?\n");
  expect_refused(place, "article_bullet --contender grid,nobody", "--contender nobody" + contenders,
                 "(see `paperproof list contenders`)\n");
  const Finished demo = place.run("demo octagon_swep");
  EXPECT_EQ(demo.status, 2);
  EXPECT_TRUE(begins(demo.err, "demo octagon_swep" + contenders)) << demo.err;
}

TEST(Command, says_what_merge_and_diff_take) {
  const Workplace place;
  ASSERT_EQ(place.run("compare article_bullet --contender mask --no-timing --quiet --rows rows.json").status, 0);
  const std::string takes =
      "rows.json: expected rows as JSON Lines, as `--rows FILE.jsonl` writes them "
      "(`\"paperproof_rows\": 1` in the first line)\n";
  for (const char* arguments : {"merge rows.json --rows out.jsonl", "diff rows.json rows.json"}) {
    const Finished finished = place.run(arguments);
    EXPECT_EQ(finished.status, 2) << arguments;
    EXPECT_EQ(finished.err, takes) << arguments;
  }
}

/// Runs what has to be refused before anything is done, and gives the one line that it says.
std::string refusal_of(const Workplace& place, const std::string& arguments) {
  const Finished finished = place.run(arguments);
  EXPECT_EQ(finished.status, 2) << arguments;
  EXPECT_EQ(finished.out, "") << arguments;
  EXPECT_TRUE(place.files().empty()) << arguments;
  return finished.err;
}

TEST(Command, refuses_numbers_that_make_no_sense_in_words) {
  const Workplace place;
  for (const std::string number : {"-5", "0", "nan", "inf", "1e3", "2.5", "many", "+7", "0x10", "99999999999999999999",
                                   "1000000001", "5,5", "''", "' '"}) {
    std::string seen = number;
    std::replace(seen.begin(), seen.end(), '\'', '"');
    EXPECT_EQ(refusal_of(place, "compare article_bullet --steps " + number),
              "paperproof: --steps: expected a whole number from 1 to 1000000000, in digits, not " + seen +
                  "; see paperproof compare --help\n");
  }
  for (const std::string number :
       {"-5", "0", "150", "nan", "1e3", "100.5", "few", "10000100", "18446744073709551600", "99999999999999999999"})
    for (const std::string before : {"", "100,"})
      EXPECT_EQ(refusal_of(place, "study scale --grid " + before + number),
                "paperproof: --grid: expected a multiple of 100 from 100 to 10000000, in digits, not " + number +
                    "; see paperproof study scale --help\n");
  EXPECT_EQ(refusal_of(place, "study scale --grid"),
            "paperproof: --grid: expected N,... behind it; see paperproof study scale --help\n");
}

TEST(Command, refuses_an_output_without_a_name) {
  const Workplace place;
  for (const std::string option : {"--rows", "--report", "--trace"})
    EXPECT_EQ(refusal_of(place, "compare article_bullet " + option + " ''"),
              "paperproof: " + option + ": expected a file name, not \"\"; see paperproof compare --help\n");
}

TEST(Command, complains_in_one_line_whatever_was_typed) {
  const Workplace place;
  for (const char* arguments : {"check 'a\nb'", "compare article_bullet --steps '5\n6'",
                                "compare article_bullet --contender 'a\nb'", "list 'a\rb\n'"}) {
    const std::string refusal = refusal_of(place, arguments);
    EXPECT_EQ(refusal.find_first_of("\n\r"), refusal.size() - 1) << refusal;
  }
}

TEST(Command, names_what_could_stand_where_a_word_is_missing_or_unknown) {
  const Workplace place;
  const std::string commands =
      "paperproof: expected one of compare, study, work-precision, stability, sweep, merge, diff, judge, campaign, "
      "replay, report, convert, check, plan, demo, list; see paperproof --help\n";
  for (const auto& [arguments, line] : {std::pair<std::string, std::string>{"", commands},
                                        {"frobnicate", commands},
                                        {"study bullets",
                                         "paperproof study: expected one of scale, bullet, corner, seam, squeeze, "
                                         "disagreement; see paperproof study --help\n"},
                                        {"list scene",
                                         "paperproof: WHAT: expected scenes, contenders, knobs, metrics or parameters, "
                                         "not scene; see paperproof list --help\n"},
                                        {"check", "paperproof: SCENE is required; see paperproof check --help\n"}}) {
    const Finished finished = place.run(arguments);
    EXPECT_EQ(finished.status, 2) << arguments;
    EXPECT_EQ(finished.err, line);
    EXPECT_EQ(finished.out, "");
  }
  EXPECT_TRUE(holds(place.run("compare --help").out, "--no-timing                 Without measuring"));
}

TEST(Command, refuses_an_output_that_cannot_be_written) {
  const Workplace place;
  const auto before = place.files();
  for (const char* option : {"--rows", "--report", "--trace"}) {
    const Finished finished =
        place.run(std::string("compare article_bullet --no-timing --quiet ") + option + " no_such_folder/out");
    EXPECT_EQ(finished.status, 2) << option;
    EXPECT_TRUE(begins(finished.err, "no_such_folder/out")) << option;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_EQ(finished.out, "") << option;
  }
  EXPECT_EQ(place.files(), before);
}

TEST(Command, refuses_an_output_that_cannot_be_written_before_it_runs_anything) {
  const Workplace place;
  // The first scene would say that it ran; the work would take minutes.
  for (const char* option : {"--rows", "--report", "--trace"}) {
    const Finished finished = place.run(std::string("compare article_bullet long_rest ") + option + " no_folder/out");
    EXPECT_EQ(finished.status, 2) << option;
    EXPECT_EQ(finished.out, "") << option;
  }
  const Finished text = place.run("compare article_bullet --rows out.txt");
  EXPECT_EQ(text.status, 2);
  EXPECT_TRUE(holds(text.err, "expected a name that ends in .json, .jsonl or .csv, not out.txt")) << text.err;
  const Finished directory = place.run("compare article_bullet --rows .");
  EXPECT_EQ(directory.status, 2);
  EXPECT_TRUE(begins(directory.err, ".: cannot be written: it is a directory"));
}

TEST(Command, refuses_one_file_for_two_purposes) {
  const Workplace place;
  place.write("good.json", good_scene);
  for (const auto& [options, part] :
       {std::pair{"--rows out --report ./out", "--report ./out: expected another file than --rows"},
        {"--rows good.json", "--rows good.json: expected another file than the scene good.json"},
        {"--trace t --rows t.good.octagon_sweep.double.jsonl", "expected another file than a trace"}}) {
    const auto before = place.files();
    const Finished finished = place.run(std::string("compare good.json --no-timing ") + options);
    EXPECT_EQ(finished.status, 2) << options;
    EXPECT_TRUE(holds(finished.err, part));
    EXPECT_EQ(finished.out, "");
    EXPECT_EQ(place.files(), before);
  }
}

TEST(Command, refuses_one_file_for_two_results_of_a_study) {
  const Workplace place;
  EXPECT_EQ(refusal_of(place, "study scale --grid 100 --rows out --report ./out"),
            "--report ./out: expected another file than --rows\n");
}

TEST(Command, refuses_scenes_whose_traces_would_have_one_name) {
  const Workplace place;
  place.write("a.json", good_with("\"good\"", "\"a/b\""));
  place.write("b.json", good_with("\"good\"", "\"a_b\""));
  const Finished finished = place.run("compare a.json b.json --no-timing --trace t");
  EXPECT_EQ(finished.status, 2);
  EXPECT_TRUE(begins(finished.err, "b.json: expected another name than a_b"));
  EXPECT_EQ(place.run("compare a.json b.json --no-timing --quiet --contender octagon_sweep").status, 0);
}

TEST(Command, refuses_knobs_that_cannot_be_turned) {
  const Workplace place;
  expect_refused(place, "article_bullet --knob width=1", "--knob width=1: expected NAME=VALUE", "pixels_per_tile");
  expect_refused(place, "article_bullet --knob unit=-1", "--knob unit=-1: unit: must be a positive length");
  expect_refused(place, "article_bullet --contender grid --knob unit=1", "--knob unit=1: expected a knob of grid");
  expect_refused(place, "article_bullet --knob unit=1 --knob unit=2", "--knob unit=2: expected unit once");
}

}  // namespace
}  // namespace paperproof::compare
