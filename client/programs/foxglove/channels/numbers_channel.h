// Plain numbers over time, for plots.
#pragma once

#include <string>

#include "client/programs/foxglove/channels/channel_source.h"

namespace collision::client {

/// collision/msg/WorldNumbers (channel.cc has the fields): one message a step.
class WorldNumbersChannel final : public ChannelSource {
 public:
  void PutAll(const SceneStep& step, ChannelBoard* board) override;
  void PutChanges(const SceneStep& step, ChannelBoard* board) override;
};

/// collision/msg/NearestNumbers, likewise: of those that touch or are expected to, the pair that
/// begins first, and of several that touch the one that began first.
class NearestNumbersChannel final : public ChannelSource {
 public:
  void PutAll(const SceneStep& step, ChannelBoard* board) override;
  void PutChanges(const SceneStep& step, ChannelBoard* board) override;
};

}  // namespace collision::client
