#include "server/service/program/kept_in_state_dir.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

#include "idl/recording/kept_files.h"
#include "server/world/world.h"

namespace collision::server {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

std::int64_t WallNow() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

RollingPlace PlaceIn(const v1::Config& config, const char* folder, const char* suffix) {
  return {.folder = config.state_dir() + "/" + folder,
          .world_and_domain = config.world() + "." + std::to_string(config.domain()),
          .suffix = suffix};
}

}  // namespace

void KeptInStateDir::Start() const {
  if (contacts) contacts->Start(WallNow());
  if (!flight) return;
  flight->Start();
  spdlog::info("flight recorder: {}", about_flight);
}

KeptInStateDir OpenKept(const v1::Config& config, const ClaimOptions& claim) {
  KeptInStateDir kept;
  if (config.state_dir().empty()) return kept;
  if (config.contacts_mb_max() > 0) {
    RollingPlace place = PlaceIn(config, wire::kContactsFolder, wire::kContactsSuffix);
    place.bytes_max = config.contacts_mb_max() * kMegabyte;
    kept.contacts = std::make_unique<ContactJournal>(place);
  }
  if (config.recorder_mb_max() == 0) return kept;
  RollingPlace place = PlaceIn(config, wire::kRecordingsFolder, wire::kRecordingSuffix);
  place.bytes_max = config.recorder_mb_max() * kMegabyte;
  place.keep_ns = ToNanoseconds(config.recorder_keep_s());
  const SegmentLimits limits{
      .bytes = std::min(config.recorder_segment_mb() * kMegabyte, place.bytes_max / kSegmentsLeast),
      .age_ns = ToNanoseconds(config.recorder_segment_s())};
  kept.about_flight =
      place.folder + ", at most " + std::to_string(config.recorder_mb_max()) + " MB";
  kept.flight = std::make_unique<FlightRecorder>(place, limits, config, claim, WallNow());
  return kept;
}

}  // namespace collision::server
