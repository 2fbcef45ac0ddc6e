// The earliest intersection found so far, and the pairs that can still improve it.
#pragma once

#include <optional>

#include "collision_core/broad_phase/broad_phase_work.h"
#include "collision_core/broad_phase/filter/horn_table.h"
#include "collision_core/broad_phase/filter/pair_sink.h"
#include "collision_core/broad_phase/half_space.h"

namespace collision::broad_phase {

/// Takes pairs in any order, asks the canonical routine only about those that a filter does not
/// rule out, and keeps the earliest intersection. The answer does not depend on the order.
class EarliestPairSink final : public PairSink {
 public:
  EarliestPairSink(const HornTable& table, const intersection::BroadQuery& query,
                   BroadPhaseWork* work);

  /// Offers a pair. Intersections later than the best do not count: the limit shrinks.
  void Offer(std::uint32_t a, std::uint32_t b) override;

  /// Offers a half-space and an agent.
  void OfferHalfSpace(const HalfSpaces::Entry& entry, std::uint32_t agent);

  const std::optional<intersection::IntersectingPair>& best() const { return best_; }

 private:
  bool Betters(std::uint32_t lower, std::uint32_t higher) const;
  void Take(const intersection::IntersectingPair& pair);
  intersection::BroadQuery Narrowed(std::uint32_t lower, std::uint32_t higher) const;
  void Limit(Instant until);

  const HornTable& table_;
  intersection::BroadQuery query_;
  BroadPhaseWork* work_;
  std::optional<intersection::IntersectingPair> best_;
  Instant when_ = Instant::Never();  ///< The instant of best_.
};

/// The time from `from` until `seconds` later.
struct Within {
  Instant from;
  double seconds;
};

/// False if the filters rule out that the two meet within the time. Counts the test and, if true,
/// also the pair query that the caller then makes.
bool MayMeet(const HornTable& table, std::uint32_t a, std::uint32_t b, const Within& within,
             BroadPhaseWork* work);
bool MayMeet(const HornTable& table, const HalfSpaces::Entry& entry, std::uint32_t agent,
             const Within& within, BroadPhaseWork* work);
/// A bound that is in no table and has no rules, with its row. Unchecked: it outlives this.
struct Guest {
  explicit Guest(const AgentBound& of) : filter(of.filter), row(HornTable::RowOf(of)) {}

  const CollisionFilter& filter;
  const HornRow row;
};
/// The same for a guest and an agent of the table.
bool MayMeet(const Guest& guest, const HornTable& table, std::uint32_t agent, const Within& within,
             BroadPhaseWork* work);

/// The canonical time of two agents of the table, with their margin. Requires that they are not
/// excluded.
intersection::IntersectionTime EarliestIntersectionOf(const intersection::BroadQuery& query,
                                                      const HornTable& table, std::uint32_t a,
                                                      std::uint32_t b);
/// The same for a half-space and an agent of the table. Requires likewise.
intersection::IntersectionTime EarliestIntersectionOf(const intersection::BroadQuery& query,
                                                      const HalfSpaces::Entry& entry,
                                                      const HornTable& table, std::uint32_t agent);

}  // namespace collision::broad_phase
