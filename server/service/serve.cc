#include "server/service/serve.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "idl/identity.h"
#include "server/bus/system_clock.h"
#include "server/config/config.h"
#include "server/process/logging.h"
#include "server/process/process_text.h"
#include "server/process/service_notify.h"
#include "server/process/signals.h"
#include "server/process/version.h"
#include "server/recording/flight_recorder.h"
#include "server/service/daemon.h"
#include "server/service/requests/signal_requests.h"
#include "server/service/wait_for_clock.h"
#include "server/shapes/threaded_shape_builder.h"
#include "server/world/world.h"

namespace collision::server {
namespace {

/// A step takes milliseconds; an operator who stops the service expects its end within a second.
constexpr std::chrono::milliseconds kStepPatience{700};

/// Leaves the step that runs: nothing is lost that the recording does not hold.
[[noreturn]] void EndInTheStep(RecordingWriter* recorder, FlightSink* flight,
                               Quarantine* quarantine) {
  std::unique_lock<std::mutex> no_write;
  if (recorder != nullptr) no_write = recorder->HoldWrites();
  if (flight != nullptr) flight->WaitUntilWritten();
  spdlog::warn(
      "a step is still running {} ms after the stop signal: collisiond exits without "
      "waiting for it; the recording, if any, is complete",
      kStepPatience.count());
  spdlog::default_logger_raw()->flush();
  if (quarantine != nullptr) quarantine->AbandonStep();
  std::_Exit(kExitOk);
}

int EndWith(ExitCode code, const char* what, const std::exception& failure) {
  EndLogging();
  spdlog::critical("{}: {}", what, failure.what());
  spdlog::default_logger_raw()->flush();
  return Fail(code, std::string(what) + ": " + failure.what());
}

std::string NetworkProfile() {
  const char* uri = std::getenv("CYCLONEDDS_URI");
  return uri == nullptr || *uri == '\0' ? "none, CYCLONEDDS_URI is not set" : uri;
}

/// As the configuration asks for; says how it ended.
void WaitForWallClock(const v1::Config& config, const SignalWatcher& signals,
                      ServiceNotifier* service_manager) {
  const std::chrono::nanoseconds longest(
      ToNanoseconds(config.clock().wait_for_synchronisation_s()));
  if (config.clock().kind() != v1::Clock::REAL_TIME || longest.count() == 0) return;
  spdlog::info("waits for the wall clock to be synchronised, at most {} s",
               config.clock().wait_for_synchronisation_s());
  const auto pause = [&](std::chrono::nanoseconds period) {
    std::this_thread::sleep_for(period);
    service_manager->Alive(std::chrono::steady_clock::now());
    return !signals.stopped();
  };
  switch (WaitForClock(longest, WallClockIsSynchronised, pause)) {
    case ClockWait::kSynchronised:
      return spdlog::info("the wall clock is synchronised");
    case ClockWait::kNotToldBySystem:
      return spdlog::warn(
          "the system does not say whether the wall clock is synchronised (under systemd, "
          "ProtectClock= forbids to ask): goes on without");
    case ClockWait::kTimeout:
      return spdlog::warn("the wall clock is still not synchronised: goes on without");
    case ClockWait::kStopped:
      return;
  }
}

/// When a status is to be published in the middle of a step that takes long.
class StatusInStep {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit StatusInStep(double period_s)
      : period_(
            std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(period_s))) {}

  bool IsDue(Time now) {
    if (now < due_) return false;
    due_ = now + period_;
    return true;
  }
  /// Between steps the daemon publishes it.
  void StepIsOver(Time now) { due_ = now + period_; }

