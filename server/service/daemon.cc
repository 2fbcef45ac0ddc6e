#include "server/service/daemon.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include "server/bus/batch_order.h"
#include "server/config/config.h"
#include "server/intake/intake.h"
#include "server/process/logging.h"
#include "server/process/names_log.h"
#include "server/publish/publisher.h"
#include "server/publish/status.h"
#include "server/recording/recording.h"
#include "server/shapes/shape_store.h"

namespace collision::server {
namespace {

/// A recording from before the field has none set.
broad_phase::BroadPhaseMethod MethodOf(v1::Config::BroadPhase method) {
  switch (method) {
    case v1::Config::ALL_PAIRS:
      return broad_phase::BroadPhaseMethod::kAllPairs;
    case v1::Config::SPATIAL_INDEX:
      return broad_phase::BroadPhaseMethod::kSpatialIndex;
    default:
      return broad_phase::BroadPhaseMethod::kAuto;
  }
}

detection::DetectorOptions OptionsOf(const v1::Config& config) {
  return {.temporal_resolution = config.temporal_resolution_s(),
          .announce_within = config.announce_within_s(),
          .skew = config.clock().skew_max_s(),
          .agents_max = config.agents_max(),
          .pairs_max = config.pairs_max(),
          .pairs_per_agent_max = config.pairs_per_agent_max(),
          .history_max = config.history_max(),
          .work_units_per_evaluation = WorkUnitsPerEvaluation(config),
          .work_units_per_step = WorkUnitsPerStep(config),
          .broad_phase = MethodOf(config.broad_phase())};
}

}  // namespace

class Daemon::Implementation {
 public:
  Implementation(const v1::Config& config, Bus& bus, Clock& clock, DaemonParts parts)
      : config_(config),
        bus_(bus),
        clock_(clock),
        recorder_(parts.recorder),
        journal_(parts.journal),
        claim_(parts.claim),
        shape_builder_(parts.shape_builder
                           ? std::move(parts.shape_builder)
                           : std::make_unique<InlineShapeBuilder>(BuildOptionsOf(config_))),
        shapes_(config_, shape_builder_.get()),
        world_(config_),
        detector_(OptionsOf(config_)),
        rejections_(config_.rejections_per_second_max(), &world_),
        intake_(config_, &world_, &detector_, &rejections_, &shapes_),
        publisher_(config_, &claim_, &bus_),
        schedule_(ToNanoseconds(config_.status_period_s())) {
    intake_.sender_clocks().SetServiceId(claim_.instance());
  }

  bool Step() {
    std::vector<v1::Input> inputs;
    const bool goes_on = bus_.Receive(Timeout(), config_.inputs_per_batch_max(), &inputs);
    if (stopped_ || (!goes_on && inputs.empty())) return false;
    if (!bus_.recorded()) AddReadyShapes(&inputs);
    SortBatch(&inputs);
    if (!Begin(clock_.Read(), &inputs)) return false;
    if (!Claim(inputs)) return false;
    if (clock_step_) FollowStep(*clock_step_);
    for (const v1::Input& input : inputs) intake_.Apply(input);
    if (world_.EpochIsOver()) EndEpoch();
    intake_.EndBatch();
    LogSilence(world_.ReleaseSilent());
    world_.UpdateSimulatedTime();
    if (claim_.phase() == ClaimPhase::kServing) {
      Detect(!inputs.empty());
      PublishAnswers();
    }
    PublishStatus();
    bus_.Flush();
#ifndef NDEBUG
    world_.Validate();
#endif
    return goes_on;
  }

  void Stop() {
    stopped_ = true;
    bus_.Wake();
  }

  const ServiceClaim& claim() const { return claim_; }
  const EventLog& event_log() const { return publisher_.event_log(); }

 private:
  /// When a tree is finished depends on the machine; the step from which on it counts becomes an
  /// input like any other.
  void AddReadyShapes(std::vector<v1::Input>* inputs) {
    for (const ReadyTree& tree : shape_builder_->TakeFinished()) {
      v1::ShapeReady& ready = *inputs->emplace_back().mutable_shape_ready();
      ready.set_content_hash(tree.hash);
      ready.set_coarse(tree.coarse);
    }
  }

