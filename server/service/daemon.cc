#include "server/service/daemon.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include "idl/limits.h"
#include "server/bus/batch_order.h"
#include "server/bus/full_batches.h"
#include "server/claim/heard_service.h"
#include "server/config/config.h"
#include "server/detectors/detector_options.h"
#include "server/detectors/detectors.h"
#include "server/intake/followed_rounds.h"
#include "server/intake/intake.h"
#include "server/process/logging.h"
#include "server/publish/publisher.h"
#include "server/publish/reports.h"
#include "server/publish/status.h"
#include "server/publish/text/state_lines.h"
#include "server/recording/step_recorder.h"
#include "server/service/detection_step.h"
#include "server/service/opening/opening_of.h"
#include "server/service/operator_commands.h"
#include "server/service/reports/contact_report.h"
#include "server/service/reports/service_report.h"
#include "server/service/reports/silence_report.h"
#include "server/service/roster_journal.h"
#include "server/service/step_limits.h"
#include "server/shapes/shape_store.h"

namespace collision::server {

class Daemon::Implementation {
 public:
  Implementation(const v1::Config& config, Bus& bus, Clock& clock, DaemonParts parts)
      : config_(config),
        bus_(bus),
        clock_(clock),
        recorder_(parts.recorder, parts.flight),
        journal_(config_, std::move(parts.journal)),
        quarantine_(parts.quarantine),
        claim_(parts.claim),
        services_(config_, claim_.instance(), std::move(parts.process)),
        progress_(std::move(parts.progress)),
        measurements_(parts.meter),
        contact_report_(&measurements_, parts.contacts, config_),
        shape_builder_(parts.shape_builder
                           ? std::move(parts.shape_builder)
                           : std::make_unique<InlineShapeBuilder>(BuildOptionsOf(config_))),
        world_(config_, parts.claim.roster),
        shapes_(config_, shape_builder_.get(), &world_.quotas()),
        detectors_(config_),
        rejections_(config_.rejections_per_second_max(), &world_),
        intake_(config_, claim_.instance(), &world_, &detectors_, &rejections_, &shapes_),
        operators_(&world_, &intake_),
        publisher_(config_, &claim_, &bus_, &contact_report_),
        schedule_(ToNanoseconds(config_.status_period_s())) {
    intake_.sender_clocks().SetServiceId(claim_.instance());
    if (parts.claim.epoch > 0) GoOnFrom(parts.claim, clock_.Read(), &world_, &intake_, &publisher_);
  }

  bool Step() {
    std::vector<v1::Input> inputs;
    const std::int64_t before_ns = world_.monotonic_ns();
    const bool waits = quarantine_ != nullptr && quarantine_->holds();
    const bool goes_on = waits || bus_.Receive(Timeout(), config_.inputs_per_batch_max(), &inputs);
    if (stopped_ || (!goes_on && inputs.empty())) return false;
    measurements_.BeginStep(inputs.size(), bus_.waited());
    if (!bus_.recorded()) shape_builder_->AddFinished(&inputs);
    if (quarantine_ != nullptr) quarantine_->Screen(&inputs);
    SortBatch(&inputs);
    if (quarantine_ != nullptr) quarantine_->BeginStep();
    const bool ends = !Apply(before_ns, std::move(inputs));
    if (quarantine_ != nullptr) quarantine_->EndStep();
    return goes_on && !ends;
  }

  void Stop() {
    stopped_ = true;
    bus_.Wake();
  }

  std::string StatusLine() const {
    switch (claim_.phase()) {
      case ClaimPhase::kServing:
        return server::StatusLine(world_, detectors_.agents(), Earliest());
      case ClaimPhase::kStandby:
        return "stands by; " + server::StatusLine(world_, detectors_.agents(), Earliest());
      case ClaimPhase::kClaiming:
        return "claims the world";
      case ClaimPhase::kWaking:
      case ClaimPhase::kYielded:
        return "another service has the world";
    }
    return "";
  }

  std::vector<std::string> StateLines() {
    return server::StateLines(StatusNow(), world_, kStateAgentsMax);
  }

