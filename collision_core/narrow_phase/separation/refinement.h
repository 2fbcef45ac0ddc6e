// Many pairs of bodies share one budget: the order in which their brackets are refined.
//
// Two orders. Level by level, as in Hubbard's paper: every pair in turn until its bracket is half
// as wide. Largest first: the pair that adds most to the total width for the work it has had. For
// thirty pairs of spiky surfaces, down to 1e-6, the second has the smaller total width at half of
// the budgets or more; the first leaves no pair behind. A pair that can never be decided takes no
// more than its share, in either order (refinement_test).
#pragma once

#include <deque>
#include <vector>

#include "collision_core/narrow_phase/separation/separation_search.h"

namespace collision::narrow_phase {

/// Which pair is refined next.
enum class RefinementOrder : std::uint8_t {
  kLevelByLevel,  ///< As in Hubbard's paper: all pairs in turn, each until its bracket is half as
                  ///< wide, which is a level of the reference tree; then all of them once more.
  kLargestFirst   ///< The pair that adds the most to the total width for the work it has had.
};

/// The state of one pair.
struct RefinedPair {
  double lower, upper;  ///< [m]
  std::uint64_t spent;  ///< Units.
  bool done;  ///< The goal is reached, or cannot be; else it was left coarse: the budget ended.
};

/// Searches that share a budget. Each pair has a weight, its importance: at the same width, it gets
/// work in proportion to its weight. No pair starves: level by level it has at most weight ·
/// kSliceUnits units in a round, twice as many after a round in which no pair came down a level;
/// largest first it counts with weight · width / units spent, which falls with each slice of work
/// that it gets. Deterministic: of equals the first pair added comes first.
///
/// Refine() may overrun the budget by less than kBatchUnits. It may be called again and again: each
/// bracket only becomes narrower, and with all the work it asks for it is that of a search alone,
/// bit for bit.
///
/// A library call: the service gives each pair a budget of its own (detection/pairs/step_budget.h),
/// and this class is kept for callers that refine several pairs at one instant, as in Hubbard's
/// time-critical loop. Callers: `./run bench narrow-phase` (tests/bench/narrow_phase/refinement.cc,
/// tests/bench/pairs/ours.cc) and tests.
class Refinement {
 public:
  /// Units of work that a pair gets at a time.
  static constexpr std::uint64_t kSliceUnits = 64;

  explicit Refinement(RefinementOrder order) : order_(order) {}

  /// The surfaces outlive this. Costs one unit and gives a first bracket, whatever the budget.
  /// Requires weight > 0. Returns the pair's number: 0, 1, 2...
  std::size_t Add(const PosedPair& pair, double weight, Goal goal,
                  std::optional<BracketTolerance> narrow, WorkBudget* work);

  /// Refines until all pairs are done or the budget is spent.
  void Refine(WorkBudget* work);

  std::size_t size() const { return entries_.size(); }
  /// Requires pair < size(), as Result() does.
  RefinedPair At(std::size_t pair) const;
  /// Pairs that are not done, in order.
  std::vector<std::size_t> Coarse() const;
  /// Σ weight · width over all pairs [m].
  double TotalWidth() const;
  /// The whole answer of a pair, once.
  SeparationBracket Result(std::size_t pair);

 private:
  struct Entry {
    Entry(const PosedPair& pair, double importance, Goal goal,
          std::optional<BracketTolerance> narrow);

    RelativePose pose;
    double weight;
    SeparationSearch search;
    std::uint64_t spent = 0;
    std::uint64_t left_of_round = 0;
    std::uint64_t spent_before = 0;  ///< Before this round.
    double round_until = 0;          ///< At this width its part of the round is done.
  };

  void RefineByLevel(WorkBudget* work);
  void RefineLargest(WorkBudget* work);
  void StartRound();
  void RefineOne(Entry* entry, std::uint64_t units, WorkBudget* work);

  const RefinementOrder order_;
  std::deque<Entry> entries_;  // searches do not move
  std::size_t next_ = 0;       // of the round
  bool is_stuck_ = false;      // no pair came down a level
  int doublings_ = 0;
};

}  // namespace collision::narrow_phase
