#include "server/service/daemon.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include "idl/limits.h"
#include "server/bus/batch_order.h"
#include "server/config/config.h"
#include "server/intake/intake.h"
#include "server/process/logging.h"
#include "server/publish/publisher.h"
#include "server/publish/reports.h"
#include "server/publish/status.h"
#include "server/recording/recording.h"
#include "server/service/operator_commands.h"
#include "server/service/roster_journal.h"
#include "server/service/share_report.h"
#include "server/service/silence_report.h"
#include "server/shapes/shape_store.h"

namespace collision::server {
namespace {

/// Rounds in which no simulator has a step follow each other in one step of the daemon, but not
/// more than these, so that it hears what arrives meanwhile.
constexpr int kRoundsPerStepMax = 64;

/// A process that makes no step for so much longer than the status period [ns] has stood still.
constexpr std::int64_t kStoodStill = 1'000'000'000;

/// Inputs of full batches that follow one another while no clock comes into force; after so many it
/// does all the same, so that a flood of messages does not stop everybody's time.
constexpr std::size_t kHeldInputsMax = 1 << 20;

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
        journal_(config_, parts.journal),
        state_failure_(parts.state_failure),
        claim_(parts.claim),
        progress_(std::move(parts.progress)),
        shape_builder_(parts.shape_builder
                           ? std::move(parts.shape_builder)
                           : std::make_unique<InlineShapeBuilder>(BuildOptionsOf(config_))),
        shapes_(config_, shape_builder_.get()),
        world_(config_, parts.claim.roster),
        detector_(OptionsOf(config_)),
        rejections_(config_.rejections_per_second_max(), &world_),
        intake_(config_, claim_.instance(), &world_, &detector_, &rejections_, &shapes_),
        operators_(&world_, &intake_),
        publisher_(config_, &claim_, &bus_),
        schedule_(ToNanoseconds(config_.status_period_s())) {
    intake_.sender_clocks().SetServiceId(claim_.instance());
  }

