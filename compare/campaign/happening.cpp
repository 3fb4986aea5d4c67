#include "campaign/happening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace paperproof::compare {
namespace {

Vec2d way_of(const TraceStep& step) { return step.path.back().position - step.path.front().position; }

/// Whether a contact's normal has such a part along up.
template <class IsSo>
bool has_contact(const Moment& m, const IsSo& is_so) {
  const Vec2d up = up_in(m.record, m.header);
  return std::any_of(m.record.contacts.begin(), m.record.contacts.end(),
                     [&](const Contact& contact) { return is_so(contact.normal.dot(up)); });
}

double walkable(const Moment& m) { return m.header.character.walkable_cosine(); }
constexpr double upright = 1e-12;  ///< Of a wall: how far its normal is from level at most.

bool meets_what_moves(const Moment& m) {
  return std::any_of(m.record.contacts.begin(), m.record.contacts.end(), [&](const Contact& contact) {
    return m.header.scenery.colliders[contact.collider].mover != no_mover;
  });
}

/// Somewhere else than it wanted, by more than gaps are restored, and free to go there.
bool goes_aside(const Moment& m) {
  constexpr double restored = 2e-6;
  return !m.record.stuck && m.record.crushed.empty() && m.record.start_overlap.empty() &&
         (way_of(m.record) - m.record.requested).cwiseAbs().maxCoeff() > restored;
}

/// From the air, where it neither follows ground nor climbs, and says that it met nothing.
bool goes_aside_from_nothing(const Moment& m) {
  const CharacterDef& character = m.header.character;
  return goes_aside(m) && m.record.contacts.empty() && m.record.met.empty() && !m.was_grounded && !m.record.dropped &&
         character.snap == 0 && character.step_height == 0;
}

/// By a leg straight up that takes no time, as stairs are climbed.
bool climbs(const Moment& m) {
  constexpr double kerb = 1e-3;
  const auto& path = m.record.path;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2d leg = path[i].position - path[i - 1].position;
    const bool at_once = path[i].fraction == path[i - 1].fraction && path[i].fraction > 0;
    if (at_once && leg.x() == 0 && leg.y() > kerb) return m.record.grounded;
  }
  return false;
}

/// Along its ground, by more than it would have fallen.
bool descends(const Moment& m) {
  if (!m.was_grounded || !m.record.grounded) return false;
  const double dt = length_of(m.record, m.header);
  return -way_of(m.record).y() > gravity_in(m.record, m.header).norm() * dt * dt + 1e-3;
}

constexpr std::array all{
    Happening{"contact", "has a contact", [](const Moment& m) { return !m.record.contacts.empty(); }},
    Happening{"walkable", "touches walkable ground",
              [](const Moment& m) { return has_contact(m, [&](double up) { return up >= walkable(m); }); }},
    Happening{
        "steep", "touches steep ground",
        [](const Moment& m) { return has_contact(m, [&](double up) { return up >= upright && up < walkable(m); }); }},
    Happening{"wall", "touches a wall",
              [](const Moment& m) { return has_contact(m, [](double up) { return std::abs(up) < upright; }); }},
    Happening{"ceiling", "touches a ceiling",
              [](const Moment& m) { return has_contact(m, [](double up) { return up <= -upright; }); }},
    Happening{"moving", "touches what moves", meets_what_moves},
    Happening{"met", "meets another character", [](const Moment& m) { return !m.record.met.empty(); }},
    Happening{"launched", "is launched", [](const Moment& m) { return m.launched; }},
    Happening{"grounded", "ends on ground", [](const Moment& m) { return m.record.grounded; }},
    Happening{"falling", "falls", [](const Moment& m) { return way_of(m.record).dot(up_in(m.record, m.header)) < 0; }},
    Happening{"steering", "steers against something in the air",
              [](const Moment& m) {
                return !m.record.grounded && m.record.input.move.value_or(0) != 0 && !m.record.contacts.empty();
              }},
    Happening{"riding", "is carried from now on", [](const Moment& m) { return m.record.ride.has_value(); }},
    Happening{"turning", "has something that turns near it",
              [](const Moment& m) {
                return std::any_of(m.record.vertex_ways.begin(), m.record.vertex_ways.end(),
                                   [](const VertexWay& way) { return way.instants.size() > 2; });
              }},
    Happening{"climbing", "climbs a stair", climbs},
    Happening{"descending", "follows its ground down", descends},
    Happening{"through", "drops through a ledge", [](const Moment& m) { return !m.record.dropped_through.empty(); }},
    Happening{"sensed", "enters or leaves a sensor", [](const Moment& m) { return !m.record.sensors.empty(); }},
    Happening{"inside", "begins inside something", [](const Moment& m) { return !m.record.start_overlap.empty(); }},
    Happening{"freed", "begins inside something and ends free",
              [](const Moment& m) { return !m.record.start_overlap.empty() && m.judged.end_overlap.empty(); }},
    Happening{"crushed", "is crushed", [](const Moment& m) { return !m.record.crushed.empty(); }},
    Happening{"again", "is crushed, and begins inside something",
              [](const Moment& m) { return !m.record.crushed.empty() && !m.record.start_overlap.empty(); }},
    Happening{"aside", "goes elsewhere than it wants", goes_aside},
    Happening{"unnamed", "is in the air, goes elsewhere, and names nothing that it met", goes_aside_from_nothing},
    Happening{"stuck", "is stuck", [](const Moment& m) { return m.record.stuck; }},
    Happening{"dropped", "drops motion that it wanted", [](const Moment& m) { return m.record.dropped; }},
};

}  // namespace

std::span<const Happening> happenings() { return all; }

std::size_t happening_named(std::string_view name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Happening& one) { return one.name == name; });
  if (found == all.end()) throw std::logic_error("no happening is named " + std::string(name));
  return static_cast<std::size_t>(found - all.begin());
}

}  // namespace paperproof::compare
