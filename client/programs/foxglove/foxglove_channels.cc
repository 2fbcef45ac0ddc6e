#include "client/programs/foxglove/foxglove_channels.h"

#include <algorithm>

#include "client/programs/foxglove/channels/log_channel.h"
#include "client/programs/foxglove/channels/message_channels.h"
#include "client/programs/foxglove/channels/numbers_channel.h"
#include "client/programs/foxglove/channels/scene_channel.h"
#include "client/programs/foxglove/channels/transform_channel.h"

namespace collision::client {
namespace {

constexpr std::int64_t kDisorderMax = 1'000'000'000;  ///< [ns]

}  // namespace

FoxgloveChannels::FoxgloveChannels() {
  At(ChannelId::kScene).source = std::make_unique<SceneChannel>();
  At(ChannelId::kTransforms).source = std::make_unique<TransformChannel>();
  At(ChannelId::kEvents).source = std::make_unique<EventChannel>();
  At(ChannelId::kStatus).source = std::make_unique<StatusChannel>();
  At(ChannelId::kLog).source = std::make_unique<LogChannel>();
  At(ChannelId::kWorldNumbers).source = std::make_unique<WorldNumbersChannel>();
  At(ChannelId::kNearestNumbers).source = std::make_unique<NearestNumbersChannel>();
}

bool FoxgloveChannels::Put(const Scene& scene, const SceneChanges& changes, bool service_alive) {
  if (TakeTime(scene.now_ns())) {
    for (Entry& entry : entries_) entry.is_shown = false;
  }
  if (TakeWorld(scene, changes)) {
    At(ChannelId::kScene).is_shown = false;
    At(ChannelId::kTransforms).is_shown = false;
  }
  const SceneStep step{.scene = scene,
                       .changes = changes,
                       .world = world_,
                       .now_ns = now_ns_,
                       .service_alive = service_alive};
  bool is_new = false;
  for (Entry& entry : entries_) {
    const bool is_read = is_read_ && entry.readers > 0;
    if (!is_read && !entry.is_shown) continue;
    ChannelBoard board(&entry.board, now_ns_);
    if (!is_read || !entry.is_shown) entry.board.Clear();
    if (is_read && !entry.is_shown) entry.source->PutAll(step, &board);
    if (is_read && entry.is_shown) entry.source->PutChanges(step, &board);
    entry.is_shown = is_read;
    is_new = is_new || board.is_new();
  }
  return is_new;
}

/// Returns whether time has begun anew: a viewer forgets all then. What comes on several topics may
/// come a little out of order.
bool FoxgloveChannels::TakeTime(std::int64_t now_ns) {
  const bool is_anew = now_ns < now_ns_ - kDisorderMax;
  now_ns_ = is_anew ? std::max<std::int64_t>(0, now_ns) : std::max<std::int64_t>(now_ns_, now_ns);
  return is_anew;
}

/// Returns whether bodies are shown in another way from now on.
bool FoxgloveChannels::TakeWorld(const Scene& scene, const SceneChanges& changes) {
  const bool was_read = is_read_;
  is_read_ = std::ranges::any_of(entries_, [](const Entry& entry) { return entry.readers > 0; });
  if (!is_read_) return false;
  const bool was_crowded = world_.is_crowded();
  const std::string frame = world_.frame();
  was_read ? world_.Take(scene, changes) : world_.TakeAll(scene);
  return was_read && (world_.is_crowded() != was_crowded || world_.frame() != frame);
}

}  // namespace collision::client
