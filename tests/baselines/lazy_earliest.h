// The earliest meeting of all, kept current by asking again only where it must.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "collision_core/base/event_queue.h"

namespace collision::baselines {

/// The first meeting of one agent.
struct AgentMeeting {
  std::uint32_t partner = 0;
  Instant when;
};

/// Finds one agent's first meeting among the newest bounds.
class AgentAsker {
 public:
  virtual ~AgentAsker() = default;
  /// At or after `from`, by `until`; nullopt: none.
  virtual std::optional<AgentMeeting> Ask(std::uint32_t agent, Instant from, Instant until) = 0;
};

/// A queue of agents by their first meeting within the horizon. A new bound lies inside the old
/// one, so what stands in the queue is never too late; only when the first entry was asked before
/// one of its two agents was renewed is that agent asked again. Ours and Bullet's tree are asked
/// through the same class.
class LazyEarliest {
 public:
  LazyEarliest(std::size_t agents, double horizon, AgentAsker* asker)
      : horizon_(horizon), entries_(agents), renewed_(agents), asker_(asker) {}

  /// Asks `agent`, now.
  void Ask(std::uint32_t agent, Instant now);
  /// The agent's bound was replaced by one inside it.
  void Renewed(std::uint32_t agent) { ++renewed_[agent]; }

  struct Found {
    std::uint32_t agent, partner;
    Instant when;
  };
  /// The earliest of all within the horizon as the newest bounds have it; nullopt: none. All agents
  /// have been asked, and `now` never goes back.
  std::optional<Found> Earliest(Instant now);

  /// Times that an agent was asked since the start.
  std::uint64_t asked() const { return asked_; }

 private:
  struct Entry {
    std::uint32_t partner = 0;                       ///< The agent itself: none within the horizon.
    std::uint32_t renewed = 0, partner_renewed = 0;  ///< When it was asked.
  };

  double horizon_;
  EventQueue<AgentIndex> queue_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> renewed_;  ///< By agent: how often.
  AgentAsker* asker_;
  std::uint64_t asked_ = 0;
};

}  // namespace collision::baselines
