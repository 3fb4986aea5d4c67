#include "scenes/tiled_rule.hpp"

#include <algorithm>
#include <initializer_list>

namespace paperproof::compare {

namespace {

/// "One-Way Platforms" and "one_way_platforms" are the same word.
std::string plain(std::string_view word) {
  std::string out;
  for (const char c : word) {
    if (c == ' ' || c == '_' || c == '-') continue;
    out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return out;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), plain(word)) != words.end();
}

bool is_true(const std::string& value) { return !is_one_of(value, {"", "false", "0", "no"}); }

TiledRole role_of_property(const std::string& name, const std::string& value) {
  if (is_one_of(name, {"oneway", "platform"})) return is_true(value) ? TiledRole::one_way : TiledRole::unmarked;
  if (is_one_of(name, {"bodytype"})) return is_one_of(value, {"static"}) ? TiledRole::solid : TiledRole::nothing;
  if (is_one_of(name, {"solid", "collision", "collides"}))
    return is_true(value) ? TiledRole::solid : TiledRole::nothing;
  return TiledRole::unmarked;
}

TiledRole role_of_class(std::string_view type) {
  if (is_one_of(type, {"platform", "oneway"})) return TiledRole::one_way;
  if (is_one_of(type, {"solid", "collision", "wall", "slope", "ground", "block", "static"})) return TiledRole::solid;
  return TiledRole::unmarked;
}

TiledRole role_of_layer_name(std::string_view name) {
  if (is_one_of(name, {"oneway", "onewayplatforms"})) return TiledRole::one_way;
  if (is_one_of(name, {"collision", "collisions", "solid", "solids", "wall", "walls", "platforms"})) {
    return TiledRole::solid;
  }
  return TiledRole::unmarked;
}

}  // namespace

TiledRole role_of(const TiledMarks& marks) {
  TiledRole found = TiledRole::unmarked;
  for (const auto& [name, value] : marks.properties) {
    const TiledRole role = role_of_property(name, value);
    if (role == TiledRole::one_way) return role;
    if (found == TiledRole::unmarked) found = role;
  }
  return found == TiledRole::unmarked ? role_of_class(marks.type) : found;
}

TiledRole role_of_layer(const TiledLayer& layer) {
  const TiledRole role = role_of(layer.marks);
  return role == TiledRole::unmarked ? role_of_layer_name(layer.name) : role;
}

bool names_spawn(std::string_view name) {
  return is_one_of(name,
                   {"spawn", "spawnpoint", "player", "mainplayer", "playerstart", "playerspawn", "start", "hero"});
}

bool names_movers(std::string_view layer_name) { return is_one_of(layer_name, {"movingplatforms"}); }

}  // namespace paperproof::compare
