#include "scenes/tile_data.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include "scenes/input_error.hpp"

namespace paperproof::compare {

namespace {

using Bytes = std::vector<unsigned char>;

constexpr bool is_xml_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

constexpr std::string_view base64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

Bytes unpack_base64(std::string_view text, const std::string& where) {
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  std::size_t digits = 0;
  std::size_t padding = 0;
  for (const char c : text) {
    if (is_xml_space(c)) continue;
    const std::size_t value = base64.find(c);
    if (c == '=') {
      ++padding;
    } else if (value == base64.npos || padding > 0) {
      refuse(where, fmt::format("expected base64; \"{}\" does not belong there", c));
    }
    bits = bits << 6U | (c == '=' ? 0 : static_cast<std::uint32_t>(value));
    if (++digits % 4 != 0) continue;
    for (const unsigned shift : {16U, 8U, 0U}) bytes.push_back(static_cast<unsigned char>(bits >> shift));
    bits = 0;
  }
  if (digits % 4 != 0 || padding > 2)
    refuse(where, "expected base64; it is cut off, its length is not a multiple of 4");
  bytes.resize(bytes.size() - padding);
  return bytes;
}

/// zlib and gzip, told apart by their headers. At most one byte more than `size` comes out, which is enough to see that
/// there is too much.
Bytes unpack_deflate(Bytes& packed, std::size_t size, const std::string& where) {
  Bytes bytes(size + 1);
  z_stream stream{};
  constexpr int detect_header = 15 + 32;
  if (inflateInit2(&stream, detect_header) != Z_OK) refuse(where, "not enough memory to unpack the tiles");
  stream.next_in = packed.data();
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = bytes.data();
  stream.avail_out = static_cast<uInt>(bytes.size());
  const int status = inflate(&stream, Z_FINISH);
  const std::size_t produced = bytes.size() - stream.avail_out;
  inflateEnd(&stream);
  const bool too_long = status != Z_STREAM_END && stream.avail_out == 0;
  if (status != Z_STREAM_END && !too_long) refuse(where, "expected zlib or gzip data; it is corrupt or cut off");
  bytes.resize(produced);
  return bytes;
}

Bytes unpack_zstd(const Bytes& packed, std::size_t size, const std::string& where) {
  Bytes bytes(size + 1);
  const std::size_t produced = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
  if (ZSTD_isError(produced) != 0) {
    refuse(where, fmt::format("expected zstd data: {}", ZSTD_getErrorName(produced)));
  }
  bytes.resize(produced);
  return bytes;
}

Bytes unpack(Bytes packed, std::string_view compression, std::size_t size, const std::string& where) {
  if (compression.empty()) return packed;
  if (compression == "zlib" || compression == "gzip") return unpack_deflate(packed, size, where);
  if (compression == "zstd") return unpack_zstd(packed, size, where);
  refuse(where, fmt::format("expected the compression zlib, gzip, zstd or none, not \"{}\"", compression));
}

}  // namespace

std::vector<TileNumber> decode_base64(std::string_view text, std::string_view compression, std::size_t count,
                                      const std::string& where) {
  const Bytes bytes = unpack(unpack_base64(text, where), compression, count * 4, where);
  if (bytes.size() != count * 4) {
    refuse(where,
           fmt::format("expected {} bytes for {} tiles, found {}", count * 4, count,
                       bytes.size() > count * 4 && !compression.empty() ? "more" : std::to_string(bytes.size())));
  }
  std::vector<TileNumber> tiles(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t byte = 4; byte-- > 0;) tiles[i] = tiles[i] << 8U | bytes[4 * i + byte];
  }
  return tiles;
}

}  // namespace paperproof::compare
