#include "runs/contender_kinds.hpp"

#include "embedded.hpp"
#include "one_line.hpp"
#include "oracle/exemptions.hpp"
#include "records/collider_json.hpp"
#include "records/schema.hpp"
#include "records/strict_json.hpp"
#include "records/trace_writer.hpp"
#include "runs/engine_intent.hpp"
#include "runs/peer_process.hpp"
#include "runs/technique_parts.hpp"
#include "runs/vertex_ways.hpp"
#include "scenes/validate.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace paperproof::compare {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::seconds patience{10};

/// What the scene has, and not every engine.
std::vector<std::string_view> needs_of(const Scene& scene) {
  std::vector<std::string_view> needs;
  const auto need = [&](std::string_view name, bool is_there) {
    if (is_there) needs.push_back(name);
  };
  const auto any = [&](const auto& is_so) { return std::ranges::any_of(scene.scenery.colliders, is_so); };
  need("movers", !scene.movers.empty());
  need("turning", !turning_movers(scene).empty());
  need("one_way", any([](const ColliderDef& collider) { return collider.one_way.has_value(); }));
  need("several", !scene.others.empty());
  need("circles", any([](const ColliderDef& collider) { return collider.shape == ColliderDef::Shape::circle; }));
  need("conveyors", any([](const ColliderDef& collider) { return collider.surface_speed != 0; }));
  return needs;
}

const Schema& protocol() {
  static const Schema schema(peer_schema.front().text);
  return schema;
}

class PeerContender final : public Contender {
 public:
  PeerContender(const Peer& peer, const Scene& scene, const Scenery& scenery)
      : process_(peer.command), characters_(character_count(scene)), places_(characters_.size()) {
    header_.scene = scene.name;
    header_.contender = peer.name;
    header_.scalar = name_of(ScalarKind::binary64);
    header_.dt = scene.dt;
    header_.characters = characters_.size();
    header_.points.assign(scene.character.shape.hull().begin(), scene.character.shape.hull().end());
    add_terms(scene, rules_for_twin(scene), header_);
    header_.scenery = scenery.as_run();
    header_.ids = scene.ids;
    header_.turning = turning_movers(scene);
    greet(scene);
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    if (input.up != Vec2d::UnitY()) throw StepRefused("a peer stands upright, and the run ends there");
    std::vector<Vec2d> wanted;
    for (std::size_t k = 0; k < characters_.size(); ++k)
      wanted.push_back(intent_.wanted(characters_[k], places_[k].position, input.players[k], input));
    const Json answer = ask(question_of(input, wanted), "characters", patience);
    if (answer["characters"].size() != characters_.size())
      throw std::runtime_error(fmt::format("the peer answers for {}, not for {}",
                                           counted(answer["characters"].size(), "character"), characters_.size()));
    for (std::size_t k = 0; k < characters_.size(); ++k) {
      TraceStep& record = records[k];
      clear(record);
      record.requested = wanted[k] * input.dt;
      record.capped = record.requested.norm() > most_way_;
      record.steered = characters_[k].steered * input.dt;
      record.movers.assign(input.movers.begin(), input.movers.end());
      add_ways(header_, input.movers, {}, record.vertex_ways);
      take(answer["characters"][k], input, k, record);
    }
    ns_ += answer.value("ns", 0.0);
    if (answer.contains("ns")) ++timed_;
  }

  void step_unrecorded(const StepInput& input) override {
    std::vector<TraceStep> unread(characters_.size());
    step(input, unread);
  }

  [[nodiscard]] Pose pose(std::size_t character) const override {
    return pose_of(characters_[character], places_[character].position);
  }

  void place(const Pose& pose, std::size_t character) override {
    characters_[character] = character_at(pose);
    places_[character] = {pose.position, true};
  }

  [[nodiscard]] std::optional<std::vector<std::string>> overlapped_at(const Vec2d& place,
                                                                      std::span<const MoverMotion> movers) override {
    if (!has_query_ || !header_.turning.empty()) return std::nullopt;
    Json question{{"overlap", point_json(place)}};
    if (const Json ways = ways_json(movers); !ways.is_null()) question["movers"] = ways;
    return ask(question, "overlaps", patience)["overlaps"].get<std::vector<std::string>>();
  }

