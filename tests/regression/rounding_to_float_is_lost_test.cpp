// Cause: g++ 12.2 from -O2 on. Two neighbouring doubles that are rounded to float and widened again are joined into one
// vector by the SLP vectorizer, and the pair of conversions is then dropped as if it did nothing.
// Seen as: other offsets of slopes in float (by one ulp, 2e-6 m at 20 m), so other bits at -O0 and at -O3.
// Remedy: -fno-tree-slp-vectorize for every target of the project (controller/compiler_options.cmake).
#include <gtest/gtest.h>

namespace {

struct Pair {
  double x;
  double y;
};

Pair rounded(const Pair& value) {
  const float x = static_cast<float>(value.x);
  const float y = static_cast<float>(value.y);
  return {static_cast<double>(x), static_cast<double>(y)};
}

TEST(Regression, two_neighbours_rounded_to_float_are_rounded) {
  const Pair exact{0.1, 0.7};                    // neither is a float
  Pair (*volatile call)(const Pair&) = rounded;  // volatile: nothing is known of its argument
  const Pair found = call(exact);
  const volatile float x = 0.1F;  // volatile: converted as it runs
  const volatile float y = 0.7F;
  EXPECT_EQ(found.x, static_cast<double>(x));
  EXPECT_EQ(found.y, static_cast<double>(y));
}

}  // namespace
