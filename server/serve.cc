#include "server/serve.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <mutex>

#include "server/config.h"
#include "server/daemon.h"
#include "server/logging.h"
#include "server/service_notify.h"
#include "server/stop_signals.h"
#include "server/system_clock.h"
#include "server/threaded_shape_builder.h"
#include "server/version.h"

namespace collision::server {
namespace {

/// A step takes milliseconds; who stops the service expects its end within a second.
constexpr std::chrono::milliseconds kStepPatience{700};

/// The step that runs is not interrupted but left: nothing of it is lost that the recording holds.
[[noreturn]] void EndInTheStep(RecordingWriter* recorder) {
  std::unique_lock<std::mutex> no_write;
  if (recorder != nullptr) no_write = recorder->HoldWrites();
  spdlog::warn("ended in the middle of a step that was not over {} ms after the signal",
               kStepPatience.count());
  spdlog::default_logger_raw()->flush();
  std::_Exit(kExitOk);
}

}  // namespace

int Fail(ExitCode code, const std::string& line) {
  std::cerr << "collisiond: " << line << std::endl;
  return code;
}

void TellEventLog(const EventLog& log) {
  EndLogging();
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::info);
  spdlog::info("event log: {} events, hash {:016x}", log.count(), log.hash());
  spdlog::set_level(level);
}

int Serve(const v1::Config& config, Bus& bus, RecordingWriter* recorder,
          std::shared_ptr<TreeCache> cache) {
  SystemClock clock;
  BuildOptions build = BuildOptionsOf(config);
  build.cache = std::move(cache);
  Daemon daemon(config, bus, clock, recorder,
                std::make_unique<ThreadedShapeBuilder>(build, [&bus] { bus.Wake(); }));
  const StopSignalWatcher signals([&daemon] { daemon.Stop(); }, kStepPatience,
                                  [recorder] { EndInTheStep(recorder); });
  ServiceNotifier service_manager;
  spdlog::info("collisiond {} serves world \"{}\" on domain {}", kVersion, config.world(),
               config.domain());
  spdlog::info("narrow phase: {} us at {} units/us = {} work units per pair and turn",
               config.time_budget_us(), config.work_units_per_us(), WorkUnitsPerTurn(config));
  service_manager.Ready();
  while (daemon.Step()) service_manager.Alive(std::chrono::steady_clock::now());
  service_manager.Stopping();
  TellEventLog(daemon.event_log());
  if (recorder && !recorder->error().empty()) return Fail(kExitRecording, recorder->error());
  return signals.stopped() ? kExitOk : Fail(kExitUnavailable, "DDS has ended");
}

}  // namespace collision::server
