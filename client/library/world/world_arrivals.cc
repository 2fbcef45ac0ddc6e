// What a World does with what arrives.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <utility>

#include "client/library/network/arrival_order.h"
#include "client/library/network/conversion.h"
#include "client/library/world/world_implementation.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

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

void World::Implementation::BeginEpoch() {
  filter_ = {};
  clock_published_ = false;
  Void(agents_.ForgetPromises(), v1::CAUSE_SKEW);
  agents_.ForgetSent();
}

void World::Implementation::Void(const std::vector<AgentId>& agents, v1::ClearanceCause cause) {
  for (const AgentId& id : agents) {
    Clearance none;
    none.cause = v1::ClearanceCause_Name(cause);
    none.void_from_ns = kBeforeAll;
    if (on_lowered_ || on_void_) lowered_.emplace_back(id, none);
  }
}

bool World::Implementation::Gather(std::chrono::nanoseconds timeout) {
  transport_->Flush();  // Descriptions may be waiting.
  Arrivals arrivals;
  if (const auto patience = gate_.Remaining(transport_->Now())) {
    timeout = std::min(timeout, *patience);
  }
  transport_->Receive(timeout, &arrivals);
  const CurrentService::Time now = transport_->Now();
  OrderEvents(&arrivals.outputs);
  for (const v1::Output& output : arrivals.outputs) {
    if (output.has_service_hello()) Handle(output.service_hello());
  }
  for (const v1::Output& output : arrivals.outputs) {
    if (output.has_service_hello() || fit_.IsUnfit(StampOf(output).service_id())) continue;
    Handle(output, now);
    if (StampOf(output).service_id() != service_.id()) others_.Keep(output, now);
  }
  // The end of a service comes after all that it wrote.
  for (const v1::Input& input : arrivals.inputs) {
    if (input.has_watch()) watches_.Hear(input.watch(), now);
    if (!input.has_service_heard() || !service_.Hear(input.service_heard())) continue;
    for (const v1::Output& status : others_.Statuses(now)) Handle(status, now);
  }
  ClearanceGate::Newest newest;
  if (lock_step_) newest = {forecasts_.newest(), screened_.newest()};
  const std::vector<v1::Clearance> passed = gate_.Take(&contacts_, newest, now);
  for (const v1::Clearance& clearance : passed) Handle(clearance);
  Heed();
  Watch(now);
  DropOldEvents();
  return !arrivals.outputs.empty() || !passed.empty();
}

void World::Implementation::DropOldEvents() {
  while (!on_event_ && events_.size() > kEventsMax) {
    events_.pop_front();
    ++events_lost_;
  }
}

void World::Implementation::Handle(const v1::Output& output, CurrentService::Time now) {
  switch (output.message_case()) {
    case v1::Output::kClearance:
      if (Accept(output.clearance().stamp(), output.clearance().now_ns(), now)) {
        AddToGate(output.clearance(), now);
      }
      break;
    case v1::Output::kCollisionEvent: {
      const v1::CollisionEvent& event = output.collision_event();
      if (service_.IsPast(event.stamp()) || Accept(event.stamp(), event.now_ns(), now)) {
        Handle(event);
      }
      break;
    }
    case v1::Output::kRejection:
      Handle(output.rejection(), now);
      break;
    case v1::Output::kSimulatorReport:
      if (Accept(output.simulator_report().stamp(), output.simulator_report().now_ns(), now)) {
        Handle(output.simulator_report(), now);
      }
      break;
    case v1::Output::kAgentBreach:
      if (Accept(output.agent_breach().stamp(), output.agent_breach().now_ns(), now)) {
        Handle(output.agent_breach());
      }
      break;
    case v1::Output::kScreeningEvent: {
      const v1::CollisionEvent& event = output.screening_event().event();
      if (Accept(event.stamp(), event.now_ns(), now)) Handle(output.screening_event());
      break;
    }
    case v1::Output::kServiceStatus: {
      const v1::ServiceStatus& status = output.service_status();
      if (status.phase() != v1::PHASE_SERVING) break;
      if (!Accept(status.stamp(), status.now_ns(), now, status.followers() > 0)) break;
      world_lock_step_ = status.simulated_clock();
      waiting_.Take(status);
      break;
    }
    default:
      break;
  }
}

