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

RollingPlace PlaceIn(const v1::Config& config, const char* folder, const char* suffix,
                     RollingLimits limits) {
  return {.folder = config.state_dir() + "/" + folder,
          .world_and_domain = config.world() + "." + std::to_string(config.domain()),
          .suffix = suffix,
          .limits = limits};
}

RollingLimits LimitsOfContacts(const v1::Config& config) {
  return {.bytes_max = config.contacts_mb_max() * kMegabyte};
}

RollingLimits LimitsOfFlight(const v1::Config& config) {
  return {.bytes_max = config.recorder_mb_max() * kMegabyte,
          .keep_ns = ToNanoseconds(config.recorder_keep_s())};
}

SegmentLimits LimitsOfSegment(const v1::Config& config) {
  return {.bytes = std::min(config.recorder_segment_mb() * kMegabyte,
                            LimitsOfFlight(config).bytes_max / kSegmentsLeast),
          .age_ns = ToNanoseconds(config.recorder_segment_s())};
}

}  // namespace

void KeptInStateDir::Start() const {
  if (contacts) contacts->Start(WallNow());
  if (!flight) return;
  flight->Start();
  spdlog::info("flight recorder: {}", about_flight);
}

void KeptInStateDir::SetLimits(const v1::Config& config) const {
  if (contacts) contacts->SetLimits(LimitsOfContacts(config));
  if (flight) flight->SetLimits(LimitsOfFlight(config), LimitsOfSegment(config));
}

KeptInStateDir OpenKept(const v1::Config& config, const ClaimOptions& claim) {
  KeptInStateDir kept;
  if (config.state_dir().empty()) return kept;
  if (config.contacts_mb_max() > 0) {
    kept.contacts = std::make_unique<ContactJournal>(
        PlaceIn(config, wire::kContactsFolder, wire::kContactsSuffix, LimitsOfContacts(config)));
  }
  if (config.recorder_mb_max() == 0) return kept;
  const RollingPlace place =
      PlaceIn(config, wire::kRecordingsFolder, wire::kRecordingSuffix, LimitsOfFlight(config));
  kept.about_flight =
      place.folder + ", at most " + std::to_string(config.recorder_mb_max()) + " MB";
  kept.flight =
      std::make_unique<FlightRecorder>(place, LimitsOfSegment(config), config, claim, WallNow());
  return kept;
}

}  // namespace collision::server
