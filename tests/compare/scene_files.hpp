/// Files that a test writes for itself, and what a loader says about them.
#pragma once

#include "scenes/load.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// A folder of the running test's own, removed at the end.
class SceneFiles {
 public:
  SceneFiles() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("paperproof_") + test->test_suite_name() + "_" + test->name());
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

  /// What is said about a file, without the file's name that it has to begin with. Empty if nothing is said.
  [[nodiscard]] std::string complaint(const std::string& name, std::string_view text) const {
    return complaint_about(write(name, text));
  }
  [[nodiscard]] static std::string complaint_about(const std::string& path) {
    try {
      (void)load_scenes(path);
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.compare(0, path.size(), path), 0) << message << "\ndoes not begin with " << path;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message.substr(path.size());
    }
    ADD_FAILURE() << path << " was accepted";
    return {};
  }

 private:
  std::filesystem::path folder_;
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

inline testing::AssertionResult holds(const std::string& text, std::string_view part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" does not hold \"" << part << '"';
}

inline testing::AssertionResult begins(const std::string& text, std::string_view part) {
  if (text.compare(0, part.size(), part) == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" does not begin with \"" << part << '"';
}

}  // namespace paperproof::compare
