#include "collision_core/broad_phase/adaptive_broad_phase.h"

#include <algorithm>
#include <utility>

#include "collision_core/broad_phase/index/all_pairs.h"
#include "collision_core/broad_phase/index/exhaustive_index.h"
#include "collision_core/broad_phase/index/spatial_index.h"

namespace collision::broad_phase {
namespace {

constexpr double kPairUnits = BroadPhaseWork::kPairUnits;
/// The cost of placing one agent, by method.
double PlaceUnits(BroadPhaseMethod kind) {
  if (kind == BroadPhaseMethod::kSpatialIndex) return BroadPhaseWork::kPlaceUnits;
  return kind == BroadPhaseMethod::kAllPairs ? 8 : 0;
}

/// Queries until the index is tried again; doubled after each try.
constexpr std::uint64_t kPatience = 2048;
constexpr std::uint64_t kPatienceMax = 1 << 20;

BroadPhaseWork operator+(const BroadPhaseWork& a, const BroadPhaseWork& b) {
  return {a.pair_queries + b.pair_queries,
          a.filter_tests + b.filter_tests,
          a.visits + b.visits,
          a.rebuilds + b.rebuilds,
          a.searches + b.searches,
          a.neighbours + b.neighbours};
}

BroadPhaseWork operator-(const BroadPhaseWork& a, const BroadPhaseWork& b) {
  return {a.pair_queries - b.pair_queries,
          a.filter_tests - b.filter_tests,
          a.visits - b.visits,
          a.rebuilds - b.rebuilds,
          a.searches - b.searches,
          a.neighbours - b.neighbours};
}

/// The most units of work that a text says; fits in 64 bits.
constexpr double kToldMax = 1e18;

std::string Whole(double x) {
  return std::to_string(static_cast<std::uint64_t>(std::min(x, kToldMax)));
}

}  // namespace

const char* Name(BroadPhaseMethod method) {
  switch (method) {
    case BroadPhaseMethod::kAllPairs:
      return "all pairs";
    case BroadPhaseMethod::kSpatialIndex:
      return "spatial index";
    case BroadPhaseMethod::kExhaustive:
      return "exhaustive";
    case BroadPhaseMethod::kAuto:
      break;
  }
  return "chosen by the scene";
}

AdaptiveBroadPhase::Method AdaptiveBroadPhase::Make(BroadPhaseMethod kind) const {
  Method method;
  if (kind == BroadPhaseMethod::kExhaustive) {
    method = {kind, std::make_unique<ExhaustiveIndex>(shared_rules())};
  } else {
    const bool grids = kind == BroadPhaseMethod::kSpatialIndex;
    std::unique_ptr<WindowedSearch> search;
    if (grids) {
      search = std::make_unique<SpatialIndex>(shared_rules());
    } else {
      search = std::make_unique<AllPairs>(shared_rules());
    }
    method.kind = grids ? BroadPhaseMethod::kSpatialIndex : BroadPhaseMethod::kAllPairs;
    method.table = &search->table();
    method.phase = std::move(search);
  }
  for (const HalfSpaces::Entry& entry : half_spaces()) {
    method.phase->SetHalfSpace(entry.agent, entry.half_space);
  }
  return method;
}

AdaptiveBroadPhase::AdaptiveBroadPhase(BroadPhaseMethod requested, SharedRules rules)
    : AgentBounds(std::move(rules)),
      requested_(requested),
      method_(Make(requested)),
      patience_(kPatience) {}

AdaptiveBroadPhase::~AdaptiveBroadPhase() = default;

void AdaptiveBroadPhase::Set(std::uint32_t agent, const AgentBound& bound) {
  if (held_.size() <= agent) held_.resize(agent + 1);
  agents_ += !held_[agent];
  held_[agent] = true;
  const bool was_half_space = mutable_half_spaces().Remove(agent);
  method_.phase->Set(agent, bound);
  if (Follows(agent) || (next_.phase && was_half_space)) next_.phase->Set(agent, bound);
  Choose();
}

void AdaptiveBroadPhase::Tighten(std::uint32_t agent, const AgentBound& bound) {
  method_.phase->Tighten(agent, bound);
  if (Follows(agent)) next_.phase->Tighten(agent, bound);
  if (next_.phase) Choose();
}

void AdaptiveBroadPhase::Remove(std::uint32_t agent) {
  ForgetRules(agent);
  mutable_half_spaces().Remove(agent);
  Release(agent);
  method_.phase->Remove(agent);
  if (next_.phase) next_.phase->Remove(agent);
  Choose();
}

void AdaptiveBroadPhase::Release(std::uint32_t agent) {
  if (agent >= held_.size() || !held_[agent]) return;
  held_[agent] = false;
  --agents_;
}

bool AdaptiveBroadPhase::SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) {
  if (!mutable_half_spaces().Set(agent, half_space)) return false;
  Release(agent);
  method_.phase->SetHalfSpace(agent, half_space);
  if (next_.phase) next_.phase->SetHalfSpace(agent, half_space);
  Choose();
  return true;
}

