#include "records/commit.hpp"

#include "records/built_commit.hpp"

namespace paperproof::compare {

std::string_view built_commit() noexcept { return PAPERPROOF_COMMIT; }

}  // namespace paperproof::compare
