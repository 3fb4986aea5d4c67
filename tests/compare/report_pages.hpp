/// What tests of the report share: a folder of their own, and the data of a page.
#pragma once

#include "report/report.hpp"

#include "compare/sample_report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace paperproof::compare {

using nlohmann::json;

/// A directory of its own for each test, gone afterwards.
class ReportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::temp_directory_path() / ("paperproof_" + name + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path() const { return (folder_ / "report.html").string(); }

  [[nodiscard]] std::string page(const Report& report, const ReportOptions& options = {}) const {
    write_report(path(), report, options);
    return read(path());
  }

  static std::string read(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  [[nodiscard]] std::size_t files_left() const {
    const std::filesystem::directory_iterator all(folder_);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

 private:
  std::filesystem::path folder_;
};

inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// What stands in the script element with this id, as a browser would find it.
inline json data(const std::string& page, const std::string& id) {
  const std::string opening = "id=\"" + id + "\">";
  const std::size_t begin = page.find(opening);
  if (begin == std::string::npos) throw std::runtime_error("no element " + id);
  const std::size_t from = begin + opening.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

inline Report report_of(const ReportScene& scene) {
  Report report;
  report.scenes = {scene};
  return report;
}

/// The first run of the sample's walk, with this many steps of 60 mm.
inline ReportScene walk_of(int steps) {
  ReportScene scene = sample_report().scenes[1];
  scene.runs.resize(1);
  std::vector<TraceStep>& all = scene.runs[0].steps;
  const TraceStep model = all.front();
  all.assign(static_cast<std::size_t>(steps), model);
  for (int i = 0; i < steps; ++i) {
    TraceStep& step = all[static_cast<std::size_t>(i)];
    step.step = i;
    step.path[0].position.x() = 0.06 * i;
    step.path[1].position.x() = 0.06 * (i + 1);
    step.contacts[0].point.x() = 0.06 * (i + 1);
  }
  return scene;
}

}  // namespace paperproof::compare
