// Prints the size and alignment of each type that crosses the binary interface of the client
// library by value: "size TYPE SIZE ALIGNMENT".
#include <cstdio>

#include "collision/collision.h"
#include "collision/monitor.h"
#include "collision/notice.h"
#include "collision/pending_names.h"
#include "collision/shape.h"
#include "collision/types.h"
#include "collision/world.h"

#define PRINT(Type) std::printf("size " #Type " %zu %zu\n", sizeof(Type), alignof(Type));

int main() {
  using namespace collision::client;
  // clang-format off
  PRINT(Agent) PRINT(AgentDescription) PRINT(AgentId) PRINT(AgentLabel) PRINT(Breach)
  PRINT(Clearance) PRINT(ClosestApproach) PRINT(DescribedAgent) PRINT(EarliestIntersection)
  PRINT(Event) PRINT(Expectation) PRINT(Geometry) PRINT(HalfSpace) PRINT(Monitor)
  PRINT(MonitorOptions) PRINT(Normal) PRINT(Notice) PRINT(PendingNames) PRINT(Proximity)
  PRINT(QuotaUse) PRINT(Rejection) PRINT(RelativeVelocity) PRINT(ServiceStatus) PRINT(Shape)
  PRINT(SimulatorClock) PRINT(SimulatorStatus) PRINT(Solid) PRINT(State) PRINT(StateUsed)
  PRINT(Tag) PRINT(TimeBracket) PRINT(Traffic) PRINT(Triangles) PRINT(World) PRINT(WorldOptions)
  PRINT(collision_agent_description) PRINT(collision_agent_id) PRINT(collision_bracket)
  PRINT(collision_breach) PRINT(collision_clearance) PRINT(collision_clock)
  PRINT(collision_closest_approach) PRINT(collision_counter) PRINT(collision_earliest)
  PRINT(collision_event) PRINT(collision_expectation) PRINT(collision_geometry)
  PRINT(collision_histogram) PRINT(collision_label) PRINT(collision_monitor_options)
  PRINT(collision_news) PRINT(collision_proximity) PRINT(collision_rejection)
  PRINT(collision_service_status) PRINT(collision_simulator_status) PRINT(collision_solid)
  PRINT(collision_state) PRINT(collision_state_used) PRINT(collision_tag) PRINT(collision_traffic)
  PRINT(collision_world_options)
      // clang-format on
      return 0;
}
