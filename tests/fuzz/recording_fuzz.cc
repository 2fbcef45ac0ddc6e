#include <google/protobuf/stubs/logging.h>
#include <spdlog/spdlog.h>

#include <stdexcept>
#include <utility>

#include "server/config/config.h"
#include "server/recording/recording.h"
#include "server/recording/replay/replay.h"
#include "server/service/daemon.h"
#include "tests/fuzz/answers.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/fuzz/targets.h"

namespace collision::fuzz {
namespace {

constexpr int kStepsMax = 32;

/// So that no input takes long: these cost time and memory as configured, not as used.
bool IsSmall(const v1::Config& config) {
  return config.agents_max() <= 1000 && config.pairs_max() <= 65536 && config.history_max() <= 64 &&
         server::WorkUnitsPerEvaluation(config) <= 40000 &&
         config.temporal_resolution_s() >= 0.001 && config.shape_triangles_max() <= 2000000;
}

}  // namespace

// Whatever a file says, its reader ends with an error that names it, or with its end; what it hands
// out can be replayed like any recording.
void FuzzRecording(Bytes bytes) {
  spdlog::set_level(spdlog::level::off);
  const google::protobuf::LogSilencer silent;
  const ScratchFile file("fuzzed.rec", bytes);
  try {
    server::RecordingReader reader(file.path());
    if (!server::CheckConfig(reader.config()).empty() || !IsSmall(reader.config())) {
      for (int i = 0; i < kStepsMax && reader.Next(); ++i) {
      }
      return;
    }
    server::ReplaySource source(reader, CheckOutput);
    server::DaemonParts parts;
    parts.claim = reader.claim();
    server::Daemon daemon(reader.config(), source, source, std::move(parts));
    for (int step = 0; step < kStepsMax && daemon.Step(); ++step) {
    }
    Require(reader.error().empty() || reader.error().starts_with(file.path()),
            "an error that does not name its file: ", reader.error());
  } catch (const BrokenPromise&) {
    throw;
  } catch (const std::runtime_error& error) {
    Require(std::string(error.what()).starts_with(file.path()),
            "an error that does not name its file: ", error.what());
  }
}

}  // namespace collision::fuzz
