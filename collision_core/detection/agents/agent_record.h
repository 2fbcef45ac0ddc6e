// What the detector knows about one agent.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "collision_core/detection/agents/bound_margin.h"
#include "collision_core/detection/agents/history.h"
#include "collision_core/detection/agents/scene_profile.h"
#include "collision_core/detection/events/agent_id.h"

namespace collision::detection {

/// One run of a simulator that has agents in the table.
struct Owner {
  /// The owner has reported everything about its agents up to here.
  Instant heard_until = Instant::Always();
  Instant still_until = Instant::Always();  ///< None of its agents jumps before.
  std::uint32_t agents = 0;                 ///< Its agents that are not removed.
};

/// One agent. `history` is never empty once the agent is in the table.
struct AgentRecord {
  AgentId id;
  /// The latest declaration. The filter and everything wider than before are in force at once,
  /// narrower limits from the next state on; each sample of the history has the declaration that
  /// was in force then.
  AgentDeclaration declaration;
  History history;
  BoundMargin margin;  ///< The margin that kept states have not yet used up since the last renewal.
  Instant admitted_from = Instant::Always();   ///< Nothing is known, or promised, before.
  Instant reported_until = Instant::Always();  ///< The newest stamp; once removed, heard_until().
  const Owner* owner = nullptr;                ///< Null once removed.
  Instant left_by = Instant::Never();          ///< Once removed: the expiry that it was told with.
  std::uint64_t removal = 0;      ///< Position in the order of removals, from 1; 0: not removed.
  bool expired = false;           ///< Promises exclude the agent: its last state has run out.
  bool shape_redeclared = false;  ///< The shape was declared anew since the newest state.
  SceneProfile::Features features = 0;

  /// Takes the latest declaration, of an agent with this body. A half-space has no limits.
  void Declare(const AgentDeclaration& declared,
               std::shared_ptr<const shape::FixedHalfSpace> half_space) {
    declaration = declared;
    if (half_space) declaration.limits = {};
    declaration.half_space = std::move(half_space);
  }
  bool is_half_space() const { return declaration.half_space != nullptr; }
  const motion::SpaceTimeBound& bound() const { return history.newest().bound; }
  Instant stamp() const { return bound().state.stamp; }
  /// The owner has reported everything about the agent up to here: no state before it will come.
  Instant heard_until() const {
    return owner == nullptr ? reported_until : std::max(reported_until, owner->heard_until);
  }
  /// It is not there any more from then on; never: its owner has not said.
  Instant gone_from() const { return removal != 0 ? left_by : bound().state.expiry; }
  /// It does not jump before.
  Instant still_until() const {
    return owner == nullptr ? reported_until : std::max(heard_until(), owner->still_until);
  }
  /// The newest bound, wider by the margin: clearance keys are computed from it. An agent that
  /// expires with its newest state is there for a nanosecond, so that whom it met before is found.
  broad_phase::AgentBound wide_bound() const {
    motion::SpaceTimeBound wide = margin.Widen(bound());
    const Instant next = Instant::FromNanoseconds(stamp().nanoseconds() + 1);
    wide.state.expiry = std::max(wide.state.expiry, next);
    return {wide, declaration.filter};
  }
};

}  // namespace collision::detection
