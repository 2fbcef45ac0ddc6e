#include "server/service/detector_options.h"

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

}  // namespace

detection::DetectorOptions DetectorOptionsOf(const v1::Config& config) {
  const std::uint64_t per_step = WorkUnitsPerStep(config);
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

}  // namespace collision::server
