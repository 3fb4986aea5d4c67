#include "crowd/meeting.hpp"

#include <algorithm>

namespace paperproof::crowd {
namespace {

/// A place on a way that only goes on.
template <class Scalar>
class Traveller {
 public:
  /// At `time`, before anything that takes no time then.
  Traveller(const Way<Scalar>& way, Scalar time) noexcept : way_(way) {
    while (!arrived() && leg_end() < time) ++corner_;
    position_ = at(time);
    rounded_ = between_corners(time);
  }
  /// At the last corner.
  [[nodiscard]] bool arrived() const noexcept { return corner_ + 1 >= way_.path.size(); }
  [[nodiscard]] const Vec2<Scalar>& position() const noexcept { return position_; }
  [[nodiscard]] Scalar leg_end() const noexcept { return way_.time(corner_ + 1); }
  /// The next part takes no time.
  [[nodiscard]] bool jumps() const noexcept { return !arrived() && way_.time(corner_) == leg_end(); }
  [[nodiscard]] Leg<Scalar> jump() noexcept {
    ++corner_;
    const Leg<Scalar> leg{position_, way_.path[corner_].position, rounded_};
    position_ = leg.to;
    rounded_ = false;
    return leg;
  }
  /// On to a time that is not beyond the end of the present part.
  [[nodiscard]] Leg<Scalar> go_to(Scalar time) noexcept {
    Leg<Scalar> leg{position_, at(time), rounded_};
    position_ = leg.to;
    rounded_ = between_corners(time);
    leg.rounded = leg.rounded || rounded_;
    if (!arrived() && leg_end() <= time) ++corner_;
    return leg;
  }

 private:
  [[nodiscard]] bool between_corners(Scalar time) const noexcept {
    return !arrived() && time > way_.time(corner_) && time < leg_end() &&
           way_.path[corner_].position != way_.path[corner_ + 1].position;
  }
  [[nodiscard]] Vec2<Scalar> at(Scalar time) const noexcept {
    const Vec2<Scalar>& start = way_.path[corner_].position;
    const Scalar start_time = way_.time(corner_);
    if (arrived() || time <= start_time) return start;
    const Vec2<Scalar>& end = way_.path[corner_ + 1].position;
    if (time >= leg_end()) return end;
    const Scalar share = (time - start_time) / (leg_end() - start_time);
    return start + (end - start) * share;
  }

  const Way<Scalar>& way_;
  std::size_t corner_ = 0;
  Vec2<Scalar> position_{Vec2<Scalar>::Zero()};
  bool rounded_ = false;
};

template <class Scalar>
Leg<Scalar> stay(const Vec2<Scalar>& position) noexcept {
  return {.from = position, .to = position};
}

/// @param begin,end when the two legs are made, as fractions of the step.
template <class Scalar>
Meeting<Scalar> meeting_of(const PairSweep<Scalar>& sweep, const Leg<Scalar>& first, const Leg<Scalar>& second,
                           Scalar begin, Scalar end) noexcept {
  Meeting<Scalar> meeting;
  meeting.meets = true;
  meeting.normal = sweep.normal;
  meeting.at_once = !(end > begin);
  const Scalar duration = meeting.at_once ? Scalar(1) : end - begin;
  meeting.first_rate = (first.to - first.from) / duration;
  meeting.second_rate = (second.to - second.from) / duration;
  meeting.time = begin + (end - begin) * sweep.stop;
  meeting.impact = std::min(begin + (end - begin) * sweep.impact, Scalar(1));
  return meeting;
}

}  // namespace

template <class Scalar>
Meeting<Scalar> first_meeting(const PairSpace<Scalar>& space, const Way<Scalar>& first, const Way<Scalar>& second,
                              Scalar from, Scalar least) noexcept {
  Traveller<Scalar> one(first, from);
  Traveller<Scalar> other(second, from);
  Scalar now = from;
  while (true) {
    Leg<Scalar> of_one = stay(one.position());
    Leg<Scalar> of_other = stay(other.position());
    Scalar next = now;
    if (one.jumps()) {
      of_one = one.jump();
    } else if (other.jumps()) {
      of_other = other.jump();
    } else {
      if (one.arrived() && other.arrived()) return {};
      next = one.arrived()     ? other.leg_end()
             : other.arrived() ? one.leg_end()
                               : std::min(one.leg_end(), other.leg_end());
      of_one = one.go_to(next);
      of_other = other.go_to(next);
    }
    const PairSweep<Scalar> sweep = space.sweep(of_one, of_other, least);
    if (sweep.meets) return meeting_of(sweep, of_one, of_other, now, next);
    now = next;
  }
}

template Meeting<float> first_meeting(const PairSpace<float>&, const Way<float>&, const Way<float>&, float,
                                      float) noexcept;
template Meeting<double> first_meeting(const PairSpace<double>&, const Way<double>&, const Way<double>&, double,
                                       double) noexcept;

}  // namespace paperproof::crowd
