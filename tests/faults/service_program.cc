#include "tests/faults/service_program.h"

#include <algorithm>

#include "idl/limits.h"
#include "server/config/config.h"

namespace collision::faults {
namespace {

/// From an arrival to the step that takes it; what comes meanwhile belongs to the same batch.
constexpr std::int64_t kWakingTime = 20'000;

}  // namespace

ServiceProgram::ServiceProgram(const v1::Config& config, const ServiceOptions& options,
                               Network* network)
    : config_(server::CompleteConfig(config)), options_(options), network_(*network) {}

ServiceProgram::~ServiceProgram() { End(); }

void ServiceProgram::Start() {
  ++process_;
  bus_ = std::make_unique<ServiceEnd>(
      &network_, [this] { Wake(network_.now_ns() + kWakingTime); },
      [this](const v1::Output& output) {
        published_.push_back({network_.now_ns(), output});
        if (output.has_service_status()) status_ = output.service_status();
      });
  const OnBehalfOf service(Owner::kServices);
  if (!options_.state_dir.empty()) {
    journal_ = std::make_unique<server::Journal>(options_.state_dir, config_.world(),
                                                 config_.domain(), config_.simulators_max());
  }
  server::ClaimOptions claim = {.instance = options_.instance++,
                                .term_before = journal_ ? journal_->term() : 0,
                                .wait_ns = static_cast<std::int64_t>(config_.claim_wait_s() * 1e9),
                                .heard_for_ns = wire::kServiceLease,
                                .stands_by = config_.on_occupied() == v1::Config::STAND_BY,
                                .waking_ns = static_cast<std::int64_t>(config_.lease_s() * 1e9),
                                .roster = {}};
  if (claim.stands_by) network_.ReadEvents(bus_->id());
  if (journal_) {
    for (const auto& [id, simulator] : journal_->simulators()) claim.roster.push_back(simulator);
  }
  daemon_ = std::make_unique<server::Daemon>(
      config_, *bus_, static_cast<server::Clock&>(*this),
      server::DaemonParts{.journal = {.journal = journal_.get()}, .claim = claim});
  awaits_ = false;
  Wake(network_.now_ns());
}

void ServiceProgram::End() {
  if (!daemon_) return;
  hash_ = daemon_->event_log().hash();
  count_ = daemon_->event_log().count();
  ++process_;
  daemon_.reset();
  journal_.reset();
}

void ServiceProgram::Kill() {
  if (!daemon_) return;
  End();
  network_.Kill(bus_->id());
}

void ServiceProgram::Suspend() {
  suspended_ = true;
  network_.Isolate(bus_->id());
}

void ServiceProgram::Resume() {
  suspended_ = false;
  network_.Rejoin(bus_->id());
  awaits_ = false;
  Wake(network_.now_ns());
}

void ServiceProgram::StepWall(std::int64_t by_ns) {
  wall_offset_ns_ += by_ns;
  wall_was_set_ = true;
  Wake(network_.now_ns());
}

server::ClockReading ServiceProgram::Read() {
  return {.wall_ns = wall_ns(),
          .monotonic_ns = network_.now_ns(),
          .wall_was_set = std::exchange(wall_was_set_, false)};
}

void ServiceProgram::Wake(std::int64_t at_ns) {
  if (!daemon_ || suspended_ || (awaits_ && awake_at_ns_ <= at_ns)) return;
  awaits_ = true;
  awake_at_ns_ = at_ns;
  const OnBehalfOf test(Owner::kTest);
  network_.At(at_ns, [this, at_ns, process = process_] {
    if (process != process_ || suspended_ || !awaits_ || awake_at_ns_ != at_ns) return;
    awaits_ = false;
    Step();
  });
}

bool ServiceProgram::StepDaemon() {
  const OnBehalfOf service(Owner::kServices);
  return daemon_->Step();
}

/// The daemon says how long it would wait only when it is asked to step. So each step that may
/// have changed that is followed by one that nothing has come for.
void ServiceProgram::Step() {
  if (!StepDaemon()) {
    yielded_ = true;
    const Network::Id id = bus_->id();
    End();
    network_.Leave(id);
    // As the program does: it starts afresh.
    if (config_.on_occupied() == v1::Config::STAND_BY) Start();
    return;
  }
  const bool idle = bus_->received() == 0 && bus_->timeout_ns() > 0;
  Wake(network_.now_ns() + (idle ? std::max(bus_->timeout_ns(), kWakingTime) : kWakingTime));
}

std::uint64_t ServiceProgram::counter(const std::string& name) const {
  for (const v1::Counter& counter : status_.counters()) {
    if (counter.name() == name) return counter.value();
  }
  return 0;
}

}  // namespace collision::faults
