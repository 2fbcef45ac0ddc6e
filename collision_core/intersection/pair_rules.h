// Rules of single pairs: some never meet, others keep a distance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "collision_core/numeric/rounding.h"

namespace collision::intersection {

/// A rule of two agents: they never meet (`excluded`), or they count as meeting where they come
/// within `margin` of each other.
struct PairRule {
  bool excluded = false;
  double margin = 0;  ///< [m], >= 0.

  friend bool operator==(const PairRule&, const PairRule&) = default;
};

/// Half of the margin, rounded up; exact except among the denormals.
inline double HalfUp(double margin) {
  const double half = 0.5 * margin;
  return 2 * half == margin ? half : numeric::NextUp(half);
}

/// The rules of all pairs that have one, by the agents' indices, in either order. An agent may have
/// rules before it exists. Memory: 48 bytes a rule and some 100 an agent that has any.
///
/// A margin m of a pair is one more exact term in addition to both radii: in the quick routine, the
/// intervals, capped balls and boxes alike, so the pair meets where it comes within m, certified as
/// before. Filters know no pairs, so an agent's reach is grown by half of its greatest margin,
/// which covers every pair of two agents. A greater margin places the agent anew; a smaller one
/// leaves the placement valid. An excluded pair is dropped after the filters, before the canonical
/// routine. Rules are looked up only for agents that have any; without rules no answer and no count
/// differs.
class PairRules {
 public:
  /// The most rules in all, and of one agent; Set() refuses more. An agent that is to ignore more
  /// partners uses its mask. The second limit bounds what one change costs.
  static constexpr std::size_t kRulesMax = std::size_t{1} << 20;
  static constexpr std::size_t kRulesOfAgentMax = 4096;

  /// Replaces the pair's rule; PairRule() takes it away. Returns false, and changes nothing, for an
  /// agent with itself, for a margin that is negative, infinite or not a number, or if there is no
  /// more room.
  bool Set(std::uint32_t a, std::uint32_t b, PairRule rule);

  /// Removes all rules of the agent; returns the agents that had one with it, ascending.
  std::vector<std::uint32_t> Forget(std::uint32_t agent);

  /// PairRule() where there is none.
  PairRule Of(std::uint32_t a, std::uint32_t b) const;

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  bool HasAny(std::uint32_t agent) const { return !empty() && of_.count(agent) != 0; }
  /// Half of the agent's greatest margin, rounded up: if every agent's reach is grown by its own,
  /// those of each two are together grown by their margin or more.
  double HalfMargin(std::uint32_t agent) const;

 private:
  struct Entry {
    std::uint32_t partner;
    PairRule rule;
  };
  struct Rules {
    std::vector<Entry> entries;  ///< Ascending by partner.
    double margin_max = 0;

    void Update();
  };

  bool HasRoom(std::uint32_t agent) const;
  void Put(std::uint32_t agent, std::uint32_t partner, PairRule rule);
  void Drop(std::uint32_t agent, std::uint32_t partner);

  std::unordered_map<std::uint32_t, Rules> of_;  ///< By agent, each rule twice. Never iterated.
  std::size_t size_ = 0;
};

}  // namespace collision::intersection
