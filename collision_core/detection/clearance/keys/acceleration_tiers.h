// Which partners accelerate so much harder than an agent that they are queried separately.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/base/ids.h"

namespace collision::detection {

/// Agents by tiers of their declared acceleration bounds, each tier 8 times the one before.
///
/// A partner whose bound is much larger than an agent's comes within reach of it over and over.
/// With one query for all partners, one such partner would make the agent query all others as
/// often. So the partners of an agent form bands: each tier at least two above the agent's
/// (always at 64 times its bound, never at 8 times) is a band of its own; all others are the band
/// kComparable. For an agent that declares no acceleration every tier above 0 is a band of its
/// own, unless more than kUnacceleratedMax agents declare none: each query would then look at all
/// the others, which hardly move, to the end of time.
///
/// Apart from that limit, the band of a partner of an agent depends on the two alone: agents
/// of comparable bounds are queried for each other at the same times, and get the same bits,
/// whether or not a faster one is in the scene. All operations are O(1) or O(kTiers).
class AccelerationTiers {
 public:
  static constexpr int kTiers = 44;
  /// The band of all partners of an agent that have none of their own.
  static constexpr int kComparable = 0;
  /// A tier that no agent is ever in.
  static constexpr int kAbsent = kTiers;
  static constexpr std::uint32_t kUnacceleratedMax = 256;

  /// The agent's declared bound [m/s²] from now on; what is not above 0 counts as 0.
  void Set(AgentIndex agent, double acceleration_max) { Put(agent, TierFor(acceleration_max)); }
  void Remove(AgentIndex agent) { Put(agent, kAbsent); }

  /// 0: the agent declares no acceleration; kAbsent: it is not there. Requires an agent that was
  /// set at some time.
  int TierOf(AgentIndex agent) const { return tiers_.at(agent); }

  /// Whether any tier may be a band of its own for the agent. Here and below: requires agents
  /// that were set at some time.
  bool HasOwnBands(AgentIndex agent) const {
    return TierOf(agent) > 0 || counts_[0] <= kUnacceleratedMax;
  }
  /// The partner's tier if that is a band of its own for the agent; otherwise kComparable.
  int BandOf(AgentIndex partner, AgentIndex agent) const {
    const int tier = TierOf(partner);
    return IsOwnBand(tier, agent) ? tier : kComparable;
  }

  /// Agents in a tier. Requires a tier from 0 to kAbsent.
  std::uint32_t Count(int tier) const {
    CORE_CHECK(tier >= 0 && tier <= kAbsent, "a tier is one of the tiers", tier);
    return counts_[static_cast<std::size_t>(tier)];
  }

  /// Appends the tiers that are not empty and are bands of their own for the agent, ascending.
  void OwnBandsOf(AgentIndex agent, std::vector<int>* tiers) const {
    for (int tier = 1; tier < kTiers; ++tier) {
      if (Count(tier) > 0 && IsOwnBand(tier, agent)) tiers->push_back(tier);
    }
  }

  /// Walks all agents: each tier's count is right.
  void Validate() const {
    std::array<std::uint32_t, kTiers + 1> counts{};
    for (const std::uint8_t tier : tiers_) {
      CORE_CHECK(tier <= kAbsent, "a tier is one of the tiers", tier);
      if (tier != kAbsent) ++counts[tier];
    }
    CORE_CHECK(counts == counts_, "the agents of each tier are counted");
  }

 private:
  bool IsOwnBand(int tier, AgentIndex agent) const {
    const int own = TierOf(agent), least = own + (own > 0 ? 2 : 1);
    return tier != kAbsent && tier >= least && HasOwnBands(agent);
  }

  static int TierFor(double acceleration_max) {
    constexpr int kLeast = -64, kGreatest = 63, kExponents = 3;
    if (!(acceleration_max > 0)) return 0;
    return 1 + (std::clamp(std::ilogb(acceleration_max), kLeast, kGreatest) - kLeast) / kExponents;
  }

  void Put(AgentIndex agent, int tier) {
    if (!tiers_.contains(agent)) tiers_.resize(agent.value() + 1, kAbsent);
    if (tiers_[agent] != kAbsent) --counts_[tiers_[agent]];
    if (tier != kAbsent) ++counts_[static_cast<std::size_t>(tier)];
    tiers_[agent] = static_cast<std::uint8_t>(tier);
  }

  std::array<std::uint32_t, kTiers + 1> counts_{};
  IndexedVector<AgentIndex, std::uint8_t> tiers_;
};

}  // namespace collision::detection
