// Chooses the broad phase that suits the scene, by counted work.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/broad_phase/broad_phase_method.h"
#include "collision_core/broad_phase/filter/horn_table.h"
#include "collision_core/broad_phase/sweeping_index.h"

namespace collision::broad_phase {

/// One method, or the cheaper of all pairs and the spatial index for the scene as it is now. Work
/// is counted, never timed, so that the same calls choose the same everywhere; and as all methods
/// give the same answers, only the cost depends on the choice.
///
/// The units of work are in the ratio of what the pieces cost: a filter's test 1, a place examined
/// 16, a pair query 256, an agent placed anew in the index 64 (BroadPhaseWork). All pairs answer up
/// to kFewAgents agents, the index beyond; the index gives way at half that number. Up to ¾
/// kManyAgents agents, every kPeriodQueries queries about one agent, the work of the index is
/// compared with what all pairs would have done, computed from the index's own counts (the same
/// pair queries and neighbours, N tests per search), or with the measured cost of all pairs just
/// before the index took over, if that is less. The excess accumulates; above kExcessUnits per
/// agent all pairs take over. A lower threshold would react to start-up cost and to the ordinary
/// ageing of a placement. The index is then tried again after a number of queries that doubles each
/// time, or with half as many agents more, or with kManyAgents.
///
/// A new method receives kMoves agents per call, while the old one answers, until it holds all of
/// them. This spreads the transfer over many calls; the first query of a new index still places
/// every agent.
///
/// The service calls the queries of NeighbourIndex only. The one-shot queries are forwarded so that
/// tests and benchmarks measure the method that the service runs, the choice between methods
/// included (callers: sweeping_index.h).
class AdaptiveBroadPhase : public SweepingIndex {
 public:
  static constexpr std::size_t kFewAgents = 128;
  static constexpr std::size_t kManyAgents = 768;
  static constexpr std::uint64_t kPeriodQueries = 256;
  static constexpr double kExcessUnits = 480;  ///< 7½ placements of all; fitted to scenes.
  static constexpr std::uint32_t kMoves = 8;

  explicit AdaptiveBroadPhase(BroadPhaseMethod requested = BroadPhaseMethod::kAuto,
                              SharedRules rules = NoRules());
  ~AdaptiveBroadPhase() override;

  void Set(std::uint32_t agent, const AgentBound& bound) override;
  void Tighten(std::uint32_t agent, const AgentBound& bound) override;
  void Remove(std::uint32_t agent) override;
  bool SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) override;
  void UpdateRules(std::uint32_t agent) override;
  void FindNeighbours(std::uint32_t agent, const NeighbourWindow& window, const Skip& skip,
                      std::vector<Neighbour>* neighbours) override;
  void FindNeighbours(const AgentBound& bound, Instant from, Instant until, const Skip& skip,
                      std::vector<Neighbour>* neighbours) override;
  std::optional<intersection::IntersectingPair> EarliestOf(
      std::uint32_t agent, const intersection::BroadQuery& query) override;
  void FindNearPairs(const intersection::BroadQuery& query, std::vector<NearPair>* pairs) override;
  std::optional<intersection::IntersectingPair> Earliest(
      const intersection::BroadQuery& query) override;

  bool Contains(std::uint32_t agent) const override { return agent < held_.size() && held_[agent]; }
  /// Agents that are held.
  std::size_t agents() const { return agents_; }
  /// Walks both methods: the one that answers holds exactly the agents that are held, the one that
  /// is being filled those below its mark; both have the same half-spaces.
  void Validate() const override;

  /// The work of all methods together.
  BroadPhaseWork work() const override;
  /// The same in the units by which it chooses.
  double units() const;

  /// Which method answers now, and why, in one sentence with the counts.
  BroadPhaseMethod method() const { return method_.kind; }
  std::string why() const;
  std::uint64_t changes() const { return changes_; }

 private:
  struct Method {
    BroadPhaseMethod kind = BroadPhaseMethod::kAuto;
    std::unique_ptr<SweepingIndex> phase;
    const HornTable* table = nullptr;  ///< Its bounds; null for the exhaustive index.
  };

  /// All methods share the rules; half-spaces are its own as well as each method's.
  Method Make(BroadPhaseMethod kind) const;
  void ValidateMethod(const Method& method) const;
  void Release(std::uint32_t agent);
  double Units(BroadPhaseMethod kind, const BroadPhaseWork& done) const;
  double UnitsByAllPairs(const BroadPhaseWork& done) const;
  double UnitsOf(const Method& method) const;
  bool Follows(std::uint32_t agent) const { return next_.phase && agent < filled_; }
  void Start(BroadPhaseMethod kind);
  void Drop();
  void Switch();
  void Fill();
  void Choose();
  void ChooseFromAllPairs();
  void ChooseFromIndex();
  void EndQuery(const BroadPhaseWork& before);
  void ResetCounts();

  const BroadPhaseMethod requested_;
  Method method_;
  Method next_;               ///< Being filled; none if its phase is null.
  std::uint32_t filled_ = 0;  ///< Agents below this index are in next_ as well.
  std::size_t agents_ = 0;    ///< Held.
  std::vector<bool> held_;    ///< By agent.
  BroadPhaseWork before_{};   ///< The work of methods that were replaced.
  double units_before_ = 0;   ///< Likewise.

  std::uint64_t queries_ = 0;     ///< Queries of one agent since the last decision.
  BroadPhaseWork answering_{};    ///< Work on them.
  std::uint64_t patience_ = 0;    ///< Queries until the index is tried again.
  std::size_t decided_with_ = 0;  ///< Agents at the last decision.
  double units_before_try_ =
      numeric::kInfinity;      ///< Cost of a query by all pairs before the index's try.
  double excess_ = 0;          ///< Excess of the index over all pairs since it answers [units].
  double units_ = 0;           ///< Cost of a query at the last decision.
  double units_of_other_ = 0;  ///< The same of the other method.
  std::uint64_t changes_ = 0;
};

}  // namespace collision::broad_phase
