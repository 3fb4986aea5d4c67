/// Files that the command carries with it: embed.cmake writes them into sources at build time.
#pragma once

#include <span>
#include <string_view>

namespace paperproof::compare {

struct EmbeddedFile {
  std::string_view name;  ///< Without its folder.
  std::string_view text;
};

// Each list is in the order in which a CMakeLists.txt names the files.
extern const std::span<const EmbeddedFile> page_files;      ///< The page; last Chart.js, MIT licence.
extern const std::span<const EmbeddedFile> built_in_files;  ///< What every scene begins with, then the built-in scenes.
extern const std::span<const EmbeddedFile> scene_schema;
extern const std::span<const EmbeddedFile> trace_schema;
extern const std::span<const EmbeddedFile> peer_schema;
extern const std::span<const EmbeddedFile> prepared_studies_file;
extern const std::span<const EmbeddedFile> families_file;
extern const std::span<const EmbeddedFile> lessons_file;      ///< What the article's bullet teaches of each technique.
extern const std::span<const EmbeddedFile> how_to_read_file;  ///< Pictures on pages.

}  // namespace paperproof::compare
