#include "tests/stress/scene.h"

#include <algorithm>
#include <cmath>

namespace collision::stress {
namespace {

/// What the closed forms in long double may be off by.
constexpr Seconds kTruthShare = 0x1p-58L;

MotionState At(const Eigen::Vector3d& p, const Eigen::Vector3d& v) {
  MotionState state;
  state.p_WA = p;
  state.v_WA = v;
  return state;
}

bool IsOpen(const CollisionEvent& event) {
  return event.status == EventStatus::kPossible || event.status == EventStatus::kConfirmed;
}

bool IsContact(const CollisionEvent& event) {
  return event.status == EventStatus::kConfirmed || event.status == EventStatus::kEnded;
}

std::string Named(const char* what, std::uint32_t a, std::uint32_t b, Seconds at) {
  return std::string(what) + ", agents " + std::to_string(a) + " and " + std::to_string(b) +
         ", at " + Show(static_cast<double>(at)) + " s";
}

}  // namespace

Motion Straight(const Eigen::Vector3d& p, const Eigen::Vector3d& v) {
  return Falling(p, v, Eigen::Vector3d::Zero());
}

Motion Falling(const Eigen::Vector3d& p, const Eigen::Vector3d& v, const Eigen::Vector3d& a) {
  return [=](Seconds t) {
    using Vector = Eigen::Matrix<Seconds, 3, 1>;
    const Vector of_a = a.cast<Seconds>(), of_v = v.cast<Seconds>();
    const Vector x = p.cast<Seconds>() + t * of_v + t * t / 2 * of_a;
    return At(x.cast<double>(), Vector(of_v + t * of_a).cast<double>());
  };
}

Scene::Scene(const DetectorOptions& options, Instant start, Outcome* outcome)
    : detector_(options),
      announce_within_(options.announce_within),
      start_(start),
      now_(start),
      outcome_(outcome) {}

Seconds Scene::Since(Instant t) const {
  return static_cast<Seconds>(t.nanoseconds() - start_.nanoseconds()) / 1e9L;
}

MotionState Scene::StateAt(std::uint32_t agent, Instant t) const {
  MotionState state = agents_[agent].motion(Since(t));
  state.stamp = t;
  return state;
}

std::uint32_t Scene::Add(const AgentDeclaration& declaration, Motion motion, int every) {
  const auto agent = static_cast<std::uint32_t>(agents_.size());
  agents_.push_back({std::move(motion), every});
  const bool admitted = detector_.Admit(IdOf(agent), declaration, StateAt(agent, now_), now_);
  outcome_->Expect(admitted, "not admitted");
  return agent;
}

void Scene::Touch(std::uint32_t a, std::uint32_t b, Seconds begin, Seconds end) {
  meetings_.push_back({std::min(a, b), std::max(a, b), begin, end});
}

void Scene::Run(std::int64_t step_ns, int steps) {
  for (int i = 0; i < steps; ++i) StepTo(Instant::FromNanoseconds(now_.nanoseconds() + step_ns));
}

void Scene::StepTo(Instant now) {
  CheckAnnounced(now);
  now_ = now;
  ++steps_;
  for (std::uint32_t agent = 0; agent < agents_.size(); ++agent) {
    if (steps_ % agents_[agent].every == 0) {
      const UpdateOutcome told = detector_.Update(IdOf(agent), StateAt(agent, now), now);
      outcome_->Expect(told == UpdateOutcome::kKept || told == UpdateOutcome::kJumped,
                       Named("an honest state is not kept", agent, agent, Since(now)));
    }
    detector_.Hear(IdOf(agent), now);
  }
  const std::uint64_t before = detector_.counters().work_units;
  detector_.Advance(now);
  work_per_step_max_ = std::max(work_per_step_max_, detector_.counters().work_units - before);
  queued_max_ = std::max(queued_max_, detector_.queued());
  outcome_->Expect(detector_.queued() <= 2 * agents_.size() + detector_.pairs_tracked(),
                   "the queue holds more than agents and pairs");
  TakeEvents();
  CheckClearances();
}

// What begins before the next step has been announced, where it is as near as that.
void Scene::CheckAnnounced(Instant next) {
  for (const Meeting& meeting : meetings_) {
    if (meeting.begin <= elapsed() || meeting.begin > Since(next)) continue;
    if (meeting.begin > elapsed() + announce_within_ || steps_ == 0) continue;
    outcome_->Expect(meeting.announced,
                     Named("not announced before", meeting.a, meeting.b, meeting.begin));
  }
}

void Scene::TakeEvents() {
  events_per_step_max_ = std::max(events_per_step_max_, detector_.events().size());
  for (const CollisionEvent& event : detector_.events()) {
    CheckBrackets(event);
    newest_[{event.lower.slot, event.higher.slot}][event.contact] = events_.size();
    events_.push_back(event);
    for (Meeting& meeting : meetings_) {
      const bool of_it = meeting.a == event.lower.slot && meeting.b == event.higher.slot;
      if (of_it && IsOpen(event) && Since(event.now) <= meeting.begin) meeting.announced = true;
    }
  }
}

void Scene::CheckBrackets(const CollisionEvent& event) {
  const Seconds at = Since(event.now);
  const auto expect = [&](bool holds, const char* what) {
    outcome_->Expect(holds, Named(what, event.lower.slot, event.higher.slot, at));
  };
  expect(event.begin.earliest <= event.begin.latest, "the begin's bracket is not ordered");
  expect(event.end.earliest <= event.end.latest, "the end's bracket is not ordered");
  if (event.evaluated_at.is_never()) return;
  expect(event.separation_lower <= event.separation_upper, "the distance's bracket is not ordered");
  for (const double x : {event.depth_lower, event.point_error, event.normal_error, event.p_WC.sum(),
                         event.normal.sum()}) {
    expect(!std::isnan(x), "not a number in an event");
  }
}

// Never late: who is told to be clear begins no new contact before. Two that are told to touch
// begin none until that has ended.
void Scene::CheckClearances() {
  for (const Meeting& meeting : meetings_) {
    if (meeting.begin <= elapsed() || IsToldToTouch(meeting)) continue;
    for (const std::uint32_t agent : {meeting.a, meeting.b}) {
      const auto clearance = detector_.ClearanceOf(IdOf(agent));
      if (!outcome_->Expect(clearance.has_value(), "no clearance")) continue;
      outcome_->Expect(!clearance->clear_until.is_never() &&
                           Since(clearance->clear_until) <= meeting.begin * (1 + kTruthShare),
                       Named("told clear beyond a contact", meeting.a, meeting.b, meeting.begin));
    }
  }
}

bool Scene::IsToldToTouch(const Meeting& meeting) const {
  const auto of_pair = newest_.find({meeting.a, meeting.b});
  if (of_pair == newest_.end()) return false;
  return std::any_of(of_pair->second.begin(), of_pair->second.end(), [&](const auto& contact) {
    return events_[contact.second].status == EventStatus::kConfirmed;
  });
}

const CollisionEvent* Scene::Covering(const Meeting& meeting) const {
  const auto of_pair = newest_.find({meeting.a, meeting.b});
  if (of_pair == newest_.end()) return nullptr;
  const Seconds slack = kTruthShare * std::fabs(meeting.begin);
  for (const auto& [contact, index] : of_pair->second) {
    const CollisionEvent& event = events_[index];
    // Of touches that last no time one event may cover several.
    const bool whole = event.status == EventStatus::kUndecided || meeting.end <= meeting.begin;
    if (!IsContact(event) && event.status != EventStatus::kUndecided && !IsOpen(event)) continue;
    const Instant latest = whole ? event.end.latest : event.begin.latest;
    if (!event.began_before && Since(event.begin.earliest) > meeting.begin + slack) continue;
    if (!latest.is_never() && Since(latest) < meeting.begin - slack) continue;
    return &event;
  }
  return nullptr;
}

bool Scene::TouchAtAll(const CollisionEvent& event) const {
  return std::any_of(meetings_.begin(), meetings_.end(), [&](const Meeting& meeting) {
    return meeting.a == event.lower.slot && meeting.b == event.higher.slot;
  });
}

void Scene::Judge(Seconds width, bool confirmed) {
  for (const Meeting& meeting : meetings_) {
    if (meeting.begin > elapsed()) continue;
    outcome_->Add("contacts", 1);
    const CollisionEvent* event = Covering(meeting);
    if (!outcome_->Expect(event != nullptr,
                          Named("no event covers it", meeting.a, meeting.b, meeting.begin))) {
      continue;
    }
    outcome_->Expect(IsContact(*event) || !confirmed,
                     Named("not confirmed", meeting.a, meeting.b, meeting.begin));
    if (!IsContact(*event)) continue;
    outcome_->Add("confirmed", 1);
    if (meeting.begin <= 0) continue;
    const Seconds found = Since(event->begin.latest) - Since(event->begin.earliest);
    outcome_->Greatest("begin_width_s", static_cast<double>(found));
    outcome_->Expect(found <= width, Named("a wide bracket", meeting.a, meeting.b, found));
    // Touches that last no time may be several in one event.
    if (event->status != EventStatus::kEnded || meeting.end <= meeting.begin) continue;
    const Seconds slack = kTruthShare * std::fabs(meeting.end);
    outcome_->Expect(Since(event->end.earliest) <= meeting.end + slack &&
                         Since(event->end.latest) >= meeting.end - slack,
                     Named("the end is not in its bracket", meeting.a, meeting.b, meeting.end));
  }
  for (const CollisionEvent& event : events_) {
    outcome_->Expect(
        !IsContact(event) || TouchAtAll(event),
        Named("a contact that is none", event.lower.slot, event.higher.slot, Since(event.now)));
  }
}

void SayScene(const Scene& scene, Outcome* outcome) {
  outcome->Greatest("events_per_step_max", static_cast<double>(scene.events_per_step_max()));
  outcome->Greatest("queued_max", static_cast<double>(scene.queued_max()));
  outcome->Greatest("work_per_step_max", static_cast<double>(scene.work_per_step_max()));
  outcome->Say(Show(outcome->Get("confirmed")) + " of " + Show(outcome->Get("contacts")) +
               " contacts confirmed, begins within " + Show(outcome->Get("begin_width_s")) +
               " s at most; a step " + Show(outcome->Get("events_per_step_max")) + " events, " +
               Show(outcome->Get("work_per_step_max")) + " units; queue " +
               Show(outcome->Get("queued_max")) + " at most");
}

}  // namespace collision::stress
