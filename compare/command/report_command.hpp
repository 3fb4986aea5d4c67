/// `paperproof report`: records in, one page out.
#pragma once

#include <string>
#include <vector>

namespace paperproof::compare {

/// Makes one page of rows and of pages that `--report` has written, whose replays and pictures are taken over.
/// For heat maps of rows some of their cases are run again: see `add_cell_replays`.
/// @param inputs files of rows (.jsonl, .json) and pages (.html). Pages are shown first, then rows, each in this order.
/// @return 0.
/// @throws InputError for what is neither, std::runtime_error where the page cannot be written.
int report_command(const std::string& path, const std::vector<std::string>& inputs);

}  // namespace paperproof::compare