void World::Implementation::Handle(const v1::Rejection& rejection, CurrentService::Time now) {
  if (rejection.simulator_id() != simulator_id_ || !IsForThis(rejection.incarnation())) return;
  const bool is_of_run = rejection.topic() != v1::TOPIC_SIMULATOR_HELLO;
  if (is_of_run && rejection.run() != run_) return;
  if (!Accept(rejection.stamp(), rejection.now_ns(), now)) return;
  if (rejection.reason() == v1::REJECTED_TOO_MANY_SIMULATORS) arrival_.HearOfNoRoom();
  Keep(FromMessage(rejection));
}

void World::Implementation::Handle(const v1::ServiceHello& hello) {
  world_lock_step_ = hello.clock_kind() == v1::CLOCK_LOCK_STEP;
  if (auto mismatch = fit_.Hear(hello)) {
    mismatch->simulator = simulator_id_;
    Keep(*mismatch);
  }
}

void World::Implementation::Keep(const Rejection& rejection) {
  if (rejections_.size() == kRejectionsMax) rejections_.pop_front();
  rejections_.push_back(rejection);
  Note(rejections_.back());
}

void World::Implementation::Heed() {
  const CurrentService::Time now = transport_->Now();
  watches_.Expire(now);
  agents_.Heed(watches_.empty() ? nullptr : &watches_, now);
}

std::string World::Implementation::ended_because() const {
  const std::string text = EndText(name_, arrival_);
  return text.empty() ? fit_.Text() : text;
}

std::string World::Implementation::Name(const AgentId& id) { return names_.Of(id); }

/// Clearances of this run are younger than this program, so they tell whether it was there before
/// the first contact.
void World::Implementation::AddToGate(const v1::Clearance& clearance, CurrentService::Time now) {
  if (clearance.simulator_id() != simulator_id_ || clearance.run() != run_) return;
  if (!IsForThis(clearance.incarnation())) return;
  if (clearance.contacts_sequence() == 0) contacts_.BeginAtNone();
  gate_.Add(clearance, now);
}

void World::Implementation::Handle(const v1::Clearance& told) {
  const v1::Clearance& clearance = least_.Take(told, fit_.RegionsOf(told.stamp().service_id()));
  // All chunks carry the grant. The service writes chunk 0 after the others, so a simulator that
  // takes the grant from there knows all clearances as of that time, and which states are wanted.
  // In real time there is no grant.
  if (clearance.chunk() == 0 && clearance.granted_until_ns() != kNever &&
      clearance.granted_until_ns() > granted_until_ns_) {
    granted_until_ns_ = clearance.granted_until_ns();
    agents_.EndRound();
  }
  // Beside another service some may have been overwritten unread: then they are not taken in.
  if (!others_.IsHeard(transport_->Now())) {
    clearances_sequence_ = std::max(clearances_sequence_, clearance.stamp().sequence());
  }
  for (const v1::AgentClearance& agent : clearance.agents()) {
    if (!agents_.SetClearance(agent, clearance.now_ns())) continue;
    const AgentId id{simulator_id_, run_, agent.slot(), agent.generation()};
    NoteSkew(agent);
    if (on_lowered_ || on_void_) lowered_.emplace_back(id, this->clearance(id));
  }
}

