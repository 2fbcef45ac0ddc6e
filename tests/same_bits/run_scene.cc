#include "tests/same_bits/run_scene.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "server/recording/replay/replay.h"
#include "server/shapes/threaded_shape_builder.h"

namespace collision::server {
namespace {

/// A hash of outputs in their order.
class OutputHash {
 public:
  void Add(const v1::Output& output) {
    if (output.has_service_status()) return;
    constexpr std::uint64_t kPrime = 0x100000001b3;
    for (const char c : output.SerializeAsString()) {
      hash_ = (hash_ ^ static_cast<unsigned char>(c)) * kPrime;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// Threads build, but each shape counts in the step after it came, as if built there.
class SteadyBuilder final : public ShapeBuilder {
 public:
  explicit SteadyBuilder(const BuildOptions& options) : threads_(options, [] {}) {}

  void Start(const std::string& hash, std::string bytes, std::uint64_t simulator) override {
    threads_.Start(hash, std::move(bytes), simulator);
    started_.push_back({hash});
  }
  bool has_finished() const override { return !started_.empty(); }
  std::vector<ReadyTree> TakeFinished() override { return std::exchange(started_, {}); }
  BuiltShape Await(const ReadyTree& tree) override { return threads_.Await(tree); }
  void Forget(const std::string& hash) override {
    std::erase(started_, ReadyTree{hash});
    threads_.Forget(hash);
  }
  ShapeBuilderCounters counters() const override { return threads_.counters(); }

 private:
  ThreadedShapeBuilder threads_;
  std::vector<ReadyTree> started_;
};

std::unique_ptr<ShapeBuilder> Make(Builders builders, const v1::Config& config) {
  switch (builders) {
    case Builders::kOwn:
      break;
    case Builders::kThreads:
      return std::make_unique<SteadyBuilder>(BuildOptionsOf(config));
    case Builders::kChance:
      return std::make_unique<ThreadedShapeBuilder>(BuildOptionsOf(config), [] {});
  }
  return nullptr;
}

RunHashes HashesOf(const Daemon& daemon, std::uint64_t outputs) {
  return {daemon.event_log().count(), daemon.event_log().hash(), outputs};
}

}  // namespace

RunHashes RunScene(const Scene& scene, Builders builders, const std::string& recording) {
  std::optional<RecordingWriter> recorder;
  if (!recording.empty()) recorder.emplace(recording, scene.config);
  Scenario scenario(scene.config, scene.network);
  scene.fill(&scenario);
  scenario.StartService(recorder ? &*recorder : nullptr, Make(builders, scene.config));
  scenario.StartSimulators();
  scenario.Run();
  for (const SimulatedSimulator* simulator : scenario.simulators()) {
    if (!simulator->finished()) throw std::runtime_error(scene.name + " did not come to its end");
  }
  OutputHash outputs;
  for (const v1::Output& output : scenario.published()) outputs.Add(output);
  return HashesOf(scenario.daemon(), outputs.value());
}

RunHashes Replay(const std::string& recording) {
  OutputHash outputs;
  RecordingReader reader(recording);
  ReplaySource source(reader, [&outputs](const v1::Output& output) { outputs.Add(output); });
  DaemonParts parts;
  parts.claim = reader.claim();
  Daemon daemon(reader.config(), source, source, std::move(parts));
  while (daemon.Step()) {
  }
  if (!reader.error().empty()) throw std::runtime_error(reader.error());
  return HashesOf(daemon, outputs.value());
}

}  // namespace collision::server
