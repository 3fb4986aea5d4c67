/// A movement from pixel to pixel.
#pragma once

#include "techniques/raster/raster_parts.hpp"

namespace paperproof::raster {

/// What one pixel of movement meets.
struct Advance {
  bool blocked = false;
  std::int64_t lift = 0;  ///< Pixels up (negative: down) that the ground takes the character with it.
};

/// One frame of a technique that looks before each pixel of movement.
///
/// The pixels are entered in the order in which the straight movement reaches them (vertical first where both are due),
/// one horizontal or vertical neighbour at a time. What blocks a direction ends the movement in that component only;
/// the other goes on, as in the article's response.
///
/// @tparam Rules what the picture says, const:
///   `bool is_free(sprite, placement)`, `Advance advance(sprite, placement, side, rising)`, and
///   `for_each_blocking(sprite, placement, side, visit)` with the solid pixels that stopped an advance.
template <class Rules>
class PixelWalk {
 public:
  /// @param result as `RasterParts::refuse` leaves it.
  PixelWalk(const RasterParts& parts, const Rules& rules, const MoveRequest& request, Scratch& scratch,
            MoveResult& result) noexcept
      : parts_(parts),
        rules_(rules),
        request_(request),
        scratch_(scratch),
        result_(result),
        corner_(parts.corner_at(request.position)),
        way_(parts.corner_at(request.position + request.displacement) - corner_) {}

  void run() noexcept {
    bool began_inside = false;
    at_ = parts_.start(corner_, way_, is_free(), began_inside);
    while (is_due(0) || is_due(1)) {
      const Eigen::Index component = is_due(1) && (!is_due(0) || time_of(1) <= time_of(0)) ? 1 : 0;
      step(component);
    }
    result_.position = position_at(1);
    result_.path.push_back({result_.position, 1});
    if (!began_inside) return;
    bool ends_inside = false;
    (void)parts_.start(parts_.corner_at(result_.position), way_, is_free(), ends_inside);
    if (ends_inside) result_.status = StepStatus::stuck;
  }

 private:
  [[nodiscard]] auto is_free() const noexcept {
    return [this](const Pixel& placement) { return rules_.is_free(parts_.sprite(), placement); };
  }
  [[nodiscard]] std::int64_t at(Eigen::Index component) const noexcept { return component == 0 ? at_.x : at_.y; }

  /// Whether the leading edge has more pixels to enter.
  [[nodiscard]] bool is_due(Eigen::Index component) const noexcept {
    const double end = corner_[component] + way_[component];
    if (stopped_[static_cast<std::size_t>(component)] || way_[component] == 0) return false;
    return way_[component] > 0 ? at(component) < ceil_to_pixel(end) : at(component) > floor_to_pixel(end);
  }
  /// The fraction of the movement at which the next pixel is entered. A pixel that the start lies in is entered at 0.
  [[nodiscard]] double time_of(Eigen::Index component) const noexcept {
    const double to_go = static_cast<double>(at(component)) - corner_[component];
    return fraction_of_step(to_go / way_[component]);
  }
  [[nodiscard]] Side side_of(Eigen::Index component) const noexcept {
    if (component == 0) return way_.x() < 0 ? Side::left : Side::right;
    return way_.y() < 0 ? Side::bottom : Side::top;
  }

  void step(Eigen::Index component) noexcept {
    const Side side = side_of(component);
    const double time = time_of(component);
    const bool rising = way_.y() > 0 && !stopped_[1];
    const Advance advance = rules_.advance(parts_.sprite(), at_, side, rising);
    if (advance.blocked) return stop(component, side, time);
    if (advance.lift != 0) record(time);
    at_ = at_ + towards(side) + Pixel{0, advance.lift};
    lifted_ += advance.lift;
    corner_.y() += static_cast<double>(advance.lift);
    // First up and then along, so that the way does not cut through the pixel that it climbs.
    if (advance.lift > 0) record(time);
  }

  void stop(Eigen::Index component, Side side, double time) noexcept {
    stopped_[static_cast<std::size_t>(component)] = true;
    result_.velocity[component] = 0;
    if (side == Side::bottom) result_.grounded = true;
    parts_.look_around(at_, scratch_);
    rules_.for_each_blocking(parts_.sprite(), at_, side,
                             [&](const Pixel& pixel) { parts_.report(pixel, side, time, scratch_, result_); });
    record(time);
  }

  [[nodiscard]] Vec2d position_at(double time) const noexcept {
    Vec2d position = request_.position + request_.displacement * time;
    position.y() += parts_.metres(lifted_);
    for (const Eigen::Index i : {0, 1}) {
      if (stopped_[static_cast<std::size_t>(i)]) position[i] = parts_.position_of(at(i), i);
    }
    return position;
  }

  /// A corner of the way, where there is room for one more and the end.
  void record(double time) noexcept {
    const Vec2d position = position_at(time);
    if (position == result_.path.back().position) return;
    if (result_.path.size() + 1 < most_corners) result_.path.push_back({position, time});
  }

  /// Of the path: a walk over many pixels shows its first turns.
  static constexpr std::size_t most_corners = 32;

  const RasterParts& parts_;
  const Rules& rules_;
  const MoveRequest& request_;
  Scratch& scratch_;
  MoveResult& result_;
  Vec2d corner_;  ///< Where the movement began, lifted with the character [px].
  Vec2d way_;     ///< [px]
  Pixel at_;      ///< The placement now.
  std::int64_t lifted_ = 0;
  std::array<bool, 2> stopped_{};
};

/// A technique that walks from pixel to pixel behind the common interface.
/// @tparam Rules as for `PixelWalk`, with `memory_bytes()`.
template <class Rules>
class PixelTechnique final : public Technique {
 public:
  /// @param name that lives as long as the program.
  PixelTechnique(std::string_view name, RasterParts parts, Rules rules)
      : name_(name), parts_(std::move(parts)), rules_(std::move(rules)) {}

  [[nodiscard]] std::string_view name() const noexcept override { return name_; }
  [[nodiscard]] Scratch make_scratch() const override { return parts_.make_scratch(); }
  [[nodiscard]] std::size_t memory_bytes() const noexcept override {
    return rules_.memory_bytes() + parts_.sprite().mask().memory_bytes();
  }

  void move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept override {
    if (parts_.refuse(request, result)) return;
    PixelWalk<Rules>(parts_, rules_, request, scratch, result).run();
  }

 private:
  std::string_view name_;
  RasterParts parts_;
  Rules rules_;
};

}  // namespace paperproof::raster
