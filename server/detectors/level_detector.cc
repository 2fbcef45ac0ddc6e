#include "server/detectors/level_detector.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "server/detectors/detector_options.h"

namespace collision::server {

LevelDetector::LevelDetector(const v1::Config& config, Level level, std::size_t detectors)
    : level_(std::make_unique<const Level>(std::move(level))),
      near_(LevelDetectorOptions(config, detectors, level_->look_ahead), level_->margin,
            level_.get(), config.tree_bytes_max() / detectors) {
  if (level_->hysteresis == 0) return;
  far_ = std::make_unique<GrownDetector>(
      LevelDetectorOptions(config, detectors, level_->look_ahead),
      level_->margin + level_->hysteresis, level_.get(), config.tree_bytes_max() / detectors);
}

void LevelDetector::Advance(Instant now, const std::function<void()>& progress) {
  Each([&](GrownDetector& detector) { detector.Advance(now, progress); });
  std::vector<detection::CollisionEvent> near;
  std::ranges::copy_if(near_.detector().events(), std::back_inserter(near),
                       [this](const auto& event) { return level_->Tells(event); });
  events_ = far_ ? hysteresis_.Take(near, far_->detector().events()) : std::move(near);
}

}  // namespace collision::server
