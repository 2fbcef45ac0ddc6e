// Changed descriptions that do not count yet.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "collision_core/detection/events/agent_id.h"

namespace collision::server {

/// A revision of the description of an agent, which may widen what it can do.
struct Widening {
  detection::AgentId agent;
  std::uint32_t revision = 0;

  friend bool operator==(const Widening&, const Widening&) = default;
};

/// What a simulator that relies on clearances has been told and has taken in: sample sequences.
struct Informed {
  std::uint64_t simulator = 0;
  std::uint64_t published = 0;
  std::uint64_t acknowledged = 0;
};

/// Wall clock: nobody is held back by grants, so clearances that were given before an agent's
/// declaration grew must first be withdrawn. The revision counts, and its owner is told so, when
/// each other simulator has acknowledged the clearances as they were published with the revision
/// in force, or when the promises that it had before have expired: a client that hears nothing
/// relies on them no longer than the service's lease, by a clock that may be off by the skew.
///
/// Of an agent that is described anew all the time the oldest revision and the newest wait, so that
/// some count while others follow. One thread.
class Widenings {
 public:
  /// `expiry_ns`: after so long no promise stands that was given before.
  explicit Widenings(std::int64_t expiry_ns) : expiry_ns_(expiry_ns) {}

  /// The detector has this revision from this step on.
  void Add(const Widening& widening);

  /// After the clearances of a step were published: the revisions that count now. `others`: every
  /// simulator that has a clearance. `now_ns`: monotonic.
  [[nodiscard]] std::vector<Widening> Take(const std::vector<Informed>& others,
                                           std::int64_t now_ns);

  /// When Take() has something to say without any acknowledgement; nullopt: nothing waits.
  std::optional<std::int64_t> NextDue() const;

  bool empty() const { return waiting_.empty(); }

  /// Another epoch: no promise stands.
  void Clear() { waiting_.clear(); }

 private:
  struct Waiting {
    std::uint32_t revision = 0;
    bool is_published = false;
    /// By simulator: the sample that it must have taken in.
    std::map<std::uint64_t, std::uint64_t> awaited = {};
    std::int64_t until_ns = 0;
  };

  void Publish(std::uint64_t owner, const std::vector<Informed>& others, std::int64_t now_ns,
               Waiting* waiting) const;
  static bool IsOver(const std::vector<Informed>& others, std::int64_t now_ns, Waiting* waiting);

  const std::int64_t expiry_ns_;
  std::map<detection::AgentId, std::vector<Waiting>> waiting_;  ///< Of each agent at most two.
};

}  // namespace collision::server