void AdaptiveBroadPhase::UpdateRules(std::uint32_t agent) {
  method_.phase->UpdateRules(agent);
  if (next_.phase) next_.phase->UpdateRules(agent);
}

std::optional<intersection::IntersectingPair> AdaptiveBroadPhase::Earliest(
    const intersection::BroadQuery& query) {
  const auto answer = method_.phase->Earliest(query);
  Choose();
  return answer;
}

std::optional<intersection::IntersectingPair> AdaptiveBroadPhase::EarliestOf(
    std::uint32_t agent, const intersection::BroadQuery& query) {
  const BroadPhaseWork before = method_.phase->work();
  const auto answer = method_.phase->EarliestOf(agent, query);
  EndQuery(before);
  return answer;
}

void AdaptiveBroadPhase::FindNeighbours(std::uint32_t agent, const NeighbourWindow& window,
                                        const Skip& skip, std::vector<Neighbour>* neighbours) {
  const BroadPhaseWork before = method_.phase->work();
  method_.phase->FindNeighbours(agent, window, skip, neighbours);
  EndQuery(before);
}

void AdaptiveBroadPhase::FindNeighbours(const AgentBound& bound, Instant from, Instant until,
                                        const Skip& skip, std::vector<Neighbour>* neighbours) {
  const BroadPhaseWork before = method_.phase->work();
  method_.phase->FindNeighbours(bound, from, until, skip, neighbours);
  EndQuery(before);
}

void AdaptiveBroadPhase::FindNearPairs(const intersection::BroadQuery& query,
                                       std::vector<NearPair>* pairs) {
  method_.phase->FindNearPairs(query, pairs);
  Choose();
}

BroadPhaseWork AdaptiveBroadPhase::work() const {
  BroadPhaseWork work = before_ + method_.phase->work();
  if (next_.phase) work = work + next_.phase->work();
  return work;
}

double AdaptiveBroadPhase::Units(BroadPhaseMethod kind, const BroadPhaseWork& done) const {
  const double placed = static_cast<double>(done.rebuilds) * static_cast<double>(agents_);
  return kPairUnits * static_cast<double>(done.pair_queries) + done.search_units() +
         PlaceUnits(kind) * placed;
}

// The same pairs, found by a test of all agents in each search.
double AdaptiveBroadPhase::UnitsByAllPairs(const BroadPhaseWork& done) const {
  const auto all = static_cast<double>(agents_ + half_spaces().size());
  return kPairUnits * static_cast<double>(done.pair_queries) +
         static_cast<double>(done.neighbours) +
         static_cast<double>(done.searches) * (all + BroadPhaseWork::kVisitUnits);
}

double AdaptiveBroadPhase::UnitsOf(const Method& method) const {
  return Units(method.kind, method.phase->work());
}

double AdaptiveBroadPhase::units() const {
  return units_before_ + UnitsOf(method_) + (next_.phase ? UnitsOf(next_) : 0);
}

void AdaptiveBroadPhase::Start(BroadPhaseMethod kind) {
  next_ = Make(kind);
  filled_ = 0;
}

void AdaptiveBroadPhase::Drop() {
  before_ = before_ + next_.phase->work();
  units_before_ += UnitsOf(next_);
  next_ = Method();
}

void AdaptiveBroadPhase::Switch() {
  before_ = before_ + method_.phase->work();
  units_before_ += UnitsOf(method_);
  method_ = std::exchange(next_, Method());
  excess_ = 0;
  ++changes_;
  ResetCounts();
}

// Resets the counts after a decision.
void AdaptiveBroadPhase::ResetCounts() {
  queries_ = 0;
  answering_ = {};
  decided_with_ = agents_;
}

void AdaptiveBroadPhase::Fill() {
  const std::uint32_t end = std::min(filled_ + kMoves, method_.table->size());
  for (; filled_ < end; ++filled_) {
    if (held_[filled_]) next_.phase->Set(filled_, method_.table->agent_bound(filled_));
  }
  if (filled_ >= method_.table->size()) Switch();
}

