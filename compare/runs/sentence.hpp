/// The sentence under a table: who is right where the contenders differ.
#pragma once

#include "records/row.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

[[nodiscard]] std::string who_is_right(const std::vector<Row>& rows);

}  // namespace paperproof::compare
