#include "tests/stress/scene.h"

#include <algorithm>
#include <cmath>

#include "collision_core/numeric/seconds.h"
#include "tests/stress/pair_judge.h"
#include "tests/support/truth/exact_meeting.h"

namespace collision::stress {
namespace {

/// What the closed forms in long double may be off by.
constexpr Seconds kTruthShare = 0x1p-58L;

constexpr double kNanosecond = 1e-9;

motion::MotionState At(const Eigen::Vector3d& p, const Eigen::Vector3d& v) {
  motion::MotionState state;
  state.p_WA = p;
  state.v_WA = v;
  return state;
}

bool IsOpen(const detection::CollisionEvent& event) {
  return event.status == detection::EventStatus::kPossible ||
         event.status == detection::EventStatus::kConfirmed;
}

bool IsContact(const detection::CollisionEvent& event) {
  return event.status == detection::EventStatus::kConfirmed ||
         event.status == detection::EventStatus::kEnded;
}

/// By plain doubles, and far more than they lose: twice the way of both does not join them.
bool IsFar(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, Instant now,
           Instant until) {
  const auto way = [&](const motion::SpaceTimeBound& bound) {
    const double s = numeric::SecondsBetween(bound.state.stamp, std::max(now, until)).upper;
    const motion::MotionState& state = bound.state;
    return bound.limits.radius + state.position_error +
           s * (state.v_WA.norm() + state.velocity_error) +
           s * s / 2 * bound.limits.acceleration_max;
  };
  return (b.state.p_WA - a.state.p_WA).norm() > 2 * (way(a) + way(b));
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

Scene::Scene(const detection::DetectorOptions& options, Instant start, Outcome* outcome)
    : detector_(options), options_(options), start_(start), now_(start), outcome_(outcome) {}

Seconds Scene::Since(Instant t) const {
  return static_cast<Seconds>(t.nanoseconds() - start_.nanoseconds()) / 1e9L;
}

const motion::MotionState& Scene::Tell(std::uint32_t agent, Instant t) {
  Agent& it = agents_[agent];
  it.told.state = it.motion(Since(t));
  it.told.state.stamp = t;
  it.places.emplace_back(t, it.told.state.p_WA.norm());
  return it.told.state;
}

std::uint32_t Scene::Add(const detection::AgentDeclaration& declaration, Motion motion, int every) {
  const auto agent = static_cast<std::uint32_t>(agents_.size());
  agents_.emplace_back();
  agents_[agent].motion = std::move(motion);
  agents_[agent].every = every;
  agents_[agent].declaration = declaration;
  agents_[agent].told.limits = declaration.limits;
  anybody_accelerates_ |= declaration.limits.acceleration_max > 0;
  const bool admitted = detector_.Admit(IdOf(agent), declaration, Tell(agent, now_), now_);
  outcome_->Expect(admitted, "not admitted");
  return agent;
}

void Scene::Touch(std::uint32_t a, std::uint32_t b, Seconds begin, Seconds end, Seconds width) {
  meetings_.push_back({std::min(a, b), std::max(a, b), begin, end, width});
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
      const detection::UpdateOutcome told = detector_.Update(IdOf(agent), Tell(agent, now), now);
      outcome_->Expect(
          told == detection::UpdateOutcome::kKept || told == detection::UpdateOutcome::kJumped,
          Named("an honest state is not kept", agent, agent, Since(now)));
    }
    detector_.SetHeardUntil(OwnerOf(IdOf(agent)), now);
  }
  const std::uint64_t before = detector_.counters().work_units;
  detector_.Advance(now);
  work_per_step_max_ = std::max(work_per_step_max_, detector_.counters().work_units - before);
  queued_max_ = std::max(queued_max_, detector_.queued());
  outcome_->Expect(detector_.queued() <= 2 * agents_.size() + detector_.pairs_tracked(),
                   "the queue holds more than agents and pairs");
  TakeEvents();
  CheckClearances();
  if (idle_forbidden_) CheckIdle();
}

// What begins before the next step has been announced, where it is as near as that.
void Scene::CheckAnnounced(Instant next) {
  for (const Meeting& meeting : meetings_) {
    if (meeting.begin <= elapsed() || meeting.begin > Since(next)) continue;
    if (meeting.begin > elapsed() + options_.announce_within || steps_ == 0) continue;
    outcome_->Expect(meeting.announced,
                     Named("not announced before", meeting.a, meeting.b, meeting.begin));
  }
}

void Scene::TakeEvents() {
  events_per_step_max_ = std::max(events_per_step_max_, detector_.events().size());
  for (const detection::CollisionEvent& event : detector_.events()) {
    CheckBrackets(event);
    newest_[{event.lower.slot, event.higher.slot}][event.contact] = events_.size();
    events_.push_back(event);
    for (Meeting& meeting : meetings_) {
      const bool of_it = meeting.a == event.lower.slot && meeting.b == event.higher.slot;
      if (of_it && IsOpen(event) && Since(event.now) <= meeting.begin) meeting.announced = true;
    }
  }
}

void Scene::CheckBrackets(const detection::CollisionEvent& event) {
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
  CheckDistance(event);
}

// How far apart two balls are: as closely as the motion since their last states leaves it. What is
// told of an instant may hold up to a nanosecond later.
void Scene::CheckDistance(const detection::CollisionEvent& event) {
  double open = 0, size = 0;
  for (const std::uint32_t agent : {event.lower.slot, event.higher.slot}) {
    const Agent& it = agents_[agent];
    const motion::MotionLimits& limits = it.told.limits;
    if (it.declaration.shape) return;
    const auto next =
        std::upper_bound(it.places.begin() + 1, it.places.end(), event.evaluated_at,
                         [](Instant at, const auto& place) { return at < place.first; });
    const auto last = std::prev(next);
    const double s = numeric::SecondsBetween(last->first, event.evaluated_at).upper + kNanosecond;
    const motion::MotionState& state = it.told.state;
    open += state.position_error + s * state.velocity_error + s * s / 2 * limits.acceleration_max;
    size += limits.radius + last->second + (next == it.places.end() ? last : next)->second;
  }
  const double width = event.separation_upper - event.separation_lower;
  const double unit = 0x1p-52 * (size + open);
  outcome_->Greatest("distance_width_m", width);
  outcome_->Greatest("distance_units", std::max(0.0, width - 2 * open) / std::max(unit, 0x1p-1000));
  outcome_->Expect(
      width <= 2 * open + kDistanceUnits * unit,
      Named("a wide distance", event.lower.slot, event.higher.slot, Since(event.evaluated_at)));
}

// Never late: an agent that is clear begins no new contact before. Two that are reported to
// touch begin none until that has ended.
void Scene::CheckClearances() {
  for (const Meeting& meeting : meetings_) {
    if (meeting.begin <= elapsed() || IsToldToTouch(meeting.a, meeting.b)) continue;
    for (const std::uint32_t agent : {meeting.a, meeting.b}) {
      const auto clearance = detector_.ClearanceOf(IdOf(agent));
      if (!outcome_->Expect(clearance.has_value(), "no clearance")) continue;
      outcome_->Expect(!clearance->clear_until.is_never() &&
                           Since(clearance->clear_until) <= meeting.begin * (1 + kTruthShare),
                       Named("clear beyond a contact", meeting.a, meeting.b, meeting.begin));
    }
  }
}

// Pairs are queried anew with every state that comes nearer than Δt; where no agent accelerates the
// first answer stays.
void Scene::CheckIdle() {
  const double asked_again =
      anybody_accelerates_ ? options_.temporal_resolution : options_.announce_within;
  const Instant soon = numeric::AddRoundedDown(now_, asked_again);
  for (std::uint32_t agent = 0; agent < agents_.size(); ++agent) {
    const auto clearance = detector_.ClearanceOf(IdOf(agent));
    if (!clearance || clearance->saturated || clearance->clear_until >= soon) continue;
    outcome_->Add("near_clearances", 1);
    outcome_->Expect(CouldTouchBy(agent, clearance->clear_until),
                     Named("idle", agent, agent, elapsed()));
  }
}

/// Whether an agent without a reported contact with it could touch it by a nanosecond after
/// `until`.
bool Scene::CouldTouchBy(std::uint32_t agent, Instant until) const {
  const Dyadic by = ExactMeeting::Between(now_, std::max(now_, until)) + Dyadic(1.0);
  const motion::SpaceTimeBound& bound = agents_[agent].told;
  for (std::uint32_t other = 0; other < agents_.size(); ++other) {
    const motion::SpaceTimeBound& partner = agents_[other].told;
    if (other == agent ||
        !CanMeet(agents_[agent].declaration.filter, agents_[other].declaration.filter)) {
      continue;
    }
    if (IsFar(bound, partner, now_, until)) continue;
    if (IsToldToTouch(std::min(agent, other), std::max(agent, other))) continue;
    const ExactMeeting larger(bound, partner, now_, {false, kPairUnits * 0x1p-52});
    if (larger.MetBy(by)) return true;
  }
  return false;
}

bool Scene::IsToldToTouch(std::uint32_t a, std::uint32_t b) const {
  const auto of_pair = newest_.find({a, b});
  if (of_pair == newest_.end()) return false;
  return std::any_of(of_pair->second.begin(), of_pair->second.end(), [&](const auto& contact) {
    return events_[contact.second].status == detection::EventStatus::kConfirmed;
  });
}

const detection::CollisionEvent* Scene::Covering(const Meeting& meeting) const {
  const auto of_pair = newest_.find({meeting.a, meeting.b});
  if (of_pair == newest_.end()) return nullptr;
  const Seconds slack = kTruthShare * std::fabs(meeting.begin);
  for (const auto& [contact, index] : of_pair->second) {
    const detection::CollisionEvent& event = events_[index];
    // One event may cover several contacts that last no time.
    const bool whole =
        event.status == detection::EventStatus::kUndecided || meeting.end <= meeting.begin;
    if (!IsContact(event) && event.status != detection::EventStatus::kUndecided && !IsOpen(event))
      continue;
    const Instant latest = whole ? event.end.latest : event.begin.latest;
    if (!event.began_before && Since(event.begin.earliest) > meeting.begin + slack) continue;
    if (!latest.is_never() && Since(latest) < meeting.begin - slack) continue;
    return &event;
  }
  return nullptr;
}

bool Scene::TouchAtAll(const detection::CollisionEvent& event) const {
  return std::any_of(meetings_.begin(), meetings_.end(), [&](const Meeting& meeting) {
    return meeting.a == event.lower.slot && meeting.b == event.higher.slot;
  });
}

void Scene::Judge(Seconds width, bool confirmed, Seconds end_width) {
  for (const Meeting& meeting : meetings_) {
    if (meeting.begin > elapsed()) continue;
    outcome_->Add("contacts", 1);
    const detection::CollisionEvent* event = Covering(meeting);
    if (!outcome_->Expect(event != nullptr,
                          Named("no event covers it", meeting.a, meeting.b, meeting.begin))) {
      continue;
    }
    outcome_->Expect(IsContact(*event) || !confirmed,
                     Named("not confirmed", meeting.a, meeting.b, meeting.begin));
    const Seconds of_it = meeting.width > 0 ? meeting.width : width;
    JudgeWidth(meeting, *event, of_it, end_width > 0 ? end_width : of_it);
    if (!IsContact(*event)) continue;
    outcome_->Add("confirmed", 1);
    // Touches that last no time may be several in one event.
    if (event->status != detection::EventStatus::kEnded || meeting.end <= meeting.begin) continue;
    const Seconds slack = kTruthShare * std::fabs(meeting.end);
    outcome_->Expect(Since(event->end.earliest) <= meeting.end + slack &&
                         Since(event->end.latest) >= meeting.end - slack,
                     Named("the end is not in its bracket", meeting.a, meeting.b, meeting.end));
  }
  for (const detection::CollisionEvent& event : events_) {
    outcome_->Expect(
        !IsContact(event) || TouchAtAll(event),
        Named("a contact that is none", event.lower.slot, event.higher.slot, Since(event.now)));
  }
}

void Scene::JudgeWidth(const Meeting& meeting, const detection::CollisionEvent& event,
                       Seconds width, Seconds end_width) {
  const auto judge = [&](const detection::TimeBracket& bracket, Seconds most, const char* what) {
    const Seconds found = Since(bracket.latest) - Since(bracket.earliest);
    outcome_->Greatest(std::string(what) + "_width_s", static_cast<double>(found));
    outcome_->Expect(found <= most, Named((std::string("a wide bracket of the ") + what).c_str(),
                                          meeting.a, meeting.b, found));
  };
  if (IsContact(event) && meeting.begin > 0) judge(event.begin, width, "begin");
  // Touches that last no time may be several in one event.
  if (meeting.end <= meeting.begin || std::isinf(meeting.end) || IsOpen(event)) return;
  if (event.status == detection::EventStatus::kEnded) judge(event.end, end_width, "end");
  const Seconds longer =
      Since(event.end.latest) - Since(event.begin.earliest) - (meeting.end - meeting.begin);
  outcome_->Add("stays", 1);
  outcome_->Greatest("longer_s", static_cast<double>(longer));
  outcome_->Expect(longer <= 2 * width, Named("not free for long", meeting.a, meeting.b, longer));
}

void SayScene(const Scene& scene, Outcome* outcome) {
  outcome->Greatest("events_per_step_max", static_cast<double>(scene.events_per_step_max()));
  outcome->Greatest("queued_max", static_cast<double>(scene.queued_max()));
  outcome->Greatest("work_per_step_max", static_cast<double>(scene.work_per_step_max()));
  const auto show = [outcome](const char* name) { return Show(outcome->Get(name)); };
  const bool near = outcome->Get("near_clearances") > 0;
  outcome->Say(show("confirmed") + " of " + show("contacts") +
               " contacts confirmed, begins within " + show("begin_width_s") +
               " s and ends within " + show("end_width_s") + " s at most, not free for " +
               show("longer_s") + " s more than in contact; " +
               (near ? "none of " + show("near_clearances") + " near clearances idle; " : "") +
               "a step " + show("events_per_step_max") + " events, " + show("work_per_step_max") +
               " units; queue " + show("queued_max") + " at most");
}

}  // namespace collision::stress