void AdaptiveBroadPhase::Choose() {
  if (requested_ != BroadPhaseMethod::kAuto) return;
  if (next_.phase) {
    // The reason for the change may no longer hold.
    if (next_.kind == BroadPhaseMethod::kAllPairs && agents_ > kManyAgents) return Drop();
    return Fill();
  }
  if (method_.kind == BroadPhaseMethod::kAllPairs) {
    ChooseFromAllPairs();
  } else {
    ChooseFromIndex();
  }
}

void AdaptiveBroadPhase::ChooseFromAllPairs() {
  if (agents_ <= kFewAgents) return;
  const bool grown = 2 * agents_ > 3 * decided_with_;
  if (agents_ > kManyAgents || grown || queries_ >= patience_) {
    units_before_try_ = grown || queries_ < kPeriodQueries
                            ? numeric::kInfinity
                            : Units(method_.kind, answering_) / static_cast<double>(queries_);
    Start(BroadPhaseMethod::kSpatialIndex);
  }
}

void AdaptiveBroadPhase::ChooseFromIndex() {
  // Half the limit: a scene about as large as it does not switch back and forth.
  if (agents_ <= kFewAgents / 2) {
    units_ = 0;
    return Start(BroadPhaseMethod::kAllPairs);
  }
  if (agents_ > kManyAgents - kManyAgents / 4 || queries_ < kPeriodQueries) return;
  const auto queries = static_cast<double>(queries_);
  units_ = Units(method_.kind, answering_) / queries;
  units_of_other_ = std::min(UnitsByAllPairs(answering_) / queries, units_before_try_);
  excess_ = std::max(0.0, excess_ + queries * (units_ - units_of_other_));
  if (excess_ > kExcessUnits * static_cast<double>(agents_)) {
    std::swap(units_, units_of_other_);
    patience_ = std::min(2 * patience_, kPatienceMax);
    Start(BroadPhaseMethod::kAllPairs);
  }
  ResetCounts();
}

void AdaptiveBroadPhase::EndQuery(const BroadPhaseWork& before) {
  ++queries_;
  answering_ = answering_ + (method_.phase->work() - before);
  Choose();
}

void AdaptiveBroadPhase::ValidateMethod(const Method& method) const {
  method.phase->Validate();
  for (auto agent = static_cast<std::uint32_t>(held_.size());
       method.table != nullptr && agent < method.table->size(); ++agent) {
    CORE_CHECK(!method.table->contains(agent), "no method holds an agent of its own", agent);
  }
  const HalfSpaces &own = half_spaces(), &others = method.phase->half_spaces();
  CORE_CHECK(own.size() == others.size(), "all methods have the same half-spaces", own.size(),
             others.size());
  for (const HalfSpaces::Entry& entry : own) {
    CORE_CHECK(others.Find(entry.agent) != nullptr, "each method has each half-space", entry.agent);
  }
}

void AdaptiveBroadPhase::Validate() const {
  AgentBounds::Validate();
  const auto count = static_cast<std::size_t>(std::count(held_.begin(), held_.end(), true));
  CORE_CHECK(count == agents_, "agents that are held are counted", count, agents_);
  ValidateMethod(method_);
  if (next_.phase) ValidateMethod(next_);
  for (std::uint32_t agent = 0; agent < held_.size(); ++agent) {
    CORE_CHECK(method_.phase->Contains(agent) == held_[agent],
               "the method that answers holds the agents that are held", agent);
    if (!next_.phase) continue;
    const bool is_next = next_.phase->Contains(agent);
    // Beyond the mark there may be agents that were half-spaces.
    CORE_CHECK(is_next <= held_[agent] && (is_next == held_[agent] || agent >= filled_),
               "the method that is being filled holds the agents below its mark", agent, filled_);
    CORE_CHECK(!is_next || agent >= filled_ ||
                   method_.table->row(agent).stamp == next_.table->row(agent).stamp,
               "both methods hold the same bounds", agent);
  }
}

std::string AdaptiveBroadPhase::why() const {
  const std::string agents = std::to_string(agents_) + " agents";
  if (requested_ != BroadPhaseMethod::kAuto) return agents + "; the configuration asks for it";
  const bool all_pairs = method_.kind == BroadPhaseMethod::kAllPairs;
  if (agents_ <= kFewAgents && all_pairs) {
    return agents + ": up to " + std::to_string(kFewAgents) + " it costs least";
  }
  if (agents_ > kManyAgents || units_ == 0) {
    return agents + ": beyond " + std::to_string(kFewAgents) + " it costs least, as a rule";
  }
  return agents + ": " + Whole(units_) + " units of work a query with " +
         std::to_string(decided_with_) + ", " + (all_pairs ? "the index " : "all pairs ") +
         Whole(units_of_other_);
}

}  // namespace collision::broad_phase
