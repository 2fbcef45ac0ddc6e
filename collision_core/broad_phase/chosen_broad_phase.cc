#include "collision_core/broad_phase/chosen_broad_phase.h"

#include <algorithm>
#include <utility>

#include "collision_core/broad_phase/all_pairs.h"
#include "collision_core/broad_phase/face_sweep.h"
#include "collision_core/broad_phase/spatial_index.h"

namespace collision {
namespace {

/// What a piece of work costs, as measured once on one machine; only the ratios count, and roughly.
constexpr double kPairUnits = 256;
constexpr double kTestUnits = 1;
constexpr double kVisitUnits = 16;
constexpr double kPlaceUnits[] = {0, 8, 0, 64};  // per agent, by method

/// Questions until the first trial; doubled by each that changes nothing.
constexpr std::uint64_t kPatience = 64;
constexpr std::uint64_t kPatienceMax = 1 << 20;

/// All pairs must be better by this factor to be taken back.
constexpr double kWorthReturning = 1.25;

/// The bounds of a method, for filling another.
template <typename M>
class Readable : public M {
 public:
  const HornTable* bounds() const { return &this->table(); }
};

BroadPhaseWork operator+(const BroadPhaseWork& a, const BroadPhaseWork& b) {
  return {a.pair_queries + b.pair_queries, a.filter_tests + b.filter_tests, a.visits + b.visits,
          a.rebuilds + b.rebuilds};
}

BroadPhaseWork operator-(const BroadPhaseWork& a, const BroadPhaseWork& b) {
  return {a.pair_queries - b.pair_queries, a.filter_tests - b.filter_tests, a.visits - b.visits,
          a.rebuilds - b.rebuilds};
}

std::string Whole(double x) {
  return std::to_string(static_cast<std::uint64_t>(std::min(x, 1e18)));
}

}  // namespace

const char* Name(BroadPhaseMethod method) {
  switch (method) {
    case BroadPhaseMethod::kAllPairs:
      return "all pairs";
    case BroadPhaseMethod::kFaceSweep:
      return "face sweep";
    case BroadPhaseMethod::kSpatialIndex:
      return "spatial index";
    case BroadPhaseMethod::kAuto:
      break;
  }
  return "chosen by the scene";
}

ChosenBroadPhase::Method ChosenBroadPhase::Make(BroadPhaseMethod kind) const {
  Method method;
  if (kind == BroadPhaseMethod::kFaceSweep) {
    method = {kind, std::make_unique<FaceSweep>()};
  } else if (kind == BroadPhaseMethod::kSpatialIndex) {
    auto phase = std::make_unique<Readable<SpatialIndex>>();
    const HornTable* table = phase->bounds();
    method = {kind, std::move(phase), table};
  } else {
    auto phase = std::make_unique<Readable<AllPairs>>();
    const HornTable* table = phase->bounds();
    method = {BroadPhaseMethod::kAllPairs, std::move(phase), table};
  }
  method.phase->ShareRules(rules_);
  for (const HalfSpaces::Entry& entry : half_spaces_) {
    method.phase->PutHalfSpace(entry.agent, entry.half_space);
  }
  return method;
}

ChosenBroadPhase::ChosenBroadPhase(BroadPhaseMethod asked)
    : asked_(asked), method_(Make(asked)), patience_(kPatience) {}

ChosenBroadPhase::~ChosenBroadPhase() = default;

void ChosenBroadPhase::Put(std::uint32_t agent, const SpaceTimeBound& bound) {
  if (held_.size() <= agent) held_.resize(agent + 1);
  agents_ += !held_[agent];
  held_[agent] = true;
  const bool was_half_space = half_spaces_.Remove(agent);
  method_.phase->Put(agent, bound);
  if (Follows(agent) || (next_.phase && was_half_space)) next_.phase->Put(agent, bound);
  Choose();
}

void ChosenBroadPhase::Narrow(std::uint32_t agent, const SpaceTimeBound& bound) {
  method_.phase->Narrow(agent, bound);
  if (Follows(agent)) next_.phase->Narrow(agent, bound);
  if (next_.phase) Choose();
}

void ChosenBroadPhase::Remove(std::uint32_t agent) {
  ForgetRules(agent);
  half_spaces_.Remove(agent);
  Release(agent);
  method_.phase->Remove(agent);
  if (next_.phase) next_.phase->Remove(agent);
  Choose();
}

void ChosenBroadPhase::Release(std::uint32_t agent) {
  if (agent >= held_.size() || !held_[agent]) return;
  held_[agent] = false;
  --agents_;
}

bool ChosenBroadPhase::PutHalfSpace(std::uint32_t agent, const HalfSpace& half_space) {
  if (!half_spaces_.Put(agent, half_space)) return false;
  Release(agent);
  method_.phase->PutHalfSpace(agent, half_space);
  if (next_.phase) next_.phase->PutHalfSpace(agent, half_space);
  Choose();
  return true;
}

void ChosenBroadPhase::RulesChanged(std::uint32_t agent) {
  method_.phase->RulesChanged(agent);
  if (next_.phase) next_.phase->RulesChanged(agent);
}

std::optional<PairMeeting> ChosenBroadPhase::Earliest(const BroadQuery& query) {
  if (OnTrial()) next_.phase->Earliest(query);
  const auto answer = method_.phase->Earliest(query);
  EndQuestion();
  return answer;
}

std::optional<PairMeeting> ChosenBroadPhase::EarliestOf(std::uint32_t agent,
                                                        const BroadQuery& query) {
  if (OnTrial()) next_.phase->EarliestOf(agent, query);
  const auto answer = method_.phase->EarliestOf(agent, query);
  EndQuestion();
  return answer;
}

void ChosenBroadPhase::Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon,
                                const Skip& skip, std::vector<Meeting>* meetings) {
  if (OnTrial()) {
    tried_.clear();
    next_.phase->Meetings(agent, from, until, horizon, skip, &tried_);
  }
  method_.phase->Meetings(agent, from, until, horizon, skip, meetings);
  EndQuestion();
}

