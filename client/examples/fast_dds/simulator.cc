// The simulator's life: joining, steps, leaving, and what it reads meanwhile.
#include "simulator.h"

#include <iostream>
#include <limits>
#include <random>

#include "event_line.h"

namespace example {
namespace {

using namespace collision::v1;
using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kNotBegun = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kStep = 100'000'000;  // [ns]
constexpr auto kPatience = 10s;
constexpr auto kContactsPatience = 30s;
constexpr auto kClockPeriod = 500ms;  // A quarter of its lease.
constexpr auto kSilence = 3s;         // A status comes every second.

/// A ball that flies along x at constant velocity.
struct Ball {
  const char* name;
  double x_m;  ///< At the begin.
  double velocity_m_s;
};
constexpr Ball kBalls[] = {{"ada", -10, 2}, {"bob", 10, -2}};
constexpr std::uint32_t kGeneration = 1;

/// FNV-1a: every program computes the id of a simulator from its name.
std::uint64_t SimulatorId(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char byte : name) hash = (hash ^ byte) * 0x100000001b3;
  return hash;
}

std::uint32_t RandomIncarnation() {
  std::random_device random;
  return std::uniform_int_distribution<std::uint32_t>(1)(random);
}

Vector3 AlongX(double x) {
  Vector3 vector;
  vector.x(x);
  return vector;
}

}  // namespace

Simulator::Simulator(const Options& options)
    : options_(options),
      id_(SimulatorId(options.simulator)),
      incarnation_(RandomIncarnation()),
      bus_(options.domain, options.world, options.simulator),
      hello_(bus_, kSimulatorHello),
      descriptions_(bus_, kAgentDescription),
      states_(bus_, kAgentStates),
      clock_(bus_, kSimulatorClock),
      hellos_(bus_, kServiceHello),
      statuses_(bus_, kServiceStatus),
      reports_(bus_, kSimulatorReport),
      rejections_(bus_, kRejection),
      clearances_(bus_, kClearance),
      contacts_(bus_, kContact) {}

void Simulator::Run(double seconds) {
  Join();
  Describe();
  const std::int64_t end = begin_ns_ + static_cast<std::int64_t>(seconds * 1e9);
  for (now_ns_ = begin_ns_;; now_ns_ = std::min(now_ns_ + kStep, end)) {
    WaitFor([&] { return IsGranted(now_ns_); });
    // The last states say that the agents leave: nothing is promised about them from then on.
    const bool is_last = now_ns_ == end;
    WriteStates(is_last ? end : kNever);
    if (is_last) break;
    const std::int64_t next = std::min(now_ns_ + kStep, end);
    if (!IsGranted(next)) WriteClock(now_ns_, next);
  }
  WriteClock(end, kNever);  // No step follows.
  Leave();
}

/// Says hello, waits for a service, and asks it for the name and for the time.
void Simulator::Join() {
  SimulatorHello hello;
  hello.simulator_id(id_);
  hello.incarnation(incarnation_);
  hello.wire_revision(WIRE_REVISION);
  hello.clock_kind(CLOCK_LOCK_STEP);
  hello.simulator_name(options_.simulator);
  hello.version("fast-dds-simulator");
  hello_.Write(hello);
  heard_at_ = SteadyClock::now();
  WaitFor([&] { return service_in_force_ != 0; });
  // A clock without a time is the question. The answer grants the time at which the world waits.
  WriteClock(kNotBegun, 0);
  const auto asked_at = SteadyClock::now();
  WaitFor([&] {
    if (SteadyClock::now() - asked_at > kPatience) {
      throw std::runtime_error(name_is_taken_ ? "another program is simulator " + options_.simulator
                                              : "the service does not answer this simulator");
    }
    return InForce().granted_ns.has_value();
  });
  begin_ns_ = *InForce().granted_ns;
}

