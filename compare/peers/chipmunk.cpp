/// Chipmunk (Debian's libchipmunk), a body, driven as its manual says:
///
///     g++ -std=c++20 -O2 compare/peers/chipmunk.cpp -lchipmunk -o chipmunk
///     paperproof compare thin_platform --peer ./chipmunk
///
/// Sources: chipmunk-physics.net/release/ChipmunkLatest-Docs (cpSpace, cpBody, cpShape, cpArbiter). It has no
/// continuous collision, and says so. Its defaults are for pixels: a metre is 32 of them here, the scenes' own scale.
#include <chipmunk/chipmunk.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

extern "C" {
#include <chipmunk/cpPolyline.h>  // says nothing of C++ itself
}

namespace {

using nlohmann::json;
using std::chrono::steady_clock;

constexpr double scale = 32;  ///< [px/m]
/// Of the octagon's corners [m]. The manual: it keeps a polygon from sticking at seams.
constexpr double radius = 0.01;

cpVect pixels(const json& point) { return cpv(point[0].get<double>() * scale, point[1].get<double>() * scale); }
json metres(const cpVect& v) { return {v.x / scale, v.y / scale}; }

std::vector<cpVect> pixels_of(const json& points) {
  std::vector<cpVect> result;
  for (const json& point : points) result.push_back(pixels(point));
  return result;
}

/// In a space without friction; bodies do not turn, as their moment is infinite.
class World {
 public:
  explicit World(const json& run)
      : least_up_(std::cos(run["max_climb_degrees"].get<double>() * std::numbers::pi / 180 + 1e-5)) {
    for (const json& mover : run.value("movers", json::array())) {
      cpBody* body = cpSpaceAddBody(space_, cpBodyNewKinematic());
      for (const json& id : mover["colliders"]) movers_[id] = body;
    }
    for (const json& collider : run["colliders"]) add(collider);
    body_ = cpSpaceAddBody(space_, cpBodyNew(1, INFINITY));
    cpBodySetUserData(body_, this);
    // A step moves bodies first, and solves velocities then. What is wanted is said in between, as in Chipmunk's demo
    // of a player. Here the round begins there: what is solved moves the body in the same step, by Chipmunk's function.
    const auto stay = [](cpBody*, cpFloat) {};
    cpBodySetPositionUpdateFunc(body_, stay);
    for (const auto& [id, body] : movers_) cpBodySetPositionUpdateFunc(body, stay);
    cpBodySetVelocityUpdateFunc(body_, [](cpBody* body, cpVect, cpFloat, cpFloat) {
      cpBodySetVelocity(body, static_cast<World*>(cpBodyGetUserData(body))->wanted_);
    });
    hull_ = pixels_of(run["points"]);
    add(cpPolyShapeNewRaw(body_, static_cast<int>(hull_.size()), hull_.data(), radius * scale), "");
  }

  json step(const json& step) {
    const json& asked = step["characters"][0];
    dt_ = step["dt"];
    for (const auto& [id, body] : movers_) {
      const json& way = step["movers"][id];
      cpBodySetPosition(body, pixels(way["from"]));
      cpBodySetVelocity(body, cpvmult(cpvsub(pixels(way["to"]), pixels(way["from"])), 1 / dt_));
    }
    wanted_ = pixels(asked["wanted"]);
    if (asked.contains("put")) {
      cpBodySetPosition(body_, pixels(asked["put"]["position"]));
      cpBodySetVelocity(body_, wanted_);
    }
    const auto began = steady_clock::now();
    cpSpaceStep(space_, dt_);
    cpBodyUpdatePosition(body_, dt_);
    const std::chrono::duration<double, std::nano> took = steady_clock::now() - began;
    json answer{{"velocity", metres(cpBodyGetVelocity(body_))}, {"contacts", json::array()}, {"grounded", false}};
    answer["path"] = {{cpBodyGetPosition(body_).x / scale, cpBodyGetPosition(body_).y / scale, 1}};
    best_ = least_up_;
    answer_ = &answer;
    cpBodyEachArbiter(
        body_, [](cpBody*, cpArbiter* touch, void* self) { static_cast<World*>(self)->read(*touch); }, this);
    return {{"characters", {answer}}, {"ns", took.count()}};
  }

  /// By cpShapesCollide, of the octagon without its radius: cpSpaceShapeQuery has the radius in it. Touching is none.
  json overlaps(const json& question) {
    for (const auto& [id, body] : movers_) cpBodySetPosition(body, pixels(question["movers"][id]["to"]));
    cpSpaceReindexStatic(space_);
    cpBody* there = cpBodyNewKinematic();
    cpBodySetPosition(there, pixels(question["overlap"]));
    cpShape* octagon = cpPolyShapeNewRaw(there, static_cast<int>(hull_.size()), hull_.data(), 0);
    cpShapeCacheBB(octagon);
    json found = json::array();
    for (const auto& [shape, id] : names_) {
      if (id.empty()) continue;
      cpShapeCacheBB(shape);
      const cpContactPointSet set = cpShapesCollide(octagon, shape);
      const auto is_deep = [](const auto& point) { return point.distance < 0; };
      if (std::any_of(set.points, set.points + set.count, is_deep)) found.push_back(id);
    }
    cpShapeFree(octagon);
    cpBodyFree(there);
    return {{"overlaps", found}};
  }

