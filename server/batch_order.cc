#include "server/batch_order.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace collision::server {
namespace {

/// Simulator, kind, slot or chunk.
using Key = std::tuple<std::uint64_t, int, std::uint32_t>;

Key KeyOf(const v1::Input& input) {
  switch (input.message_case()) {
    case v1::Input::kAgentDescription:
      return {input.agent_description().simulator_id(), 0, input.agent_description().slot()};
    case v1::Input::kAgentRemoval:
      return {input.agent_removal().simulator_id(), 0, input.agent_removal().slot()};
    case v1::Input::kShapePart:
      return {input.shape_part().simulator_id(), 1, 0};
    case v1::Input::kAgentStates:
      return {input.agent_states().simulator_id(), 2, input.agent_states().chunk()};
    case v1::Input::kSimulatorClock:
      return {input.simulator_clock().simulator_id(), 3, 0};
    case v1::Input::kLiveliness:
      return {input.liveliness().simulator_id(), 4, 0};
    case v1::Input::MESSAGE_NOT_SET:
      break;
  }
  return {0, 5, 0};
}

}  // namespace

void SortBatch(std::vector<v1::Input>* batch) {
  std::stable_sort(batch->begin(), batch->end(),
                   [](const v1::Input& a, const v1::Input& b) { return KeyOf(a) < KeyOf(b); });
}

}  // namespace collision::server
