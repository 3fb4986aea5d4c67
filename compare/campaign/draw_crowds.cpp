#include "campaign/draw.hpp"
#include "campaign/drawing.hpp"
#include "campaign/shapes.hpp"
#include "oracle/exact.hpp"
#include "oracle/pair.hpp"
#include "scenes/step_times.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace paperproof::compare {
namespace {

/// How often what happens to a character, and how fast.
struct Fates {
  double launch = 0;
  double far_launch = 0;  ///< Of the launches: up to 1,000 m per step.
};

/// Draws several characters in a closed room.
class CrowdDraw {
 public:
  CrowdDraw(Random& random, RandomRun& run) : random_(random), run_(run), scene_(run.scene) {
    const Box2 box = scene_.character.shape.box();
    extent_ = box.upper - box.lower;
  }

  RandomRun among_solids() {
    most_ = random_.integer(2, 16);
    room_ = {extent_.x() * (1.5 + most_ * random_.between(0.3, 0.8)), extent_.y() * random_.between(1.3, 4)};
    add_room();
    const int things = random_.integer(0, 4);
    for (int i = 0; i < things; ++i) add_thing();
    draw_rules(random_, scene_.character);
    place(0.3);
    if (starts_.size() < 2) return none();
    scene_.gravity = {0, random_.chance(0.85) ? -30.0 : random_.between(-5, 5)};
    scene_.dt = random_.chance(0.8) ? 1.0 / 60 : random_.log_between(1e-3, 0.2);
    play({.launch = 0.03, .far_launch = 0.3});
    return std::move(run_);
  }

  RandomRun among_movers() {
    scene_.dt = random_.chance(0.8) ? 1.0 / 60 : random_.log_between(1e-3, 0.1);
    if (!random_.chance(0.9)) origin_ = {far(random_), far(random_)};
    most_ = random_.integer(2, 10);
    room_ = {extent_.x() * (3 + most_ * random_.between(0.5, 1.2)), extent_.y() * random_.between(1.5, 5)};
    add_room();
    const int movers = random_.integer(1, 4);
    for (int i = 0; i < movers; ++i) add_mover(static_cast<MoverIndex>(i));
    draw_rules(random_, scene_.character);
    place(0.2);
    if (starts_.size() < 2) return none();
    play({.launch = 0.01, .far_launch = 0.2});
    return std::move(run_);
  }

 private:
  /// How one mover goes, until it turns.
  struct Drift {
    Vec2d by{0, 0};  ///< [m per step]
    int steps = 0;
  };

  ColliderDef& add(ColliderDef def, MoverIndex mover = no_mover, const Vec2d& at = Vec2d::Zero()) {
    for (Vec2d& point : def.points) point += origin_ + at;
    def.mover = mover;
    return scene_.scenery.colliders.emplace_back(std::move(def));
  }

  void add_room() {
    add(box(-1, -1, room_.x() + 1, 0));
    add(box(-1, room_.y(), room_.x() + 1, room_.y() + 1));
    add(box(-1, 0, 0, room_.y()));
    add(box(room_.x(), 0, room_.x() + 1, room_.y()));
  }

  void add_thing() {
    const Vec2d at{random_.between(0, room_.x()), random_.between(0, room_.y())};
    const double w = random_.between(0.1, 1.5) * extent_.x();
    const double h = random_.chance(0.4) ? random_.log_between(1e-4, 0.1) : random_.between(0.1, 0.6) * extent_.y();
    if (random_.chance(0.4))
      add(polygon({at, at + Vec2d{w, 0}, at + Vec2d{random_.chance(0.5) ? w : 0, h}}));
    else if (random_.chance(0.3))
      add(chain({at, at + Vec2d{w, random_.between(-h, h)}}));
    else
      add(box(at.x(), at.y(), at.x() + w, at.y() + h));
  }

  void add_mover(MoverIndex mover) {
    scene_.movers.push_back({.id = std::to_string(mover), .path = {{0, Vec2d::Zero()}}});
    const Vec2d at{random_.between(0, room_.x()), random_.between(0, room_.y())};
    const double width = random_.between(0.3, 5) * extent_.x();
    switch (random_.integer(0, 5)) {
      case 0:  // a lift
      case 1:
        add(box(0, 0, width, 0.2), mover, at);
        break;
      case 2:  // a cabin: one that walks goes with it all the same
        add(box(0, 0, width, 0.2), mover, at);
        add(box(-0.1, 0, 0, 1), mover, at);
        add(box(width, 0, width + 0.1, 1), mover, at);
        break;
      case 3: {  // a press
        const Vec2d size{random_.between(0.2, 1), random_.between(0.5, 2)};
        add(box(0, 0, size.x(), size.y()), mover, at);
        break;
      }
      case 4: {  // a paper
        const double thin = random_.log_between(1e-4, 0.05);
        add(random_.chance(0.5) ? box(0, 0, thin, 1.5) : box(0, 0, width, thin), mover, at);
        break;
      }
      default:
        add(chain({{0, 0}, {width, random_.between(-0.2, 0.2)}}), mover, at).one_way = Vec2d{0, 1};
    }
    if (random_.chance(0.1)) scene_.scenery.colliders.back().surface_speed = random_.between(-4, 4);
  }

