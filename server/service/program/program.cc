#include "server/service/program/program.h"

#include <google/protobuf/util/json_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "idl/limits.h"
#include "idl/recording/utc.h"
#include "server/bus/dds_bus.h"
#include "server/config/config.h"
#include "server/config/config_options.h"
#include "server/process/logging.h"
#include "server/process/signals.h"
#include "server/recording/recording.h"
#include "server/service/daemon.h"
#include "server/service/program/calibrate.h"
#include "server/service/program/kept_in_state_dir.h"
#include "server/service/program/recording_file.h"
#include "server/service/program/replay_program.h"
#include "server/service/requests/reload.h"
#include "server/service/serve.h"
#include "server/shapes/tree_cache.h"
#include "server/world/world.h"

namespace collision::server {
namespace {

/// The folder that systemd has made and named in this variable of the environment; empty: it made
/// none, or several, of which none is ours alone.
std::string FolderOfSystemd(const char* variable) {
  const char* value = std::getenv(variable);
  const std::string folder = value == nullptr ? "" : value;
  return folder.find(':') == std::string::npos ? folder : "";
}

/// Folders that are not configured are those of systemd: CacheDirectory=, StateDirectory=.
void TakeFoldersOfSystemd(v1::Config* config) {
  v1::Config with_folders = *config;
  if (config->tree_cache_dir().empty()) {
    with_folders.set_tree_cache_dir(FolderOfSystemd("CACHE_DIRECTORY"));
  }
  if (CheckValue(with_folders, *FindConfigOption("tree_cache_dir")).empty()) {
    config->set_tree_cache_dir(with_folders.tree_cache_dir());
  }
  if (config->state_dir().empty()) with_folders.set_state_dir(FolderOfSystemd("STATE_DIRECTORY"));
  if (CheckValue(with_folders, *FindConfigOption("state_dir")).empty()) {
    config->set_state_dir(with_folders.state_dir());
  }
}

/// Null: none is wanted. Throws std::runtime_error if there can be none.
std::shared_ptr<TreeCache> MakeTreeCache(const v1::Config& config) {
  if (config.tree_cache_dir().empty()) return nullptr;
  return std::make_shared<TreeCache>(config.tree_cache_dir(),
                                     config.tree_cache_mb() * std::uint64_t{1'000'000},
                                     BuildOptionsOf(config).tree);
}

/// The journal, whole or not. Throws std::runtime_error if it is damaged and that is to end the
/// service.
std::unique_ptr<Journal> ReadJournal(const v1::Config& config) {
  auto journal = std::make_unique<Journal>(config.state_dir(), config.world(), config.domain(),
                                           config.simulators_max());
  const std::vector<std::string>& damage = journal->damage();
  if (!damage.empty() && config.on_state_failure() == v1::Config::END) {
    const std::string more =
        damage.size() > 1 ? " (and " + std::to_string(damage.size() - 1) + " more)" : "";
    throw std::runtime_error(damage[0] + more + "; move the file away to begin anew");
  }
  for (const std::string& line : damage) {
    spdlog::warn("{}; the service goes on with what is left of it (on_state_failure)", line);
  }
  return journal;
}

/// Null: none is wanted, or the service goes on without one, for the reason in `failure`. Throws
/// std::runtime_error otherwise.
std::unique_ptr<Journal> OpenJournal(const v1::Config& config, std::string* failure) {
  if (config.state_dir().empty()) return nullptr;
  try {
    return ReadJournal(config);
  } catch (const JournalInUse&) {
    throw;
  } catch (const std::runtime_error& error) {
    spdlog::error("{}", error.what());
    if (config.on_state_failure() == v1::Config::END) {
      throw std::runtime_error(std::string(error.what()) + kGoOnInstead);
    }
    *failure = error.what();
    return nullptr;
  }
}

/// What a service remembers, as it is at the start.
struct State {
  std::unique_ptr<Journal> journal = nullptr;
  std::string failure = {};  ///< Why there is none, and the service goes on.
  bool opens_later = false;  ///< Another service has it now.
};

/// The exit code if that ends the service; nullopt: it does not.
std::optional<int> OpenState(const v1::Config& config, State* state) {
  if (config.on_state_failure() == v1::Config::END && config.state_dir().empty()) {
    return Fail(kExitConfiguration,
                "on_state_failure: END needs a folder for the journal: set state_dir, or "
                "StateDirectory= in the unit of systemd (it sets STATE_DIRECTORY)");
  }
  try {
    if (!state->opens_later) state->journal = OpenJournal(config, &state->failure);
  } catch (const JournalInUse& error) {
    if (config.on_occupied() != v1::Config::STAND_BY) return Fail(kExitOccupied, error.what());
    state->opens_later = true;
  } catch (const std::runtime_error& error) {
    return Fail(kExitFile, std::string("state_dir: ") + error.what());
  }
  return std::nullopt;
}

dds::SenderLimits SenderLimitsOf(const v1::Config& config) {
  return {.samples_per_second = config.sender_messages_per_second_max(),
          .bytes_per_second = config.sender_bytes_per_second_max(),
          .waiting_bytes_max = config.waiting_mb_max() * std::size_t{1'000'000}};
}

DdsBusOptions BusOptionsOf(const v1::Config& config) {
  return {.lease = std::chrono::nanoseconds(ToNanoseconds(config.lease_s())),
          .sender_limits = SenderLimitsOf(config),
          .stands_by = config.on_occupied() == v1::Config::STAND_BY,
          .credentials = config.credentials_dir()};
}

void LogSecurity(const DdsBus& bus, const v1::Config& config) {
  if (!config.credentials_dir().empty()) {
    spdlog::info(
        "secured: only programs with credentials of the same authority are heard; ours: {}",
        config.credentials_dir());
  } else if (bus.is_secured()) {
    spdlog::info("secured by the network profile");
  } else if (!bus.open_interface().empty()) {
    spdlog::warn(
        "not secured, and heard beyond this machine (network interface {}): whoever reaches it can "
        "write in any name. Keep it to this machine (cyclonedds-loopback.xml), or give all "
        "programs "
        "of the world credentials (collisionctl make-certificates, credentials_dir)",
        bus.open_interface());
  }
}

/// Null: there is no folder for it, or no room: the service goes on without. Requires the lock of
/// the journal.
std::unique_ptr<Quarantine> OpenQuarantine(const v1::Config& config, const Journal* journal) {
  if (journal == nullptr) return nullptr;
  try {
    return std::make_unique<Quarantine>(config.state_dir(), config.world(), config.domain(),
                                        journal->simulators());
  } catch (const std::runtime_error& error) {
    spdlog::warn("{}; a message that fails the service is not recognised at the next start",
                 error.what());
    return nullptr;
  }
}

/// An id that no other service has: of two random ones, equal with probability 2^-63. Of several
/// that start together the lowest serves: never one `without_journal` beside the one that holds it.
std::uint64_t DrawInstance(bool without_journal) {
  std::random_device source;
  constexpr std::uint64_t kHighest = std::uint64_t{1} << 63;
  const std::uint64_t drawn = (std::uint64_t{source()} << 32 | source()) & ~kHighest;
  return without_journal ? drawn | kHighest : std::max<std::uint64_t>(drawn, 1);
}

/// `journal`: null if there is none, or (`opens_later`) not yet. `again`: it has left the world to
/// another service, and waits for that one at least as long as a service is heard: the network may
/// have lost its first word.
ClaimOptions ClaimOf(const v1::Config& config, const Journal* journal, bool opens_later,
                     bool again) {
  const std::int64_t least_wait = again ? wire::kServiceLease : 0;
  ClaimOptions claim = {.instance = DrawInstance(opens_later),
                        .term_before = journal != nullptr ? journal->term() : 0,
                        .wait_ns = std::max(ToNanoseconds(config.claim_wait_s()), least_wait),
                        .heard_for_ns = wire::kServiceLease,
                        .stands_by = config.on_occupied() == v1::Config::STAND_BY,
                        .waking_ns = ToNanoseconds(config.lease_s())};
  if (journal == nullptr) return claim;
  for (const auto& [id, simulator] : journal->simulators()) claim.roster.push_back(simulator);
  return claim;
}

/// The configuration, with what the command line says in its place.
ConfigResult Load(const Options& options) {
  ConfigResult loaded =
      options.config_file.empty() ? ParseConfig("", "") : LoadConfig(options.config_file);
  if (!loaded.ok()) return loaded;
  if (options.world) loaded.config.set_world(*options.world);
  if (options.domain) loaded.config.set_domain(*options.domain);
  if (options.log_level) loaded.config.set_log_level(*options.log_level);
  if (options.credentials) loaded.config.set_credentials_dir(*options.credentials);
  return loaded;
}

/// The same while the service runs. A pipe has been read, and may block.
ConfigResult LoadAgain(const Options& options) {
  std::error_code error;
  const std::string& file = options.config_file;
  if (file.empty() || std::filesystem::is_regular_file(file, error)) return Load(options);
  ConfigResult refused;
  refused.errors = {file + ": " + (error ? error.message() : "not a regular file") +
                    ": it cannot be read again"};
  return refused;
}

/// As a reload reads it.
std::function<ConfigResult()> LoaderOf(const Options& options) {
  return [options] {
    ConfigResult loaded = LoadAgain(options);
    TakeFoldersOfSystemd(&loaded.config);
    return loaded;
  };
}

/// `again`: it has left the world to another service, and is to stand by for that one. `config`
/// changes when it is read again.
std::optional<int> ServeOnce(v1::Config& config, const Options& options, bool again) {
  std::shared_ptr<TreeCache> cache;
  try {
    cache = MakeTreeCache(config);
  } catch (const std::runtime_error& error) {
    return Fail(kExitFile, std::string("tree_cache_dir: ") + error.what());
  }
  // The other service may share the folder, and needs the journal now.
  State state{.opens_later = again && !config.state_dir().empty()};
  if (const auto failed = OpenState(config, &state)) return failed;
  std::unique_ptr<Journal>& journal = state.journal;
  std::function<Journal*()> open_journal;
  if (state.opens_later) open_journal = [&] { return (journal = ReadJournal(config)).get(); };
  const std::unique_ptr<Quarantine> quarantine = OpenQuarantine(config, journal.get());
  const ClaimOptions claim = ClaimOf(config, journal.get(), state.opens_later, again);
  std::unique_ptr<DdsBus> bus;
  try {
    bus = std::make_unique<DdsBus>(config.world(), config.domain(), BusOptionsOf(config));
  } catch (const std::runtime_error& error) {
    return Fail(kExitUnavailable, error.what());
  }
  RecordingFile recording(options.record_file);
  std::unique_ptr<RecordingWriter> recorder;
  try {
    recorder = recording.Open(config, claim);
  } catch (const std::runtime_error& error) {
    return Fail(kExitFile, error.what());
  }
  const KeptInStateDir kept = OpenKept(config, claim);
  LogSecurity(*bus, config);
  return Serve(config, *bus,
               {.recorder = recorder.get(),
                .flight = kept.flight.get(),
                .contacts = kept.contacts.get(),
                .trees = std::move(cache),
                .journal = {.journal = journal.get(),
                            .open = std::move(open_journal),
                            .failure = std::move(state.failure)},
                .quarantine = quarantine.get(),
                .claim = claim,
                .on_work =
                    [&] {
                      recording.Keep();
                      kept.Start();
                    },
                .load_config = LoaderOf(options),
                .on_config =
                    [&](const v1::Config& in_force) {
                      kept.SetLimits(in_force);
                      config = in_force;
                    }});
}

int Serve(v1::Config config, const Options& options) {
  PrepareSignals();
  for (bool again = false;; again = true) {
    if (const std::optional<int> code = ServeOnce(config, options, again)) return *code;
  }
}

/// Longer than a step may take (WatchdogSec= in the unit).
constexpr std::chrono::seconds kReloadPatience{60};

int ReloadOther(std::int32_t service) {
  const std::string process = "process " + std::to_string(service);
  switch (AskToReload(service, kReloadPatience)) {
    case ReloadAnswer::kDone:
      return kExitOk;
    case ReloadAnswer::kDoneInPart:
      std::cout << "collisiond: " << process
                << ": fields that differ take a new start; its log names them\n";
      return kExitOk;
    case ReloadAnswer::kRefused:
      return Fail(kExitConfiguration,
                  process + " keeps its configuration, for the reason that its log says");
    case ReloadAnswer::kNoProcess:
      return Fail(kExitUnavailable, process + " is not there, or belongs to another user");
    case ReloadAnswer::kNoService:
      return Fail(kExitUnavailable, process + " is no collisiond that serves");
    case ReloadAnswer::kNoAnswer:
      return Fail(kExitUnavailable, process + " has not answered within 60 s");
  }
  return kExitSoftware;
}

int Calibrate() {
  const double rate = std::max(MeasureWorkUnitsPerUs(), 1.0);
  std::cout << "work_units_per_us: " << std::llround(rate) << '\n';
  return kExitOk;
}

int Run(const Options& options) {
  if (options.calibrate) return Calibrate();
  if (!options.replay_file.empty()) return RunReplay(options);
  if (options.reload) return ReloadOther(*options.reload);
  ConfigResult loaded = Load(options);
  for (const std::string& error : loaded.errors) std::cerr << error << '\n';
  if (!loaded.ok()) return kExitConfiguration;
  if (options.print_config) std::cout << PrintConfig(loaded.config);
  if (options.check_config) std::cout << options.config_file << ": ok\n";
  if (options.print_config || options.check_config) return kExitOk;
  try {
    StartLogging(LogOptionsOf(loaded.config));
  } catch (const std::exception& error) {
    return Fail(kExitFile, std::string("log_file: ") + error.what());
  }
  TakeFoldersOfSystemd(&loaded.config);
  return Serve(loaded.config, options);
}

}  // namespace

int RunProgram(const Options& options) {
  return EndOnFailure([&options] { return Run(options); });
}

}  // namespace collision::server