  void write_notes(Row& row) const override {
    row.engine = engine_;
    row.machine = machine_;
    row.skin_m = header_.tolerances.front().metres;
    if (timed_ > 0) row.ns_per_step_own_clock = ns_ / timed_;
  }

 private:
  struct Place {
    Vec2d position{Vec2d::Zero()};
    bool is_new = true;  ///< The peer was not told yet.
  };

  /// The peer hears the scene, and says who it is.
  void greet(const Scene& scene) {
    const Json greeting = ask({{"paperproof_peer", 1}, {"run", trace_header_json(header_)}}, "name", longest_greeting);
    engine_ = greeting["name"].get<std::string>() + ' ' + greeting["version"].get<std::string>();
    const Json can = greeting.value("can", Json::array());
    for (const std::string_view need : needs_of(scene))
      if (std::ranges::find(can, need) == can.end())
        throw NotApplicable(fmt::format("{} does not say that it can: {}", engine_, need));
    machine_ = greeting.value("machine", "");
    has_query_ = greeting.value("overlap", false);
    header_.scalar = greeting.value("scalar", header_.scalar);
    header_.path_exact = greeting.value("path_exact", false);
    most_way_ = greeting.value("most_way", most_way_);
    // The judge looks at this one then: a capsule that fits into the octagon stands deeper than the octagon would.
    if (greeting.contains("points")) {
      const CharacterShape shape(points_of(greeting["points"]));
      header_.points.assign(shape.hull().begin(), shape.hull().end());
    }
    header_.tolerances = {{"touch", std::min(greeting.value("skin", 0.0), box2d_skin) + rounding_of_gap(scene)}};
  }

  /// What is kept exactly comes out as a difference of places, each rounded as this peer counts [m].
  [[nodiscard]] double rounding_of_gap(const Scene& scene) const {
    double farthest = 0;
    for (const ColliderDef& collider : scene.scenery.colliders) {
      const Box2 box = box_of(collider);
      farthest = std::max({farthest, box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff()});
    }
    return 2 * ulp_at(header_, {farthest, 0});
  }

  /// @throws NotApplicable for a refusal.
  Json ask(const Json& question, const char* expected, std::chrono::milliseconds within) {
    const std::string what = engine_.empty() ? "the peer's greeting" : "the peer's answer";
    if (!engine_.empty() && process_.has_said_more()) throw std::runtime_error("the peer answers before it is asked");
    const Json answer = json_of(process_.ask(question.dump(), within), what);
    if (const auto fault = protocol().fault(answer)) throw std::runtime_error(what + ": " + *fault);
    if (answer.contains("refuses")) throw NotApplicable(answer["refuses"].get<std::string>());
    if (!answer.contains(expected)) throw std::runtime_error(fmt::format("{} has no {}", what, expected));
    return answer;
  }
  /// What is none, as what a library prints, is quoted.
  static Json json_of(const std::string& said, const std::string& what) {
    try {
      return strict_json(said, what);
    } catch (const std::runtime_error& fault) {
      throw std::runtime_error(
          fmt::format("{}; it says \"{}\"", fault.what(), cut_in_the_middle(without_controls(said), 60)));
    }
  }

  /// Of each collider that moves, by its id.
  [[nodiscard]] Json ways_json(std::span<const MoverMotion> movers) const {
    Json ways;
    for (ColliderIndex i = 0; i < header_.ids.size(); ++i) {
      const MoverIndex mover = header_.scenery.colliders[i].mover;
      if (mover == no_mover) continue;
      Json& way = ways[header_.ids[i]];
      way = {{"from", point_json(movers[mover].from)}, {"to", point_json(movers[mover].to)}};
      if (!header_.turning.empty()) way["angle"] = {movers[mover].from_angle, movers[mover].to_angle};
    }
    return ways;
  }

