#include "scenes/json_joint.hpp"

#include "near_names.hpp"

#include <fmt/format.h>

#include <utility>

namespace paperproof::compare {
namespace {

/// Box2D takes a shorter distance for as long [m], and nearer points have no direction.
constexpr double least_length = 0.005;
constexpr double longest = 2e6;    ///< [m]
constexpr double stiffest = 1e12;  ///< [N/m], [N s/m]

MoverIndex read_body(const JsonCursor& at, const Scene& scene) {
  const std::string id = at.text();
  std::vector<std::string> bodies;
  for (MoverIndex i = 0; i < scene.movers.size(); ++i) {
    if (!scene.movers[i].body) continue;
    if (scene.movers[i].id == id) return i;
    bodies.push_back(scene.movers[i].id);
  }
  at.refuse(fmt::format("expected the id of one of \"bodies\"; \"{}\" is none{}", id, did_you_mean(id, bodies)));
}

void read_bodies(const JsonCursor& at, const Scene& scene, Joint& joint) {
  if (at.size() != 1 && at.size() != 2)
    at.refuse("expected one body, which is held to the ground, or two, which are held to each other");
  joint.body = read_body(at.element(0), scene);
  if (at.size() == 1) return;
  joint.other = read_body(at.element(1), scene);
  if (joint.other == joint.body) at.element(1).refuse("expected another body than the first");
}

void read_distance(const JsonCursor& entry, const JsonCursor& at, Joint& joint) {
  if (at.size() != 2) at.refuse("expected two points: on the first body, and on the second or the ground");
  joint.point = at.element(0).point();
  joint.end = at.element(1).point();
  const double apart = (joint.end - joint.point).norm();
  if (!(apart >= least_length && apart <= longest))
    at.refuse(fmt::format("expected two points that are from {} to {} m apart", least_length, longest));
  const auto length = entry.find("length");
  joint.length = length ? length->number_within(least_length, longest) : apart;
  const auto stiffness = entry.find("stiffness");
  if (stiffness) {
    joint.stiffness = stiffness->positive();
    if (joint.stiffness > stiffest) stiffness->refuse(fmt::format("expected at most {} N/m", stiffest));
  }
  const auto damping = entry.find("damping");
  if (damping && !stiffness) damping->refuse("expected only beside \"stiffness\": without it the distance is a rod");
  if (damping) joint.damping = damping->number_within(0, stiffest);
}

}  // namespace

Joint read_joint(const JsonCursor& entry, std::string id, const Scene& scene) {
  entry.refuse_other_keys({"id", "bodies", "distance", "length", "stiffness", "damping", "revolute", "prismatic"});
  Joint joint;
  joint.id = std::move(id);
  read_bodies(entry.require("bodies"), scene, joint);
  const auto distance = entry.find("distance");
  const auto pin = entry.find("revolute");
  const auto rail = entry.find("prismatic");
  if (distance.has_value() + pin.has_value() + rail.has_value() != 1)
    entry.refuse("expected exactly one of \"distance\", \"revolute\" and \"prismatic\"");
  if (distance) {
    read_distance(entry, *distance, joint);
    return joint;
  }
  for (const char* key : {"length", "stiffness", "damping"})
    if (const auto found = entry.find(key)) found->refuse("expected only beside \"distance\"");
  if (pin) {
    joint.kind = Joint::Kind::revolute;
    joint.point = pin->point();
    return joint;
  }
  joint.kind = Joint::Kind::prismatic;
  joint.axis = rail->point();
  const double size = joint.axis.norm();
  if (!(size >= 1e-6 && size <= 1e6)) rail->refuse("expected a direction: a vector 1e-6 to 1e6 long");
  return joint;
}

}  // namespace paperproof::compare
