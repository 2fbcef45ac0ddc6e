#include "client/library/world/world_implementation.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <random>
#include <stdexcept>
#include <utility>

#include "client/library/network/arrival_order.h"
#include "client/library/network/conversion.h"
#include "client/library/validation.h"
#include "idl/identity.h"
#include "idl/limits.h"

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

std::uint32_t DrawIncarnation() {
  std::random_device device;
  std::uint32_t incarnation = 0;
  while (incarnation == 0) incarnation = device();
  return incarnation;
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

}  // namespace

World::Implementation::Implementation(const WorldOptions& options,
                                      std::unique_ptr<Transport> transport)
    : name_(options.simulator),
      simulator_id_(SimulatorId(options.simulator)),
      run_(options.run != 0 ? options.run : RunByClock()),
      lock_step_(options.lock_step),
      on_leave_(options.on_leave),
      levels_(options.levels),
      transport_(std::move(transport)),
      arrival_(run_, options.incarnation != 0 ? options.incarnation : DrawIncarnation(),
               options.lock_step),
      agents_(options.simulator, simulator_id_, run_, arrival_.incarnation(), PolicyOf(options)),
      shapes_(simulator_id_, run_, arrival_.incarnation()),
      gate_(options.lock_step ? ClearanceGate::kPatienceInLockStep : ClearanceGate::kPatience),
      wall_clock_(options.wall_clock ? options.wall_clock : SystemClockNs),
      fit_({options.simulator, options.lock_step, options.frame}),
      waiting_(simulator_id_),
      notices_({options.simulator, options.world, options.domain, options.lock_step}) {
  v1::Input message;
  *message.mutable_simulator_hello() = HelloOf(
      {options.simulator, options.lock_step, options.frame}, simulator_id_, arrival_.incarnation());
  transport_->Write(message);
}

bool World::Implementation::WaitForService(std::chrono::nanoseconds timeout) {
  RequireOutsideCallback("WaitForService()");
  const Deadline deadline = Until(timeout);
  while (!transport_->service_alive()) {
    const auto remaining = deadline.Remaining();
    if (remaining.count() == 0 || closed_) return false;
    Gather(std::min<std::chrono::nanoseconds>(remaining, kRepeatPeriod));
    TellNotices();
  }
  return true;
}

AgentId World::Implementation::AddAgent(const AgentDescription& description, const State& state) {
  Validate(description);
  Validate(state);
  const AgentId id = agents_.Add(description, state);
  names_.Hear(id, description.name);
  shapes_.Add(description.shape, Writer());
  WriteDescription(id);
  return id;
}

void World::Implementation::SetState(const AgentId& id, const State& state) {
  Validate(state);
  if (state.discontinuity && state.stamp_ns < next_ns_) {
    throw std::invalid_argument("stamp_ns: " + std::to_string(state.stamp_ns) +
                                " of a discontinuity, allowed: >= " + std::to_string(next_ns_) +
                                ", the next step that was announced");
  }
  agents_.Stage(id, state);
}

void World::Implementation::SetDescription(const AgentId& id, const AgentDescription& description) {
  Validate(description);
  if (description.hypothetical != agents_.description(id).hypothetical()) {
    throw std::invalid_argument("hypothetical: another value, allowed: that of AddAgent()");
  }
  const std::string former = agents_.description(id).shape_hash();
  agents_.Describe(id, description);
  shapes_.Add(description.shape, Writer());
  WriteDescription(id);
  shapes_.Remove(former, Writer());
}

void World::Implementation::RemoveAgent(const AgentId& id) {
  const std::string former = agents_.description(id).shape_hash();
  v1::Input message;
  if (auto last = agents_.TakeLast(id)) {
    *message.mutable_agent_states() = *std::move(last);
    transport_->Write(message);
  }
  *message.mutable_agent_removal() = agents_.Remove(id);
  transport_->Write(message);
  shapes_.Remove(former, Writer());
  transport_->Flush();
}

void World::Implementation::Publish(std::int64_t clock_ns) {
  RequireForward(clock_ns);
  next_ns_ = kBeforeAll;
  if (clock_published_ && clock_ns > Reachable()) {
    throw std::invalid_argument("clock_ns: " + std::to_string(clock_ns) +
                                ", allowed: <= " + std::to_string(Reachable()) + ", as granted");
  }
  Send(clock_ns);
}