void ChosenBroadPhase::NearPairs(const BroadQuery& query, std::vector<NearPair>* pairs) {
  method_.phase->NearPairs(query, pairs);
  EndQuestion();
}

BroadPhaseWork ChosenBroadPhase::work() const {
  BroadPhaseWork work = before_ + method_.phase->work();
  if (next_.phase) work = work + next_.phase->work();
  return work;
}

double ChosenBroadPhase::Units(const Method& method, const BroadPhaseWork& since) const {
  const BroadPhaseWork done = method.phase->work() - since;
  const double placed = static_cast<double>(done.rebuilds) * static_cast<double>(agents_);
  return kPairUnits * static_cast<double>(done.pair_queries) +
         kTestUnits * static_cast<double>(done.filter_tests) +
         kVisitUnits * static_cast<double>(done.visits) +
         kPlaceUnits[static_cast<int>(method.kind)] * placed;
}

double ChosenBroadPhase::units() const {
  return units_before_ + Units(method_, {}) + (next_.phase ? Units(next_, {}) : 0);
}

// Full, and with so few agents that its work must be seen first.
bool ChosenBroadPhase::OnTrial() const {
  return Filled() && next_.kind == BroadPhaseMethod::kSpatialIndex && agents_ <= kManyAgents;
}

void ChosenBroadPhase::Start(BroadPhaseMethod kind) {
  next_ = Make(kind);
  filled_ = 0;
}

void ChosenBroadPhase::Drop() {
  before_ = before_ + next_.phase->work();
  units_before_ += Units(next_, {});
  next_ = Method();
}

void ChosenBroadPhase::Switch() {
  before_ = before_ + method_.phase->work();
  units_before_ += Units(method_, {});
  method_ = std::exchange(next_, Method());
  ++changes_;
  Settle();
}

// A decision has been made.
void ChosenBroadPhase::Settle() {
  questions_ = 0;
  decided_with_ = agents_;
  method_since_ = method_.phase->work();
}

