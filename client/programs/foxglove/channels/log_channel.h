// Sentences for people.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "client/programs/foxglove/channels/channel_source.h"

namespace collision::client {

/// foxglove.Log: contacts that are confirmed or over, a service that comes, is replaced or leaves.
/// The newest kLinesMax; a reader that comes later gets what the book of events still has.
class LogChannel final : public ChannelSource {
 public:
  static constexpr std::uint64_t kLinesMax = 1000;

  void PutAll(const SceneStep& step, ChannelBoard* board) override;
  void PutChanges(const SceneStep& step, ChannelBoard* board) override;

 private:
  /// As it was told last; 0: none is heard.
  struct Service {
    std::uint64_t id = 0;
    std::uint32_t term = 0;
    friend bool operator==(const Service&, const Service&) = default;
  };

  void PutEvent(const SceneStep& step, std::uint64_t number, ChannelBoard* board);
  void PutService(const SceneStep& step, ChannelBoard* board);
  void PutLine(foxglove::Log::Level level, std::int64_t at_ns, const std::string& sentence,
               ChannelBoard* board);

  std::uint64_t lines_ = 0;
  std::optional<Service> service_;
  std::map<std::uint64_t, v1::EventStatus> told_;  ///< By number of the event.
};

}  // namespace collision::client