 private:
  const Time::duration period_;
  Time due_ = std::chrono::steady_clock::now() + period_;
};

void LogStart(const v1::Config& config, const ClaimOptions& claim, bool has_journal) {
  spdlog::info("collisiond {}, service {} ({}), claims world \"{}\" on domain {}", Version(),
               IdText(claim.instance), ProcessText(), config.world(), config.domain());
  spdlog::info("network profile: {}", NetworkProfile());
  if (!has_journal) spdlog::info("no journal: nothing is kept for the next start");
  spdlog::info("narrow phase: {} us at {} units/us = {} work units per pair and evaluation",
               config.time_budget_us(), config.work_units_per_us(), WorkUnitsPerEvaluation(config));
}

/// All but what gives up.
SignalActions ActionsOf(Daemon* daemon, SignalRequests* requests, Bus* bus) {
  return {.stop = [daemon] { daemon->Stop(); },
          .patience = kStepPatience,
          .give_up = nullptr,
          .reload =
              [requests, bus](pid_t asker) {
                requests->AskToReload(asker);
                bus->Wake();
              },
          .dump =
              [requests, bus] {
                requests->AskToDump();
                bus->Wake();
              }};
}

/// It has left the world to another service, for which it is to stand by.
bool StartsAfresh(const Daemon& daemon, const ClaimOptions& claim, bool stopped) {
  return daemon.claim().phase() == ClaimPhase::kYielded && claim.stands_by && !stopped;
}

/// What was to be kept, and is not; nullopt: nothing.
std::optional<int> FailureAtTheEnd(const v1::Config& config, const Daemon& daemon,
                                   const RecordingWriter* recorder) {
  const bool needs_recording = config.on_recording_failure() == v1::Config::END;
  if (needs_recording && recorder && !recorder->error().empty()) {
    return Fail(kExitFile, recorder->error() +
                               " (on_recording_failure is END; GO_ON serves without a recording)");
  }
  if (config.on_state_failure() == v1::Config::END && !daemon.state_failure().empty()) {
    return Fail(kExitFile, "state_dir: " + daemon.state_failure() + kGoOnInstead);
  }
  return std::nullopt;
}

/// Whether it works now, which is told.
bool BecomesReady(const Daemon& daemon, const std::function<void()>& on_work,
                  ServiceNotifier* service_manager) {
  if (!daemon.claim().works()) return false;
  if (on_work) on_work();
  service_manager->Ready();
  return true;
}

std::optional<int> ServeUntilStopped(const v1::Config& config, Bus& bus, ServiceParts parts) {
  SystemClock clock([&bus] { bus.Wake(); });
  RecordingWriter* const recorder = parts.recorder;
  const ProcessMeter meter;
  const bool has_journal = parts.journal.journal != nullptr || parts.journal.open != nullptr;
  BuildOptions build = BuildOptionsOf(config);
  build.cache = std::move(parts.trees);
  ServiceNotifier service_manager;
  StatusInStep status(config.status_period_s());
  Daemon daemon(
      config, bus, clock,
      {.recorder = recorder,
       .flight = parts.flight,
       .contacts = parts.contacts,
       .shape_builder = std::make_unique<ThreadedShapeBuilder>(build, [&bus] { bus.Wake(); }),
       .journal = std::move(parts.journal),
       .quarantine = parts.quarantine,
       .process = ProcessText(),
       .claim = parts.claim,
       .meter = &meter,
       .progress = [&] {
         const auto now = std::chrono::steady_clock::now();
         service_manager.Alive(now);
         return status.IsDue(now);
       }});
  SignalRequests requests(
      Reloader(config, std::move(parts.load_config)), std::move(parts.on_config),
      [&daemon] { return daemon.StateLines(); }, &service_manager);
  SignalActions actions = ActionsOf(&daemon, &requests, &bus);
  actions.give_up = [recorder, flight = parts.flight, quarantine = parts.quarantine] {
    EndInTheStep(recorder, flight, quarantine);
  };
  const SignalWatcher signals(std::move(actions));
  LogStart(config, parts.claim, has_journal);
  WaitForWallClock(config, signals, &service_manager);
  bool ready = false;
  while (daemon.Step()) {
    ready = ready || BecomesReady(daemon, parts.on_work, &service_manager);
    requests.Fulfil();
    const auto now = std::chrono::steady_clock::now();
    service_manager.Alive(now);
    if (service_manager.WantsStatus(now)) service_manager.Tell(daemon.StatusLine(), now);
    status.StepIsOver(now);
  }
  const bool starts_afresh = StartsAfresh(daemon, parts.claim, signals.stopped());
  if (!starts_afresh) service_manager.Stopping();
  LogFingerprint(daemon);
  if (const auto failed = FailureAtTheEnd(config, daemon, recorder)) return failed;
  if (starts_afresh) {
    spdlog::warn("{}: starts afresh, to stand by", daemon.claim().why());
    return std::nullopt;
  }
  if (signals.stopped()) return kExitOk;
  if (daemon.claim().phase() == ClaimPhase::kYielded) {
    return Fail(kExitOccupied, "world \"" + config.world() + "\": " + daemon.claim().why());
  }
  return Fail(kExitUnavailable, "DDS has ended");
}

}  // namespace

int Fail(ExitCode code, const std::string& line) {
  std::cerr << "collisiond: " << line << std::endl;
  return code;
}

void LogFingerprint(const Daemon& daemon) {
  EndLogging();
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::info);
  const auto write = [](const char* what, const EventLog& log) {
    spdlog::info("{} log: {} events, hash {:016x}", what, log.count(), log.hash());
  };
  if (daemon.screening_log().count() > 0) write("screening", daemon.screening_log());
  write("event", daemon.event_log());
  spdlog::set_level(level);
}

int EndOnFailure(const std::function<int()>& run) {
  try {
    return run();
  } catch (const std::logic_error& failure) {
    return EndWith(kExitSoftware, "a check has failed, which is a bug in collisiond", failure);
  } catch (const std::exception& failure) {
    return EndWith(kExitSystem, "memory or another system resource is exhausted", failure);
  }
}

std::optional<int> Serve(const v1::Config& config, Bus& bus, ServiceParts parts) {
  std::optional<int> code;
  const int failed = EndOnFailure([&] {
    code = ServeUntilStopped(config, bus, std::move(parts));
    return kExitOk;
  });
  return failed == kExitOk ? code : failed;
}

}  // namespace collision::server
