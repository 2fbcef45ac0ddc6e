#include "collision_core/narrow_phase/separation/refinement.h"

#include <algorithm>

#include "collision_core/base/check.h"

namespace collision::narrow_phase {
namespace {

// A pair's units of a round are doubled at most this many times; longer rounds end only with the
// budget.
constexpr int kDoublingsMax = 40;

// The most units of a pair in a round before they are doubled: still an integer after
// kDoublingsMax.
constexpr double kShareMax = 0x1p+20;

// The distance of bodies that overlap is 0; so is that of a body inside the other, however far
// apart their surfaces are.
double WidthOf(const SeparationSearch& search) {
  return std::max(0.0, std::max(0.0, search.upper()) - std::max(0.0, search.lower()));
}

}  // namespace

Refinement::Entry::Entry(const PosedPair& pair, double importance, Goal goal,
                         std::optional<BracketTolerance> narrow)
    : pose(pair.pose),
      weight(importance),
      search({pair.a, pair.b, pose}, goal, narrow, SearchOrder::kNearest) {}

std::size_t Refinement::Add(const PosedPair& pair, double weight, Goal goal,
                            std::optional<BracketTolerance> narrow, WorkBudget* work) {
  CORE_CHECK(weight > 0, "the weight of a pair is positive", weight);
  Entry& entry = entries_.emplace_back(pair, weight, goal, narrow);
  WorkBudget start(1);
  entry.search.Start(&start);
  entry.spent = start.spent();
  work->Spend(start.spent());
  return entries_.size() - 1;
}

void Refinement::Refine(WorkBudget* work) {
  order_ == RefinementOrder::kLevelByLevel ? RefineByLevel(work) : RefineLargest(work);
}

void Refinement::RefineOne(Entry* entry, std::uint64_t units, WorkBudget* work) {
  WorkBudget slice(std::min(units, work->left()));
  entry->search.Refine(&slice);
  entry->spent += slice.spent();
  work->Spend(slice.spent());
}

void Refinement::StartRound() {
  next_ = 0;
  doublings_ = is_stuck_ ? std::min(doublings_ + 1, kDoublingsMax) : 0;
  is_stuck_ = true;
  for (Entry& entry : entries_) {
    entry.round_until = 0.5 * WidthOf(entry.search);
    const double share = std::max(1.0, entry.weight * static_cast<double>(kSliceUnits));
    entry.spent_before = entry.spent;
    entry.left_of_round = static_cast<std::uint64_t>(std::min(share, kShareMax)) << doublings_;
  }
}

// Where the budget ended in the midst of a round, the next one goes on with the same pair.
void Refinement::RefineByLevel(WorkBudget* work) {
  const auto is_done = [](const Entry& entry) { return entry.search.done(); };
  while (!work->exhausted()) {
    if (next_ >= entries_.size()) {
      if (std::all_of(entries_.begin(), entries_.end(), is_done)) return;
      StartRound();
    }
    Entry& entry = entries_[next_];
    const bool is_down = entry.search.done() ||
                         (entry.round_until > 0 && WidthOf(entry.search) <= entry.round_until);
    if (is_down && entry.spent > entry.spent_before) is_stuck_ = false;
    if (is_down || entry.left_of_round == 0) {
      ++next_;
      continue;
    }
    const std::uint64_t before = entry.spent;
    RefineOne(&entry, std::min(kSliceUnits, entry.left_of_round), work);
    const std::uint64_t used = entry.spent - before;
    entry.left_of_round -= std::min(entry.left_of_round, used);
  }
}

void Refinement::RefineLargest(WorkBudget* work) {
  struct Claim {
    double gain;
    std::size_t pair;
    bool operator<(const Claim& other) const {
      return gain != other.gain ? gain < other.gain : pair > other.pair;
    }
  };
  std::vector<Claim> claims;
  const auto claim = [&](std::size_t pair) {
    const Entry& entry = entries_[pair];
    if (entry.search.done()) return;
    const double width = entry.weight * WidthOf(entry.search);
    claims.push_back({width / static_cast<double>(entry.spent), pair});
    std::push_heap(claims.begin(), claims.end());
  };
  for (std::size_t pair = 0; pair < entries_.size(); ++pair) claim(pair);
  while (!claims.empty() && !work->exhausted()) {
    std::pop_heap(claims.begin(), claims.end());
    const std::size_t pair = claims.back().pair;
    claims.pop_back();
    RefineOne(&entries_[pair], kSliceUnits, work);
    claim(pair);
  }
}

RefinedPair Refinement::At(std::size_t pair) const {
  CORE_CHECK(pair < entries_.size(), "a pair has been added", pair, entries_.size());
  const Entry& entry = entries_[pair];
  return {entry.search.lower(), entry.search.upper(), entry.spent, entry.search.done()};
}

SeparationBracket Refinement::Result(std::size_t pair) {
  CORE_CHECK(pair < entries_.size(), "a pair has been added", pair, entries_.size());
  return entries_[pair].search.Result();
}

std::vector<std::size_t> Refinement::Coarse() const {
  std::vector<std::size_t> coarse;
  for (std::size_t pair = 0; pair < entries_.size(); ++pair) {
    if (!entries_[pair].search.done()) coarse.push_back(pair);
  }
  return coarse;
}

double Refinement::TotalWidth() const {
  double total = 0;
  for (const Entry& entry : entries_) total += entry.weight * WidthOf(entry.search);
  return total;
}

}  // namespace collision::narrow_phase