bool World::Implementation::Accept(const v1::ServiceStamp& stamp, std::int64_t now_ns,
                                   CurrentService::Time now, bool followed) {
  const std::uint64_t id = service_.id();
  const std::uint32_t epoch = service_.epoch();
  if (!service_.Accept(stamp, now, followed)) return false;
  if (service_.id() != id) {
    ChangeService(id);
    gate_.Clear();
    least_.Clear();
    clearances_sequence_ = 0;
    service_is_new_ = id != 0;
    agents_.BeginService();
    service_now_ns_ = now_ns;
    for (const v1::Output& output : others_.Take(service_.id(), now)) Handle(output, now);
  } else if (service_.epoch() != epoch) {
    service_now_ns_ = now_ns;
    if (!lock_step_) BeginEpoch();
  }
  service_now_ns_ = std::max(service_now_ns_, now_ns);
  if (!lock_step_) echo_.Hear(stamp, now_ns, wall_clock_());
  return true;
}

// The one before may come into force again: it publishes most things once, and counts on.
void World::Implementation::ChangeService(std::uint64_t former_id) {
  FormerService former{former_id, contacts_, std::exchange(forecasts_, {}),
                       std::exchange(screened_, {})};
  if (former_.id == service_.id()) {
    contacts_.GoOn(former_.contacts);
    forecasts_ = std::move(former_.forecasts);
    screened_ = std::move(former_.screened);
  } else {
    contacts_.Restart();
  }
  former_ = std::move(former);
}

void World::Implementation::Watch(CurrentService::Time now) {
  if (service_.IsLost(now) == service_lost_) return;
  service_lost_ = !service_lost_;
  lost_news_ = service_lost_;
}

Clearance World::Implementation::clearance(const AgentId& id) const {
  Clearance clearance = agents_.clearance(id);
  if (service_.id() == 0) return clearance;
  if (!lock_step_) clearance.expires_ns = service_now_ns_ + wire::kServiceLease;
  if (service_lost_) {
    // Nobody would tell of a lowering. What was granted stands.
    const std::int64_t stands_ns = lock_step_ ? granted_until_ns_ : clearance.expires_ns;
    clearance.clear_until_ns = std::min(clearance.clear_until_ns, stands_ns);
  }
  return clearance;
}

void World::Implementation::Handle(const v1::CollisionEvent& event) {
  const bool own = IsOwn(event.lower()) || IsOwn(event.higher());
  if (own) {
    names_.Hear(FromMessage(event.lower()), event.lower_label().agent_name());
    names_.Hear(FromMessage(event.higher()), event.higher_label().agent_name());
  }
  if (lock_step_ && event.contacts_sequence() == 0) {
    forecasts_.Hear(event);
    if (own && IsForecast(event.status())) forecasts_.Hold(event);
  } else if (!own) {
    if (event.contacts_sequence() > 0) contacts_.Take(event.contacts_sequence());
  } else if (filter_.IsNew(event, &contacts_)) {
    Keep(event);
  }
}

void World::Implementation::Handle(const v1::ScreeningEvent& screening) {
  if (screening.simulator_id() != simulator_id_ || screening.run() != run_) return;
  if (!IsForThis(screening.incarnation())) return;
  const v1::CollisionEvent& event = screening.event();
  names_.Hear(FromMessage(event.lower()), event.lower_label().agent_name());
  names_.Hear(FromMessage(event.higher()), event.higher_label().agent_name());
  if (!lock_step_) return KeepScreened(event);
  screened_.Hear(event);
  screened_.Hold(event);
}

void World::Implementation::KeepScreened(const v1::CollisionEvent& event) {
  if (!screening_filter_.IsNewest(event)) return;
  events_.push_back(FromMessage(event));
  events_.back().hypothetical = true;
}

void World::Implementation::Keep(const v1::CollisionEvent& event) {
  const bool is_wanted = event.level().empty() || std::ranges::count(levels_, event.level()) > 0;
  if (is_wanted) events_.push_back(FromMessage(event));
}

void World::Implementation::Handle(const v1::SimulatorReport& report, Arrival::Time now) {
  if (report.simulator_id() != simulator_id_) return;
  arrival_.Hear(report, now);
  const bool goes_on = arrival_.run() == run_ && arrival_.ended() == v1::RUN_GOES_ON;
  if (goes_on) return;
  run_ = arrival_.run();
  agents_.SetRun(run_);
  shapes_.SetRun(run_);
  Void(agents_.ForgetPromises(), v1::CAUSE_NONE);
}

