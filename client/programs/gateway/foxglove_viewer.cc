#include "client/programs/gateway/foxglove_viewer.h"

#include <google/protobuf/util/json_util.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "client/programs/gateway/json_member.h"
#include "client/programs/shared/web_text.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"

namespace collision::gateway {
namespace {

using client::Channel;
using client::JsonObject;
using google::protobuf::Struct;
using google::protobuf::Value;

constexpr char kMessageData = 1, kTime = 2;  ///< Opcodes of binary messages.
constexpr int kStatusError = 2;              ///< The highest level of a status.
constexpr std::size_t kNameMax = 64;         ///< A longer name is not repeated.

std::string ServerInfo(const FoxgloveServer& server) {
  return JsonObject()
      .Text("op", "serverInfo")
      .Text("name", server.name)
      .Add("capabilities", client::JsonTexts({"time"}))
      .Add("metadata",
           JsonObject().Text("world", server.world).Text("version", server.version).Json())
      .Text("sessionId", server.session_id)
      .Json();
}

std::string Advertise() {
  std::vector<std::string> channels;
  for (const Channel& channel : client::Channels()) {
    const bool is_binary = channel.schema_encoding == "protobuf";
    channels.push_back(
        JsonObject()
            .Count("id", channel.id)
            .Text("topic", channel.topic)
            .Text("encoding", channel.encoding)
            .Text("schemaName", channel.schema_name)
            .Text("schema", is_binary ? client::Base64(channel.schema) : channel.schema)
            .Text("schemaEncoding", channel.schema_encoding)
            .Json());
  }
  return JsonObject().Text("op", "advertise").Add("channels", client::JsonArray(channels)).Json();
}

/// Little-endian.
template <class Number>
void Append(Number value, std::string* bytes) {
  for (std::size_t i = 0; i < sizeof value; ++i) *bytes += static_cast<char>(value >> (8 * i));
}

WebMessage TimeMessage(std::int64_t now_ns) {
  std::string bytes(1, kTime);
  Append(static_cast<std::uint64_t>(now_ns), &bytes);
  return {.is_text = false, .pieces = {MakePayload(std::move(bytes))}};
}

/// A whole number that an id can be.
std::optional<std::uint32_t> IdOf(const Value& value) {
  const double number = value.number_value();
  const bool is_id = value.kind_case() == Value::kNumberValue && number >= 0 &&
                     number <= std::numeric_limits<std::uint32_t>::max() &&
                     std::floor(number) == number;
  return is_id ? std::optional(static_cast<std::uint32_t>(number)) : std::nullopt;
}

}  // namespace

FoxgloveViewer::FoxgloveViewer(client::FoxgloveChannels* channels, const FoxgloveServer& server)
    : channels_(*channels), texts_{ServerInfo(server), Advertise()} {}

std::optional<WebMessage> FoxgloveViewer::Next() {
  if (!texts_.empty()) {
    WebMessage message{.is_text = true, .pieces = {MakePayload(std::move(texts_.front()))}};
    texts_.pop_front();
    return message;
  }
  if (!pending_ && time_sent_ == channels_.now_ns()) TakePending();
  // Once more: the message may be of a later step.
  const std::int64_t now_ns = channels_.now_ns();
  if (std::exchange(time_sent_, now_ns) != now_ns) return TimeMessage(now_ns);
  if (!pending_) return std::nullopt;
  std::string head(1, kMessageData);
  Append(pending_->subscription, &head);
  WebMessage message{.is_text = false,
                     .pieces = {MakePayload(std::move(head)), std::move(pending_->message)}};
  pending_.reset();
  return message;
}

void FoxgloveViewer::TakePending() {
  auto next = subscriptions_.upper_bound(turn_);
  for (std::size_t i = 0; i < subscriptions_.size(); ++i, ++next) {
    if (next == subscriptions_.end()) next = subscriptions_.begin();
    if (Payload message = next->second.reader->Next()) {
      turn_ = next->first;
      pending_ = {.subscription = next->first, .message = std::move(message)};
      return;
    }
  }
}

std::string FoxgloveViewer::Hear(const std::string& message, bool is_text) {
  Struct operation;
  if (!is_text) {
    Refuse("This server takes no messages of clients.");
  } else if (!google::protobuf::util::JsonStringToMessage(message, &operation).ok()) {
    Refuse("That is not a JSON object.");
  } else {
    Obey(operation);
  }
  return "";
}

void FoxgloveViewer::Obey(const Struct& operation) {
  const std::string& name = MemberOf(operation, "op").string_value();
  if (name == "subscribe") {
    for (const Value& wish : MemberOf(operation, "subscriptions").list_value().values()) {
      Subscribe(wish.struct_value());
    }
  } else if (name == "unsubscribe") {
    for (const Value& id : MemberOf(operation, "subscriptionIds").list_value().values()) {
      Unsubscribe(id);
    }
  } else {
    const bool is_short = name.size() <= kNameMax;
    Refuse("This server does not support the operation \"" + (is_short ? name : "...") + "\".");
  }
}

void FoxgloveViewer::Subscribe(const Struct& wish) {
  const auto id = IdOf(MemberOf(wish, "id")), channel = IdOf(MemberOf(wish, "channelId"));
  if (!id || !channel || !client::IsChannel(*channel)) {
    return Refuse("A subscription has an id and the channelId of a channel that is advertised.");
  }
  if (subscriptions_.count(*id) > 0) {
    return Refuse("There is a subscription " + std::to_string(*id) + " already.");
  }
  for (const auto& [other, subscription] : subscriptions_) {
    if (subscription.channel != *channel) continue;
    return Refuse("There is a subscription to channel " + std::to_string(*channel) + " already.");
  }
  subscriptions_[*id] = {.channel = *channel,
                         .reader = std::make_unique<client::ChannelReader>(
                             &channels_, static_cast<client::ChannelId>(*channel))};
}

void FoxgloveViewer::Unsubscribe(const Value& id) {
  const auto number = IdOf(id);
  if (!number || subscriptions_.erase(*number) == 0) {
    return Refuse("There is no such subscription to end.");
  }
  if (pending_ && pending_->subscription == *number) pending_.reset();
}

void FoxgloveViewer::Refuse(const std::string& why) {
  if (texts_.size() >= kAnswersMax) return;
  texts_.push_back(
      JsonObject().Text("op", "status").Count("level", kStatusError).Text("message", why).Json());
}

}  // namespace collision::gateway
