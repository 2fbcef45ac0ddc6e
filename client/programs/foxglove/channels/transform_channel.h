// Where the bodies are.
#pragma once

#include <set>

#include "client/programs/foxglove/channels/channel_source.h"

namespace collision::client {

/// foxglove.FrameTransforms: the newest state of each agent that has an entity of its own and a
/// state, at the state's stamp; an item "tf/C" for a chunk of the state table.
class TransformChannel final : public ChannelSource {
 public:
  void PutAll(const SceneStep& step, ChannelBoard* board) override;
  void PutChanges(const SceneStep& step, ChannelBoard* board) override;

 private:
  void PutChunk(const SceneStep& step, std::uint32_t chunk, ChannelBoard* board);
};

}  // namespace collision::client
