// The detector of what hypothetical agents would meet.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <vector>

#include "collision_core/detection/detector.h"

namespace collision::server {

/// Screens hypothetical agents against real ones: it has the agents of both kinds, and of their
/// pairs only those of one real and one hypothetical agent. The broad phase drops all others by
/// their sides (CollisionFilter) before it compares any bounds.
///
/// It begins with the real agents as another detector holds them, their newest states; of what was
/// before it knows nothing. From then on each call is made to both. One thread.
class ScreeningDetector {
 public:
  /// Takes over the real agents from `contacts`. O(agents).
  ScreeningDetector(const detection::DetectorOptions& options, const detection::Detector& contacts);

  /// An agent of either kind.
  bool Admit(const detection::AgentId& id, const detection::AgentDeclaration& declaration,
             const motion::MotionState& state, Instant effective_from);
  bool Redeclare(const detection::AgentId& id, const detection::AgentDeclaration& declaration,
                 Instant effective_from);
  bool Remove(const detection::AgentId& id);

  /// Whether this is a hypothetical agent that has not been removed.
  bool IsHypothetical(const detection::AgentId& id) const { return hypothetical_.contains(id); }
  std::size_t hypothetical() const { return hypothetical_.size(); }  ///< Their number.

  /// As Detector::Advance().
  void Advance(Instant now, const std::function<void()>& progress);

  /// No hypothetical agent is left, and the last Advance() has told the end of what there was.
  bool is_over() const { return is_over_; }

  /// As Detector::TakeChangedClearances(), of the hypothetical agents: what a real one may do does
  /// not depend on them.
  std::vector<detection::AgentClearance> TakeChangedClearances();

  /// For what changes no declaration.
  detection::Detector& detector() { return detector_; }
  const detection::Detector& detector() const { return detector_; }

 private:
  detection::Detector detector_;
  std::set<detection::AgentId> hypothetical_;
  bool is_over_ = false;
};

}  // namespace collision::server
