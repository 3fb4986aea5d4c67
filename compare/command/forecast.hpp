/// How long work will take, said before it has taken long.
#pragma once

#include <chrono>
#include <string>
#include <utility>

namespace paperproof::compare {

/// Measures the first steps and says once, on standard error, how long all of them will take if that is long. Terminal
/// or not: who waits for hours wants to know from the start.
class Forecast {
 public:
  /// @param steps of all scenes. @param noun what they are called.
  Forecast(bool wanted, double steps, std::string noun = "steps")
      : wanted_(wanted), steps_(steps), noun_(std::move(noun)), begin_(Clock::now()), scene_begin_(begin_) {}

  /// A scene whose preparation takes long. @param seconds that it takes. @param why in words.
  void preparation(const std::string& scene, double seconds, const std::string& why) const;
  void begin_scene(double steps);
  /// @param share of the scene's steps that is done. Zero says that the first one begins.
  void done(double share);

 private:
  using Clock = std::chrono::steady_clock;

  bool wanted_;
  double steps_;
  std::string noun_;
  Clock::time_point begin_;
  Clock::time_point scene_begin_;  ///< Of its first step.
  double steps_before_ = 0;        ///< In scenes that are done.
  double steps_of_scene_ = 0;
};

/// "40 seconds", "3 minutes", "5 hours", "12 days".
[[nodiscard]] std::string duration_in_words(double seconds);

}  // namespace paperproof::compare