  /// The time until something is due without any input.
  std::chrono::nanoseconds Timeout() const {
    if (shape_builder_->has_finished()) return std::chrono::nanoseconds(0);
    std::int64_t due = schedule_.next_ns();
    if (const auto next = intake_.NextDue()) due = std::min(due, *next);
    if (const auto next = world_.NextRelease()) due = std::min(due, *next);
    if (const auto next = claim_.NextDue()) due = std::min(due, *next);
    std::int64_t wait = due - world_.monotonic_ns();
    if (!world_.simulated()) {
      wait = std::min(wait, ToNanoseconds(config_.temporal_resolution_s()));
    }
    return std::chrono::nanoseconds(std::max<std::int64_t>(wait, 0));
  }

  /// Takes the time of this step and records what it applies. False: it could not be recorded.
  bool Begin(const ClockReading& reading, std::vector<v1::Input>* inputs) {
    clock_step_ = world_.SetReading(reading);
    ++steps_.batches;
    steps_.inputs += inputs->size();
    if (recorder_ == nullptr) return true;
    v1::RecordedBatch batch;
    batch.set_wall_ns(reading.wall_ns);
    batch.set_monotonic_ns(reading.monotonic_ns);
    batch.set_wall_was_set(reading.wall_was_set);
    for (v1::Input& input : *inputs) *batch.add_inputs() = std::move(input);
    const bool kept = recorder_->Record(batch);
    for (std::size_t i = 0; i < inputs->size(); ++i) {
      (*inputs)[i] = std::move(*batch.mutable_inputs(static_cast<int>(i)));
    }
    return kept;
  }

  /// Takes what other services say of themselves. False: one of them has the world.
  bool Claim(const std::vector<v1::Input>& inputs) {
    const std::int64_t now_ns = world_.monotonic_ns();
    for (const v1::Input& input : inputs) {
      if (!input.has_service_heard()) continue;
      const v1::ServiceHeard& heard = input.service_heard();
      claim_.Hear({.instance = heard.service_id(),
                   .term = heard.term(),
                   .serving = heard.phase() != v1::PHASE_CLAIMING,
                   .sequence = heard.sequence()},
                  now_ns);
    }
    const ClaimPhase before = claim_.phase();
    claim_.Update(now_ns);
    for (const std::string& conflict : claim_.Conflicts(now_ns)) {
      Log(spdlog::level::warn, "two services in one world", conflict);
    }
    if (claim_.phase() == ClaimPhase::kServing && before == ClaimPhase::kClaiming) BeginTerm();
    return claim_.phase() != ClaimPhase::kYielded;
  }

  void BeginTerm() {
    KeepTerm();
    schedule_.Hasten();
    spdlog::info("serves world \"{}\" in term {}", config_.world(), claim_.term());
  }

  void KeepTerm() {
    if (journal_ == nullptr || journal_->SetTerm(claim_.term(), world_.epoch())) return;
    Log(spdlog::level::err, "state is not kept", journal_->error());
  }

  /// Everybody has left: brings what they told to its end, and lets time begin anew.
  void EndEpoch() {
    intake_.EndEpoch();
    world_.FinishEpoch();
    CloseEpoch("no simulator holds time any more");
  }

  /// The wall clock was set. Before the inputs of the step are applied: they were written by the
  /// clock as it is now, or are refused.
  void FollowStep(const ClockStep& step) {
    ++steps_.clock_steps;
    steps_.last_clock_step = StepText(step);
    Log(spdlog::level::warn, "wall clock was set",
        steps_.last_clock_step + (step.breaks
                                      ? ", by more than clock.skew_max_s: all promises are void"
                                      : ", within clock.skew_max_s: promises hold"));
    if (!step.breaks) return;
    intake_.ExpelAgents();
    CloseEpoch("the wall clock was set; agents come back with their next states");
  }

