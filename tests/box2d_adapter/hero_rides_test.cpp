/// A hero that stands on what moves and turns, for 20 seconds; `PAPERPROOF_RIDE_FRAMES=216000` makes it an hour.
#include "hero_world.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace paperproof::box2d::hero_test {
namespace {

constexpr double half_foot = 5.0 / 32;  ///< Of the default hero [m].

/// In [-1, 1]: there and back at one speed, in `period` frames, from 0.
double to_and_fro(int frame_number, int period) {
  const double phase = static_cast<double>((frame_number + period / 4) % period) / period;
  return 1 - 4 * std::abs(phase - 0.5);
}

/// What a hero rides.
struct Ground {
  const char* name;
  b2BodyType type = b2_kinematicBody;
  double wheel_radius = 0;  ///< [m]; zero: a plank.
  Vec2d reach{0, 0};        ///< How far it goes, to either side [m].
  double tilt = 0;          ///< How far it turns, to either side [radians].
  double belt = 0;          ///< Speed of its surface [m/s].
  int period = 240;         ///< Of all that [frames].
  double start = 0.5;       ///< Where the hero stands, from the middle [m].
};

class Ride {
 public:
  explicit Ride(const Ground& ground)
      : ground_(ground),
        game_({.position = {ground.start, std::max(ground.wheel_radius, 0.125) + half_height + 0.05},
               .surface_of = [this](b2Fixture&) { return Surface{.speed = belt_speed_}; }}) {
    const auto radius = static_cast<float>(ground.wheel_radius);
    body_ = (radius > 0 ? game_.circle(ground.type, {0, 0}, radius, 20) : game_.box(ground.type, {0, 0}, 4, 0.125F, 20))
                .GetBody();
    if (ground.type == b2_dynamicBody) {
      b2BodyDef wall;
      b2RevoluteJointDef joint;
      joint.Initialize(game_.world.CreateBody(&wall), body_, {0, 0});
      joint.enableMotor = true;
      joint.maxMotorTorque = 1e6F;
      motor_ = static_cast<b2RevoluteJoint*>(game_.world.CreateJoint(&joint));
    }
    game_.run(30);
  }

  /// The ground goes on, then the hero.
  void go(int frame_number) {
    const double phase = to_and_fro(frame_number + 1, ground_.period);
    const Vec2d way = ground_.reach * phase;
    const b2Vec2 there(static_cast<float>(way.x()), static_cast<float>(way.y()));
    const auto spin = static_cast<float>((ground_.tilt * phase - static_cast<double>(body_->GetAngle())) / frame);
    if (motor_ != nullptr) {
      motor_->SetMotorSpeed(spin);
    } else {
      body_->SetAngularVelocity(spin);
      body_->SetLinearVelocity(static_cast<float>(1 / frame) * (there - body_->GetPosition()));
    }
    belt_speed_ = ground_.belt * (phase > to_and_fro(frame_number, ground_.period) ? 1 : -1);
    game_.go();
  }

  [[nodiscard]] bool is_carried() const {
    return game_.hero.grounded() && game_.hero.ground() == body_->GetFixtureList() &&
           game_.hero.state().ride.ground != paperproof::Ride::none;
  }
  /// Along the surface, from the middle [m]. It is the same again after each period.
  [[nodiscard]] double place() const {
    const b2Vec2 at = body_->GetPosition();
    const Vec2d from = game_.hero.position() - Vec2d(at.x, at.y);
    if (ground_.wheel_radius == 0) return from.x();
    const auto turned = static_cast<double>(body_->GetAngle());
    return ground_.wheel_radius * (std::atan2(from.x(), from.y() - half_height) + turned);
  }

 private:
  Ground ground_;
  double belt_speed_ = 0;
  Game game_;
  b2Body* body_ = nullptr;
  b2RevoluteJoint* motor_ = nullptr;
};

class HeroRides : public ::testing::TestWithParam<Ground> {};

TEST_P(HeroRides, without_a_toggle) {
  const Ground& ground = GetParam();
  const int frames = test::steps_wanted("PAPERPROOF_RIDE_FRAMES", 1200);
  Ride ride(ground);
  double drift = 0;
  for (int i = 0; i < ground.period; ++i) ride.go(i);
  ASSERT_TRUE(ride.is_carried());
  const double start = ride.place();
  for (int i = 0; i < frames; ++i) {
    ride.go(i);
    ASSERT_TRUE(ride.is_carried()) << "frame " << i;
    if ((i + 1) % ground.period == 0) drift = std::max(drift, std::abs(ride.place() - start));
  }
  std::printf("%s: %.3g m off in %d frames\n", ground.name, drift, frames);
  const double turn = ground.tilt * 4 / ground.period;  // in a frame
  // A wheel is a belt with the direction that it has under the foot when the step begins. So each step goes too far
  // down, by half of turn^2 times the distance of the foot from the top: explicit Euler on a circle.
  const double on_wheel = 1.2 * (ground.start - half_foot) * std::expm1(turn * turn / 2 * frames);
  EXPECT_LE(drift, ground.wheel_radius > 0 ? on_wheel : 1e-15 * frames + 1e-13);
}

INSTANTIATE_TEST_SUITE_P(
    EveryGround, HeroRides,
    ::testing::Values(Ground{.name = "lift", .reach = {0, 10}, .period = 1200},
                      Ground{.name = "reversing_lift", .reach = {0.5, 1}, .period = 30},
                      Ground{.name = "conveyor", .belt = 1.5},
                      Ground{.name = "conveyor_on_a_lift", .reach = {1, 2}, .belt = 1.5},
                      Ground{.name = "turning_plank", .tilt = 0.3},
                      Ground{.name = "turning_plank_far_out", .tilt = 0.3, .start = 2.5},
                      Ground{.name = "turning_lift", .reach = {1, 2}, .tilt = 0.3},
                      Ground{.name = "plank_on_a_motor", .type = b2_dynamicBody, .tilt = 0.3},
                      Ground{.name = "wheel", .wheel_radius = 2, .tilt = 0.2},
                      Ground{.name = "wheel_on_a_lift", .wheel_radius = 2, .reach = {1, 2}, .tilt = 0.2},
                      Ground{.name = "wheel_on_a_motor", .type = b2_dynamicBody, .wheel_radius = 2, .tilt = 0.2}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace paperproof::box2d::hero_test
