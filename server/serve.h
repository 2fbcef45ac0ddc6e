// The daemon from its start to its end.
#pragma once

#include <memory>

#include "idl/config.pb.h"
#include "server/bus.h"
#include "server/event_log.h"
#include "server/options.h"
#include "server/recording.h"
#include "server/tree_cache.h"

namespace collision::server {

/// Runs the daemon until SIGTERM or SIGINT, the end of the bus, or a batch that cannot be recorded.
/// Returns the exit code. PrepareSignals() was called. If the step that runs is not over 0.7 s after
/// the signal, it does not return: what is recorded stays whole, and the process ends with 0.
/// `recorder` may be null, and so may `cache`, which is made with BuildOptionsOf(config).
int Serve(const v1::Config& config, Bus& bus, RecordingWriter* recorder,
          std::shared_ptr<TreeCache> cache = nullptr);

/// Always said, whatever the log level: two runs are compared by it.
void TellEventLog(const EventLog& log);

/// Says why the program fails; returns `code`.
int Fail(ExitCode code, const std::string& line);

}  // namespace collision::server