Advance World::Implementation::AdvanceTo(std::int64_t clock_ns, std::chrono::nanoseconds timeout) {
  RequireOutsideCallback("AdvanceTo()");
  RequireForward(clock_ns);
  const Deadline deadline = Until(timeout);
  Listen(std::chrono::nanoseconds(0));
  while (!closed_) {
    Deliver();
    if (closed_) break;
    if (!lock_step_) {
      Send(clock_ns);
    } else if (arrival_.waits()) {
      // Nothing counts that it writes: the step is taken when the name is free.
      if (IsQuiet()) WriteClock(Reachable());
    } else if (clock_ns <= Reachable()) {
      DeliverAll();
      if (closed_) break;
      RequireForward(clock_ns);  // A callback may have moved the clock.
      Reach(clock_ns);
    } else {
      if (!clock_published_) Reach(Reachable());
      Tell(clock_ns);
    }
    ungranted_ = lock_step_ && !arrival_.waits() && clock_ns > Reachable();
    TellNotices();
    if (closed_) break;
    if (clock_published_ && clock_ns_ >= clock_ns) return Advance::kReached;
    const auto remaining = deadline.Remaining();
    if (remaining.count() == 0) break;
    Listen(std::min<std::chrono::nanoseconds>(remaining, kRepeatPeriod));
  }
  return Advance::kTimeout;
}

std::optional<std::int64_t> World::Implementation::Join(std::chrono::nanoseconds timeout) {
  RequireOutsideCallback("Join()");
  if (clock_published_) throw std::logic_error("Join() called after the first clock");
  if (!lock_step_) return wall_clock_();
  const Deadline deadline = Until(timeout);
  Gather(std::chrono::nanoseconds(0));  // An answer that has arrived counts without any waiting.
  while (granted_until_ns_ == kBeforeAll) {
    // A clock without a time asks for it.
    if (!asked_ || IsQuiet()) WriteClock(kBeforeAll);
    asked_ = true;
    ungranted_ = true;
    TellNotices();
    const auto remaining = deadline.Remaining();
    if (remaining.count() == 0 || closed_) return std::nullopt;
    Gather(std::min<std::chrono::nanoseconds>(remaining, kRepeatPeriod));
  }
  ungranted_ = false;
  joined_ns_ = granted_until_ns_;
  return joined_ns_;
}

void World::Implementation::Poll(std::chrono::nanoseconds timeout) {
  RequireOutsideCallback("Poll()");
  // Who waits here has nothing more to tell of this time, so the service may judge it.
  if (clock_due_ && timeout.count() > 0) Tell(clock_ns_ + 1);
  Listen(timeout);
  DeliverAll();
  TellNotices();
}

void World::Implementation::Listen(std::chrono::nanoseconds timeout) {
  const Deadline deadline = Until(timeout);
  std::chrono::nanoseconds left = timeout;
  do {
    if (Gather(std::min<std::chrono::nanoseconds>(left, kRepeatPeriod))) left = {};
    Tend();
    left = std::min(left, deadline.Remaining());
  } while (left.count() > 0);
}

std::vector<Event> World::Implementation::TakeEvents() { return TakeAll(&events_); }

std::vector<Rejection> World::Implementation::TakeRejections() { return TakeAll(&rejections_); }

Deadline World::Implementation::Until(std::chrono::nanoseconds timeout) const {
  return Deadline(timeout, [this] { return transport_->Now(); });
}

void World::Implementation::RequireOutsideCallback(const char* function) const {
  if (in_callback_) throw std::logic_error(std::string(function) + " called inside a callback");
}

void World::Implementation::RequireForward(std::int64_t clock_ns) const {
  ValidateClock(clock_ns);
  if (!lock_step_) return;
  const auto require = [clock_ns](std::int64_t least_ns, const char* what) {
    if (clock_ns >= least_ns) return;
    throw std::invalid_argument("clock_ns: " + std::to_string(clock_ns) +
                                ", allowed: >= " + std::to_string(least_ns) + ", " + what);
  };
  if (!clock_published_) {
    if (joined_ns_) require(*joined_ns_, "the time that Join() told");
    return;
  }
  require(clock_ns_, "the last clock published");
  // Others may have gone on in reliance on it.
  if (clock_ns > clock_ns_) require(next_ns_, "the next step that was announced");
}

std::int64_t World::Implementation::Reachable() const {
  if (!lock_step_) return kNever;
  // A run starts at 0 without a grant, and a clock that was published stands.
  return std::max({granted_until_ns_, clock_ns_, std::int64_t{0}});
}