std::vector<Rejection> World::Implementation::standing_refusals() const {
  std::vector<Rejection> refusals = fit_.Unfit();
  if (!arrival_.own()) return refusals;
  for (const v1::StandingRefusal& refusal : arrival_.own()->refusals()) {
    refusals.push_back(FromMessage(refusal, *arrival_.own()));
  }
  return refusals;
}

bool World::Implementation::IsForThis(std::uint32_t incarnation) const {
  return incarnation == 0 || incarnation == arrival_.incarnation();
}

bool World::Implementation::IsOwn(const v1::AgentId& id) const {
  return id.simulator_id() == simulator_id_ && id.run() == run_;
}

void World::Implementation::Deliver() {
  if (const auto lost = std::exchange(lost_news_, std::nullopt)) Call(*lost ? on_lost_ : on_back_);
  if (on_waiting_ && waiting_.TakeChange()) Call(on_waiting_, waiting_.names());
  while (!closed_ && !lowered_.empty()) {
    const auto [id, clearance] = lowered_.front();
    lowered_.pop_front();
    if (clearance.void_from_ns != kNever) Call(on_void_, id, clearance);
    Call(on_lowered_, id, clearance);
  }
  while (on_event_ && !closed_ && !events_.empty()) {
    const Event event = events_.front();
    events_.pop_front();
    Call(on_event_, event);
  }
}

void World::Implementation::DeliverAll() {
  for (const v1::CollisionEvent& event : forecasts_.Take()) {
    if (filter_.IsNew(event, &contacts_)) Keep(event);
  }
  for (const v1::CollisionEvent& event : screened_.Take()) KeepScreened(event);
  DropOldEvents();
  Deliver();
}

void World::Implementation::TellNotices() {
  notices_.Look({.service_heard = transport_->service_alive() && !service_lost_,
                 .world_lock_step = world_lock_step_,
                 .waits = ungranted_,
                 .granted_until_ns = granted_until_ns_,
                 .next_ns = next_ns_,
                 .waiting_for = waiting_.names(),
                 .laggard = waiting_.laggard(),
                 .other_program = waits_for_name(),
                 .ended = ended_because()},
                transport_->Now());
  if (const auto warning = transport_->TakeCredentialsWarning()) notices_.Credentials(*warning);
  while (!closed_) {
    const std::optional<Notice> notice = notices_.Take();
    if (!notice) return;
    if (on_notice_) {
      Call(on_notice_, *notice);
    } else {
      std::fprintf(stderr, "%s: %s\n", name_.c_str(), notice->text.c_str());
    }
  }
}

void World::Implementation::Note(const Rejection& rejection) {
  const bool is_of_agent =
      rejection.topic == "TOPIC_AGENT_DESCRIPTION" || rejection.topic == "TOPIC_AGENT_STATES";
  notices_.Refuse(rejection, is_of_agent ? agents_.NameIn(rejection.slot) : "");
}

/// Others hear of it, too: what counts is whose clock it is.
void World::Implementation::NoteSkew(const v1::AgentClearance& clearance) {
  if (clearance.cause() == v1::CAUSE_SKEW && IsOwn(clearance.cause_agent())) {
    notices_.SkewedClock(clearance.void_from_ns());
  }
}

void World::Implementation::Handle(const v1::AgentBreach& breach) {
  if (breach.simulator_id() != simulator_id_ || breach.run() != run_) return;
  if (!IsForThis(breach.incarnation())) return;
  const std::string agent = agents_.NameIn(breach.slot());
  if (!agent.empty()) notices_.Breach(FromMessage(breach), agent, transport_->Now());
}

template <typename Callback, typename... Values>
void World::Implementation::Call(const Callback& callback, const Values&... values) {
  if (!callback || closed_) return;
  const Callback called = callback;  // It may replace itself.
  const Raised raised(&in_callback_);
  called(values...);
}

}  // namespace collision::client
