// What is told of one level.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "server/detectors/grown_detector.h"
#include "server/detectors/hysteresis.h"

namespace collision::server {

/// Finds the crossings of a level with a detector of its own, and where the level has a hysteresis
/// with a second one. One thread.
class LevelDetector {
 public:
  /// Detectors that a level needs.
  static std::size_t DetectorsOf(const Level& level) { return level.hysteresis > 0 ? 2 : 1; }

  /// `detectors`: of all levels together.
  LevelDetector(const v1::Config& config, Level level, std::size_t detectors);

  const Level& level() const { return *level_; }

  /// Calls `call(GrownDetector&)` for each of its detectors.
  template <typename Call>
  void Each(const Call& call) {
    call(near_);
    if (far_) call(*far_);
  }
  template <typename Call>
  void Each(const Call& call) const {
    call(near_);
    if (far_) call(*far_);
  }

  /// Brings both to `now`.
  void Advance(Instant now, const std::function<void()>& progress);

  /// What is told of the last Advance(), in this order; valid until the next one.
  const std::vector<detection::CollisionEvent>& events() const { return events_; }

  /// As those of a detector: until when no agent crosses the level.
  std::vector<detection::AgentClearance> TakeChangedClearances() {
    return near_.detector().TakeChangedClearances();
  }

  /// Revisions that the hysteresis held back.
  std::uint64_t withheld() const { return hysteresis_.withheld(); }

 private:
  std::unique_ptr<const Level> level_;  ///< Where the detectors find it.
  GrownDetector near_;
  std::unique_ptr<GrownDetector> far_;  ///< Null: the level has no hysteresis.
  Hysteresis hysteresis_;
  std::vector<detection::CollisionEvent> events_;
};

}  // namespace collision::server
