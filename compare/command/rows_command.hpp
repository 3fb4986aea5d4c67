/// `paperproof merge` and `paperproof diff`: rows in, rows or words out.
#pragma once

#include <string>
#include <vector>

namespace paperproof::compare {

/// Puts the rows of several files together: shards of one sweep in the order of the whole one, anything else file by
/// file, each Case once.
/// @return 0.
/// @throws InputError for a file that holds no rows, and where shards are missing or not complete.
int merge_command(const std::vector<std::string>& files, const std::string& rows_path);

/// Names what changed between two files of rows: for each Case that both have every number and word that differs, but
/// for costs; and the Cases that only one has.
/// @return 0 where nothing changed, else 1.
/// @throws InputError for a file that holds no rows.
int diff_command(const std::string& before, const std::string& after);

}  // namespace paperproof::compare
