#include "server/config/config_digest.h"

#include <algorithm>
#include <string>

#include "idl/identity.h"
#include "server/config/config_options.h"

namespace collision::server {
namespace {

constexpr std::string_view kFieldsWithoutResults[] = {"world",
                                                      "domain",
                                                      "clock.wait_for_synchronisation_s",
                                                      "log_level",
                                                      "log_file",
                                                      "log_format",
                                                      "status_period_s",
                                                      "broad_phase",
                                                      "tree_cache_dir",
                                                      "tree_cache_mb",
                                                      "state_dir",
                                                      "claim_wait_s",
                                                      "on_state_failure",
                                                      "on_occupied",
                                                      "lease_s",
                                                      "on_recording_failure",
                                                      "recorder_mb_max",
                                                      "recorder_segment_mb",
                                                      "recorder_segment_s",
                                                      "recorder_keep_s",
                                                      "contacts_mb_max",
                                                      "earliest_period_s",
                                                      "credentials_dir"};

}  // namespace

std::span<const std::string_view> FieldsWithoutResults() { return kFieldsWithoutResults; }

std::uint64_t ConfigurationDigest(const v1::Config& complete) {
  v1::Config defaults;
  defaults.mutable_clock()->set_kind(complete.clock().kind());
  std::string text;
  for (const ConfigOption& option : ConfigOptions()) {
    if (std::ranges::count(kFieldsWithoutResults, option.path) > 0) continue;
    SetValue(&defaults, option, DefaultOf(option, complete));
    const std::string value = ValueText(complete, option);
    const bool is_default = value == ValueText(defaults, option) && option.path != "clock.kind";
    if (!is_default) text.append(option.path).append(": ").append(value).append("\n");
  }
  for (const v1::SimulatorLimits& block : complete.limits()) {
    text.append("limits: ").append(block.ShortDebugString()).append("\n");
  }
  for (const v1::AgentClass& block : complete.classes()) {
    text.append("classes: ").append(block.ShortDebugString()).append("\n");
  }
  for (const v1::ExcludedPair& block : complete.excluded()) {
    text.append("excluded: ").append(block.ShortDebugString()).append("\n");
  }
  for (const v1::Level& block : complete.levels()) {
    text.append("levels: ").append(block.ShortDebugString()).append("\n");
  }
  const std::uint64_t digest = Fnv1a(text);
  return digest != 0 ? digest : 1;
}

}  // namespace collision::server