 private:
  void add(cpShape* shape, const std::string& id) {
    cpShapeSetFriction(shape, 0);
    cpShapeSetElasticity(shape, 0);
    names_[cpSpaceAddShape(space_, shape)] = id;
  }

  void add(const json& collider) {
    if (collider.value("sensor", false)) return;
    const std::string id = collider["id"];
    cpBody* body = movers_.contains(id) ? movers_[id] : cpSpaceGetStaticBody(space_);
    if (collider.contains("circle")) {
      const json& circle = collider["circle"];
      add(cpCircleShapeNew(body, circle[2].get<double>() * scale, pixels(circle)), id);
    } else if (collider.contains("chain")) {
      const std::vector<cpVect> chain = pixels_of(collider["chain"]);
      for (std::size_t i = 1; i < chain.size(); ++i) add(cpSegmentShapeNew(body, chain[i - 1], chain[i], 0), id);
    } else {
      if (collider.contains("holes")) throw std::runtime_error("a polygon with a hole, and it knows convex ones");
      add_polygon(body, pixels_of(collider["polygon"]), id);
    }
  }

  /// As it is where it is convex; else in the convex parts that Chipmunk makes of it.
  void add_polygon(cpBody* body, std::vector<cpVect> ring, const std::string& id) {
    if (cpAreaForPoly(static_cast<int>(ring.size()), ring.data(), 0) < 0) std::reverse(ring.begin(), ring.end());
    std::vector<cpVect> hull = ring;
    if (cpConvexHull(static_cast<int>(ring.size()), ring.data(), hull.data(), nullptr, 0) ==
        static_cast<int>(ring.size())) {
      add(cpPolyShapeNewRaw(body, static_cast<int>(ring.size()), ring.data(), 0), id);
      return;
    }
    cpPolyline* line = static_cast<cpPolyline*>(cpcalloc(1, sizeof(cpPolyline) + (ring.size() + 1) * sizeof(cpVect)));
    line->count = line->capacity = static_cast<int>(ring.size()) + 1;
    std::copy(ring.begin(), ring.end(), line->verts);
    line->verts[ring.size()] = ring.front();
    cpPolylineSet* parts = cpPolylineConvexDecomposition(line, 0);
    for (int i = 0; i < parts->count; ++i)
      add(cpPolyShapeNewRaw(body, parts->lines[i]->count - 1, parts->lines[i]->verts, 0), id);
  }

  /// The normal of an arbiter points away from the body that asks.
  void read(cpArbiter& touch) {
    CP_ARBITER_GET_SHAPES(&touch, mine, other);
    const cpVect normal = cpvneg(cpArbiterGetNormal(&touch));
    const cpVect approach = cpvsub(wanted_, cpBodyGetVelocity(cpShapeGetBody(other)));
    const json named{{"collider", names_[other]}, {"normal", {normal.x, normal.y}}};
    const double along = cpvdot(normal, approach) * dt_ / scale;
    if (along < -1e-7) (*answer_)["contacts"].push_back(named);
    if (normal.y < best_ || along > 1e-7) return;
    best_ = normal.y;
    (*answer_)["grounded"] = true;
    (*answer_)["ground"] = named;
    static_cast<void>(mine);
  }

  cpSpace* space_ = cpSpaceNew();
  double least_up_;
  double best_ = 0;  ///< Upward part of the most level normal so far.
  double dt_ = 0;
  cpVect wanted_ = cpvzero;
  cpBody* body_ = nullptr;
  json* answer_ = nullptr;
  std::vector<cpVect> hull_;
  std::map<std::string, cpBody*> movers_;
  std::map<cpShape*, std::string> names_;
};

/// Chipmunk tells its version on the standard output, which is for answers alone.
FILE* const answers = [] {
  FILE* out = fdopen(dup(STDOUT_FILENO), "w");
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return out;
}();

void say(const json& what) {
  std::fprintf(answers, "%s\n", what.dump().c_str());
  std::fflush(answers);
}

}  // namespace

int main() try {
  std::string line;
  std::getline(std::cin, line);
  World world(json::parse(line)["run"]);
  say({{"name", "Chipmunk"},
       {"version", cpVersionString},
       {"can", {"movers", "circles", "conveyors"}},
       {"skin", radius},
       {"machine", "native"},
       {"overlap", true}});
  while (std::getline(std::cin, line)) {
    const json heard = json::parse(line);
    say(heard.contains("overlap") ? world.overlaps(heard) : world.step(heard));
  }
} catch (const std::runtime_error& reason) {
  say({{"refuses", reason.what()}});
}