  /// Publishes the end of what was told in this epoch, and begins the next.
  void CloseEpoch(const char* why) {
    if (claim_.phase() == ClaimPhase::kServing) {
      Detect(true);
      PublishAnswers();
    }
    Log(spdlog::level::info, "epoch over",
        fmt::format("epoch {} ends at {} s: {}", world_.epoch(),
                    1e-9 * static_cast<double>(world_.now().nanoseconds()), why));
    detector_ = detection::Detector(OptionsOf(config_));
    advanced_to_.reset();
    world_.BeginEpoch();
    publisher_.BeginEpoch(world_.epoch());
    schedule_.Hasten();
    KeepTerm();
  }

  /// Logs each silent simulator that holds the world's time, or has been released, once.
  void LogSilence(const std::vector<std::string>& released) {
    std::vector<std::string> waited_for = world_.WaitedFor();
    for (const std::string& name : waited_for) {
      if (std::find(waited_for_.begin(), waited_for_.end(), name) == waited_for_.end()) {
        waits_.Add(name);
      }
    }
    waited_for_ = std::move(waited_for);
    for (const std::string& name : released) releases_.Add(name);
    waits_.Write(world_.monotonic_ns());
    releases_.Write(world_.monotonic_ns());
  }

  /// Advances the detector to the world's time and publishes what it found. With a simulated clock
  /// only inputs and releases change anything.
  void Detect(bool inputs) {
    if (!world_.started()) return;
    if (world_.simulated() && !inputs && world_.now() == advanced_to_) return;
    advanced_to_ = world_.now();
    detector_.Advance(world_.now());
    for (const detection::AgentClearance& clearance : detector_.TakeChangedClearances()) {
      world_.SetClearance(clearance);
    }
    world_.UpdateGrants();
    publisher_.PublishEvents(detector_.events());
    publisher_.PublishEarliest(detector_.Earliest(), world_.now());
  }

  /// Publishes what does not come from the detector alone. Events have left before the clearances,
  /// and with them the grants, of the same step.
  void PublishAnswers() {
    publisher_.PublishRejections(rejections_.Take());
    publisher_.PublishClearances(&world_);
  }

  void PublishStatus() {
    if (!schedule_.Take(world_)) return;
    publisher_.PublishStatus(MakeStatus({.config = config_,
                                         .world = world_,
                                         .detector = detector_,
                                         .intake = intake_,
                                         .shapes = shapes_,
                                         .rejections = rejections_,
                                         .event_log = publisher_.event_log(),
                                         .steps = steps_,
                                         .queries_per_second = query_rate_.Take(
                                             detector_.counters().queries, world_.monotonic_ns()),
                                         .network = bus_.network_counters()}));
  }

  const v1::Config config_;
  Bus& bus_;
  Clock& clock_;
  BatchSink* const recorder_;
  Journal* const journal_;
  ServiceClaim claim_;
  const std::unique_ptr<ShapeBuilder> shape_builder_;
  ShapeStore shapes_;
  World world_;
  detection::Detector detector_;
  Rejections rejections_;
  Intake intake_;
  Publisher publisher_;
  StatusSchedule schedule_;
  Rate query_rate_;
  StepCounters steps_;
  std::optional<ClockStep> clock_step_;  ///< Of this step.
  std::vector<std::string> waited_for_;  ///< Logged already.
  NamesLog waits_{
      "world time waits for simulator {}: its process has ended; start it again (or set "
      "clock.on_silent_simulator to RELEASE)"};
  NamesLog releases_{
      "world time goes on without simulator {}: its process has ended; its agents stay, and "
      "their bounds grow"};
  std::optional<Instant> advanced_to_;
  std::atomic<bool> stopped_ = false;
};

Daemon::Daemon(const v1::Config& config, Bus& bus, Clock& clock, DaemonParts parts)
    : implementation_(std::make_unique<Implementation>(config, bus, clock, std::move(parts))) {}

Daemon::~Daemon() = default;

bool Daemon::Step() { return implementation_->Step(); }

void Daemon::Stop() { implementation_->Stop(); }

const ServiceClaim& Daemon::claim() const { return implementation_->claim(); }

const EventLog& Daemon::event_log() const { return implementation_->event_log(); }

}  // namespace collision::server
