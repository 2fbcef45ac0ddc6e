#include "server/detectors/detector_options.h"

#include <algorithm>

#include "server/config/config.h"

namespace collision::server {
namespace {

/// A recording from before the field has none set.
broad_phase::BroadPhaseMethod MethodOf(v1::Config::BroadPhase method) {
  switch (method) {
    case v1::Config::ALL_PAIRS:
      return broad_phase::BroadPhaseMethod::kAllPairs;
    case v1::Config::SPATIAL_INDEX:
      return broad_phase::BroadPhaseMethod::kSpatialIndex;
    default:
      return broad_phase::BroadPhaseMethod::kAuto;
  }
}

/// With `per_step` work units in a step; 0: no limit.
detection::DetectorOptions OptionsOf(const v1::Config& config, std::uint64_t per_step) {
  const bool sliced = config.clock().kind() == v1::Clock::REAL_TIME && per_step > 0;
  return {.temporal_resolution = config.temporal_resolution_s(),
          .announce_within = config.announce_within_s(),
          .skew = config.clock().skew_max_s(),
          .agents_max = config.agents_max(),
          .pairs_max = config.pairs_max(),
          .pairs_per_agent_max = config.pairs_per_agent_max(),
          .history_max = config.history_max(),
          .work_units_per_evaluation = WorkUnitsPerEvaluation(config),
          .work_units_per_step = per_step,
          .work_units_per_slice =
              sliced ? std::max<std::uint64_t>(1, per_step / kSlicesPerResolution) : 0,
          .broad_phase = MethodOf(config.broad_phase())};
}

std::uint64_t PartOf(std::uint64_t per_step, double share) {
  return static_cast<std::uint64_t>(share * static_cast<double>(per_step));
}

/// Of the budget of a step, the part of all levels.
std::uint64_t OfLevels(std::uint64_t per_step) { return PartOf(per_step, kLevelsShare); }

}  // namespace

detection::DetectorOptions DetectorOptionsOf(const v1::Config& config,
                                             std::size_t level_detectors) {
  const std::uint64_t per_step = WorkUnitsPerStep(config);
  return OptionsOf(config, level_detectors > 0 ? per_step - OfLevels(per_step) : per_step);
}

detection::DetectorOptions LevelDetectorOptions(const v1::Config& config,
                                                std::size_t level_detectors, double look_ahead) {
  const std::uint64_t per_step = WorkUnitsPerStep(config);
  const std::uint64_t share = std::max<std::uint64_t>(1, OfLevels(per_step) / level_detectors);
  detection::DetectorOptions options = OptionsOf(config, per_step > 0 ? share : 0);
  options.announce_within = look_ahead;
  return options;
}

detection::DetectorOptions ScreeningDetectorOptions(const v1::Config& config) {
  const std::uint64_t per_step = WorkUnitsPerStep(config);
  const std::uint64_t share = std::max<std::uint64_t>(1, PartOf(per_step, kScreeningShare));
  return OptionsOf(config, per_step > 0 ? share : 0);
}

}  // namespace collision::server
