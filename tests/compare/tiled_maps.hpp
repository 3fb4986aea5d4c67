/// Maps that tests write, and how they look for what became of them.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>

#include "scene_files.hpp"
#include "scenes/tiled_model.hpp"

namespace paperproof::compare {

inline std::string base64(const std::string& bytes) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
  }
  return out;
}

inline std::string little_endian(const std::vector<TileNumber>& tiles) {
  std::string bytes;
  for (const TileNumber tile : tiles) {
    for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(tile >> shift & 0xffU);
  }
  return bytes;
}

/// @param window_bits 15 writes zlib, 31 gzip.
inline std::string deflated(const std::string& bytes, int window_bits) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string in = bytes;
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

inline std::string zstd(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  return out;
}

/// A map of 4 x 3 tiles of 16 px with one tileset of 10 plain tiles.
inline std::string tmx(const std::string& layers, const std::string& tileset_content = "") {
  return "<?xml version=\"1.0\"?>\n"
         "<map orientation=\"orthogonal\" width=\"4\" height=\"3\" tilewidth=\"16\" tileheight=\"16\">\n"
         "<tileset firstgid=\"1\" name=\"plain\" tilewidth=\"16\" tileheight=\"16\" tilecount=\"10\">" +
         tileset_content + "</tileset>\n" + layers + "\n</map>\n";
}

inline std::string tile_layer(const std::string& name, const std::string& data) {
  return "<layer name=\"" + name + "\" width=\"4\" height=\"3\">" + data + "</layer>";
}

inline std::string csv_layer(const std::string& csv) {
  return tile_layer("Collision", "<data encoding=\"csv\">" + csv + "</data>");
}

inline std::string objects(const std::string& name, const std::string& content) {
  return "<objectgroup name=\"" + name + "\">" + content + "</objectgroup>";
}

inline const std::string floor_csv = "0,0,0,0, 0,0,0,0, 1,1,1,1";
inline const std::string spawn =
    R"(<objectgroup name="things"><object id="1" name="Spawn" x="16" y="4"/></objectgroup>)";

inline const ColliderDef& collider(const Scene& scene, const std::string& id) {
  const auto found = std::find(scene.ids.begin(), scene.ids.end(), id);
  if (found == scene.ids.end()) {
    ADD_FAILURE() << "no collider " << id;
    static const ColliderDef none;
    return none;
  }
  return scene.scenery.colliders[static_cast<std::size_t>(found - scene.ids.begin())];
}

/// The corners, sorted: which one comes first does not matter.
inline std::vector<std::pair<double, double>> corners(const ColliderDef& def) {
  std::vector<std::pair<double, double>> out;
  for (const Vec2d& p : def.points) out.emplace_back(p.x(), p.y());
  std::sort(out.begin(), out.end());
  return out;
}

inline std::vector<std::pair<double, double>> box_corners(double left, double bottom, double right, double top) {
  return {{left, bottom}, {left, top}, {right, bottom}, {right, top}};
}

}  // namespace paperproof::compare
