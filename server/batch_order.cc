#include "server/batch_order.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>

namespace collision::server {
namespace {

/// Simulator, kind, slot or chunk.
using Key = std::tuple<std::uint64_t, int, std::uint32_t>;

struct Ordered {
  Key key;
  v1::Input input;
};

/// `reused`: a description of the same slot arrived later. Otherwise a removal ends what the states
/// of its batch tell.
Key KeyOf(const v1::Input& input, bool reused) {
  switch (input.message_case()) {
    case v1::Input::kAgentDescription:
      return {input.agent_description().simulator_id(), 0, input.agent_description().slot()};
    case v1::Input::kAgentRemoval:
      return {input.agent_removal().simulator_id(), reused ? 0 : 4, input.agent_removal().slot()};
    case v1::Input::kShapePart:
      return {input.shape_part().simulator_id(), 1, 0};
    case v1::Input::kAgentStates:
      return {input.agent_states().simulator_id(), 2, input.agent_states().chunk()};
    case v1::Input::kSimulatorClock:
      return {input.simulator_clock().simulator_id(), 3, 0};
    case v1::Input::kLiveliness:
      return {input.liveliness().simulator_id(), 5, 0};
    case v1::Input::MESSAGE_NOT_SET:
      break;
  }
  return {0, 6, 0};
}

}  // namespace

void SortBatch(std::vector<v1::Input>* batch) {
  std::vector<Ordered> ordered(batch->size());
  std::set<std::pair<std::uint64_t, std::uint32_t>> described;
  for (std::size_t i = batch->size(); i-- > 0;) {
    v1::Input& input = (*batch)[i];
    const v1::AgentDescription& description = input.agent_description();
    const v1::AgentRemoval& removal = input.agent_removal();
    if (input.has_agent_description()) {
      described.emplace(description.simulator_id(), description.slot());
    }
    const bool reused =
        input.has_agent_removal() && described.contains({removal.simulator_id(), removal.slot()});
    ordered[i] = {KeyOf(input, reused), std::move(input)};
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Ordered& a, const Ordered& b) { return a.key < b.key; });
  std::transform(ordered.begin(), ordered.end(), batch->begin(),
                 [](Ordered& entry) { return std::move(entry.input); });
}

}  // namespace collision::server
