/// Which commit this was built from.
#pragma once

#include <string_view>

namespace paperproof::compare {

/// 12 hexadecimal digits, with a `+` where files were changed since; empty outside of a clone.
[[nodiscard]] std::string_view built_commit() noexcept;

}  // namespace paperproof::compare