  const std::string& state_failure() const { return journal_.failure(); }
  const ServiceClaim& claim() const { return claim_; }
  const Publisher& said() const { return publisher_; }

 private:
  /// The step after its batch was received. False: the service is to end.
  bool Apply(std::int64_t before_ns, std::vector<v1::Input> received) {
    const SharedBatch batch = Begin(clock_.Read(), std::move(received));
    if (!Record(batch)) return false;
    contact_report_.BeginStep(batch->wall_ns());
    const BatchInputs& inputs = batch->inputs();
    // Otherwise there is a step for each status at least.
    const std::int64_t gap_ns = world_.monotonic_ns() - before_ns;
    if (gap_ns > ToNanoseconds(config_.status_period_s()) + kStoodStill) {
      world_.WakeUp();
      services_.ForgetProgress();
    }
    const ClaimPhase before = claim_.phase();
    claim_.WakeUp(gap_ns, world_.monotonic_ns());
    if (claim_.phase() == ClaimPhase::kServing) bus_.EndHold(true);
    if (!Claim(inputs, before)) return false;
    if (claim_.speaks()) publisher_.PublishHello();
    if (clock_step_ && claim_.phase() != ClaimPhase::kWaking) FollowStep();
    for (const v1::Input& input : inputs) {
      if (quarantine_ != nullptr) quarantine_->Apply(input);
      if (claim_.works() && rounds_.SucceedsLast(input)) EndEpoch("who held time starts again");
      rounds_.Apply(input);
    }
    if (quarantine_ != nullptr) quarantine_->EndMessages();
    full_batches_.Take(inputs, config_.inputs_per_batch_max());
    if (!full_batches_.holds_clocks()) intake_.TakeClocks();
    rounds_.ApplyKept();
    if (claim_.BeginsToSpeak()) {
      publisher_.PublishInherited(&world_);
      schedule_.Hasten();
    }
    const bool restarts = claim_.works() && operators_.ObeyAll(inputs);
    if (operators_.TakeNews()) schedule_.Hasten();
    const bool removed = LetGoOfSilent();
    MoveOn(!inputs.empty() || removed);
    if (restarts) EndEpoch("an operator restarts time");
    if (claim_.works() && world_.EpochIsOver()) EndEpoch("no simulator holds time any more");
    intake_.EndBatch();
    if (claim_.phase() == ClaimPhase::kServing && !journal_.Keep(world_)) return false;
    publisher_.PublishRejections(rejections_.Take());
    publisher_.PublishBreaches(intake_.TakeBreaches());
    if (claim_.speaks()) PublishAnswers();
    if (claim_.phase() != ClaimPhase::kWaking && schedule_.Take(world_)) SendStatus();
    for (const std::uint64_t simulator : world_.TakeForgotten()) bus_.Forget(simulator);
    publisher_.Flush();
    measurements_.EndStep();
    for (const auto& [matter, text] : bus_.TakeWarnings()) Log(spdlog::level::warn, matter, text);
#ifndef NDEBUG
    world_.Validate();
#endif
    return true;
  }

  /// The time until something is due without any input.
  std::chrono::nanoseconds Timeout() const {
    const bool has_round = claim_.works() && world_.RunsInRounds() && detection_.NextRound();
    if (has_round || shape_builder_->has_finished() || full_batches_.last_was_full()) {
      return std::chrono::nanoseconds(0);
    }
    std::int64_t due = schedule_.next_ns();
    if (claim_.phase() == ClaimPhase::kWaking) due = *claim_.NextDue();
    const bool speaks = claim_.speaks();
    for (const std::optional<std::int64_t>& next :
         {intake_.NextDue(), world_.NextRelease(), claim_.NextDue(),
          speaks ? world_.NextRevision() : std::nullopt,
          speaks ? reports_.next_ns() : std::nullopt}) {
      if (next) due = std::min(due, *next);
    }
    std::int64_t wait = due - world_.monotonic_ns();
    if (!world_.simulated()) {
      const int slices = detectors_.pairs_waiting() > 0 ? kSlicesPerResolution : 1;
      wait = std::min(wait, ToNanoseconds(config_.temporal_resolution_s()) / slices);
    }
    if (const auto standstill = claim_.standstill_ns()) wait = std::min(wait, *standstill / 2);
    return std::chrono::nanoseconds(std::max<std::int64_t>(wait, 0));
  }

