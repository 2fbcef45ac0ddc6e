#include <spdlog/spdlog.h>

#include <map>
#include <optional>
#include <tuple>

#include "tests/fuzz/answers.h"
#include "tests/fuzz/fuzzed_messages.h"
#include "tests/fuzz/targets.h"
#include "tests/server/scripted_bus.h"

namespace collision::fuzz {
namespace {

constexpr int kStepsMax = 24;
constexpr int kInputsMax = 160;

v1::Config FuzzedWorld(FuzzedData* data) {
  constexpr double kResolutions[] = {1.0 / 60, 0.001, 1};
  constexpr double kSkews[] = {0.002, 1e-9, 1};
  v1::Config config;
  config.set_log_level("off");
  const bool wall = data->Below(4) == 0;
  config.mutable_clock()->set_kind(wall ? v1::Clock::REAL_TIME : v1::Clock::LOCK_STEP);
  if (wall || data->Flag()) config.mutable_clock()->set_skew_max_s(data->OneOf(kSkews));
  if (!wall && data->Flag()) config.mutable_clock()->set_on_silent_simulator(v1::Clock::RELEASE);
  config.set_temporal_resolution_s(data->OneOf(kResolutions));
  config.set_announce_within_s(config.temporal_resolution_s() *
                               static_cast<double>(1 + data->Byte()));
  constexpr v1::Config::BroadPhase kMethods[] = {v1::Config::AUTO, v1::Config::ALL_PAIRS,
                                                 v1::Config::SPATIAL_INDEX};
  config.set_broad_phase(data->OneOf(kMethods));
  // Small, so that every limit is met and no input takes long.
  config.set_agents_max(static_cast<std::uint32_t>(4 + data->Below(4)));
  config.set_simulators_max(3);
  config.set_pairs_max(static_cast<std::uint32_t>(1 + data->Below(16)));
  config.set_pairs_per_agent_max(static_cast<std::uint32_t>(1 + data->Below(4)));
  config.set_history_max(static_cast<std::uint32_t>(2 + data->Below(8)));
  config.set_rejections_per_second_max(static_cast<std::uint32_t>(1 + data->Byte()));
  config.set_undescribed_after_s(0.5);
  config.set_time_budget_us(static_cast<double>(data->Byte()));
  config.set_step_budget_us(static_cast<double>(data->Byte()));
  config.set_shape_triangles_max(64);
  config.set_shapes_max(4);
  config.set_shape_bytes_max(1 << 20);
  return config;
}

/// Every refusal is reported, or counted as suppressed.
void CheckRefusals(const v1::ServiceStatus& status, std::uint64_t reported) {
  std::uint64_t refused = 0, suppressed = 0;
  for (const v1::Counter& counter : status.counters()) {
    if (counter.name() == "rejections_suppressed") {
      suppressed = counter.value();
    } else if (counter.name().starts_with("rejected_")) {
      refused += counter.value();
    }
  }
  Require(refused == reported + suppressed, refused, " refused; reported ", reported,
          ", suppressed ", suppressed);
}

/// A daemon, and what it has said so far.
class Session {
 public:
  explicit Session(const v1::Config& config)
      : simulated_(config.clock().kind() == v1::Clock::LOCK_STEP), daemon_(config) {
    if (!simulated_) now_ns_ = daemon_.bus().wall_ns;
  }

  std::int64_t now_ns() const { return now_ns_; }

  void Step(std::vector<v1::Input> inputs, double seconds) {
    daemon_.Step(std::move(inputs), seconds);
    if (!simulated_) now_ns_ += static_cast<std::int64_t>(seconds * 1e9);
    for (const v1::Output& output : std::exchange(daemon_.bus().outputs, {})) Take(output);
  }

  void End() {
    Step({}, 1);
    if (status_) CheckRefusals(*status_, reported_);
  }

 private:
  void Take(const v1::Output& output) {
    CheckOutput(output);
    if (output.has_rejection()) ++reported_;
    if (output.has_service_status()) status_ = output.service_status();
    if (!output.has_clearance()) return;
    const v1::Clearance& clearance = output.clearance();
    if (simulated_) now_ns_ = clearance.now_ns();
    // Time that was granted is never taken back within an epoch.
    const std::tuple key(clearance.simulator_id(), clearance.run(), clearance.stamp().epoch());
    std::int64_t& granted = granted_.try_emplace(key, clearance.granted_until_ns()).first->second;
    Require(clearance.granted_until_ns() >= granted, "granted ", granted, ", now only ",
            clearance.granted_until_ns());
    granted = clearance.granted_until_ns();
  }

  const bool simulated_;
  server::ScriptedDaemon daemon_;
  std::int64_t now_ns_ = 0;
  std::uint64_t reported_ = 0;
  std::optional<v1::ServiceStatus> status_;
  /// By simulator, run and epoch.
  std::map<std::tuple<std::uint64_t, std::uint32_t, std::uint32_t>, std::int64_t> granted_;
};

std::vector<v1::Input> FuzzedBatch(std::int64_t now_ns, int* left, FuzzedData* data) {
  std::vector<v1::Input> batch;
  for (std::size_t count = data->Below(16); count > 0 && *left > 0; --count, --*left) {
    if (data->empty()) break;
    v1::Input input = FuzzedInput(now_ns, data);
    if (ThroughNetwork(&input)) batch.push_back(std::move(input));
  }
  return batch;
}

}  // namespace

void FuzzCodec(Bytes bytes) {
  spdlog::set_level(spdlog::level::off);
  FuzzedData data(bytes);
  const v1::Config config = FuzzedWorld(&data);
  Require(server::CheckConfig(server::CompleteConfig(config)).empty(), "a bad configuration");
  Session session(config);
  int left = kInputsMax;
  for (int step = 0; step < kStepsMax && !data.empty(); ++step) {
    const double seconds = static_cast<double>(data.Byte()) / 64;
    session.Step(FuzzedBatch(session.now_ns(), &left, &data), seconds);
  }
  session.End();
}

}  // namespace collision::fuzz