void World::Implementation::Send(std::int64_t clock_ns) {
  if (arrival_.waits()) return Wait(clock_ns);
  // A wall clock that was set back: the service begins another epoch, or the clock catches up.
  if (clock_published_ && clock_ns < clock_ns_) return WriteClock();
  const bool again = MustReintroduce();
  if (clock_published_ && clock_ns == clock_ns_ && !agents_.HasNews(clock_ns) && !again) return;
  if (again) Reintroduce();
  Reach(clock_ns);
  WriteClock();
}

void World::Implementation::Wait(std::int64_t clock_ns) {
  clock_ns_ = clock_ns;
  clock_published_ = true;
  if (IsQuiet()) WriteClock();
}

void World::Implementation::Reach(std::int64_t clock_ns) {
  if (!arrival_.waits()) WriteDue(clock_ns);
  clock_ns_ = clock_ns;
  clock_published_ = true;
  clock_due_ = true;
}

void World::Implementation::WriteDue(std::int64_t clock_ns) {
  v1::Input message;
  Heed();
  for (v1::AgentStates& chunk : agents_.TakeDue(clock_ns)) {
    *message.mutable_agent_states() = std::move(chunk);
    transport_->Write(message);
  }
  transport_->Flush();
}

void World::Implementation::Tell(std::int64_t next_ns) {
  const bool known = !clock_due_ && next_ns <= next_ns_;
  if (known && arrival_.waits()) return;
  const bool again = MustReintroduce();
  if (known && !agents_.HasNews(clock_ns_) && !again) return;
  if (again) Reintroduce();
  Reach(clock_ns_);
  next_ns_ = std::max(next_ns_, next_ns);
  WriteClock();
}

void World::Implementation::WriteClock() { WriteClock(clock_ns_); }

void World::Implementation::WriteClock(std::int64_t clock_ns) {
  last_clock_ = agents_.Clock(clock_ns, next_ns_, lock_step_);
  if (!lock_step_) echo_.FillIn(wall_clock_(), &last_clock_);
  clock_due_ = false;
  RepeatClock();
  arrival_.Wrote(last_clock_, agents_.stated(), clock_written_);
}

void World::Implementation::RepeatClock() {
  last_clock_.set_service_id(service_.id());
  last_clock_.set_service_term(service_.term());
  last_clock_.set_clearances_sequence(clearances_sequence_);
  service_is_new_ = false;
  v1::Input message;
  *message.mutable_simulator_clock() = last_clock_;
  transport_->Write(message);
  transport_->Flush();
  clock_written_ = transport_->Now();
}

void World::Implementation::Tend() {
  // In real time it tells before its first clock that it is there, and how far that is off.
  const bool present = !lock_step_ && agents_.size() > 0;
  if (closed_ || (!clock_published_ && !present)) return;
  const bool again = MustReintroduce();
  if (again) Reintroduce();
  if (!clock_published_) {
    if (again || IsQuiet()) WriteClock(kBeforeAll);
    return;
  }
  // A clock that has been reached is told with what comes next; until then the last one stands.
  if (clock_due_) {
    if (last_clock_.simulator_id() != 0 && (IsQuiet() || service_is_new_)) RepeatClock();
  } else if (again) {
    Reach(clock_ns_);
    WriteClock();
  } else if (IsQuiet() || service_is_new_ || agents_.clock_released()) {
    WriteClock();
  }
}

bool World::Implementation::IsQuiet() const {
  return transport_->Now() - clock_written_ >= kRepeatPeriod;
}

bool World::Implementation::MustReintroduce() {
  return transport_->service_alive() && arrival_.TakeDue(transport_->Now());
}

void World::Implementation::Finish() {
  if (!lock_step_) return;
  if (clock_published_) return Tell(kNever);
  if (!asked_) return;
  // It gives up to join.
  next_ns_ = kNever;
  WriteClock(kBeforeAll);
}

void World::Implementation::Close() {
  closed_ = true;
  try {
    // Of a name that another program has nothing counts.
    if (on_leave_ == OnLeave::kRemove && !arrival_.waits()) RemoveAgents();
    if (agents_.size() == 0) Finish();
  } catch (const std::exception&) {
    // A destructor cannot report it. Without a network the service waits, as if this process had
    // been killed.
  }
}

void World::Implementation::RemoveAgents() {
  for (const v1::AgentDescription& agent : agents_.Descriptions()) {
    RemoveAgent({simulator_id_, run_, agent.slot(), agent.generation()});
  }
}

void World::Implementation::Reintroduce() {
  if (arrival_.with_shapes()) shapes_.WriteAll(Writer());
  v1::Input message;
  for (const v1::AgentRemoval& removal : agents_.Removals()) {
    *message.mutable_agent_removal() = removal;
    transport_->Write(message);
  }
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

}  // namespace collision::client
