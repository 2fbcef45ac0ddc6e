#include "server/bus/batch_order.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
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

/// `reused`: a later message of the batch writes anew what the removal removes. Otherwise the
/// removal takes effect after the states of its batch.
Key KeyOf(const v1::Input& input, bool reused) {
  switch (input.message_case()) {
    case v1::Input::kServiceHeard:
    case v1::Input::kEventHeard:
    case v1::Input::kShapeReady:
    case v1::Input::kOperatorCommand:
    case v1::Input::kWatch:
      return {0, -1, 0};
    case v1::Input::kSimulatorHello:  // whether the others count
      return {input.simulator_hello().simulator_id(), -1, 0};
    case v1::Input::kAgentDescription:
      return {input.agent_description().simulator_id(), 0, input.agent_description().slot()};
    case v1::Input::kAgentRemoval:
      return {input.agent_removal().simulator_id(), reused ? 0 : 4, input.agent_removal().slot()};
    case v1::Input::kShapePart:
      return {input.shape_part().simulator_id(), 1, 0};
    case v1::Input::kShapeRemoval:
      return {input.shape_removal().simulator_id(), reused ? 1 : 5, 0};
    case v1::Input::kAgentStates:
      return {input.agent_states().simulator_id(), 2, input.agent_states().chunk()};
    case v1::Input::kSimulatorClock:
      return {input.simulator_clock().simulator_id(), 3, 0};
    case v1::Input::kLiveliness:
      return {input.liveliness().simulator_id(), 6, 0};
    case v1::Input::MESSAGE_NOT_SET:
      break;
  }
  return {0, 7, 0};
}

/// What later messages of a batch write, seen from its end.
class WrittenLater {
 public:
  void Add(const v1::Input& input) {
    if (input.has_agent_description()) {
      const v1::AgentDescription& agent = input.agent_description();
      slots_.emplace(agent.simulator_id(), agent.slot(), agent.incarnation());
    } else if (input.has_shape_part()) {
      const v1::ShapePart& part = input.shape_part();
      parts_.emplace(part.simulator_id(), part.shape(), part.part());
    }
  }

  bool Replaces(const v1::Input& input) const {
    if (input.has_agent_removal()) {
      const v1::AgentRemoval& removal = input.agent_removal();
      return slots_.contains({removal.simulator_id(), removal.slot(), removal.incarnation()});
    }
    if (!input.has_shape_removal()) return false;
    const v1::ShapeRemoval& removal = input.shape_removal();
    return parts_.contains({removal.simulator_id(), removal.shape(), removal.part()});
  }

 private:
  using Instance = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t>;

  std::set<Instance> slots_;  ///< Simulator, slot, incarnation.
  std::set<Instance> parts_;  ///< Simulator, shape, part.
};

}  // namespace

void SortBatch(std::vector<v1::Input>* batch) {
  std::vector<Ordered> ordered(batch->size());
  WrittenLater later;
  for (std::size_t i = batch->size(); i-- > 0;) {
    v1::Input& input = (*batch)[i];
    later.Add(input);
    const bool reused = later.Replaces(input);
    ordered[i] = {KeyOf(input, reused), std::move(input)};
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Ordered& a, const Ordered& b) { return a.key < b.key; });
  std::transform(ordered.begin(), ordered.end(), batch->begin(),
                 [](Ordered& entry) { return std::move(entry.input); });
}

}  // namespace collision::server
