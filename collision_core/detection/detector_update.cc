// What is told to the detector between two steps.
#include <algorithm>

#include "collision_core/detection/detector_implementation.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// Whether somebody might have been met under the first that cannot be under the second.
bool Narrower(const motion::AgentDeclaration& before, const motion::AgentDeclaration& next) {
  return next.radius < before.radius || next.acceleration_max < before.acceleration_max ||
         next.time_step < before.time_step;
}

// The same body, though perhaps with another tree.
bool SameBody(const std::shared_ptr<const shape::Shape>& a,
              const std::shared_ptr<const shape::Shape>& b) {
  return a == b || (a && b && a->IsSameBodyAs(*b));
}

// What is in force until the next state. A shape that was awaited has been there since the state that it is in force
// with; one that the owner changed since, or changes now, is somewhere within the ball until the next state.
void Reshape(const motion::AgentDeclaration& before, const motion::AgentDeclaration& declaration,
             AgentRecord* record) {
  motion::AgentDeclaration& in_force = record->history.newest().declaration;
  const bool arrived = before.shape_awaited && declaration.shape != nullptr;
  const bool same = SameBody(declaration.shape, before.shape) &&
                    declaration.shape_awaited == before.shape_awaited;
  // Another tree says nothing new of the past: it counts there, too, and the former one is of no use.
  if (same && declaration.shape) record->history.ReplaceTree(declaration.shape);
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

// Puts in force what is wider than before; what is narrower waits for the next state. True if
// somebody who relied on the bound must be asked anew.
bool Widen(const motion::AgentDeclaration& declaration, AgentRecord* record) {
  motion::AgentDeclaration& in_force = record->history.newest().declaration;
  const motion::AgentDeclaration before = in_force;
  in_force.radius = std::max(before.radius, declaration.radius);
  in_force.acceleration_max = std::max(before.acceleration_max, declaration.acceleration_max);
  in_force.speed_max = std::max(before.speed_max, declaration.speed_max);
  in_force.time_step = std::max(before.time_step, declaration.time_step);
  in_force.angular_acceleration_max = motion::WiderAngularBound(
      before.angular_acceleration_max, declaration.angular_acceleration_max);
  const bool spins_faster = in_force.angular_acceleration_max != before.angular_acceleration_max;
  Reshape(before, declaration, record);
  in_force.group = declaration.group;
  in_force.mask = declaration.mask;
  return in_force.radius > before.radius || in_force.acceleration_max > before.acceleration_max ||
         in_force.speed_max > before.speed_max || in_force.time_step > before.time_step ||
         (before.shape && (!SameBody(in_force.shape, before.shape) || spins_faster)) ||
         (in_force.group & ~before.group) != 0 || (in_force.mask & ~before.mask) != 0;
}

}  // namespace

Detector::Implementation::Implementation(const DetectorOptions& options)
    : pairs_(options.pairs_max),
      announcer_(options, &counters_),
      options_(options),
      broad_phase_(options.broad_phase),
      former_(std::make_unique<broad_phase::AdaptiveBroadPhase>(), options.agents_max),
      key_rows_(options.skew) {
  for (auto& of_class : horizons_) of_class.fill(1);
}

// The bits of an id are its owner's choice: mixed, so that no scene makes all meet in one bucket by
// chance (SplitMix64's finalizer).
std::size_t Detector::Implementation::IdHash::operator()(const AgentId& id) const {
  std::uint64_t hash = id.simulator + (std::uint64_t{id.slot} << 32 | id.run);
  for (const std::uint64_t more : {std::uint64_t{id.slot}, std::uint64_t{id.generation}}) {
    hash += more + 0x9e3779b97f4a7c15;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111eb;
    hash ^= hash >> 31;
  }
  return hash;
}

AgentRecord* Detector::Implementation::Find(const AgentId& id) {
  const auto found = index_.find(id);
  return found == index_.end() ? nullptr : agents_[found->second].get();
}

