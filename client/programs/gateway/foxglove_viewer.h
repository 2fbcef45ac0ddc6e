// A viewer that speaks Foxglove's WebSocket protocol: Foxglove, Lichtblick, PlotJuggler.
#pragma once

#include <google/protobuf/struct.pb.h>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "client/programs/foxglove/foxglove_channels.h"
#include "client/programs/gateway/web/web_types.h"

namespace collision::gateway {

/// The sub-protocols, with the same messages. Programs of before July 2025 know the older one
/// alone, PlotJuggler the newer one alone.
inline constexpr char kFoxgloveProtocol[] = "foxglove.sdk.v1";
inline constexpr char kFoxgloveOldProtocol[] = "foxglove.websocket.v1";

/// What a server says of itself.
struct FoxgloveServer {
  std::string name;
  std::string world;
  std::string version;
  /// The same for all viewers, as long as the gateway runs: a viewer forgets all at a new one.
  std::string session_id;
};

/// Says which channels there are and sends those that the viewer subscribes to, one message at a
/// time, each behind the world's time. A viewer that reads slowly gets what is newest. What it asks
/// and is not offered is answered with a status; the connection goes on.
class FoxgloveViewer final : public WebViewer {
 public:
  /// Answers that wait; what is wrong beyond is not answered. There is at most one subscription to
  /// each channel.
  static constexpr std::size_t kAnswersMax = 32;

  /// `channels` outlives it.
  FoxgloveViewer(client::FoxgloveChannels* channels, const FoxgloveServer& server);

  std::optional<WebMessage> Next() override;
  std::string Hear(const std::string& message, bool is_text) override;

 private:
  struct Subscription {
    std::uint32_t channel = 0;
    std::unique_ptr<client::ChannelReader> reader;
  };

  /// A message that waits until the world's time is sent.
  struct Pending {
    std::uint32_t subscription = 0;
    Payload message;
  };

  void Obey(const google::protobuf::Struct& operation);
  void Subscribe(const google::protobuf::Struct& wish);
  void Unsubscribe(const google::protobuf::Value& id);
  void Refuse(const std::string& why);
  void TakePending();

  client::FoxgloveChannels& channels_;
  std::deque<std::string> texts_;
  std::map<std::uint32_t, Subscription> subscriptions_;  ///< By the id that the viewer chose.
  std::uint32_t turn_ = 0;  ///< The subscription that was served last: each has its turn.
  std::optional<Pending> pending_;
  std::int64_t time_sent_ = -1;
};

}  // namespace collision::gateway
