/// The numbers of a tile layer where they are packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// A tile number as stored: the lower 28 bits say which tile, the upper ones how it is flipped.
using TileNumber = std::uint32_t;

/// Base64 of little-endian 32-bit numbers.
/// @param compression "" (none), "zlib", "gzip" or "zstd".
/// @throws InputError at `where` for text that is not base64, a stream that cannot be unpacked, another count.
[[nodiscard]] std::vector<TileNumber> decode_base64(std::string_view text, std::string_view compression,
                                                    std::size_t count, const std::string& where);

}  // namespace paperproof::compare