bool Detector::Implementation::Admit(const AgentId& id, const motion::AgentDeclaration& declaration,
                                     const motion::MotionState& state, Instant effective_from) {
  if (index_.size() >= options_.agents_max || index_.contains(id)) return false;
  std::uint32_t agent;
  if (free_.empty()) {
    agent = static_cast<std::uint32_t>(agents_.size());
    agents_.emplace_back();
    marks_.push_back(0);
    full_.push_back(0);
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
  record.keys.SetAll(Instant::Never());
  index_[id] = agent;
  NoteFull(agent);
  scene_.Add(record.features);
  Store(agent, {state, declaration, options_.skew}, Link::kJumped);
  Renew(agent, state.stamp, ClearanceCause::kAdmission, effective_from);
  return true;
}

UpdateOutcome Detector::Implementation::Update(const AgentId& id, const motion::MotionState& state,
                                               Instant effective_from) {
  const auto found = index_.find(id);
  if (found == index_.end()) return UpdateOutcome::kUnknown;
  const std::uint32_t agent = found->second;
  AgentRecord& record = At(agent);
  if (state.stamp < record.stamp()) return UpdateOutcome::kOlder;
  const motion::SpaceTimeBound next{state, record.declaration, options_.skew};
  if (record.expired) return Return(agent, next, effective_from);
  if (state.discontinuity) return Jump(agent, next, effective_from);
  const motion::ContractCheck check = CheckContract(record.bound(), state);
  switch (check.verdict) {
    case motion::ContractVerdict::kKept:
      return Keep(agent, next, check, effective_from);
    case motion::ContractVerdict::kWidened:
      ++counters_.widenings;
      Store(agent, next, Link::kFollows);
      Renew(agent, state.stamp, ClearanceCause::kWidening, effective_from);
      return UpdateOutcome::kWidened;
    case motion::ContractVerdict::kBreached:
      break;
  }
  Break(agent, next, effective_from);
  return UpdateOutcome::kBreached;
}

void Detector::Implementation::Store(std::uint32_t agent, const motion::SpaceTimeBound& bound,
                                     Link link) {
  AgentRecord& record = At(agent);
  record.history.Push(bound, link, options_.history_max);
  record.reshaped = false;
  record.heard = std::max(record.heard, bound.state.stamp);
  NoteChanged(agent);
}

// It had expired: it starts anew.
UpdateOutcome Detector::Implementation::Return(std::uint32_t agent,
                                               const motion::SpaceTimeBound& next,
                                               Instant effective_from) {
  AgentRecord& record = At(agent);
  record.expired = false;
  record.admitted_from = next.state.stamp;
  record.keys.SetAll(Instant::Never());
  record.history.Clear();
  Store(agent, next, Link::kJumped);
  Renew(agent, next.state.stamp, ClearanceCause::kAdmission, effective_from);
  return UpdateOutcome::kJumped;
}

UpdateOutcome Detector::Implementation::Jump(std::uint32_t agent,
                                             const motion::SpaceTimeBound& next,
                                             Instant effective_from) {
  ++counters_.jumps;
  const Instant stamp = next.state.stamp;
  former_.Keep(agent, At(agent).bound(), numeric::AddRoundedUp(stamp, options_.skew));
  Store(agent, next, Link::kJumped);
  // By our clock the jump may have come earlier by the skew.
  Renew(agent, numeric::AddRoundedDown(stamp, -options_.skew), ClearanceCause::kTeleport,
        effective_from);
  return UpdateOutcome::kJumped;
}

UpdateOutcome Detector::Implementation::Keep(std::uint32_t agent,
                                             const motion::SpaceTimeBound& next,
                                             const motion::ContractCheck& check,
                                             Instant effective_from) {
  ++counters_.updates_kept;
  AgentRecord& record = At(agent);
  const bool covered = record.margin.Spend(check, record.bound().state);
  if (Narrower(record.bound().declaration, next.declaration)) {
    former_.Keep(agent, record.bound(), next.state.stamp);
  }
  const Instant stamp = next.state.stamp;
  Store(agent, next, Link::kFollows);
  if (!covered) {
    Renew(agent, stamp, ClearanceCause::kWidening, effective_from);
    return UpdateOutcome::kKept;
  }
  Narrow(agent);
  if (record.keys.first() < stamp && !record.saturated) {
    record.asked = AgentRecord::kNotAsked;
    queue_.Set(agent, DueAt(record));
  }
  return UpdateOutcome::kKept;
}

void Detector::Implementation::Break(std::uint32_t agent, const motion::SpaceTimeBound& next,
                                     Instant effective_from) {
  ++counters_.breaches;
  AgentRecord& record = At(agent);
  const Instant before = record.stamp();
  Store(agent, next, Link::kBroken);
  NoteCause(ClearanceCause::kBreach, record.id, before, &record);
  Renew(agent, next.state.stamp, ClearanceCause::kBreach, effective_from);
  // Near partners are judged again from the last honest state on: what lies between is unknown.
  for (const std::uint32_t slot : record.pairs) {
    pairs_[slot].tracker.RetractFree(before, false);
    pairs_[slot].broken = true;
  }
}

bool Detector::Implementation::Redeclare(const AgentId& id,
                                         const motion::AgentDeclaration& declaration,
                                         Instant effective_from) {
  const auto found = index_.find(id);
  if (found == index_.end()) return false;
  AgentRecord& record = At(found->second);
  record.declaration = declaration;
  const bool widened = Widen(declaration, &record);
  NoteChanged(found->second);
  if (record.expired) return true;
  if (widened) {
    ++counters_.widenings;
    Renew(found->second, record.stamp(), ClearanceCause::kWidening, effective_from);
  } else {
    Narrow(found->second);
  }
  return true;
}

bool Detector::Implementation::Remove(const AgentId& id) {
  const auto found = index_.find(id);
  if (found == index_.end()) return false;
  // It was there until its owner last spoke of it; partners are judged up to then.
  const std::uint32_t agent = found->second;
  AgentRecord& record = At(agent);
  Instant& expiry = record.history.newest().state.expiry;
  expiry = std::min(expiry, record.heard);
  expiries_.Set(agent, expiry);
  record.leaving = ++removals_;
  scene_.Remove(record.features);
  index_.erase(found);
  return true;
}

void Detector::Implementation::Hear(const AgentId& id, Instant until) {
  if (AgentRecord* record = Find(id)) record->heard = std::max(record->heard, until);
}

void Detector::Implementation::Put(std::uint32_t agent) {
  const motion::SpaceTimeBound wide = At(agent).margin.Widen(At(agent).bound());
  broad_phase_.Set(agent, wide);
  key_rows_.Put(agent, wide);
  NoteBound(agent);
}

void Detector::Implementation::Narrow(std::uint32_t agent) {
  const motion::SpaceTimeBound wide = At(agent).margin.Widen(At(agent).bound());
  broad_phase_.Tighten(agent, wide);
  key_rows_.Put(agent, wide);
  NoteBound(agent);
}

// What is kept of the newest bound beside the broad phase.
void Detector::Implementation::NoteBound(std::uint32_t agent) {
  AgentRecord& record = At(agent);
  const motion::SpaceTimeBound& bound = record.bound();
  extremes_.Include(bound);
  if (bound.state.expiry.is_never()) {
    expiries_.Remove(agent);
  } else {
    expiries_.Set(agent, bound.state.expiry);
  }
  const SceneProfile::Features features = SceneProfile::Of(bound);
  if (features == record.features || record.leaving != 0) return;
  scene_.Remove(record.features);
  scene_.Add(features);
  record.features = features;
}

void Detector::Implementation::NoteChanged(std::uint32_t agent) {
  if (At(agent).changed) return;
  At(agent).changed = true;
  changed_.push_back(agent);
}

void Detector::Implementation::Touch(std::uint32_t agent) {
  if (At(agent).touched) return;
  At(agent).touched = true;
  touched_.push_back(agent);
}

void Detector::Implementation::Renew(std::uint32_t agent, Instant from, ClearanceCause cause,
                                     Instant effective_from) {
  AgentRecord& record = At(agent);
  if (!record.renewed_from) renewed_.push_back(agent);
  record.renewed_from = std::min(record.renewed_from.value_or(from), from);
  if (record.renewed_cause != ClearanceCause::kBreach) record.renewed_cause = cause;
  record.effective_from = std::max(record.effective_from, effective_from);
  if (record.renewed_cause != ClearanceCause::kBreach) {
    NoteCause(record.renewed_cause, record.id, Instant::Never(), &record);
  }
  record.margin = KeyMargin(record.bound());
  NoteChanged(agent);
  Put(agent);
  latest_.Remove(agent);
  restlessness_.Set(agent, record.bound().declaration.acceleration_max);
  if (!record.saturated) record.keys.SetAll(std::min(record.keys.first(), from));
  NoteKeys(agent);
  for (const std::uint32_t slot : record.pairs) {
    pairs_[slot].tracker.RetractFree(from, false);
    Tell(pairs_[slot].lower == agent ? pairs_[slot].higher : pairs_[slot].lower, agent);
  }
}

// Of several causes in one step the breach is told that voids promises from earliest on, whatever
// comes after it: nobody else tells who the culprit was.
void Detector::Implementation::NoteCause(ClearanceCause cause, const AgentId& by, Instant void_from,
                                         AgentRecord* record) {
  if (void_from > record->void_from) return;
  record->cause = cause;
  record->cause_agent = by;
  record->void_from = void_from;
}

// The partner's clearance may be lowered because of `cause`.
void Detector::Implementation::Tell(std::uint32_t agent, std::uint32_t cause) {
  AgentRecord& record = At(agent);
  const AgentRecord& source = At(cause);
  const bool breach = source.renewed_cause == ClearanceCause::kBreach;
  NoteCause(source.renewed_cause, source.id, breach ? source.void_from : Instant::Never(), &record);
  Touch(agent);
}

}  // namespace collision::detection