void Simulator::Describe() {
  for (std::uint32_t slot = 0; slot < std::size(kBalls); ++slot) {
    AgentDescription description;
    description.simulator_id(id_);
    description.slot(slot);
    description.incarnation(incarnation_);
    description.run(run_);
    description.generation(kGeneration);
    description.revision(1);
    description.sequence(++descriptions_sequence_);
    description.states_sequence(states_sequence_);
    description.simulator_name(options_.simulator);
    description.agent_name(kBalls[slot].name);
    description.radius_m(0.5);
    description.acceleration_max_m_s2(1);
    description.angular_acceleration_max_rad_s2(-1);  // Not declared; 0 is, for most others.
    descriptions_.Write(description);
    ++agents_;
  }
}

/// States go out once they are granted. The service grants nothing beyond the first ones before it
/// has them, so they need not be carried in later samples.
void Simulator::WriteStates(std::int64_t expiry_ns) {
  AgentStates sample;
  sample.simulator_id(id_);
  sample.incarnation(incarnation_);
  sample.run(run_);
  const double elapsed = 1e-9 * static_cast<double>(now_ns_ - begin_ns_);
  for (std::uint32_t slot = 0; slot < std::size(kBalls); ++slot) {
    const Ball& ball = kBalls[slot];
    AgentState state;
    state.slot(slot);
    state.generation(kGeneration);
    state.stamp_ns(now_ns_);
    state.sequence(++states_sequence_);
    state.position_m(AlongX(ball.x_m + ball.velocity_m_s * elapsed));
    state.velocity_m_s(AlongX(ball.velocity_m_s));
    state.orientation().w(1);  // All zero is no quaternion, and refused.
    state.expiry_ns(expiry_ns);
    sample.states().push_back(state);
  }
  states_.Write(sample);
}

/// "All up to clock_ns is written, and nothing follows before next_ns."
void Simulator::WriteClock(std::int64_t clock_ns, std::int64_t next_ns) {
  last_clock_.clock_ns(clock_ns);
  last_clock_.next_ns(next_ns);
  last_clock_.states_sequence(states_sequence_);
  last_clock_.descriptions_sequence(descriptions_sequence_);
  last_clock_.agents(agents_);
  SendClock();
}

void Simulator::RepeatClock() {
  if (clock_written_at_ != SteadyTime()) SendClock();
}

void Simulator::SendClock() {
  last_clock_.simulator_id(id_);
  last_clock_.incarnation(incarnation_);
  last_clock_.run(run_);
  last_clock_.simulator_name(options_.simulator);
  last_clock_.lock_step(true);
  last_clock_.service_id(service_in_force_);
  last_clock_.service_term(term_in_force_);
  last_clock_.clearances_sequence(InForce().clearances);
  clock_.Write(last_clock_);
  clock_written_at_ = SteadyClock::now();
}

void Simulator::Leave() {
  for (std::uint32_t slot = 0; slot < std::size(kBalls); ++slot) {
    AgentDescription key;
    key.simulator_id(id_);
    key.slot(slot);
    key.incarnation(incarnation_);
    descriptions_.Dispose(key);
  }
  // A writer that is gone cannot repeat what a reader has missed.
  states_.Flush();
  clock_.Flush();
  descriptions_.Flush();
}

void Simulator::WaitFor(const std::function<bool()>& condition) {
  for (;;) {
    Read();
    if (condition()) return;
    const auto now = SteadyClock::now();
    if (now - heard_at_ > kPatience) {
      throw std::runtime_error("no service is heard in world \"" + options_.world +
                               "\" on domain " + std::to_string(options_.domain));
    }
    // A writer that was silent for longer than its lease, since its process stood still, lives
    // again with its next sample only.
    if (now - clock_written_at_ >= kClockPeriod) RepeatClock();
    bus_.Wait(100ms);
  }
}

/// A grant counts when the contacts before it have come.
bool Simulator::IsGranted(std::int64_t instant_ns) {
  const Service& service = InForce();
  const bool contacts_came = service.contacts_heard >= service.contacts_named ||
                             SteadyClock::now() - service.contacts_named_at > kContactsPatience;
  return service.granted_ns && *service.granted_ns >= instant_ns && contacts_came;
}

/// Hellos first. What is of another wire revision must not be read at all.
void Simulator::Read() {
  for (const ServiceHello& hello : hellos_.Take()) ReadHello(hello);
  if (service_in_force_ == 0) return;
  for (const ServiceStatus& status : statuses_.Take()) ReadStatus(status);
  for (const SimulatorReport& report : reports_.Take()) ReadReport(report);
  for (const Rejection& rejection : rejections_.Take()) ReadRejection(rejection);
  for (const Clearance& clearance : clearances_.Take()) ReadClearance(clearance);
  for (const CollisionEvent& contact : contacts_.Take()) ReadContact(contact);
}

