/// Reads back the records that a page carries.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace paperproof::compare {

/// The most that is read of a page [bytes]. Small: a page of many scenes does not fit. Large: a hostile file decides
/// how much memory is used.
inline constexpr std::uintmax_t most_page_bytes = 256'000'000;

/// The data of a page that ReportWriter wrote.
class PageReader {
 public:
  /// @throws std::runtime_error naming the file: it is no regular file, too large, cannot be read, or is no such page.
  explicit PageReader(const std::string& path);
  /// The page's index: see `index_json`.
  [[nodiscard]] const nlohmann::ordered_json& index() const noexcept { return index_; }
  /// The replay of a scene, as it stands there.
  [[nodiscard]] std::string replay(std::size_t scene) const;
  /// The replays of a study's cells, as they stand there; `[]` of a page from before there were any.
  [[nodiscard]] std::string cells(std::size_t study) const;

 private:
  [[nodiscard]] std::string element(const std::string& id) const;

  std::string path_;
  std::string text_;
  nlohmann::ordered_json index_;
};

}  // namespace paperproof::compare
