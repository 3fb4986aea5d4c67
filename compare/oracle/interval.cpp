#include "oracle/interval.hpp"

namespace paperproof::compare::detail {
namespace {

/// pi/2 is this double plus something in `rest_of_half_pi`.
constexpr double half_pi = 0x1.921fb54442d18p+0;
const Interval rest_of_half_pi{0x1.1a62633145c06p-54, 0x1.1a62633145c07p-54};

/// 1 - x²/(n (n+1)) (1 - x²/((n+2) (n+3)) (…)) for |x| < 1, with bounds on what is left out.
Interval series(const Interval& squared, int n) {
  // The innermost bracket that is left out is 1 - x²/((n+18) (n+19)) (…), and the rest of it lies between 0 and 1.
  Interval sum(0.99, 1);
  for (int k = n + 16; k >= n; k -= 2) {
    sum = Interval(1) - squared * sum / (static_cast<double>(k) * (k + 1));
  }
  return sum;
}

}  // namespace

SineCosine sine_cosine(const Interval& angle) {
  const double middle = angle.low + (angle.high - angle.low) / 2;
  const double radius = Interval::up(std::max(middle - angle.low, angle.high - middle));
  const double quarter_turns = std::nearbyint(middle / half_pi);
  const Interval rest =
      (Interval(middle) - Interval(quarter_turns) * half_pi) - Interval(quarter_turns) * rest_of_half_pi;
  const Interval squared = rest * rest;
  const Interval sine = rest * series(squared, 2);
  const Interval cosine = series(squared, 1);
  const Interval off(-radius, radius);
  const auto within_one = [](const Interval& x) {
    return Interval(std::clamp(x.low, -1.0, 1.0), std::clamp(x.high, -1.0, 1.0));
  };
  const auto turned = [&](const Interval& s, const Interval& c) {
    return SineCosine{within_one(s + off), within_one(c + off)};
  };
  switch (static_cast<long long>(quarter_turns) & 3) {
    case 0:
      return turned(sine, cosine);
    case 1:
      return turned(cosine, -sine);
    case 2:
      return turned(-sine, -cosine);
    default:
      return turned(-cosine, sine);
  }
}

}  // namespace paperproof::compare::detail
