#include "client/programs/foxglove/channels/numbers_channel.h"

#include <cmath>

#include "client/library/network/conversion.h"
#include "client/programs/foxglove/messages/cdr.h"

namespace collision::client {
namespace {

constexpr double kSecondsOfMicrosecond = 1e-6;

/// The counter of this name; 0: the status has none.
std::uint64_t CounterOf(const v1::ServiceStatus& status, const std::string& name) {
  for (const v1::Counter& counter : status.counters()) {
    if (counter.name() == name) return counter.value();
  }
  return 0;
}

/// Of all agents that are promised any; NaN: none is.
double LeastClearance(const SceneStep& step) {
  double least = NAN;
  const std::vector<ShownAgent>& agents = step.world.agents();
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const StateTable::Agent& agent = step.scene.states().agents()[i];
    if (!agents[i].is_there || !agent.is_promised) continue;
    least = std::fmin(least, SecondsAhead(agent.clear_until_ns, step.now_ns));
  }
  return least;
}

double EarliestContact(const SceneStep& step) {
  const auto& earliest = step.scene.view().earliest();
  return earliest && earliest->found() ? SecondsAhead(earliest->earliest_ns(), step.now_ns) : NAN;
}

std::uint32_t OpenEvents(const SceneStep& step, v1::EventStatus status) {
  std::uint32_t count = 0;
  for (const std::uint64_t number : step.world.open_events()) {
    count += step.scene.events().At(number).newest.status() == status;
  }
  return count;
}

/// Null: there is none.
const v1::CollisionEvent* Nearest(const SceneStep& step) {
  const v1::CollisionEvent* nearest = nullptr;
  for (const std::uint64_t number : step.world.open_events()) {
    const v1::CollisionEvent& event = step.scene.events().At(number).newest;
    // A level of distance is no contact.
    if (!IsExpectedToTouch(event) || !event.level().empty()) continue;
    if (nearest == nullptr || event.begin().earliest_ns() < nearest->begin().earliest_ns()) {
      nearest = &event;
    }
  }
  return nearest;
}

}  // namespace

void WorldNumbersChannel::PutAll(const SceneStep& step, ChannelBoard* board) {
  const WorldView& view = step.scene.view();
  const v1::ServiceStatus status = view.status().value_or(v1::ServiceStatus());
  CdrWriter message;
  message.Time(step.now_ns)
      .Uint32(status.agents())
      .Uint32(status.pairs_tracked())
      .Uint32(OpenEvents(step, v1::EVENT_POSSIBLE))
      .Uint32(OpenEvents(step, v1::EVENT_CONFIRMED))
      .Uint64(CounterOf(status, "events_confirmed"))
      .Float64(EarliestContact(step))
      .Float64(LeastClearance(step))
      .Float64(kSecondsOfMicrosecond * static_cast<double>(status.cpu_us()))
      .Uint64(status.memory_bytes());
  board->Put("world", message.bytes());
}

void WorldNumbersChannel::PutChanges(const SceneStep& step, ChannelBoard* board) {
  if (step.changes.now || step.changes.status) PutAll(step, board);
}

void NearestNumbersChannel::PutAll(const SceneStep& step, ChannelBoard* board) {
  const v1::CollisionEvent* event = Nearest(step);
  const bool has_gap = event != nullptr && event->has_proximity();
  const v1::Bracket gap = has_gap ? event->proximity().separation_m() : v1::Bracket();
  const auto ahead = [&](auto instant) {
    return event == nullptr ? NAN : SecondsAhead(instant(event->begin()), step.now_ns);
  };
  const auto name = [&](auto side) {
    return event == nullptr ? "" : step.scene.view().Name(FromMessage(side(*event)));
  };
  CdrWriter message;
  message.Time(step.now_ns)
      .Float64(has_gap ? gap.lower() : NAN)
      .Float64(has_gap ? gap.upper() : NAN)
      .Float64(ahead([](const v1::TimeBracket& begin) { return begin.earliest_ns(); }))
      .Float64(ahead([](const v1::TimeBracket& begin) { return begin.latest_ns(); }))
      .String(name([](const v1::CollisionEvent& one) { return one.lower(); }))
      .String(name([](const v1::CollisionEvent& one) { return one.higher(); }));
  board->Put("nearest", message.bytes());
}

void NearestNumbersChannel::PutChanges(const SceneStep& step, ChannelBoard* board) {
  if (step.changes.now || !step.changes.events.changed.empty()) PutAll(step, board);
}

}  // namespace collision::client
