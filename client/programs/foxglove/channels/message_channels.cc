#include "client/programs/foxglove/channels/message_channels.h"

namespace collision::client {
namespace {

std::string EventName(std::uint64_t number) { return "event/" + std::to_string(number); }

}  // namespace

void EventChannel::PutAll(const SceneStep& step, ChannelBoard* board) {
  const EventBook& events = step.scene.events();
  for (const std::uint64_t number : events.Numbers()) {
    if (!events.At(number).CameToNothing()) board->Put(EventName(number), events.At(number).newest);
  }
}

void EventChannel::PutChanges(const SceneStep& step, ChannelBoard* board) {
  for (const std::uint64_t number : step.changes.events.dropped) board->Remove(EventName(number));
  for (const std::uint64_t number : step.changes.events.changed) {
    const EventBook::Entry& entry = step.scene.events().At(number);
    if (entry.is_superseded) {
      board->Remove(EventName(number));
    } else {
      board->Put(EventName(number), entry.newest);
    }
  }
}

void StatusChannel::PutAll(const SceneStep& step, ChannelBoard* board) {
  const auto& status = step.scene.view().status();
  if (status) board->Put("status", *status);
}

void StatusChannel::PutChanges(const SceneStep& step, ChannelBoard* board) {
  if (step.changes.status) PutAll(step, board);
}

}  // namespace collision::client