  bool Step() {
    std::vector<v1::Input> inputs;
    const std::int64_t before_ns = world_.monotonic_ns();
    const bool goes_on = bus_.Receive(Timeout(), config_.inputs_per_batch_max(), &inputs);
    if (stopped_ || (!goes_on && inputs.empty())) return false;
    if (!bus_.recorded()) AddReadyShapes(&inputs);
    SortBatch(&inputs);
    if (!Begin(clock_.Read(), &inputs)) return false;
    // Otherwise there is a step for each status at least.
    const std::int64_t gap_ns = world_.monotonic_ns() - before_ns;
    if (gap_ns > ToNanoseconds(config_.status_period_s()) + kStoodStill) world_.WakeUp();
    if (!Claim(inputs)) return false;
    if (clock_step_) FollowStep(*clock_step_);
    for (const v1::Input& input : inputs) intake_.Apply(input);
    batch_was_full_ = IsFull(inputs);
    held_inputs_ =
        batch_was_full_ && held_inputs_ < kHeldInputsMax ? held_inputs_ + inputs.size() : 0;
    if (held_inputs_ == 0) intake_.TakeClocks();
    const bool restarts = ObeyOperators(inputs);
    const bool removed = RemoveSilent();
    ReportSilence(world_.ReleaseSilent());
    MoveOn(!inputs.empty() || removed);
    if (restarts) EndEpoch("an operator restarts time");
    if (world_.EpochIsOver()) EndEpoch("no simulator holds time any more");
    intake_.EndBatch();
    if (claim_.phase() == ClaimPhase::kServing) {
      if (!KeepState(journal_.Keep(world_))) return false;
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

  /// Whether more may have arrived than was taken. The network hands on instance by instance, so a
  /// clock may have come with the newest of the states that it counts while older ones of other
  /// agents still wait: no clock comes into force then.
  bool IsFull(const std::vector<v1::Input>& inputs) const {
    const auto received = std::count_if(inputs.begin(), inputs.end(), [](const v1::Input& input) {
      return !input.has_shape_ready();
    });
    return received >= static_cast<std::ptrdiff_t>(config_.inputs_per_batch_max());
  }

  /// The time until something is due without any input.
  std::chrono::nanoseconds Timeout() const {
    if (shape_builder_->has_finished() || batch_was_full_) return std::chrono::nanoseconds(0);
    if (world_.RunsInRounds() && NextRound()) return std::chrono::nanoseconds(0);
    std::int64_t due = schedule_.next_ns();
    if (const auto next = intake_.NextDue()) due = std::min(due, *next);
    if (const auto next = world_.NextRelease()) due = std::min(due, *next);
    if (const auto next = world_.NextRevision()) due = std::min(due, *next);
    if (const auto next = claim_.NextDue()) due = std::min(due, *next);
    if (const auto next = reports_.next_ns()) due = std::min(due, *next);
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
      if (input.has_simulator_clock()) claim_.HearOfTerm(input.simulator_clock().service_term());
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
    intake_.SetContended(claim_.IsContended(now_ns));
    if (claim_.phase() == ClaimPhase::kServing && before == ClaimPhase::kClaiming) BeginTerm();
    return claim_.phase() != ClaimPhase::kYielded;
  }

  void BeginTerm() {
    // What an earlier configuration left behind means nothing to a wall clock.
    if (!world_.simulated()) journal_.Clear();
    KeepState(journal_.SetTerm(claim_.term(), world_.epoch()));
    schedule_.Hasten();
    spdlog::info("serves world \"{}\" in term {}", config_.world(), claim_.term());
  }

  /// Tells that the journal cannot be written. False: the service is to end (on_state_failure).
  bool KeepState(bool kept) {
    if (kept) return true;
    if (state_failure_.empty()) {
      state_failure_ = journal_.error();
      spdlog::error("{}; nothing more is kept for the next start", state_failure_);
      schedule_.Hasten();
    }
    return config_.on_state_failure() != v1::Config::END;
  }

  /// True: the world's time is to begin anew. Only a service that serves is asked.
  bool ObeyOperators(const std::vector<v1::Input>& inputs) {
    bool restarts = false;
    if (claim_.phase() != ClaimPhase::kServing) return restarts;
    for (const v1::Input& input : inputs) {
      if (input.has_operator_command()) restarts |= operators_.Obey(input.operator_command());
    }
    if (operators_.TakeNews()) schedule_.Hasten();
    return restarts;
  }

  /// Removes simulators that were silent for too long. False: there was none.
  bool RemoveSilent() {
    const std::vector<std::uint64_t> overdue =
        world_.silence().Overdue(world_.simulators(), world_.monotonic_ns());
    for (const std::uint64_t id : overdue) {
      Simulator* simulator = world_.Find(id);
      silence_report_.AddRemoved(simulator->name());
      intake_.EndRun(simulator, EndCause::kSilent);
    }
    return !overdue.empty();
  }

  /// Everybody has left: brings what they told to its end, and lets time begin anew.
  void EndEpoch(const char* why) {
    intake_.EndEpoch();
    world_.FinishEpoch();
    CloseEpoch(why);
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
    past_ += detector_.counters();
    detector_ = detection::Detector(OptionsOf(config_));
    advanced_to_.reset();
    world_.BeginEpoch();
    publisher_.BeginEpoch(world_.epoch());
    schedule_.Hasten();
    KeepState(journal_.SetTerm(claim_.term(), world_.epoch()));
  }

  /// Tells of each simulator that the world's time waits for, or goes on without.
  void ReportSilence(const std::vector<std::string>& released) {
    if (silence_report_.TakeWaited(world_.Waited())) schedule_.Hasten();
    silence_report_.AddReleased(released);
    silence_report_.Write(world_.monotonic_ns());
  }

  /// Brings into effect what was told, moves the world's time as far as it may go, and detects.
  void MoveOn(bool inputs) {
    if (claim_.phase() != ClaimPhase::kServing) return;
    if (!world_.RunsInRounds()) {
      intake_.Enact();
      world_.MoveOn();
      return Detect(inputs);
    }
    world_.ShareGrant();
    for (int round = 0; round < kRoundsPerStepMax; ++round) {
      const std::optional<Instant> next = NextRound();
      if (!next) return;
      intake_.Enact();
      world_.MoveTo(*next);
      Detect(true);
    }
  }

  /// The end of the round, if it is over: then everything in it is known.
  std::optional<Instant> NextRound() const {
    return intake_.AwaitsShapes() ? std::nullopt : world_.NextNow();
  }

  /// Advances the detector to the world's time and publishes what it found. With a simulated clock
  /// only inputs and releases change anything.
  void Detect(bool inputs) {
    if (!world_.started()) return;
    if (world_.simulated() && !inputs && world_.now() == advanced_to_) return;
    advanced_to_ = world_.now();
    detector_.Advance(world_.now(), [this] {
      if (progress_ && progress_()) SendStatus();
    });
    if (shares_.Take(detector_.owner_work(), world_)) schedule_.Hasten();
    shares_.Write(world_.monotonic_ns());
    for (const detection::AgentClearance& clearance : detector_.TakeChangedClearances()) {
      world_.SetClearance(clearance);
    }
    world_.UpdateGrants();
    publisher_.PublishEvents(detector_.events(), world_);
    publisher_.PublishEarliest(detector_.Earliest(), world_.now());
  }

  /// Publishes what does not come from the detector alone. Events have left before the clearances,
  /// and with them the grants, of the same step.
  void PublishAnswers() {
    publisher_.PublishRejections(rejections_.Take());
    publisher_.PublishClearances(&world_);
    if (world_.AcknowledgeRevisions()) publisher_.PublishClearances(&world_);
    publisher_.PublishReports(reports_.TakeDue(world_));
  }

  void PublishStatus() {
    if (schedule_.Take(world_)) SendStatus();
  }

  void SendStatus() {
    detection::DetectorCounters counted = past_;
    counted += detector_.counters();
    publisher_.PublishStatus(
        MakeStatus({.config = config_,
                    .world = world_,
                    .detector = detector_,
                    .counted = counted,
                    .intake = intake_,
                    .shapes = shapes_,
                    .rejections = rejections_,
                    .event_log = publisher_.event_log(),
                    .events = publisher_.event_counters(),
                    .steps = steps_,
                    .queries_per_second = query_rate_.Take(counted.queries, world_.monotonic_ns()),
                    .network = bus_.network_counters(),
                    .extensions = Extensions()}));
  }

  std::vector<v1::KeyValue> Extensions() const {
    std::vector<v1::KeyValue> extensions;
    silence_report_.AddExtensions(&extensions);
    operators_.AddExtensions(&extensions);
    shares_.AddExtensions(&extensions);
    if (!state_failure_.empty()) {
      v1::KeyValue& failure = extensions.emplace_back();
      failure.set_key("state_failure");
      failure.set_value(state_failure_.substr(0, wire::kExtensionValueMax));
    }
    return extensions;
  }

  const v1::Config config_;
  Bus& bus_;
  Clock& clock_;
  BatchSink* const recorder_;
  RosterJournal journal_;
  std::string state_failure_;  ///< Empty: what must be kept is kept.
  ServiceClaim claim_;
  const std::function<bool()> progress_;  ///< As in DaemonParts.
  const std::unique_ptr<ShapeBuilder> shape_builder_;
  ShapeStore shapes_;
  World world_;
  detection::Detector detector_;
  detection::DetectorCounters past_;  ///< Of the epochs that are over.
  Rejections rejections_;
  Intake intake_;
  OperatorCommands operators_;
  Publisher publisher_;
  Reports reports_;
  StatusSchedule schedule_;
  Rate query_rate_;
  StepCounters steps_;
  SilenceReport silence_report_{config_.clock().on_silent_simulator() == v1::Clock::RELEASE};
  ShareReport shares_;
  std::optional<ClockStep> clock_step_;  ///< Of this step.
  std::optional<Instant> advanced_to_;
  bool batch_was_full_ = false;
  std::size_t held_inputs_ = 0;  ///< In the full batches up to now.
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
