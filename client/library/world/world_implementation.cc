#include "client/library/world/world_implementation.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "client/library/deadline.h"
#include "client/library/network/conversion.h"
#include "client/library/validation.h"
#include "idl/identity.h"

namespace collision::client {
namespace {

/// Tenths of a second: finer than the interval between two starts of one simulator. The service
/// refuses a run lower than the last.
std::uint32_t RunByClock() {
  using namespace std::chrono;
  using Tenths = duration<std::int64_t, std::deci>;
  const auto since_2020 = system_clock::now() - sys_days(year(2020) / January / 1);
  return static_cast<std::uint32_t>(duration_cast<Tenths>(since_2020).count());
}

std::int64_t SystemClockNs() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

PublishPolicy PolicyOf(const WorldOptions& options) {
  const std::uint32_t chunk_size = options.on_demand ? 1 : kChunkSizeMax;
  return {.on_demand = options.on_demand,
          .lead_ns = options.lock_step ? 0 : options.lead.count(),
          .chunk_size = options.chunk_size > 0 ? options.chunk_size : chunk_size,
          .wall_clock = !options.lock_step};
}

template <typename T>
std::vector<T> TakeAll(std::deque<T>* queue) {
  std::vector<T> all(std::move_iterator(queue->begin()), std::move_iterator(queue->end()));
  queue->clear();
  return all;
}

/// True while it lives, also if the callback throws.
class Raised {
 public:
  explicit Raised(bool* flag) : flag_(flag) { *flag_ = true; }
  ~Raised() { *flag_ = false; }
  Raised(const Raised&) = delete;
  Raised& operator=(const Raised&) = delete;

