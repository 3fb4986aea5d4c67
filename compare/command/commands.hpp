/// The commands that take names and files, and no more. All print to standard output. They throw InputError for what
/// cannot be used, and std::runtime_error where an output cannot be written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// Writes a map or a built-in scene as a JSON scene.
/// @return 0.
int convert_command(const std::string& from, const std::string& to);

/// Questions of first contact with exact answers, as JSON Lines or CSV: see compare/queries/README.md.
/// @param scenes to go through beside the random runs; maps, too. @return 0.
int export_queries_command(int count, const std::string& path, const std::vector<std::string>& scenes);

/// The article's bullet, one technique at a time.
/// @param technique empty: all, in the order of the article.
/// @return 0.
int demo_command(const std::string& technique);

/// @param what scenes, contenders, families, knobs, metrics, parameters or schema.
/// @return 0.
int list_command(const std::string& what);
/// Prints what scenes hold. @return 0.
int check_command(const std::vector<std::string>& scenes);
/// Prints what runs of scenes leave out. @param seed of a random input that replaces the scenes' own. @return 0.
int plan_command(const std::vector<std::string>& scenes, const std::optional<std::uint64_t>& seed);

/// Makes one page of rows and of other pages; it keeps the replays and pictures of those.
/// For heat maps of rows some of their cases are run again: see `add_cell_replays`.
/// @param inputs files of rows (.jsonl, .json) and pages (.html). Pages are shown first, then rows, each in this order.
/// @return 0.
int report_command(const std::string& path, const std::vector<std::string>& inputs);

/// Puts the rows of several files together: shards of one sweep in the order of the whole one, anything else file by
/// file, each Case once. Shards that are missing, or not complete, cannot be used.
/// @return 0.
int merge_command(const std::vector<std::string>& files, const std::string& rows_path);

/// Names what changed between two files of rows: for each Case that both have every number and word that differs, but
/// for costs; and the Cases that only one has.
/// @return 0 where nothing changed, else 1.
int diff_command(const std::string& before, const std::string& after);

}  // namespace paperproof::compare
