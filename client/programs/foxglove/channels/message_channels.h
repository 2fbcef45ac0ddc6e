// The service's own messages, as they came.
#pragma once

#include "client/programs/foxglove/channels/channel_source.h"

namespace collision::client {

/// collision.v1.CollisionEvent: the newest revision of each event that the book keeps; to a reader
/// that comes later not those that came to nothing.
class EventChannel final : public ChannelSource {
 public:
  void PutAll(const SceneStep& step, ChannelBoard* board) override;
  void PutChanges(const SceneStep& step, ChannelBoard* board) override;
};

/// collision.v1.ServiceStatus: the newest of the service in force.
class StatusChannel final : public ChannelSource {
 public:
  void PutAll(const SceneStep& step, ChannelBoard* board) override;
  void PutChanges(const SceneStep& step, ChannelBoard* board) override;
};

}  // namespace collision::client
