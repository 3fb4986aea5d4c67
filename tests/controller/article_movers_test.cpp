/// What the article's techniques refuse of movers. tests/situations/techniques.json has what carries, pushes and
/// crushes.
#include "controller/article_support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace paperproof::article_tests {
namespace {

ColliderDef conveyor(ColliderDef def, double speed) {
  def.surface_speed = speed;
  return def;
}

constexpr std::array moving_kinds{"discrete", "penetration_resolution", "speculative_march", "speculative"};

TEST(MovingRefusals, of_steps_that_conveyors_make_too_long) {
  for (const std::string_view kind : moving_kinds) {
    SCOPED_TRACE(kind);
    Rig by_conveyor(kind, {conveyor(rectangle(-9, -1, 9, 0), 1e300)});
    by_conveyor.request.dt = 1;
    EXPECT_EQ(by_conveyor.move({0, 1}, {0, -2}).status, StepStatus::out_of_range);
    EXPECT_EQ(by_conveyor.result.position, Vec2d(0, 1));
  }
}

TEST(MovingRefusals, of_what_a_technique_cannot_express_say_so) {
  const auto refusal = [](std::string_view kind, const ColliderDef& collider) {
    return refusal_by<NotExpressible>([&] { Rig(kind, {collider}); });
  };
  const ColliderDef mover = compare::box(0, 0, 1, 1, 0);
  const ColliderDef belt = conveyor(rectangle(0, 0, 1, 1), 1);
  for (const std::string_view kind : {"grid", "pixel_colour", "pixel_tile", "mask", "wind_back"})
    for (const ColliderDef& each : {mover, belt})
      EXPECT_EQ(refusal(kind, each), std::string(kind) + " is for scenery that stands still");
  for (const std::string_view kind : {"wind_back", "penetration_resolution", "speculative", "discrete"})
    EXPECT_EQ(refusal(kind, compare::circle({0, 0}, 1)),
              std::string(kind) + " knows no circles: make a polygon of them");
  EXPECT_EQ(refusal("bounding_box", mover), "");
  EXPECT_EQ(refusal("bounding_box", belt), "bounding_box carries nobody: there is a conveyor");
}

}  // namespace
}  // namespace paperproof::article_tests
