#include "server/service/program/replay_program.h"

#include <google/protobuf/util/json_util.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "idl/recording/utc.h"
#include "server/config/config.h"
#include "server/process/logging.h"
#include "server/recording/replay/replay.h"
#include "server/recording/replay/segment_chain.h"
#include "server/recording/replay/transcript.h"
#include "server/service/daemon.h"
#include "server/service/serve.h"

namespace collision::server {
namespace {

/// An event as it is, with the wall time at which it was told as an extension; of a hypothetical
/// agent the message to its owner, which holds one.
void PrintEvent(const v1::Output& published, std::int64_t wall_ns) {
  if (!published.has_collision_event() && !published.has_screening_event()) return;
  v1::Output output = published;
  v1::CollisionEvent* event = output.has_collision_event()
                                  ? output.mutable_collision_event()
                                  : output.mutable_screening_event()->mutable_event();
  v1::KeyValue* told = event->add_extensions();
  told->set_key("told_utc");
  told->set_value(wire::UtcText(wall_ns));
  const google::protobuf::Message* message = event;
  if (output.has_screening_event()) message = &output.screening_event();
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string line;
  if (google::protobuf::util::MessageToJsonString(*message, &line, options).ok()) {
    std::cout << line << '\n';
  }
}

/// Gets what the service tells in a step of a replay, and when that step was.
using TellFunction = std::function<void(std::int64_t wall_ns, const v1::Output& output)>;

/// What is complete is replayed, also of a recording that ends too early.
int Replay(SegmentChain& chain, const TellFunction& tell,
           const ReplaySource::BatchFunction& on_batch) {
  ReplaySource* clock = nullptr;
  ReplaySource source(
      chain, [&](const v1::Output& output) { tell(clock->Read().wall_ns, output); }, on_batch);
  clock = &source;
  DaemonParts parts;
  parts.claim = chain.claim();
  Daemon daemon(chain.config(), source, source, std::move(parts));
  while (std::cout && daemon.Step()) {
  }
  std::cout.flush();
  spdlog::info("{}: here the replay of this start of the service ends", chain.path());
  if (!on_batch) LogFingerprint(daemon);  // a transcript is for programs
  if (!chain.error().empty()) return Fail(kExitFile, chain.error());
  return std::cout ? kExitOk : Fail(kExitFile, "standard output cannot be written");
}

/// Prints the events from `range` on.
int PrintEvents(SegmentChain& chain, const ReplayRange& range) {
  const auto tell = [&range](std::int64_t wall_ns, const v1::Output& output) {
    if (!range.from_ns || wall_ns >= *range.from_ns) PrintEvent(output, wall_ns);
  };
  return Replay(chain, tell, {});
}

int PrintTranscript(SegmentChain& chain) {
  Transcript transcript(&std::cout);
  transcript.Begin(chain.config(), chain.claim());
  const auto tell = [&transcript](std::int64_t wall_ns, const v1::Output& output) {
    transcript.Add(wall_ns, output);
  };
  const auto add = [&transcript](const v1::RecordedBatch& batch) { transcript.Add(batch); };
  return Replay(chain, tell, add);
}

/// The settings of a recording may be damaged, too.
std::optional<int> RefusalOfConfig(const SegmentChain& chain) {
  for (const ConfigError& error : CheckConfig(chain.config())) {
    return Fail(kExitFile,
                chain.path() + ": byte 0: its configuration: " + error.field + ": " + error.what);
  }
  return std::nullopt;
}

}  // namespace

int RunReplay(const Options& options) {
  StartLogging({.level = options.log_level.value_or("info")});  // not where the recorded run logged
  const ReplayRange range{.from_ns = options.from_ns, .until_ns = options.until_ns};
  if (range.from_ns && range.until_ns && *range.until_ns < *range.from_ns) {
    return Fail(kExitUsage, "--until " + wire::UtcText(*range.until_ns) +
                                ": allowed: a time after --from, " + wire::UtcText(*range.from_ns));
  }
  std::unique_ptr<SegmentChain> chain;
  try {
    chain = std::make_unique<SegmentChain>(options.replay_file, range);
  } catch (const std::runtime_error& error) {
    return Fail(kExitFile, error.what());
  }
  int code = kExitOk;
  const auto note = [&code](int result) { code = code == kExitOk ? result : code; };
  const auto skipped = [&note](const std::string& cause) { note(Fail(kExitFile, cause)); };
  while (std::cout && chain->NextRun(skipped)) {
    if (chain->begins_behind_a_gap()) {
      spdlog::warn(
          "{}: begins in the middle of a start of the service: what came before is missing",
          chain->path());
    }
    const std::optional<int> refused = RefusalOfConfig(*chain);
    note(refused              ? *refused
         : options.transcript ? PrintTranscript(*chain)
                              : PrintEvents(*chain, range));
  }
  return code;
}

}  // namespace collision::server