  /// Takes the time of this step. Nothing changes the batch from here on.
  SharedBatch Begin(const ClockReading& reading, std::vector<v1::Input> received) {
    if (const auto step = world_.SetReading(reading)) clock_step_ = step;
    world_.FollowGrant(bus_.recorded_grant());
    ++steps_.batches;
    steps_.inputs += received.size();
    return BatchOf(reading, bus_.earliest_readers(), world_.granted(), std::move(received));
  }

  /// False: that failed, and ends the service.
  bool Record(const SharedBatch& batch) {
    const bool begins = claim_.phase() == ClaimPhase::kServing && recorder_.wants_opening();
    if (begins || (claim_.works() && recorder_.wants_census()))
      recorder_.Open(OpeningOf(world_, claim_));
    if (recorder_.Record(batch)) return true;
    spdlog::error("{}; nothing more is recorded", recorder_.failure());
    schedule_.Hasten();
    return config_.on_recording_failure() != v1::Config::END;
  }

  /// Takes what other services say; `before`: this step. False: one of them has the world.
  bool Claim(const BatchInputs& inputs, ClaimPhase before) {
    const std::int64_t now_ns = world_.monotonic_ns();
    for (const v1::Input& input : inputs) {
      if (input.has_simulator_clock()) {
        const v1::SimulatorClock& clock = input.simulator_clock();
        claim_.HearClock(clock.service_id(), clock.service_term());
      }
      publisher_.Hear(input);
      if (input.has_service_heard()) HearService(input.service_heard());
    }
    claim_.SetFollowed(world_.followers() > 0);
    claim_.Update(now_ns);
    services_.Write(claim_.Conflicts(now_ns), now_ns);
    intake_.SetContended(claim_.IsContended(now_ns));
    if (claim_.phase() != before) ChangePhase(before);
    if (claim_.phase() == ClaimPhase::kStandby) rounds_.StandBy();
    bus_.HoldAfter(std::chrono::nanoseconds(claim_.hold_after_ns()));
    return claim_.phase() != ClaimPhase::kYielded;
  }

  void HearService(const v1::ServiceHeard& heard) {
    claim_.SetFits(services_.Hear(heard, world_.monotonic_ns()));
    if (heard.ended()) return claim_.HearEnd(heard.service_id());
    claim_.Hear(HeardOf(heard), world_.monotonic_ns());
    const bool is_lonely = heard.agents() > 0 && !heard.followed();  // its own cable may be out
    if (claim_.phase() == ClaimPhase::kServing || heard.phase() != v1::PHASE_SERVING || is_lonely)
      return;
    if (!detection_.has_detected() && world_.FollowEpoch(heard.epoch()))
      publisher_.BeginEpoch(world_.epoch(), world_);
    publisher_.ForgetBefore(heard.epoch());
    if (heard.epoch() == world_.epoch())
      world_.HearGranted(Instant::FromNanoseconds(heard.granted_until_ns()));
    for (const EndedRun& ended : EndedRunsIn(heard.ended_runs())) intake_.FollowEnd(ended);
    const bool is_past = world_.simulated() && heard.epoch() < world_.epoch();
    if (claim_.phase() != ClaimPhase::kStandby || is_past || world_.IsWaking()) return;
    if (services_.HearProgress(heard, detectors_.agents(), world_.newest())) {
      publisher_.ForgetUndecided(Instant::FromNanoseconds(heard.now_ns()));
      world_.ForgetLowerings();
      schedule_.Hasten();
    }
  }

