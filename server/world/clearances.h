// The clearances of the agents of one simulator, and which of them must be published again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "collision_core/base/event_queue.h"
#include "collision_core/detection/detector.h"
#include "idl/limits.h"
#include "server/world/lowerings.h"

namespace collision::server {

/// Slots per clearance sample. Chunk c holds the slots [64 c, 64 c + 63]; chunk 0 always exists,
/// since it carries the grant.
inline constexpr std::uint32_t kSlotsPerChunk = wire::kStatesPerChunkMax;

/// Longer than an acknowledgement takes on any network on which a simulator keeps up.
inline constexpr std::int64_t kRepeatAfterNs = 1'000'000'000;

/// The clearances of one simulator as the detector last gave them, and the chunks whose samples are
/// out of date.
///
/// Where a clearance only rises its sample may wait: readers then know less, and nothing wrong.
///
/// A sample is a function of the clearances here, of the agents' acknowledged states and revisions
/// (AgentTable) and of the grant (SimulatorTime). Each change of one of them marks its chunk, and
/// the publisher takes the marks: it publishes a chunk whole, so that a lost sample costs nothing
/// but age. One thread.
class Clearances {
 public:
  /// The sample that holds `slot` is out of date.
  void MarkChanged(std::uint32_t slot) { changed_.insert(slot / kSlotsPerChunk); }

  /// The grant, which stands in chunk 0, is out of date.
  void MarkGrantChanged() { changed_.insert(0); }

  /// All samples are out of date.
  void MarkAllChanged();

  /// Replaces the clearance of the agent in `slot`, and marks its chunk, which may wait if the
  /// clearance only rises. That of a `hypothetical` agent holds no time: clear_until() is that of
  /// the others.
  void Set(std::uint32_t slot, const detection::AgentClearance& clearance, bool hypothetical);

  /// Likewise until when the agent crosses no level of this index. It is not published: only when
  /// a state of the agent is wanted depends on it.
  void SetOfLevel(std::uint32_t slot, std::size_t level,
                  const detection::AgentClearance& clearance);

  /// Null: there is none.
  const detection::AgentClearance* OfLevel(std::uint32_t slot, std::size_t level) const;

  /// The agent in `slot` is gone, with its clearance; marks its chunk.
  void Forget(std::uint32_t slot);

  /// The sample of this chunk was published under this sequence, at this monotonic time.
  void Publish(std::uint32_t chunk, std::uint64_t sequence, std::int64_t now_ns);

  /// A clock of the simulator says that it has taken in all samples up to this sequence. If some
  /// wait for that, none was taken in for kRepeatAfterNs, and the world is `contended`, all are
  /// marked: beside those of another service, which are of the same keys, they may have been
  /// overwritten unread. Without another one that cannot be, and a sample that is written again
  /// while its first copy is lost on the way would come after the grant that was to follow it.
  void Acknowledge(std::uint64_t sequence, std::int64_t now_ns, bool contended);

  /// What lowered them and has not been acknowledged.
  const Lowerings& lowerings() const { return lowerings_; }
  /// A new run or another epoch, or another service has told them.
  void ForgetLowerings() { lowerings_.Clear(); }

  /// By slot.
  const std::map<std::uint32_t, detection::AgentClearance>& all() const { return clearances_; }

  /// Until when all of its real agents are clear: Never() if there is none, Always() while one is
  /// in contact, because a contact may end at any time. O(1).
  Instant clear_until() const { return ends_.empty() ? Instant::Never() : ends_.top_key(); }

  /// Walks everything: each clearance has its place in the queue.
  void Validate() const;

  /// The chunks that are marked, in ascending order. Of those that may wait the ones that have
  /// waited for `wait_ns` of monotonic time, counted from the first call after they were marked, or
  /// have an agent of which readers know only that it is clear up to `soon`.
  [[nodiscard]] std::set<std::uint32_t> TakeChanged(std::int64_t now_ns, std::int64_t wait_ns,
                                                    Instant soon);

 private:
  using SlotIndex = Index<struct SlotTag>;

  struct Risen {
    std::optional<std::int64_t> since_ns;    ///< nullopt: since the last TakeChanged().
    Instant known_until = Instant::Never();  ///< To readers, that one of its agents is clear.
  };

  static Instant EndOf(const detection::AgentClearance& clearance) {
    return clearance.in_contact ? Instant::Always() : clearance.clear_until;
  }

  std::map<std::uint32_t, detection::AgentClearance> clearances_;
  /// By slot and level.
  std::map<std::pair<std::uint32_t, std::size_t>, detection::AgentClearance> of_levels_;
  EventQueue<SlotIndex> ends_;  // EndOf() of the clearance of each real agent
  std::set<std::uint32_t> changed_;
  std::map<std::uint32_t, Risen> risen_;  ///< The chunks that may wait.
  Lowerings lowerings_;
  std::int64_t waiting_since_ns_ = 0;  ///< While samples are not acknowledged.
};

}  // namespace collision::server
