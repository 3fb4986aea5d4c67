/// The command as a user runs it, in a folder of the running test's own.
#pragma once

#include "compare/table.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

struct Finished {
  int status = -1;
  std::string out;
  std::string err;
};

inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::vector<nlohmann::json> json_lines(const std::string& text) {
  std::vector<nlohmann::json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

/// The data in an element of a page.
inline nlohmann::json element(const std::string& page, const std::string& id) {
  const std::string opening = "id=\"" + id + "\">";
  const std::size_t from = page.find(opening) + opening.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// A replay that a page carries as a JSON string, as text: see `packed`.
inline std::string unpacked(const std::string& json_string) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : json_string) {
    if (digits.find(c) == std::string_view::npos) continue;
    bits = bits << 6U | static_cast<unsigned>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> static_cast<unsigned>(count -= 8));
  }
  std::string text(std::size_t{1} << 24U, '\0');
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, MAX_WBITS + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

/// JSON Lines of rows without their header.
inline std::string rows_in(const std::string& text) { return text.substr(text.find('\n') + 1); }

/// A folder in which the command runs.
class Workplace : public SceneFiles {
 public:
  Workplace() {}  // without it clang refuses `const Workplace place;`
  /// The status of a line of shell code in the folder. There $SOURCES is the folder of this project.
  [[nodiscard]] int shell(const std::string& line) const {
    const std::string begin = "export SOURCES='" PAPERPROOF_SOURCE_DIR "' && cd '" + path("") + "' && ";
    const int raw = std::system((begin + line).c_str());
    return WIFEXITED(raw) ? WEXITSTATUS(raw) : -1;
  }
  /// @param arguments as typed in a shell, where its output may be sent elsewhere. @param before what stands before the
  /// command there.
  [[nodiscard]] Finished run(const std::string& arguments, const std::string& before = "") const {
    std::string folder = path("");
    folder.pop_back();  // the slash. The outputs lie beside the folder, not in it
    const std::string out = folder + ".out";
    const std::string err = folder + ".err";
    const int status =
        shell(before + " '" PAPERPROOF_COMMAND "' </dev/null >'" + out + "' 2>'" + err + "' " + arguments);
    Finished finished{status, content(out), content(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return finished;
  }
  /// Every file with what is in it.
  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path("")))
      if (entry.is_regular_file()) all[entry.path().filename()] = content(entry.path());
    return all;
  }
};

/// A test with such a folder.
class CommandTest : public testing::Test {
 protected:
  /// Ends with status 0.
  Finished runs(const std::string& arguments) const {
    Finished finished = place.run(arguments);
    EXPECT_EQ(finished.status, 0) << arguments << "\n" << finished.err;
    return finished;
  }
  [[nodiscard]] std::string written(const std::string& name) const { return content(place.path(name)); }

  [[nodiscard]] std::vector<nlohmann::json> rows_of(const std::string& name) const {
    return json_lines(rows_in(written(name)));
  }

  const Workplace place;
};

/// What rows of tables/calls.json say of calls.
void check_call(const Json& row);
inline constexpr const char* keys_of_calls =
    " files before first calls status out not_out says err row reason not_reason ";

/// A scene that runs; the bad ones differ from it in one place.
inline constexpr const char* good_scene = R"({
  "paperproof_scene": 1, "name": "good", "gravity": [0, -30], "dt": 0.016, "steps": 20,
  "character": { "position": [0, 3] },
  "scenery": [ { "id": "floor", "polygon": [[-4,0],[4,0],[4,-1],[-4,-1]] } ]
})";

inline std::string good_with(std::string_view from, std::string_view to) { return with(good_scene, from, to); }

}  // namespace paperproof::compare
