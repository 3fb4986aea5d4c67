/// Folders of JSON files, each of which lists entries.
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::test {

/// Calls `use` for each entry of the list in each file of a folder, file by file in alphabetical order: with the stem
/// of the file, with what the file says besides its list, and with the entry. @throws std::invalid_argument that names
/// the file.
template <class Use>
void for_each_entry(const std::string& folder, const char* list, const Use& use) {
  using Json = nlohmann::ordered_json;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const std::filesystem::path& path : paths) {
    try {
      Json file = Json::parse(std::ifstream(path));
      const Json entries = std::move(file.at(list));
      file.erase(list);
      for (const Json& entry : entries) use(path.stem().string(), file, entry);
    } catch (const std::exception& error) {
      throw std::invalid_argument(path.string() + ": " + error.what());
    }
  }
}

}  // namespace paperproof::test
