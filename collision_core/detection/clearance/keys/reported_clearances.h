// The clearances that are published: when they change, and why.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/detection/clearance/keys/agent_clearance.h"
#include "collision_core/detection/clearance/keys/coverage_table.h"
#include "collision_core/detection/pairs/tracked_pairs.h"

namespace collision::detection {

/// Derives each agent's clearance from its keys and its tracked pairs, and remembers the last one
/// published. If several causes lower a clearance in one step, the breach that voids promises from
/// the earliest time is reported, whatever comes after it: no other message names the agent that
/// broke its bound.
class ReportedClearances {
 public:
  /// All outlive the object.
  ReportedClearances(const DetectorContext& context, const TrackedPairs& pairs,
                     const CoverageTable& coverage)
      : context_(context), pairs_(pairs), coverage_(coverage) {}

  /// The agent of this index is new: nothing has been published.
  void AddAgent(AgentIndex agent);

  /// The agent's own promises count from `effective_from`, the latest of several.
  void SetEffectiveFrom(AgentIndex agent, Instant effective_from);
  /// The agent broke its bound: promises are void from `from` on.
  void RecordBreach(AgentIndex agent, Instant from);
  /// Promises to the agent are void from `from` on, because of the clock that `culprit` goes by.
  void RecordVoid(AgentIndex agent, AgentIndex culprit, Instant from);
  /// The agent's own renewal is the cause, unless that was a breach, which RecordBreach() records.
  void RecordRenewal(AgentIndex agent);
  /// The agent's clearance may be lowered because of the renewal of `cause`.
  void NotifyPartner(AgentIndex agent, AgentIndex cause);

  /// Clearances that differ from those published last, or whose promises are void, in the order of
  /// ids.
  std::vector<AgentClearance> TakeChanged();
  /// As of the last step. Requires an agent of the table.
  AgentClearance Of(AgentIndex agent) const;

 private:
  struct Report {
    std::optional<AgentClearance> last;
    ClearanceCause cause = ClearanceCause::kNone;  // since then
    AgentId cause_agent;
    Instant void_from = Instant::Never();
    Instant effective_from = Instant::Always();
  };

  void RecordCause(const AgentClearance& cause, Report* report) const;
  std::optional<AgentClearance> TakeChange(AgentIndex agent);

  const DetectorContext context_;
  const TrackedPairs& pairs_;
  const CoverageTable& coverage_;
  IndexedVector<AgentIndex, Report> reports_;
};

}  // namespace collision::detection
