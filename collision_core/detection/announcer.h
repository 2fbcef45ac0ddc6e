// When a pair's news is worth an event, and what it says.
#pragma once

#include <vector>

#include "collision_core/detection/agent_record.h"
#include "collision_core/detection/pair_table.h"

namespace collision::detection {

/// Turns what is known of a pair into revisions of events: possible before confirmed, confirmed
/// before ended, each status once, and further revisions only where a bracket moved enough to
/// matter.
class Announcer {
 public:
  Announcer(const DetectorOptions& options, DetectorCounters* counters)
      : options_(options), counters_(counters) {}

  /// The events of this step begin.
  void Start(Instant now);
  const std::vector<CollisionEvent>& events() const { return events_; }

  /// `preview` is the pair's tracker, run ahead of what is settled. Returns false when the pair is
  /// far apart again and needs no more tracking. `work_allowed`: in the pair's turn; an eighth of it
  /// comes on top for a contact that is told. `last`: one of the two leaves; what was is told, but
  /// nothing new is announced.
  bool Report(const AgentRecord& lower, const AgentRecord& higher, std::uint32_t slot,
              const ContactTracker& preview, std::uint64_t work_allowed, bool last,
              PairTable* pairs);

  /// Nobody watches the two any more: withdrawn, or ended if the contact was confirmed; by now if one of them
  /// is `gone`, else (expired, masked) nobody knows when.
  void Leave(const AgentRecord& lower, const AgentRecord& higher, std::uint32_t slot, bool gone,
             PairTable* pairs);

 private:
  struct Subject;  // the pair and its two agents

  void Finish(const Subject& subject, const ContactEpisode& episode);
  void Possible(const Subject& subject, const ContactTracker& preview);
  void Confirm(const Subject& subject, const ContactEpisode& episode);
  void Open(const Subject& subject, Instant free_until, bool began_before);
  void Emit(const Subject& subject, EventStatus status);
  void Evaluate(const Subject& subject, const Nearest& at,
                const narrow_phase::ContactNormal& normal);

  DetectorOptions options_;
  DetectorCounters* counters_;
  Instant now_;
  std::vector<CollisionEvent> events_;
};

}  // namespace collision::detection
