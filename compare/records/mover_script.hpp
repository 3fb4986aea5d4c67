/// Where a scene says that a mover is, as a trace carries it.
#pragma once

#include <paperproof/types.hpp>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// The path of one mover through time. Offset and angle are linear between entries, and before the first entry they are
/// that entry's.
struct MoverScript {
  enum class Loop : std::uint8_t {
    once,       ///< Stays at the last entry.
    loop,       ///< Begins anew at the first one. Offsets end where they began; angles go on from where they ended.
    ping_pong,  ///< Goes back the same way, in the same time.
  };
  struct Waypoint {
    double time = 0;          ///< [s], ascending
    Vec2d at{Vec2d::Zero()};  ///< Offset [m].
  };
  struct Turn {
    double time = 0;  ///< [s], ascending
    double at = 0;    ///< Angle, counter-clockwise [radians].
  };
  std::vector<ColliderIndex> colliders{};  ///< What goes along.
  std::vector<Waypoint> path;              ///< At least one.
  Loop loop = Loop::once;
  std::vector<Turn> turns{};  ///< Empty: it does not turn.
  bool body = false;          ///< Box2D moves it, and the path says only where it begins.
};

/// As scenes and traces have it.
[[nodiscard]] constexpr std::string_view name_of(MoverScript::Loop loop) noexcept {
  constexpr std::array<std::string_view, 3> names{"once", "loop", "ping_pong"};
  return names[static_cast<std::size_t>(loop)];
}

}  // namespace paperproof::compare
