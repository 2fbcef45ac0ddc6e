// The daemon from its start to its end.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "idl/config.pb.h"
#include "server/bus/bus.h"
#include "server/claim/journal.h"
#include "server/claim/quarantine.h"
#include "server/claim/service_claim.h"
#include "server/config/config.h"
#include "server/recording/recording.h"
#include "server/service/exit_code.h"
#include "server/shapes/tree_store.h"

namespace collision::server {

class ContactSink;
class Daemon;
class FlightSink;

/// The end of the line about a journal that ends the service.
inline constexpr char kGoOnInstead[] =
    " (on_state_failure is END; GO_ON serves without what is lost)";

/// What a service may have beside its bus; all may be null.
struct ServiceParts {
  RecordingWriter* recorder = nullptr;
  FlightSink* flight = nullptr;
  ContactSink* contacts = nullptr;
  std::shared_ptr<TreeStore> trees = nullptr;
  JournalParts journal = {};
  Quarantine* quarantine = nullptr;
  ClaimOptions claim = {};
  std::function<void()> on_work = nullptr;  ///< Called once, when it serves or stands by.
  /// Reads the configuration again, as the start did; null: there is no file.
  std::function<ConfigResult()> load_config = nullptr;
  /// Called with what is in force after that.
  std::function<void(const v1::Config&)> on_config = nullptr;
};

/// Runs the daemon until SIGTERM or SIGINT, the end of the bus, a batch that cannot be recorded, a
/// failure (EndOnFailure()), or until another service has the world. Returns the exit code;
/// nullopt: another service has the world, and this one is to stand by (`claim.stands_by`): call it
/// again with new parts, a new bus and another instance, so that it knows nothing of its own but
/// what the world tells. PrepareSignals() was called.
///
/// A step that is not over 0.7 s after the signal is not waited for: what is recorded stays whole,
/// and the process ends with 0 from another thread, so Serve() does not return.
std::optional<int> Serve(const v1::Config& config, Bus& bus, ServiceParts parts);

/// Returns what `run` returns. If a CheckFailure, or another std::logic_error, leaves it, there is
/// a bug in this program: logs what failed as critical, and returns kExitSoftware. If any other
/// exception leaves it, the system lacks what the program cannot do without, for example memory:
/// logs that too, and returns kExitSystem.
///
/// By then the stack of `run` is unwound and the daemon destroyed; nothing more is published, and
/// the fingerprint of the events is not logged. The recording is whole: each batch was handed to
/// the operating system before it was applied. If the check failed within a step, the batch of that
/// step is the last one, and a replay fails in the same check. If it failed on a thread that builds
/// shapes, the recording holds the bytes of the shape.
int EndOnFailure(const std::function<int()>& run);

/// Logs number and hash of all events, whatever the log level: two runs are compared by this line,
/// the last one. Where there were hypothetical agents, that of their events comes before.
void LogFingerprint(const Daemon& daemon);

/// Prints why the program fails to standard error; returns `code`.
int Fail(ExitCode code, const std::string& line);

}  // namespace collision::server
