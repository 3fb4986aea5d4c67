/// Calls that cannot be served, of every subcommand: each ends soon, with status 2, one line that is ours, and no file
/// touched. tables/refused_calls.json has those whose files are text.
#include "compare/command_workplace.hpp"
#include "compare/table.hpp"

#include <sys/stat.h>

#include <iterator>
#include <set>
#include <tuple>

namespace paperproof::compare {
namespace {

/// Names, sizes and times: some are larger than memory.
auto files_in(const Workplace& place) {
  std::set<std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>> all;
  for (const auto& entry : std::filesystem::directory_iterator(place.path("")))
    if (std::filesystem::is_regular_file(entry.symlink_status()))
      all.emplace(entry.path().filename().string(), entry.file_size(), entry.last_write_time());
  return all;
}

/// @param says what the line has to say, where that is known.
void refused(const Workplace& place, const std::string& arguments, const std::string& says = "") {
  const auto before = files_in(place);
  // One that hangs ends with status 124. The load of the machine is not its fault.
  const Finished finished = place.run(arguments, "timeout -k 1 60");
  const std::string what = "paperproof " + arguments.substr(0, 300) + "\n" + finished.err;
  EXPECT_EQ(finished.status, 2) << what;
  EXPECT_EQ(finished.out, "") << what;
  EXPECT_EQ(finished.err.find_first_of("\n\r"), finished.err.size() - 1) << "one line: " << what;
  EXPECT_GT(finished.err.size(), 10U) << what;
  EXPECT_LE(finished.err.size(), 300U) << what;
  EXPECT_TRUE(holds(quoted(finished.err), quoted(says))) << what;
  for (const char* foreign : {"terminate", "std::", "json.exception", "basic_string", "what()", "vector", "filesystem",
                              "bad_alloc", "CLI", "stoi", "Segmentation", "AddressSanitizer", "runtime error"})
    EXPECT_EQ(finished.err.find(foreign), std::string::npos) << what;
  EXPECT_EQ(files_in(place), before) << "a file was touched by\n" << what;
}

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

TEST(CommandRefuses, scenes_that_are_none) {
  const Workplace place;
  for (const std::string end : {".json", ".tmx", ".tmj", ".stl", ".png"})
    for (const auto& [name, says] : inputs_ending_in(place, end)) {
      refused(place, "check " + name, says);
      if (end != ".json") continue;
      refused(place, "plan " + name, says);
      refused(place, "compare " + name + " --no-timing --rows o.json", says);
      refused(place, "convert " + name + " o.json", says);
      refused(place, "sweep " + name + " --vary dt=0.01,0.02 --rows o.jsonl", says);
    }
  for (const auto& [name, says] : inputs_ending_in(place, "")) {
    refused(place, "compare --files-from " + name, says);
    refused(place, "check " + name);
  }
}

TEST(CommandRefuses, rows_that_are_no_files_of_their_kind) {
  const Workplace place;
  const std::string row =
      R"({"scene":"paper","contender":"mask","scalar":"double","mode":"free","steps":60,"verdict":"holds"})"
      "\n";
  const std::string header = "{\"paperproof_rows\":1,\"environment\":{\"compiler\":\"any\"}}\n";
  place.write("good.jsonl", header + row);
  const auto read = [&](const std::string& name, const std::string& says) {
    refused(place, "merge good.jsonl " + name + " --rows o.jsonl", says);
    refused(place, "diff " + name + " good.jsonl", says);
    refused(place, "report o.html good.jsonl " + name, says);
  };
  for (const auto& [name, says] : inputs_ending_in(place, ".jsonl")) {
    read(name, says);
    if (!name.starts_with("empty") && !name.starts_with("missing"))  // with these a sweep begins
      refused(place, "sweep paper --vary speed=1,2 --contender mask --resume --rows " + name,
              name.starts_with("loop") ? "cannot be written" : says);
  }
  refused(place, "diff good.jsonl pipe.jsonl", "pipe.jsonl: expected a regular file; this is a pipe");
  place.write("fault.jsonl", header + with(row, "\"mask\"", "\"mask\xff\"") + row);  // no text
  read("fault.jsonl", "fault.jsonl:2:35: expected JSON");
  for (const std::string end : {".json", ".html"})
    for (const auto& [name, says] : inputs_ending_in(place, end)) refused(place, "report o.html " + name, says);
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Every call of the row is refused, once for each word of `each`.
void check_refused(const Json& row) {
  const Workplace place;
  if (row.contains("first")) {
    ASSERT_EQ(place.shell(row["first"]), 0);
  }
  for (const auto& [name, text] : object_in(row, "files").items()) place.write(name, quoted(text_in(text)));
  for (const std::string& word : row.contains("each") ? words_of(row["each"]) : std::vector<std::string>{""})
    for (const Json& call : row.at("calls"))
      refused(place, filled(call, {{"each", word}}), filled(row.value("says", ""), {{"each", word}}));
}

const bool table = table_tests("refused_calls.json", " first files each calls says ", check_refused);

}  // namespace
}  // namespace paperproof::compare