 private:
  bool* flag_;
};

}  // namespace

World::Implementation::Implementation(const WorldOptions& options,
                                      std::unique_ptr<Transport> transport)
    : simulator_id_(SimulatorId(options.simulator)),
      run_(options.run != 0 ? options.run : RunByClock()),
      lock_step_(options.lock_step),
      transport_(std::move(transport)),
      agents_(options.simulator, simulator_id_, run_, PolicyOf(options)),
      shapes_(simulator_id_, run_),
      wall_clock_(options.wall_clock ? options.wall_clock : SystemClockNs) {}

bool World::Implementation::WaitForService(std::chrono::nanoseconds timeout) {
  RequireOutsideCallback("WaitForService()");
  const Deadline deadline(timeout);
  while (!transport_->service_alive()) {
    const auto remaining = deadline.Remaining();
    if (remaining.count() == 0) return false;
    Gather(remaining);
  }
  return true;
}

AgentId World::Implementation::AddAgent(const AgentDescription& description, const State& state) {
  Validate(description);
  Validate(state);
  const AgentId id = agents_.Add(description, state);
  shapes_.Add(description.shape, Writer());
  WriteDescription(id);
  return id;
}

void World::Implementation::SetState(const AgentId& id, const State& state) {
  Validate(state);
  agents_.Stage(id, state);
}

void World::Implementation::SetDescription(const AgentId& id, const AgentDescription& description) {
  Validate(description);
  const std::string former = agents_.description(id).shape_hash();
  agents_.Describe(id, description);
  shapes_.Add(description.shape, Writer());
  WriteDescription(id);
  shapes_.Remove(former, Writer());
}

void World::Implementation::RemoveAgent(const AgentId& id) {
  const std::string former = agents_.description(id).shape_hash();
  v1::Input message;
  *message.mutable_agent_removal() = agents_.Remove(id);
  transport_->Write(message);
  shapes_.Remove(former, Writer());
  transport_->Flush();
}

void World::Implementation::Publish(std::int64_t clock_ns) {
  RequireForward(clock_ns);
  if (clock_published_ && clock_ns > Reachable()) {
    throw std::invalid_argument("clock_ns: " + std::to_string(clock_ns) +
                                ", allowed: <= " + std::to_string(Reachable()) + ", as granted");
  }
  Send(clock_ns);
}

Advance World::Implementation::AdvanceTo(std::int64_t clock_ns, std::chrono::nanoseconds timeout) {
  RequireOutsideCallback("AdvanceTo()");
  RequireForward(clock_ns);
  const Deadline deadline(timeout);
  Poll(std::chrono::nanoseconds(0));
  while (!closed_) {
    Send(std::min(clock_ns, Reachable()));
    if (clock_ns_ >= clock_ns) return Advance::kReached;
    const auto remaining = deadline.Remaining();
    if (remaining.count() == 0) break;
    const Deadline repeat(kRepeatPeriod);
    Poll(std::min<std::chrono::nanoseconds>(remaining, kRepeatPeriod));
    if (repeat.Remaining().count() == 0) Repeat();
  }
  return Advance::kTimeout;
}

void World::Implementation::Poll(std::chrono::nanoseconds timeout) {
  RequireOutsideCallback("Poll()");
  Gather(timeout);
  Deliver();
}

std::vector<Event> World::Implementation::TakeEvents() { return TakeAll(&events_); }

std::vector<Rejection> World::Implementation::TakeRejections() { return TakeAll(&rejections_); }

void World::Implementation::RequireOutsideCallback(const char* function) const {
  if (in_callback_) throw std::logic_error(std::string(function) + " called inside a callback");
}

void World::Implementation::RequireForward(std::int64_t clock_ns) const {
  ValidateClock(clock_ns);
  if (!clock_published_ || !lock_step_ || clock_ns >= clock_ns_) return;
  throw std::invalid_argument("clock_ns: " + std::to_string(clock_ns) + ", allowed: >= " +
                              std::to_string(clock_ns_) + ", the last clock published");
}

std::int64_t World::Implementation::Reachable() const {
  if (!lock_step_) return kNever;
  // A run starts at 0 without a grant, and a clock that was published stands.
  return std::max({granted_until_ns_, clock_ns_, std::int64_t{0}});
}

void World::Implementation::Send(std::int64_t clock_ns) {
  // A wall clock that was set back: the service begins another epoch, or the clock catches up.
  if (clock_published_ && clock_ns < clock_ns_) return Repeat();
  if (clock_published_ && clock_ns == clock_ns_ && !agents_.HasNews(clock_ns) && !name_refused_)
    return;
  v1::Input message;
  if (name_refused_) Reintroduce();
  for (v1::AgentStates& chunk : agents_.TakeDue(clock_ns)) {
    *message.mutable_agent_states() = std::move(chunk);
    transport_->Write(message);
  }
  *message.mutable_simulator_clock() = Clock(clock_ns);
  transport_->Write(message);
  transport_->Flush();
  clock_ns_ = clock_ns;
  clock_published_ = true;
}

void World::Implementation::Repeat() {
  if (!clock_published_ || closed_) return;
  v1::Input message;
  if (name_refused_) Reintroduce();
  *message.mutable_simulator_clock() = Clock(clock_ns_);
  transport_->Write(message);
  transport_->Flush();
}

v1::SimulatorClock World::Implementation::Clock(std::int64_t clock_ns) {
  v1::SimulatorClock clock = agents_.Clock(clock_ns, lock_step_);
  if (!lock_step_) echo_.FillIn(wall_clock_(), &clock);
  return clock;
}

void World::Implementation::Reintroduce() {
  name_refused_ = false;
  shapes_.WriteAll(Writer());
  v1::Input message;
  for (const v1::AgentDescription& description : agents_.Descriptions()) {
    *message.mutable_agent_description() = description;
    transport_->Write(message);
  }
  for (v1::AgentStates& chunk : agents_.SentStates()) {
    *message.mutable_agent_states() = std::move(chunk);
    transport_->Write(message);
  }
}

void World::Implementation::WriteDescription(const AgentId& id) {
  v1::Input message;
  *message.mutable_agent_description() = agents_.description(id);
  transport_->Write(message);
}

ShapePublisher::Writer World::Implementation::Writer() {
  return [this](const v1::Input& message) { transport_->Write(message); };
}

bool World::Implementation::Accept(const v1::ServiceStamp& stamp, std::int64_t now_ns,
                                   CurrentService::Time at) {
  const std::uint64_t id = service_.id();
  const std::uint32_t epoch = service_.epoch();
  if (!service_.Accept(stamp, at)) return false;
  if (lock_step_) return true;
  echo_.Hear(stamp, now_ns, wall_clock_());
  if (service_.id() == id && service_.epoch() != epoch) BeginEpoch();
  return true;
}

void World::Implementation::BeginEpoch() {
  filter_ = {};
  agents_.ForgetSent();
  clock_published_ = false;
}

void World::Implementation::Gather(std::chrono::nanoseconds timeout) {
  transport_->Flush();  // Descriptions may be waiting.
  Arrivals arrivals;
  transport_->Receive(timeout, &arrivals);
  const CurrentService::Time now = std::chrono::steady_clock::now();
  for (const v1::Output& output : arrivals.outputs) Handle(output, now);
  if (on_event_) return;
  while (events_.size() > kEventsMax) {
    events_.pop_front();
    ++events_lost_;
  }
}

void World::Implementation::Handle(const v1::Output& output, CurrentService::Time now) {
  switch (output.message_case()) {
    case v1::Output::kClearance:
      if (Accept(output.clearance().stamp(), output.clearance().now_ns(), now)) {
        Handle(output.clearance());
      }
      break;
    case v1::Output::kCollisionEvent:
      if (Accept(output.collision_event().stamp(), output.collision_event().now_ns(), now)) {
        Handle(output.collision_event());
      }
      break;
    case v1::Output::kRejection: {
      const v1::Rejection& rejection = output.rejection();
      if (rejection.simulator_id() != simulator_id_ || rejection.run() != run_) break;
      name_refused_ |= rejection.reason() == v1::REJECTED_ID_OWNED;
      if (rejections_.size() == kRejectionsMax) rejections_.pop_front();
      rejections_.push_back(FromMessage(rejection));
      break;
    }
    case v1::Output::kServiceStatus:
      if (output.service_status().phase() == v1::PHASE_CLAIMING) break;
      if (!Accept(output.service_status().stamp(), output.service_status().now_ns(), now)) break;
      simulated_clock_ = output.service_status().simulated_clock();
      break;
    default:
      break;
  }
}

void World::Implementation::Handle(const v1::Clearance& clearance) {
  if (clearance.simulator_id() != simulator_id_ || clearance.run() != run_) return;
  // All chunks carry the grant. The service writes chunk 0 after the others, so a simulator that
  // takes the grant from there knows all clearances as of that time, and which states are wanted.
  if (clearance.chunk() == 0) {
    granted_until_ns_ = std::max(granted_until_ns_, clearance.granted_until_ns());
  }
  for (const v1::AgentClearance& agent : clearance.agents()) {
    agents_.SetClearance(agent, clearance.now_ns());
  }
}

void World::Implementation::Handle(const v1::CollisionEvent& event) {
  if (!IsOwn(event.lower()) && !IsOwn(event.higher())) return;
  if (filter_.IsNew(event)) events_.push_back(FromMessage(event));
}

bool World::Implementation::IsOwn(const v1::AgentId& id) const {
  return id.simulator_id() == simulator_id_ && id.run() == run_;
}

void World::Implementation::Deliver() {
  while (on_event_ && !closed_ && !events_.empty()) {
    const Event event = events_.front();
    events_.pop_front();
    const auto callback = on_event_;  // It may replace itself.
    const Raised raised(&in_callback_);
    callback(event);
  }
}

}  // namespace collision::client