  /// Apart from each other and from all solids; in some runs on whole pixels, so that neighbours touch exactly.
  void place(double on_pixels) {
    const auto hull = scene_.character.shape.hull();
    const ExactScenery solids(scene_.scenery, {hull.begin(), hull.end()});
    const ExactPair pair(hull);
    const bool whole_pixels = random_.chance(on_pixels);
    for (int tries = 0; tries < 200 && static_cast<int>(starts_.size()) < most_; ++tries) {
      Vec2d at = origin_ + Vec2d{random_.between(0, room_.x()), random_.between(0, room_.y())};
      if (whole_pixels) at = round_to_pixels(at);
      if (whole_pixels && !starts_.empty() && random_.chance(0.5))
        at = starts_.back() + Vec2d{random_.chance(0.5) ? extent_.x() : -extent_.x(), 0};
      const bool free =
          std::none_of(starts_.begin(), starts_.end(), [&](const Vec2d& other) { return pair.overlap(at, other); });
      if (free && solids.overlapped(at).empty()) starts_.push_back(at);
    }
    if (starts_.empty()) return;
    scene_.start.position = starts_.front();
    for (std::size_t k = 1; k < starts_.size(); ++k)
      scene_.others.push_back({.start = {.position = starts_[k]}, .input = {}});
  }

  RandomRun none() {
    scene_.steps = 0;
    return std::move(run_);
  }

  void play(const Fates& fates) {
    scene_.steps = 60;
    const StepTimes times(scene_);
    std::vector<InputNotes> notes;
    for (std::size_t k = 0; k < starts_.size(); ++k)
      notes.emplace_back(k == 0 ? scene_.input : scene_.others[k - 1].input);
    std::vector<Input> inputs(starts_.size());
    std::vector<Drift> drifts(scene_.movers.size());
    for (int step = 0; step < scene_.steps; ++step) {
      for (std::size_t k = 0; k < inputs.size(); ++k) {
        press_keys(random_, inputs[k]);
        notes[k].note(step, inputs[k]);
        if (random_.chance(fates.launch)) launch(step, k, fates.far_launch);
      }
      for (std::size_t k = 0; k < drifts.size(); ++k) move_on(times.end(step), drifts[k], scene_.movers[k].path);
    }
  }

  void launch(int step, std::size_t character, double far_launch) {
    const double speed = random_.log_between(1e-3, random_.chance(far_launch) ? 1e3 : 5) / scene_.dt;
    const Vec2d velocity = towards(any_direction(random_)) * speed;
    add_launch(run_, {step, static_cast<CharacterIndex>(character), velocity});
  }

  void move_on(double time, Drift& drift, std::vector<MoverDef::Waypoint>& path) {
    if (drift.steps-- <= 0) {
      drift.steps = random_.integer(5, 40);
      const double speed = random_.log_between(1e-3, random_.chance(0.1) ? 3 : 0.1);
      const double angle = random_.chance(0.7) ? random_.integer(0, 3) * std::numbers::pi / 2 : random_.angle();
      drift.by = towards(angle) * speed;
      if (random_.chance(0.15)) drift.by.setZero();
    }
    const Vec2d at = path.back().at;
    for (const Eigen::Index axis : {0, 1})
      if (std::abs(at[axis]) > 0.5 * room_[axis] && at[axis] * drift.by[axis] > 0) drift.by[axis] = -drift.by[axis];
    path.push_back({time, at + drift.by});
  }

  Random& random_;
  RandomRun& run_;
  Scene& scene_;
  Vec2d extent_{Vec2d::Zero()};  ///< Of a character [m].
  Vec2d origin_{Vec2d::Zero()};  ///< Of the room [m].
  Vec2d room_{Vec2d::Zero()};    ///< Its size [m].
  int most_ = 0;                 ///< Characters.
  std::vector<Vec2d> starts_;
};

}  // namespace

RandomRun draw_crowd(std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  return CrowdDraw(random, run).among_solids();
}

RandomRun draw_crowd_among_movers(std::uint64_t seed) {
  Random random(seed);
  RandomRun run;
  return CrowdDraw(random, run).among_movers();
}

}  // namespace paperproof::compare
