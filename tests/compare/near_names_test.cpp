/// What is said to somebody who mistyped a name.
#include "near_names.hpp"

#include "compare/table.hpp"

namespace paperproof::compare {
namespace {

const bool table = table_tests("near_names.json", " known typed near ", [](const Json& row) {
  EXPECT_EQ(Json(near_names(row["typed"].get<std::string>(), row["known"].get<std::vector<std::string>>())),
            row["near"]);
});

}  // namespace
}  // namespace paperproof::compare
