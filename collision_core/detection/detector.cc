#include "collision_core/detection/detector.h"

#include <algorithm>

#include "collision_core/detection/detector_implementation.h"
#include "collision_core/detection/judge.h"
#include "collision_core/detection/scene_profile.h"

namespace collision {
namespace {

// Shapes are looked at so far ahead, in units of announce_within: a little beyond what the announcer takes for
// "far apart again".
constexpr double kLookAhead = 1.3;

// Of the work that is left in a turn: for what is settled, then for what is heard; the rest is for what is promised.
constexpr double kSettledShare = 0.5;
constexpr double kHeardShare = 0.8;

// What is in force until the next state. A shape that was awaited has been there since the state that it is in force
// with; one that the owner changed since, or changes now, is somewhere within the ball until the next state.
void Reshape(const AgentDeclaration& before, const AgentDeclaration& declaration,
             AgentRecord* record) {
  AgentDeclaration& in_force = record->history.newest().declaration;
  const bool arrived = before.shape_awaited && declaration.shape != nullptr;
  const bool same =
      declaration.shape == before.shape && declaration.shape_awaited == before.shape_awaited;
  if (arrived && !record->reshaped) {
    in_force.shape = declaration.shape;
    in_force.shape_awaited = false;
  } else if (!same && !arrived) {
    in_force.shape = nullptr;
    in_force.shape_awaited = true;
  }
  // Awaited before and after: it may be another one.
  if (!arrived && (!same || declaration.shape_awaited)) record->reshaped = true;
}

// Of the freedom that was found at `looked`, has half passed? Then it is time to look again.
bool WearsOut(Instant looked, Instant now, Instant free_until) {
  if (looked == Instant::Always() || free_until <= now) return true;
  return free_until.nanoseconds() - now.nanoseconds() <= now.nanoseconds() - looked.nanoseconds();
}

}  // namespace

Detector::Implementation::Implementation(const DetectorOptions& options)
    : pairs_(options.pairs_max), announcer_(options, &counters_), options_(options) {}

AgentRecord* Detector::Implementation::Find(const AgentId& id) {
  const auto found = index_.find(id);
  return found == index_.end() ? nullptr : agents_[found->second].get();
}

bool Detector::Implementation::Admit(const AgentId& id, const AgentDeclaration& declaration,
                                     const MotionState& state, Instant effective_from) {
  if (index_.size() >= options_.agents_max || index_.contains(id)) return false;
  std::uint32_t agent;
  if (free_.empty()) {
    agent = static_cast<std::uint32_t>(agents_.size());
    agents_.emplace_back();
  } else {
    agent = free_.back();
    free_.pop_back();
  }
  agents_[agent] = std::make_unique<AgentRecord>();
  AgentRecord& record = At(agent);
  record.id = id;
  record.declaration = declaration;
  record.heard = state.stamp;
  record.admitted_from = state.stamp;
  record.history.Push({state, declaration, options_.skew}, Link::kJumped, options_.history_max);
  index_[id] = agent;
  Renew(agent, state.stamp, ClearanceCause::kAdmission, effective_from);
  return true;
}

UpdateOutcome Detector::Implementation::Update(const AgentId& id, const MotionState& state,
                                               Instant effective_from) {
  const auto found = index_.find(id);
  if (found == index_.end()) return UpdateOutcome::kUnknown;
  const std::uint32_t agent = found->second;
  AgentRecord& record = At(agent);
  if (state.stamp < record.stamp()) return UpdateOutcome::kOlder;
  const SpaceTimeBound next{state, record.declaration, options_.skew};
  const auto push = [&](Link link) {
    record.history.Push(next, link, options_.history_max);
    record.reshaped = false;
    record.heard = std::max(record.heard, state.stamp);
    record.changed = true;
  };
  if (record.expired) {
    record.expired = false;
    record.admitted_from = state.stamp;
    record.history.Clear();
    push(Link::kJumped);
    Renew(agent, state.stamp, ClearanceCause::kAdmission, effective_from);
    return UpdateOutcome::kJumped;
  }
  if (state.discontinuity) {
    ++counters_.jumps;
    push(Link::kJumped);
    // By our clock the jump may have come earlier by the skew.
    Renew(agent, AddRoundedDown(state.stamp, -options_.skew), ClearanceCause::kTeleport,
          effective_from);
    return UpdateOutcome::kJumped;
  }
  const Instant before = record.stamp();
  const ContractCheck check = CheckContract(record.bound(), state);
  switch (check.verdict) {
    case ContractVerdict::kKept:
      ++counters_.updates_kept;
      push(Link::kFollows);
      record.position_drift += check.position_drift;
      record.velocity_drift += check.velocity_drift;
      if (DriftedBeyondKeys(record)) {
        Renew(agent, state.stamp, ClearanceCause::kWidening, effective_from);
        return UpdateOutcome::kKept;
      }
      Put(agent);
      // A state beyond the agent's key (it was granted more time before the key was lowered): ask at once.
      if (record.key < state.stamp) queue_.Set(agent, Instant::Always());
      return UpdateOutcome::kKept;
    case ContractVerdict::kWidened:
      ++counters_.widenings;
      push(Link::kFollows);
      Renew(agent, state.stamp, ClearanceCause::kWidening, effective_from);
      return UpdateOutcome::kWidened;
    case ContractVerdict::kBreached:
      break;
  }
  ++counters_.breaches;
  push(Link::kBroken);
  record.void_from = before;
  Renew(agent, state.stamp, ClearanceCause::kBreach, effective_from);
  // Near partners are judged again from the last honest state on: what lies between is unknown.
  for (const std::uint32_t slot : record.pairs) {
    pairs_[slot].tracker.RetractFree(before, false);
    pairs_[slot].broken = true;
  }
  return UpdateOutcome::kBreached;
}

bool Detector::Implementation::Redeclare(const AgentId& id, const AgentDeclaration& declaration,
                                         Instant effective_from) {
  const auto found = index_.find(id);
  if (found == index_.end()) return false;
  AgentRecord& record = At(found->second);
  record.declaration = declaration;
  AgentDeclaration& in_force = record.history.newest().declaration;
  const AgentDeclaration before = in_force;
  in_force.radius = std::max(before.radius, declaration.radius);
  in_force.acceleration_max = std::max(before.acceleration_max, declaration.acceleration_max);
  in_force.time_step = std::max(before.time_step, declaration.time_step);
  in_force.angular_acceleration_max =
      WiderAngularBound(before.angular_acceleration_max, declaration.angular_acceleration_max);
  const bool spins_faster = in_force.angular_acceleration_max != before.angular_acceleration_max;
  Reshape(before, declaration, &record);
  in_force.group = declaration.group;
  in_force.mask = declaration.mask;
  record.changed = true;
  const bool widened = in_force.radius > before.radius ||
                       in_force.acceleration_max > before.acceleration_max ||
                       in_force.time_step > before.time_step ||
                       (before.shape && (in_force.shape != before.shape || spins_faster)) ||
                       (in_force.group & ~before.group) != 0 || (in_force.mask & ~before.mask) != 0;
  if (record.expired) return true;
  if (widened) {
    ++counters_.widenings;
    Renew(found->second, record.stamp(), ClearanceCause::kWidening, effective_from);
  } else {
    Put(found->second);
  }
  return true;
}

bool Detector::Implementation::Remove(const AgentId& id) {
  const auto found = index_.find(id);
  if (found == index_.end()) return false;
  // It was there until its owner last spoke of it; partners are judged up to then.
  AgentRecord& record = At(found->second);
  Instant& expiry = record.history.newest().state.expiry;
  expiry = std::min(expiry, record.heard);
  leaving_.push_back(found->second);
  index_.erase(found);
  return true;
}

void Detector::Implementation::Hear(const AgentId& id, Instant until) {
  if (AgentRecord* record = Find(id)) record->heard = std::max(record->heard, until);
}

void Detector::Implementation::Renew(std::uint32_t agent, Instant from, ClearanceCause cause,
                                     Instant effective_from) {
  AgentRecord& record = At(agent);
  if (!record.renewed_from) renewed_.push_back(agent);
  record.renewed_from = std::min(record.renewed_from.value_or(from), from);
  if (record.renewed_cause != ClearanceCause::kBreach) record.renewed_cause = cause;
  record.effective_from = std::max(record.effective_from, effective_from);
  record.cause = record.renewed_cause;
  record.cause_agent = record.id;
  record.position_drift = record.velocity_drift = 0;
  record.changed = true;
  Put(agent);
  SetKey(agent, std::min(record.key, from));
  for (const std::uint32_t slot : record.pairs) {
    pairs_[slot].tracker.RetractFree(from, false);
    Tell(pairs_[slot].lower == agent ? pairs_[slot].higher : pairs_[slot].lower, agent);
  }
}

// The partner's clearance may be lowered because of `cause`.
void Detector::Implementation::Tell(std::uint32_t agent, std::uint32_t cause) {
  AgentRecord& record = At(agent);
  const AgentRecord& source = At(cause);
  record.cause = source.renewed_cause;
  record.cause_agent = source.id;
  if (source.renewed_cause == ClearanceCause::kBreach) record.void_from = source.void_from;
}

// Promises exclude the agent from here on. What is known of its pairs is judged a last time.
void Detector::Implementation::Expire(std::uint32_t agent, bool gone) {
  AgentRecord& record = At(agent);
  const std::vector<std::uint32_t> slots = record.pairs;
  for (const std::uint32_t slot : slots) {
    Turn(slot, true);
    if (pairs_.slots().contains(slot)) Drop(slot, gone);
  }
  record.expired = true;
  record.renewed_from.reset();
  std::erase(renewed_, agent);
  broad_phase_.Remove(agent);
  queue_.Remove(agent);
}

void Detector::Implementation::Leave(std::uint32_t agent) {
  if (!At(agent).expired) Expire(agent, true);
  pairs_.Forget(agent);
  agents_[agent].reset();
  free_.push_back(agent);
}

// The two will not meet any more, whatever they do.
void Detector::Implementation::Drop(std::uint32_t slot, bool gone) {
  const PairRecord& pair = pairs_[slot];
  announcer_.Leave(At(pair.lower), At(pair.higher), slot, gone, &pairs_);
  std::erase(At(pair.lower).pairs, slot);
  std::erase(At(pair.higher).pairs, slot);
  pairs_.Remove(slot);
}

void Detector::Implementation::Advance(Instant now) {
  now_ = std::max(now_, now);
  ++step_;
  announcer_.Start(now_);
  // First: whoever leaves or expires may have met somebody since the last step.
  AskAll();
  std::erase_if(leaving_, [this](std::uint32_t agent) {
    const bool over = At(agent).bound().state.expiry <= now_;
    if (over) Leave(agent);
    return over;
  });
  for (const auto& [id, agent] : index_) {
    if (!At(agent).expired && At(agent).bound().state.expiry <= now_) Expire(agent, false);
  }
  TurnAll();
  TrimHistories();
}

void Detector::Implementation::TurnAll() {
  const std::vector<std::uint32_t> slots(pairs_.slots().begin(), pairs_.slots().end());
  for (const std::uint32_t slot : slots) {
    const PairRecord& pair = pairs_[slot];
    const bool news = At(pair.lower).changed || At(pair.higher).changed;
    const bool soon = pair.clear_until <= AddRoundedDown(now_, options_.temporal_resolution);
    const bool due =
        !pair.announced && pair.clear_until <= AddRoundedDown(now_, options_.announce_within);
    if (news || soon || due || pair.in_contact) Turn(slot, false);
  }
}

// Up to here no later state of the agent is waited for. States of its own rate may still narrow what is known;
// an agent that speaks seldom, or once, is not waited for longer than twice its last interval.
Instant Detector::Implementation::SettledUntil(const AgentRecord& agent) const {
  const double patience = std::max(options_.announce_within, 2 * agent.history.LastInterval());
  return std::max(agent.stamp(), std::min(agent.heard, AddRoundedDown(now_, -patience)));
}

// States may reach beyond now: then contacts that have not begun yet are known, and their ends.
void Detector::Implementation::NoteAhead(const ContactTracker& preview, PairRecord* pair) const {
  if (pair->ahead_until <= now_) pair->ahead_from = pair->ahead_until = Instant::Never();
  for (const std::vector<ContactEpisode>* episodes :
       {&pair->tracker.finished(), &preview.finished()}) {
    for (const ContactEpisode& episode : *episodes) {
      if (episode.end.latest <= now_ || pair->ahead_from <= episode.begin.earliest) continue;
      pair->ahead_from = episode.begin.earliest;
      pair->ahead_until = episode.end.latest;
    }
  }
}

// `last`: no more states will come, so that everything known is settled.
void Detector::Implementation::Turn(std::uint32_t slot, bool last) {
  PairRecord& pair = pairs_[slot];
  const AgentRecord& a = At(pair.lower);
  const AgentRecord& b = At(pair.higher);
  if (!CanMeet(a.bound().declaration, b.bound().declaration)) {
    Drop(slot, false);
    return;
  }
  // One budget for all that this turn looks at, what is settled first.
  Work work(options_.work_units_per_turn);
  const auto judge = [&](Instant until, ContactTracker* tracker) {
    counters_.segments += Judge(a.history, b.history, until, &work, tracker);
  };
  // Settled: both owners' states reach up to here, so that the bounds of both directions count.
  const Instant there = std::min(a.bound().state.expiry, b.bound().state.expiry);
  const Instant heard = std::min({a.heard, b.heard, now_, there});
  {
    const WorkShare share(last ? 1 : kSettledShare, &work);
    judge(last ? heard : std::min({SettledUntil(a), SettledUntil(b), there}), &pair.tracker);
  }
  // Heard: no jump that we do not know of lies before.
  ContactTracker preview = pair.tracker;
  preview.TakeFinished();
  {
    const WorkShare share(kHeardShare, &work);
    judge(heard, &preview);
  }
  // Promised: free as long as both honour their newest bounds.
  if (preview.free() && !last) {
    ContactTracker outlook = preview;
    judge(std::min(std::max(a.stamp(), b.stamp()), there), &outlook);
    if (outlook.free() && outlook.finished().size() == preview.finished().size()) {
      const Instant from = std::min(now_, outlook.at());
      const Instant earliest = EarliestIntersection(a.bound(), b.bound(), from).instant();
      ++counters_.pair_queries;
      if (from == now_) {
        pair.earliest = earliest;
        pair.asked = step_;
      }
      outlook.ExtendFree(earliest);
      if (HaveShapes(a.history, b.history) && WearsOut(pair.looked_ahead, now_, outlook.at())) {
        pair.looked_ahead = now_;
        // Balls that overlap need not touch: as far ahead as decides what is announced.
        const Instant ahead = AddRoundedDown(now_, kLookAhead * options_.announce_within);
        outlook.ExtendFree(
            ShapesFreeAhead(a.history, b.history, outlook.at(), std::min(ahead, there), &work));
      }
      preview = outlook;
      const bool free_throughout = pair.tracker.free() && preview.finished().empty();
      if (free_throughout) pair.tracker.ExtendFree(preview.at());
    }
  }
  pair.work += work.spent();
  counters_.work_units += work.spent();
  NoteAhead(preview, &pair);
  pair.in_contact = preview.in_contact();
  pair.clear_until = preview.free_until();
  if (!announcer_.Report(a, b, slot, preview, last, &pairs_)) Untrack(slot);
}

// Keeps what is still needed: for pairs that are not judged up to the newest state, and for news that may come
// late, from the agent whose newest state is the oldest.
void Detector::Implementation::TrimHistories() {
  Instant oldest = now_;
  for (const auto& [id, agent] : index_) {
    if (!At(agent).expired) oldest = std::min(oldest, At(agent).stamp());
  }
  for (const auto& [id, agent] : index_) {
    AgentRecord& record = At(agent);
    if (!record.changed) continue;
    record.changed = false;
    Instant needed = oldest;
    for (const std::uint32_t slot : record.pairs) {
      needed = std::min(needed, pairs_[slot].tracker.at());
    }
    record.history.Trim(needed);
  }
}

Detector::Profile Detector::Implementation::DescribeScene() const {
  SceneProfile scene;
  for (const auto& [id, agent] : index_) scene.Count(*agents_[agent]);
  return scene.Describe();
}

Detector::Detector(const DetectorOptions& options)
    : implementation_(std::make_unique<Implementation>(options)) {}
Detector::~Detector() = default;

bool Detector::Admit(const AgentId& id, const AgentDeclaration& declaration,
                     const MotionState& state, Instant effective_from) {
  return implementation_->Admit(id, declaration, state, effective_from);
}
UpdateOutcome Detector::Update(const AgentId& id, const MotionState& state,
                               Instant effective_from) {
  return implementation_->Update(id, state, effective_from);
}
bool Detector::Redeclare(const AgentId& id, const AgentDeclaration& declaration,
                         Instant effective_from) {
  return implementation_->Redeclare(id, declaration, effective_from);
}
bool Detector::Remove(const AgentId& id) { return implementation_->Remove(id); }
void Detector::Hear(const AgentId& id, Instant until) { implementation_->Hear(id, until); }
void Detector::Advance(Instant now) { implementation_->Advance(now); }
const std::vector<CollisionEvent>& Detector::events() const {
  return implementation_->announcer_.events();
}
std::vector<AgentClearance> Detector::TakeChangedClearances() {
  return implementation_->TakeChangedClearances();
}
std::optional<AgentClearance> Detector::ClearanceOf(const AgentId& id) const {
  return implementation_->ClearanceOf(id);
}
EarliestAnswer Detector::Earliest() { return implementation_->Earliest(); }
Instant Detector::now() const { return implementation_->now_; }
std::size_t Detector::agents() const { return implementation_->index_.size(); }
std::size_t Detector::pairs_tracked() const { return implementation_->pairs_.size(); }
const DetectorCounters& Detector::counters() const { return implementation_->counters_; }
Detector::Profile Detector::profile() const { return implementation_->DescribeScene(); }

}  // namespace collision