  void ChangePhase(ClaimPhase before) {
    schedule_.Hasten();
    switch (claim_.phase()) {
      case ClaimPhase::kServing:
        bus_.EndHold(before == ClaimPhase::kWaking);
        if (before == ClaimPhase::kWaking) return;
        if (before == ClaimPhase::kStandby) services_.LogTakeOver(world_.monotonic_ns());
        journal_.Open();
        journal_.SetTerm(claim_.term(), world_.epoch(), world_.monotonic_ns());
        spdlog::info("serves world \"{}\" in term {}", config_.world(), claim_.term());
        if (before != ClaimPhase::kStandby) return;
        world_.TakeOver();
        reports_ = {};  // everybody is told anew what holds
        return;
      case ClaimPhase::kStandby:
        bus_.EndHold(false);
        spdlog::info("{}: stands by", claim_.why());
        return;
      case ClaimPhase::kWaking:
        spdlog::warn("stood still: listens whether the standby has taken over");
        return;
      case ClaimPhase::kClaiming:
      case ClaimPhase::kYielded:
        return;
    }
  }

  /// Removes simulators that were silent for too long, releases others, and tells of each that time
  /// waits for, or goes on without. False: none was removed.
  bool LetGoOfSilent() {
    const std::vector<std::string> removed = intake_.RemoveSilent();
    silence_report_.AddRemoved(removed);
    const std::vector<std::string> released = world_.ReleaseSilent();
    if (claim_.phase() == ClaimPhase::kServing) {
      if (silence_report_.TakeWaited(world_.Waited())) schedule_.Hasten();
      silence_report_.AddReleased(released);
      silence_report_.Write(world_.monotonic_ns());
    }
    return !removed.empty();
  }

  /// Everybody has left: brings what they told to its end, and lets time begin anew.
  void EndEpoch(const char* why) {
    intake_.EndEpoch();
    world_.FinishEpoch();
    CloseEpoch(why);
  }

  /// The wall clock was set. Before the inputs of the step are applied: they were written by the
  /// clock as it is now, or are refused.
  void FollowStep() {
    const ClockStep step = *std::exchange(clock_step_, std::nullopt);
    ++steps_.clock_steps;
    steps_.last_clock_step = StepText(step);
    Log(spdlog::level::warn, "wall clock was set", steps_.last_clock_step);
    if (!step.breaks) return;
    intake_.ExpelAgents();
    CloseEpoch("the wall clock was set; agents come back with their next states");
  }

  /// Publishes the end of what was told in this epoch, and begins the next.
  void CloseEpoch(const char* why) {
    if (claim_.works()) detection_.Detect(true);
    if (claim_.speaks()) PublishAnswers();
    Log(spdlog::level::info, "epoch over",
        fmt::format("epoch {} ends at {} s: {}", world_.epoch(),
                    1e-9 * static_cast<double>(world_.now().nanoseconds()), why));
    detectors_.BeginEpoch();
    detection_.BeginEpoch();
    rounds_.Clear();
    world_.BeginEpoch();
    publisher_.BeginEpoch(world_.epoch(), world_);
    services_.ForgetProgress();
    schedule_.Hasten();
    if (claim_.phase() != ClaimPhase::kServing) return;
    journal_.SetTerm(claim_.term(), world_.epoch(), world_.monotonic_ns());
  }

  /// Moves the world's time as far as it may go, and detects.
  void MoveOn(bool inputs) {
    if (!claim_.works()) return;
    if (world_.awaits_others() &&
        services_.MayBegin(world_.agents_in_time(), world_.stands_by(), world_.monotonic_ns())) {
      world_.Begin();
    }
    detection_.MoveOn(inputs);
  }

  /// Of a step that goes on: publishes the status if that is asked for.
  void TellProgress() {
    if (!progress_ || !progress_()) return;
    SendStatus();
    publisher_.Flush();
  }

  /// Publishes the rest of what a step has found; the events have left before its grants.
  void PublishAnswers() {
    if (publisher_.EarliestIsDue(world_)) {
      publisher_.PublishEarliest(Earliest(), world_);
    }
    publisher_.PublishClearances(&world_);
    if (world_.AcknowledgeRevisions()) publisher_.PublishClearances(&world_);
    publisher_.PublishReports(reports_.TakeDue(world_));
  }