void Simulator::ReadHello(const ServiceHello& hello) {
  if (hello.wire_revision() != WIRE_REVISION) {
    throw std::runtime_error("the service speaks wire revision " +
                             std::to_string(hello.wire_revision()) + ", this program " +
                             std::to_string(WIRE_REVISION));
  }
  if (hello.clock_kind() != CLOCK_LOCK_STEP) {
    throw std::runtime_error("world \"" + options_.world +
                             "\" runs in real time, not in lock-step");
  }
  if (service_in_force_ == 0 || hello.term() > term_in_force_) {
    Follow(hello.service_id(), hello.term());
  }
}

/// A standby that has taken over writes nothing but its status, not even a hello, until it is
/// named in the clocks of the simulators.
void Simulator::ReadStatus(const ServiceStatus& status) {
  const auto now = SteadyClock::now();
  if (status.stamp().service_id() == service_in_force_) {
    heard_at_ = now;
  } else if (status.phase() == PHASE_SERVING && status.stamp().term() > term_in_force_ &&
             (status.followers() > 0 || now - heard_at_ > kSilence)) {
    Follow(status.stamp().service_id(), status.stamp().term());
  }
}

void Simulator::Follow(std::uint64_t service_id, std::uint32_t term) {
  service_in_force_ = service_id;
  term_in_force_ = term;
  heard_at_ = SteadyClock::now();
  RepeatClock();
}

/// Which program the service takes for this simulator, and whether its run goes on.
void Simulator::ReadReport(const SimulatorReport& report) {
  if (report.simulator_id() != id_ || report.stamp().service_id() != service_in_force_) return;
  const bool is_mine = report.incarnation() == incarnation_;
  if (is_mine && report.ended() != RUN_GOES_ON) {
    throw std::runtime_error("the service has ended the run of this simulator");
  }
  if (!is_mine && agents_ > 0) {
    throw std::runtime_error("another program has become simulator " + options_.simulator);
  }
  name_is_taken_ = !is_mine && report.alive();
  if (!is_mine && !report.alive() && report.run() >= run_) {
    run_ = report.run() + 1;  // The one before has ended: its name is free for a higher run.
    RepeatClock();
  }
}

void Simulator::ReadClearance(const Clearance& clearance) {
  const bool is_mine = clearance.simulator_id() == id_ && clearance.run() == run_ &&
                       clearance.incarnation() == incarnation_;
  if (!is_mine) return;
  Service& service = services_[clearance.stamp().service_id()];
  service.clearances = std::max(service.clearances, clearance.stamp().sequence());
  if (clearance.chunk() == 0) service.granted_ns = clearance.granted_until_ns();
  if (clearance.contacts_sequence() > service.contacts_named) {
    service.contacts_named = clearance.contacts_sequence();
    service.contacts_named_at = SteadyClock::now();
  }
}

void Simulator::ReadContact(const CollisionEvent& contact) {
  Service& service = services_[contact.stamp().service_id()];
  service.contacts_heard = std::max(service.contacts_heard, contact.contacts_sequence());
  const auto is_mine = [&](const AgentId& agent) {
    return agent.simulator_id() == id_ && agent.run() == run_;
  };
  // Events of a level are about a margin, not about contact.
  if ((!is_mine(contact.lower()) && !is_mine(contact.higher())) || contact.level().size() > 0) {
    return;
  }
  std::cout << EventLine(contact) << std::endl;
}

void Simulator::ReadRejection(const Rejection& rejection) {
  if (rejection.simulator_id() != id_ || rejection.incarnation() != incarnation_) return;
  const std::string text =
      "refused: " + rejection.field().to_string() + ": " + rejection.detail().to_string();
  if (rejection.reason() == REJECTED_MISMATCH) throw std::runtime_error(text);
  if (agents_ > 0) std::cerr << text << "\n";  // Before, it is the name that is taken.
}

}  // namespace example