  Json question_of(const StepInput& input, std::span<const Vec2d> wanted) {
    Json question{{"dt", input.dt}};
    if (const Json ways = ways_json(input.movers); !ways.is_null()) question["movers"] = ways;
    for (std::size_t k = 0; k < characters_.size(); ++k) {
      Json one{{"wanted", point_json(wanted[k])}};
      if (input.players[k].drop) one["drop"] = true;
      if (std::exchange(places_[k].is_new, false))
        one["put"] = {{"position", point_json(places_[k].position)},
                      {"velocity", point_json(characters_[k].state.velocity)}};
      question["characters"].push_back(std::move(one));
    }
    return question;
  }

  void take(const Json& said, const StepInput& input, std::size_t k, TraceStep& record) {
    record.path = {{places_[k].position, 0}};
    for (const Json& corner : said["path"])
      if (const double t = corner[2].get<double>(); t > record.path.back().fraction)
        record.path.push_back({point_of(corner), t});
      else
        throw std::runtime_error(
            fmt::format("the times of the peer's way do not ascend from above 0: {:g} comes after {:g}", t,
                        record.path.back().fraction));
    if (record.path.back().fraction != 1) throw std::runtime_error("the peer's way does not end at 1");
    places_[k].position = record.path.back().position;
    for (const Json& contact : said.value("contacts", Json::array())) {
      const Vec2d normal = normal_of(contact["normal"]);
      if (header_.path_exact && !contact.contains("fraction"))
        throw std::runtime_error("a contact of the peer has no fraction, and its way is exact");
      record.contacts.push_back({.collider = collider_named(contact["collider"]),
                                 .point = contact.contains("point") ? point_of(contact["point"]) : places_[k].position,
                                 .normal = normal,
                                 .fraction = contact.value("fraction", 0.0),
                                 .separation = contact.value("separation", 0.0),
                                 .side = side_of_normal(normal.x(), normal.y())});
    }
    EngineStep ended{.velocity = (record.path.back().position - record.path.front().position) / input.dt,
                     .grounded = said.value("grounded", false)};
    if (said.contains("velocity")) ended.velocity = point_of(said["velocity"]);
    if (said.contains("ground"))
      ended.ground = EngineGround{collider_named(said["ground"]["collider"]),
                                  normal_of(said["ground"].value("normal", Json{0, 1}))};
    intent_.take_over(ended, input, record.contacts, characters_[k]);
    write_state(characters_[k].state, record);
    record.stuck = said.value("stuck", false);
    for (const Json& id : said.value("dropped_through", Json::array()))
      record.dropped_through.push_back(collider_named(id));
    std::ranges::sort(record.dropped_through);
  }

  static Vec2d normal_of(const Json& said) {
    const Vec2d normal = point_of(said);
    constexpr double rounding = 1e-3;  // of engines in float
    if (!(std::abs(normal.norm() - 1) <= rounding))
      throw std::runtime_error("a normal of the peer is no unit vector: " + said.dump());
    return normal;
  }

  [[nodiscard]] ColliderIndex collider_named(const std::string& id) const {
    const auto found = std::ranges::find(header_.ids, id);
    if (found == header_.ids.end()) throw std::runtime_error("the peer names a collider that there is not: " + id);
    return static_cast<ColliderIndex>(found - header_.ids.begin());
  }

  PeerProcess process_;
  std::string engine_;
  std::string machine_;
  bool has_query_ = false;  ///< It answers what a character would overlap.
  TraceHeader header_;
  EngineIntent intent_{header_};
  std::vector<EngineCharacter> characters_;
  std::vector<Place> places_;
  double most_way_ = std::numeric_limits<double>::infinity();  ///< See README.md of the peers [m].
  double ns_ = 0;                                              ///< Of all steps that it timed.
  int timed_ = 0;
};

}  // namespace

std::unique_ptr<Contender> make_peer_contender(const Peer& peer, const Scene& scene, const Scenery& scenery) {
  return std::make_unique<PeerContender>(peer, scene, scenery);
}

}  // namespace paperproof::compare