void ChosenBroadPhase::Fill() {
  const std::uint32_t end = std::min(filled_ + kMoves, method_.table->size());
  for (; filled_ < end; ++filled_) {
    if (held_[filled_]) next_.phase->Put(filled_, method_.table->bound(filled_));
  }
  if (!Filled()) return;
  questions_ = 0;
  method_since_ = method_.phase->work();
  next_since_ = next_.phase->work();
}

void ChosenBroadPhase::Choose() {
  if (asked_ != BroadPhaseMethod::kAuto) return;
  if (next_.phase && filled_ < method_.table->size()) Fill();
  if (method_.kind == BroadPhaseMethod::kAllPairs) {
    ChooseFromAllPairs();
  } else {
    ChooseFromIndex();
  }
}

void ChosenBroadPhase::ChooseFromAllPairs() {
  if (!next_.phase) {
    // Filled in time: with every agent that comes, kMoves of the others follow.
    const bool must = agents_ > kManyAgents - kManyAgents / kMoves && agents_ > decided_with_;
    const bool grown = 2 * agents_ > 3 * decided_with_ && questions_ >= kPatience;
    if (must || (agents_ > kFewAgents && (grown || questions_ >= patience_))) {
      Start(BroadPhaseMethod::kSpatialIndex);
    }
    return;
  }
  if (!Filled()) return;
  if (agents_ > kManyAgents) {
    Switch();
  } else if (questions_ >= kTrialQuestions) {
    units_of_other_ = Units(next_, next_since_) / static_cast<double>(questions_);
    units_ = Units(method_, method_since_) / static_cast<double>(questions_);
    patience_ = std::min(2 * patience_, kPatienceMax);
    if (units_of_other_ < kWorthIt * units_) {
      std::swap(units_, units_of_other_);
      Switch();
    } else {
      Drop();
      Settle();
    }
  }
}

void ChosenBroadPhase::ChooseFromIndex() {
  if (next_.phase) {
    if (agents_ > kManyAgents) {
      Drop();
    } else if (Filled()) {
      Switch();
    }
    return;
  }
  // With room between them: a scene about as large as the limit does not go to and fro.
  if (agents_ <= kFewAgents / 2) return Start(BroadPhaseMethod::kAllPairs);
  if (agents_ > kManyAgents - kManyAgents / 4 || questions_ < kPeriodQuestions) return;
  const double questions = static_cast<double>(questions_);
  const BroadPhaseWork done = method_.phase->work() - method_since_;
  units_ = Units(method_, method_since_) / questions;
  // All pairs asks of every agent the same pairs, and tests all others.
  units_of_other_ = kPairUnits * static_cast<double>(done.pair_queries) / questions +
                    kTestUnits * static_cast<double>(agents_ + half_spaces_.size());
  if (units_ > kWorthReturning * units_of_other_) {
    patience_ = std::min(2 * patience_, kPatienceMax);
    Start(BroadPhaseMethod::kAllPairs);
  } else {
    Settle();
  }
}

void ChosenBroadPhase::EndQuestion() {
  ++questions_;
  Choose();
}

std::string ChosenBroadPhase::why() const {
  const std::string agents = std::to_string(agents_) + " agents";
  if (asked_ != BroadPhaseMethod::kAuto) return agents + "; the configuration asks for it";
  if (method_.kind == BroadPhaseMethod::kAllPairs) {
    if (agents_ <= kFewAgents) {
      return agents + ": up to " + std::to_string(kFewAgents) + " it costs least";
    }
    if (units_of_other_ == 0) return agents + ": too few questions so far to try the index";
  } else if (agents_ > kManyAgents) {
    return agents + ": beyond " + std::to_string(kManyAgents) + " it costs least";
  }
  return agents + ": " + Whole(units_) + " units of work a question with " +
         std::to_string(decided_with_) + ", " +
         (method_.kind == BroadPhaseMethod::kAllPairs ? "the index " : "all pairs ") +
         Whole(units_of_other_);
}

}  // namespace collision
