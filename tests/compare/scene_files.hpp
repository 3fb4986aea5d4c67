/// Files that a test writes for itself, and what a loader says about them.
#pragma once

#include "scenes/load.hpp"
#include "support/refusal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// A folder of its own, removed at the end. The same test may run elsewhere at the same time.
class SceneFiles {
 public:
  SceneFiles() {
    static int count = 0;
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("paperproof_") + std::to_string(getpid()) + "_" + test->test_suite_name() + "_" +
               test->name() + std::to_string(count++));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~SceneFiles() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  SceneFiles(const SceneFiles&) = delete;
  SceneFiles& operator=(const SceneFiles&) = delete;

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// @returns the path, as a user would give it.
  std::string write(const std::string& name, std::string_view text) const {
    const std::filesystem::path file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }

  [[nodiscard]] Scene load(const std::string& name, std::string_view text) const {
    return load_scenes(write(name, text)).front();
  }

  /// The message that refuses a file, without the name of the file with which it begins; else " was accepted".
  [[nodiscard]] std::string complaint(const std::string& name, std::string_view text) const {
    return complaint_about(write(name, text));
  }
  [[nodiscard]] static std::string complaint_about(const std::string& path) {
    const std::string message =
        paperproof::test::refusal_by<InputError>([&] { (void)load_scenes(path); }, path + " was accepted");
    EXPECT_EQ(message.compare(0, path.size(), path), 0) << message << "\ndoes not begin with " << path;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message.substr(path.size());
  }

 private:
  std::filesystem::path folder_;
};

/// A test with such a folder.
class SceneFilesTest : public testing::Test {
 protected:
  const SceneFiles files;
};

/// The same text with the first `from` replaced by `to`; fails the test if there is none.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "nothing to replace: " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

/// Text with " for ', so that tables of JSON can be read.
inline std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '\'', '"');
  return text;
}

/// What blocks, one after the other: "a: box 0 0 2 1; b: polygon 0 0 1 0 0 1". Polygons begin with their least corner.
inline std::string solids_of(const Scene& scene) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < scene.ids.size(); ++i) {
    const ColliderDef& def = scene.scenery.colliders[i];
    std::vector<Vec2d> points = def.points;
    text << (i == 0 ? "" : "; ") << scene.ids[i];
    if (def.shape == ColliderDef::Shape::polygon) {
      const auto before = [](const Vec2d& a, const Vec2d& b) {
        return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
      };
      std::rotate(points.begin(), std::min_element(points.begin(), points.end(), before), points.end());
      const bool is_box = points.size() == 4 && points[0].x() + points[2].x() == points[1].x() + points[3].x() &&
                          (points[0].x() == points[1].x() || points[0].y() == points[1].y());
      if (is_box) points = {points[0], points[2]};
      text << (is_box ? ": box" : ": polygon");
    } else {
      text << (def.shape == ColliderDef::Shape::chain ? ": chain" : ": circle");
    }
    for (const Vec2d& point : points) text << ' ' << point.x() + 0.0 << ' ' << point.y() + 0.0;
    if (def.radius > 0) text << " radius " << def.radius;
    if (def.one_way) text << " one-way " << def.one_way->x() << ' ' << def.one_way->y();
    if (def.mover != no_mover) text << " of mover " << def.mover;
  }
  return text.str();
}

inline testing::AssertionResult holds(const std::string& text, std::string_view part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" does not hold \"" << part << '"';
}

inline testing::AssertionResult begins(const std::string& text, std::string_view part) {
  if (text.compare(0, part.size(), part) == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" does not begin with \"" << part << '"';
}

}  // namespace paperproof::compare
