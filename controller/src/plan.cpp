#include <paperproof/plan.hpp>

#include <algorithm>

#include <paperproof/scenery_facts.hpp>

namespace paperproof {
namespace {

/// Up to this many pieces, a test of each piece costs no more than a search in a tree: 1.7 ns for each piece against 45
/// ns.
constexpr std::size_t few = 16;

/// Buckets are never chosen. A query of the tree is faster even in the best case for buckets, tiles of one size: by a
/// third among 1,000 tiles, by almost half among 10,000. Buckets also take 24 bytes for each cell of each piece, and
/// the tree takes 21 bytes for each piece.
template <class Scalar>
void choose_broad_phase(std::span<const Box2<Scalar>> boxes, Plan& plan) {
  const std::string count = std::to_string(boxes.size()) + (boxes.size() == 1 ? " piece" : " pieces");
  if (boxes.size() <= few) {
    plan.broad_phase = BroadPhaseKind::all_pairs;
    plan.broad_phase_reason = count + ": a test of each piece costs no more than a search";
  } else {
    plan.broad_phase = BroadPhaseKind::tree;
    plan.broad_phase_reason = count + ": a tree finds the near pieces in a few comparisons";
  }
}

template <class Scalar>
bool has_slope(const PieceVertices<Scalar>& vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2<Scalar>& next = vertices[(i + 1) % vertices.size()];
    if (vertices[i].x() != next.x() && vertices[i].y() != next.y()) return true;
  }
  return false;
}

template <class Scalar>
bool has_slope(const Scenery<Scalar>& scenery) {
  const PieceIndex solid = scenery.sensor_pieces().first;
  for (PieceIndex piece = 0; piece < solid; ++piece) {
    if (scenery.pieces()[piece].is_circle()) return true;
    if (!scenery.pieces()[piece].is_rectangle() && has_slope(scenery.vertices_of(piece))) return true;
  }
  return false;
}

}  // namespace

std::string_view name_of(Stage stage) noexcept {
  switch (stage) {
    case Stage::movers:
      return "movers";
    case Stage::one_way:
      return "one_way";
    case Stage::sensors:
      return "sensors";
    case Stage::slopes:
      return "slopes";
    case Stage::jump:
      return "jump";
    case Stage::gravity:
      return "gravity";
  }
  return "movers";
}

std::string_view name_of(BroadPhaseKind kind) noexcept {
  switch (kind) {
    case BroadPhaseKind::all_pairs:
      return "all_pairs";
    case BroadPhaseKind::buckets:
      return "buckets";
    case BroadPhaseKind::tree:
      return "tree";
  }
  return "tree";
}

template <class Scalar>
Plan make_plan(const Scenery<Scalar>& scenery, const Foreseen& foreseen) {
  Plan plan;
  choose_broad_phase(scenery.static_boxes(), plan);
  const auto leave_out = [&plan](bool needed, Stage stage, bool Stages::*member, const char* reason) {
    plan.stages.*member = needed;
    if (!needed) plan.omitted.push_back({stage, reason});
  };
  const bool carries = scenery.mover_count() > 0 || has_conveyors(scenery);
  leave_out(
      carries, Stage::movers, &Stages::movers,
      foreseen.company
          ? "no scenery moves and there is no conveyor: only impacts between characters need an order in time"
          : "no scenery moves and there is no conveyor, so the character's own motion gives the order of impacts");
  const std::span<const ColliderInfo> kinds = scenery.collider_kinds();
  const bool has_one_way =
      std::any_of(kinds.begin(), kinds.end(), [](const ColliderInfo& kind) { return kind.one_way.has_value(); });
  leave_out(has_one_way, Stage::one_way, &Stages::one_way,
            "there is no one-way chain, so no impact depends on the side from which it comes");
  leave_out(scenery.sensor_pieces().size() > 0, Stage::sensors, &Stages::sensors,
            "there is no sensor, so the character can enter no collider without a contact");
  // Among moving scenery, characters are obstacles to each other, and an octagon has slopes.
  leave_out(has_slope(scenery) || (foreseen.company && carries), Stage::slopes, &Stages::slopes,
            "every edge is level or upright, so only the sides of the character and of its box are axes that can "
            "separate");
  leave_out(foreseen.jump, Stage::jump, &Stages::jump, "the jump button is never pressed, so no jump can begin");
  leave_out(foreseen.gravity, Stage::gravity, &Stages::gravity,
            "gravity is zero in every step, and adding zero changes no velocity");
  return plan;
}

template Plan make_plan(const Scenery<float>&, const Foreseen&);
template Plan make_plan(const Scenery<double>&, const Foreseen&);

}  // namespace paperproof
