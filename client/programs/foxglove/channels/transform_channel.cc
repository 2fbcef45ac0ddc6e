#include "client/programs/foxglove/channels/transform_channel.h"

namespace collision::client {
namespace {

void AddTransform(const ShownAgent& agent, const StateTable::Agent& state,
                  const std::string& world_frame, foxglove::FrameTransforms* all) {
  foxglove::FrameTransform* transform = all->add_transforms();
  SetTime(state.stamp_ns, transform->mutable_timestamp());
  transform->set_parent_frame_id(world_frame);
  transform->set_child_frame_id(agent.frame);
  foxglove::Vector3* p = transform->mutable_translation();
  p->set_x(state.p[0]);
  p->set_y(state.p[1]);
  p->set_z(state.p[2]);
  foxglove::Quaternion* q = transform->mutable_rotation();
  q->set_w(state.q[0]);
  q->set_x(state.q[1]);
  q->set_y(state.q[2]);
  q->set_z(state.q[3]);
}

}  // namespace

void TransformChannel::PutAll(const SceneStep& step, ChannelBoard* board) {
  const auto count = static_cast<std::uint32_t>(step.world.agents().size());
  for (std::uint32_t first = 0; first < count; first += StateTable::kStatesOfAChunk) {
    PutChunk(step, first / StateTable::kStatesOfAChunk, board);
  }
}

void TransformChannel::PutChanges(const SceneStep& step, ChannelBoard* board) {
  std::set<std::uint32_t> chunks(step.changes.chunks.begin(), step.changes.chunks.end());
  for (const SceneChanges::Slot& slot : step.changes.agents) {
    const auto number = step.scene.NumberOf(slot);
    if (number) chunks.insert(*number / StateTable::kStatesOfAChunk);
  }
  for (const std::uint32_t chunk : chunks) PutChunk(step, chunk, board);
}

void TransformChannel::PutChunk(const SceneStep& step, std::uint32_t chunk, ChannelBoard* board) {
  const std::vector<ShownAgent>& agents = step.world.agents();
  const std::size_t first = std::size_t{chunk} * StateTable::kStatesOfAChunk;
  const std::size_t end = std::min(first + StateTable::kStatesOfAChunk, agents.size());
  foxglove::FrameTransforms all;
  for (std::size_t i = first; i < end; ++i) {
    const StateTable::Agent& state = step.scene.states().agents()[i];
    if (!state.has_state || !step.world.IsApart(agents[i]) || agents[i].is_half_space) continue;
    AddTransform(agents[i], state, step.world.frame(), &all);
  }
  const std::string name = "tf/" + std::to_string(chunk);
  if (all.transforms_size() > 0) return board->Put(name, all);
  board->Remove(name);
}

}  // namespace collision::client
