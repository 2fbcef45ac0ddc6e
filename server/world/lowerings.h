// What lowered clearances, until those it concerns have taken it in.
#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "collision_core/detection/clearance/keys/agent_clearance.h"
#include "idl/limits.h"

namespace collision::server {

/// What a simulator must be told of the clearance of one agent.
struct Lowering {
  std::uint32_t count = 0;  ///< How often it was lowered since the agent was admitted.
  /// The newest cause; one that voids promises stands before others.
  detection::ClearanceCause cause = detection::ClearanceCause::kNone;
  detection::AgentId cause_agent{};
  Instant void_from = Instant::Never();  ///< The earliest that has not been taken in.
};

/// The lowerings of the agents of one simulator. The detector tells a lowering once, and a sample
/// may be overwritten before it is read, so a cause stands in every sample until the simulator has
/// acknowledged one that carried it: its acknowledgement is at least the sequence of the newest
/// sample of that chunk. Samples of one writer arrive in their order, so it then has that one, or
/// none of it was needed any more. One thread.
class Lowerings {
 public:
  /// What the detector newly says of the agent in `slot`.
  void Take(std::uint32_t slot, const detection::AgentClearance& clearance);

  /// The agent in `slot` is gone.
  void Forget(std::uint32_t slot) { by_slot_.erase(slot); }

  /// The sample of this chunk was published under this sequence.
  void Publish(std::uint32_t chunk, std::uint64_t sequence);

  /// The simulator has taken in all samples up to this sequence.
  void Acknowledge(std::uint64_t sequence);

  /// What stands now.
  Lowering Of(std::uint32_t slot) const;

  /// The sequence of the newest sample, and the newest acknowledged; 0: none.
  std::uint64_t published() const { return newest_published_; }
  std::uint64_t acknowledged() const { return acknowledged_; }

  /// A new run or another epoch: nothing stands.
  void Clear() { *this = {}; }

 private:
  std::map<std::uint32_t, Lowering> by_slot_;
  /// Sequence of the newest sample by chunk; none while it does not say what stands.
  std::map<std::uint32_t, std::uint64_t> published_;
  std::set<std::uint32_t> standing_;  ///< Slots with a cause.
  std::uint64_t newest_published_ = 0;
  std::uint64_t acknowledged_ = 0;
};

}  // namespace collision::server
