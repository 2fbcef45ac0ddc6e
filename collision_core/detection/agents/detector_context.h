// What the detector's components share.
#pragma once

#include "collision_core/base/ids.h"
#include "collision_core/base/index_set.h"
#include "collision_core/detection/agents/agent_table.h"
#include "collision_core/detection/step/detector_counters.h"
#include "collision_core/detection/step/step_clock.h"

namespace collision::detection {

/// All outlive the components. Only the façade changes the clock and the agents.
struct DetectorContext {
  const StepClock& clock;
  const AgentTable& agents;
  DetectorCounters* counters;
  IndexSet<AgentIndex>* clearances_dirty;  ///< Agents whose clearance may have changed.
};

}  // namespace collision::detection
