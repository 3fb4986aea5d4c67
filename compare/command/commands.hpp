/// The commands that take names and files, and no more. All print to standard output. They throw InputError for what
/// cannot be used, and std::runtime_error where an output cannot be written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What these commands are given: each takes some of it.
struct Given {
  std::string what;                   ///< A scene to `convert`, a technique to `demo`, or which names to `list`.
  std::vector<std::string> names;     ///< Of scenes or files.
  std::string to;                     ///< Where the result goes.
  std::optional<std::uint64_t> seed;  ///< For `plan`: of a random input that replaces the scenes' own.
  int count = 100'000;                ///< Of questions to `export`.
};

/// Writes a map or a built-in scene as a JSON scene.
/// @return 0.
int convert_command(const Given& given);

/// Questions of first contact with exact answers, as JSON Lines or CSV: see compare/queries/README.md.
/// @param given names of scenes to go through beside the random runs; maps, too. @return 0.
int export_queries_command(const Given& given);

/// The article's bullet, one technique at a time; without one all, in the order of the article.
/// @return 0.
int demo_command(const Given& given);

/// Of scenes, contenders, families, knobs, metrics, parameters or the schema.
/// @return 0.
int list_command(const Given& given);
/// Prints what scenes hold. @return 0.
int check_command(const Given& given);
/// Prints what runs of scenes leave out. @return 0.
int plan_command(const Given& given);

/// Makes one page of rows and of other pages; it keeps the replays and pictures of those.
/// For heat maps of rows some of their cases are run again: see `add_cell_replays`.
/// @param given files of rows (.jsonl, .json) and pages (.html). Pages are shown first, then rows, each in this order.
/// @return 0.
int report_command(const Given& given);

/// Puts the rows of several files together: shards of one sweep in the order of the whole one, anything else file by
/// file, each Case once. Shards that are missing, or not complete, cannot be used.
/// @return 0.
int merge_command(const Given& given);

/// Names what changed between two files of rows: for each Case that both have every number and word that differs, but
/// for costs; and the Cases that only one has.
/// @return 0 where nothing changed, else 1.
int diff_command(const Given& given);

}  // namespace paperproof::compare
