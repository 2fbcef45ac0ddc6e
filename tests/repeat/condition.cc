#include "tests/repeat/condition.h"

namespace collision::repeat {

const std::vector<Condition>& AllConditions() {
  static const std::vector<Condition> conditions = {
      {.name = "full-speed", .text = "as fast as it goes"},
      {.name = "real-time",
       .text = "simulators keep to real time, in long scenes to a multiple of it",
       .paced = true},
      {.name = "starved-service",
       .text = "collisiond of low priority beside busy loops, stopped again and again",
       .starves_service = true},
      {.name = "starved-simulators",
       .text = "simulators of low priority beside busy loops, stopped again and again",
       .starves_simulators = true},
      {.name = "slow-network",
       .text = "each frame between simulators and service delayed by 1 ms to 5 ms, 1 % lost",
       .slow_network = true},
  };
  return conditions;
}

}  // namespace collision::repeat
