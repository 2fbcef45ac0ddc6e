#include "server/bus/dds_bus.h"

#include <malloc.h>

#include <utility>

#include "idl/dds/network_log.h"
#include "idl/identity.h"

namespace collision::server {
namespace {

DdsSessionOptions SessionOptions(const std::string& world, std::uint32_t domain,
                                 const DdsBusOptions& options) {
  DdsSessionOptions session;
  session.world = world;
  session.domain = domain;
  session.role = DdsRole::kService;
  session.lease = options.lease;
  session.reads_events_of_services = options.stands_by;
  session.credentials = options.credentials;
  session.sender_limits = options.sender_limits;
  return session;
}

// Matters of the log.
constexpr char kNetwork[] = "network", kStranger[] = "stranger";

v1::Counter CounterOf(const std::string& name, std::uint64_t value) {
  v1::Counter counter;
  counter.set_name(name);
  counter.set_value(value);
  return counter;
}

}  // namespace

DdsBus::DdsBus(const std::string& world, std::uint32_t domain, const DdsBusOptions& options)
    : world_(world), session_(SessionOptions(world, domain, options)) {
  // Not before: of what is wrong with a network profile every line is wanted.
  dds::SetNetworkLog([this](const std::string& line) {
    const std::lock_guard lock(said_mutex_);
    if (said_.size() < kSaidMax) said_.push_back("Cyclone DDS: " + line);
  });
}

DdsBus::~DdsBus() { dds::SetNetworkLog(nullptr); }

bool DdsBus::Receive(std::chrono::nanoseconds timeout, std::size_t limit,
                     std::vector<v1::Input>* inputs) {
  session_.Receive(timeout, limit, inputs, nullptr);
  earliest_readers_ = session_.earliest_readers();
  // What has been freed stays with the allocator otherwise, for good.
  if (session_.TakeRelief()) malloc_trim(0);
  ran_ = std::chrono::steady_clock::now();
  return true;
}

void DdsBus::Publish(const v1::Output& output) {
  if (standstill_.count() > 0) {
    const auto now = std::chrono::steady_clock::now();
    holds_ = holds_ || now - ran_ > standstill_;
    ran_ = now;
  }
  if (holds_) {
    held_.push_back(output);
  } else {
    Write(output);
  }
}

void DdsBus::EndHold(bool publish) {
  holds_ = false;
  for (const v1::Output& output : std::exchange(held_, {})) {
    if (publish) Write(output);
  }
}

void DdsBus::Write(const v1::Output& output) {
  switch (output.message_case()) {
    case v1::Output::kClearance:
      return session_.Write(output.clearance());
    case v1::Output::kEarliestIntersection:
      return session_.Write(output.earliest_intersection());
    case v1::Output::kCollisionEvent:
      return session_.Write(output.collision_event());
    case v1::Output::kRejection:
      return session_.Write(output.rejection());
    case v1::Output::kServiceStatus:
      return session_.Write(output.service_status());
    case v1::Output::kSimulatorReport:
      return session_.Write(output.simulator_report());
    case v1::Output::kAgentBreach:
      return session_.Write(output.agent_breach());
    case v1::Output::kScreeningEvent:
      return session_.Write(output.screening_event());
    case v1::Output::kServiceHello:
      return session_.Write(output.service_hello());
    case v1::Output::MESSAGE_NOT_SET:
      return;
  }
}

void DdsBus::Flush() { session_.Flush(); }

void DdsBus::Wake() { session_.Wake(); }

std::vector<BusWarning> DdsBus::TakeWarnings() {
  std::vector<std::string> said;
  {
    const std::lock_guard lock(said_mutex_);
    said = std::exchange(said_, {});
  }
  std::vector<BusWarning> lines;
  for (std::string& line : said) lines.push_back({kNetwork, std::move(line)});
  for (const DdsIgnored& ignored : session_.TakeIgnored()) {
    lines.push_back(
        {kNetwork, SimulatorIn(ignored.partition) + " writes more than it may: it is ignored for " +
                       std::to_string(ignored.duration / std::chrono::seconds(1)) + " s"});
  }
  for (const std::string& stranger : session_.TakeStrangers()) {
    lines.push_back({kStranger, stranger + " is on this network without credentials of this world: "
                                           "nothing that it writes is taken"});
  }
  AddForgeries(&lines);
  if (const auto warning = session_.TakeCredentialsWarning()) {
    lines.push_back({"credentials", *warning});
  }
  return lines;
}

void DdsBus::AddForgeries(std::vector<BusWarning>* lines) {
  const auto now = std::chrono::steady_clock::now();
  if (now < forgeries_due_) return;
  for (const DdsForgery& forgery : session_.TakeForgeries()) {
    forgeries_due_ = now + kForgeriesTold;
    lines->push_back({"forgery", SimulatorIn(forgery.partition) + " writes as simulator " +
                                     IdText(forgery.simulator) + ", which is not its name: " +
                                     std::to_string(forgery.samples) + " samples refused"});
  }
}

std::vector<std::string> DdsBus::flooding() const {
  std::vector<std::string> texts;
  for (const DdsLoss& loss : session_.losses()) {
    texts.push_back(SimulatorIn(loss.partition) + ": " + std::to_string(loss.dropped) +
                    " messages dropped; " + std::to_string(loss.waiting) + " wait");
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(loss.ignored_for).count();
    if (seconds > 0) texts.back() += "; ignored for " + std::to_string(seconds) + " s";
  }
  return texts;
}

std::string DdsBus::SimulatorIn(const std::string& partition) const {
  if (partition.empty()) return "a program that has left";
  const bool in_world = partition.starts_with(world_ + ".");
  return "simulator \"" + partition.substr(in_world ? world_.size() + 1 : 0) + "\"";
}

std::vector<v1::Counter> DdsBus::network_counters() const {
  const DdsCounters counted = counters();
  return {CounterOf("dds_samples_lost", counted.samples_lost),
          CounterOf("dds_samples_refused", counted.samples_refused),
          CounterOf("dds_senders_ignored", counted.senders_ignored),
          CounterOf("dds_samples_forged", counted.samples_forged),
          CounterOf("dds_writes_failed", counted.writes_failed)};
}

DdsCounters DdsBus::counters() const { return session_.counters(); }

}  // namespace collision::server
