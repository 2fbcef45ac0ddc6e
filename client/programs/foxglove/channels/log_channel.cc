#include "client/programs/foxglove/channels/log_channel.h"

#include <algorithm>

#include "client/library/network/conversion.h"
#include "collision/event_text.h"
#include "idl/identity.h"

namespace collision::client {

void LogChannel::PutAll(const SceneStep& step, ChannelBoard* board) {
  lines_ = 0;
  service_.reset();
  told_.clear();
  for (const std::uint64_t number : step.scene.events().Numbers()) PutEvent(step, number, board);
  PutService(step, board);
}

void LogChannel::PutChanges(const SceneStep& step, ChannelBoard* board) {
  PutService(step, board);
  for (const std::uint64_t number : step.changes.events.dropped) told_.erase(number);
  for (const std::uint64_t number : step.changes.events.changed) PutEvent(step, number, board);
}

void LogChannel::PutEvent(const SceneStep& step, std::uint64_t number, ChannelBoard* board) {
  const v1::CollisionEvent& event = step.scene.events().At(number).newest;
  const v1::EventStatus status = event.status();
  const bool is_contact =
      status == v1::EVENT_CONFIRMED || status == v1::EVENT_ENDED || status == v1::EVENT_UNDECIDED;
  if (!is_contact) return;
  const auto [told, is_new] = told_.try_emplace(number, status);
  if (!is_new && told->second == status) return;
  told->second = status;
  const WorldView& view = step.scene.view();
  const auto name = [&view](const AgentId& id) { return view.FullName(id); };
  const std::int64_t now_ns = std::max(step.now_ns, event.now_ns());
  PutLine(status == v1::EVENT_ENDED ? foxglove::Log::INFO : foxglove::Log::WARNING, event.now_ns(),
          EventSentence(FromMessage(event), name, now_ns, 0), board);
}

void LogChannel::PutService(const SceneStep& step, ChannelBoard* board) {
  const auto& status = step.scene.view().status();
  Service service;
  if (status && step.service_alive) service = {status->service_id(), status->stamp().term()};
  if (service == service_) return;
  const bool is_first = !service_;
  const Service former = service_.value_or(Service{});
  service_ = service;
  if (service.id == 0) {
    if (is_first) return;
    PutLine(foxglove::Log::ERROR, step.now_ns, "No service of this world is heard any more.",
            board);
    return;
  }
  const std::string who = "service " + IdText(service.id) + " (term " +
                          std::to_string(service.term) + ", version " + status->version() + ")";
  PutLine(foxglove::Log::INFO, step.now_ns,
          former.id == 0 ? "The " + who + " serves world " + status->world() + "."
                         : "The " + who + " has taken over world " + status->world() + ".",
          board);
}

void LogChannel::PutLine(foxglove::Log::Level level, std::int64_t at_ns,
                         const std::string& sentence, ChannelBoard* board) {
  foxglove::Log line;
  SetTime(at_ns, line.mutable_timestamp());
  line.set_level(level);
  line.set_message(sentence);
  line.set_name("collisiond");
  board->Put("log/" + std::to_string(lines_++ % kLinesMax), line);
}

}  // namespace collision::client