  detection::EarliestAnswer Earliest() const {
    return detection_.has_detected() ? detectors_.contacts().Earliest(kEarliestQueriesMax)
                                     : detection::EarliestAnswer();
  }

  void SendStatus() { publisher_.PublishStatus(StatusNow()); }

  v1::ServiceStatus StatusNow() {
    const std::uint64_t queries = detectors_.counted().queries;
    return MakeStatus({.config = config_,
                       .world = world_,
                       .detectors = detectors_,
                       .intake = intake_,
                       .shapes = shapes_,
                       .rejections = rejections_,
                       .publisher = publisher_,
                       .bus = bus_,
                       .steps = steps_,
                       .measurements = measurements_,
                       .queries_per_second = query_rate_.Take(queries, world_.monotonic_ns()),
                       .configuration = services_.configuration(),
                       .extensions = Extensions()});
  }

  std::vector<v1::KeyValue> Extensions() {
    std::vector<v1::KeyValue> extensions;
    services_.AddExtensions(claim_.phase() == ClaimPhase::kStandby, &extensions);
    silence_report_.AddExtensions(&extensions);
    operators_.AddExtensions(&extensions);
    detection_.AddExtensions(&extensions);
    AddText("state_failure", journal_.failure() + journal_.awaited(), &extensions);
    AddText(std::string(wire::kEndedRunsExtension),
            world_.ended_runs().TakeTurn(wire::kExtensionValueMax), &extensions);
    for (const auto& [key, failure] : recorder_.Failures()) AddText(key, failure, &extensions);
    AddText("log_failure", LogFailure(), &extensions);
    AddText("contacts_failure", contact_report_.failure(), &extensions);
    if (quarantine_ != nullptr) AddText("quarantine", quarantine_->Summary(), &extensions);
    return extensions;
  }

  const v1::Config config_;
  Bus& bus_;
  Clock& clock_;
  StepRecorder recorder_;
  RosterJournal journal_;
  Quarantine* const quarantine_;  ///< Null: none.
  ServiceClaim claim_;
  ServiceReport services_;
  const std::function<bool()> progress_;  ///< As in DaemonParts.
  Measurements measurements_;
  ContactReport contact_report_;
  const std::unique_ptr<ShapeBuilder> shape_builder_;
  World world_;
  ShapeStore shapes_;
  Detectors detectors_;
  Rejections rejections_;
  Intake intake_;
  FollowedRounds rounds_{&world_, &intake_};
  OperatorCommands operators_;
  Publisher publisher_;
  Reports reports_;
  StatusSchedule schedule_;
  DetectionStep detection_{{world_, intake_, rounds_, detectors_, publisher_, schedule_},
                           [this] { TellProgress(); }};
  Rate query_rate_;
  StepCounters steps_;
  SilenceReport silence_report_{config_.clock().on_silent_simulator() == v1::Clock::RELEASE};
  std::optional<ClockStep> clock_step_;  ///< To be followed.
  FullBatches full_batches_;
  std::atomic<bool> stopped_ = false;
};

Daemon::Daemon(const v1::Config& config, Bus& bus, Clock& clock, DaemonParts parts)
    : implementation_(std::make_unique<Implementation>(config, bus, clock, std::move(parts))) {}

Daemon::~Daemon() = default;

const std::string& Daemon::state_failure() const { return implementation_->state_failure(); }

bool Daemon::Step() { return implementation_->Step(); }

void Daemon::Stop() { implementation_->Stop(); }

std::string Daemon::StatusLine() const { return implementation_->StatusLine(); }

std::vector<std::string> Daemon::StateLines() const { return implementation_->StateLines(); }

const ServiceClaim& Daemon::claim() const { return implementation_->claim(); }

const EventLog& Daemon::event_log() const { return implementation_->said().event_log(); }

const EventLog& Daemon::screening_log() const { return implementation_->said().screening_log(); }

}  // namespace collision::server
