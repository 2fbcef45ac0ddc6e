// A world that is heard, written to MCAP files.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "client/library/network/message_monitor.h"
#include "client/programs/foxglove/foxglove_channels.h"
#include "client/programs/recordings/heard_first.h"
#include "client/programs/recordings/mcap_writer.h"
#include "client/programs/recordings/page_stream.h"

namespace collision::client {

struct WorldRecorderOptions {
  std::string path;     ///< Of the file; a former one is replaced.
  double rate_hz = 10;  ///< How often the page's items are written, in the world's time.
  std::function<std::int64_t()> wall_ns = {};  ///< The wall time of what is heard now.
};

/// Hears a world, and writes
///   - each message as it came, on a channel with the name of its topic (`collision/v1/contact`),
///     as protobuf with its schema;
///   - the channels for Foxglove (foxglove/channel.h): `/scene`, `/tf` and so on;
///   - the items of the page (scene/item.h) on the channel `/page`.
/// The time of a message ("log time") is the world's; "publish time" is the wall's. A world whose
/// time begins anew goes on in another file: run.2.mcap behind run.mcap. One
/// thread.
class WorldRecorder {
 public:
  /// Throws std::runtime_error if the file cannot be written, as all below do.
  WorldRecorder(std::unique_ptr<Receiver> receiver, WorldRecorderOptions options);
  ~WorldRecorder();
  WorldRecorder(const WorldRecorder&) = delete;
  WorldRecorder& operator=(const WorldRecorder&) = delete;

  /// Hears what comes within `timeout`. Returns how many messages came.
  std::size_t Poll(std::chrono::nanoseconds timeout);

  /// Writes the end of the file.
  void Close();

  /// What was written, by the paths of the files.
  const std::map<std::string, std::uint64_t>& files() const { return files_; }

  /// Written to the file so far.
  std::uint64_t bytes() const { return file_->bytes(); }

  /// Of the world.
  std::int64_t now_ns() const { return now_ns_; }
  const WorldView& view() const { return stream_.scene().view(); }

 private:
  void Hear(const Arrivals& arrivals);
  void Begin();
  void WriteMessage(const google::protobuf::Message& holder);
  void WritePage();
  void WriteForFoxglove();
  std::uint16_t SchemaOf(const McapWriter::Schema& schema);
  std::uint16_t ChannelOf(const std::string& topic, const google::protobuf::Message& message);

  const WorldRecorderOptions options_;
  TakingTimes times_;  ///< Of what the page is told.
  PageStream stream_;
  std::unique_ptr<McapWriter> file_;
  std::map<std::string, std::uint16_t> channels_;  ///< By topic.
  std::map<std::string, std::uint16_t> schemas_;   ///< By message type.
  std::uint16_t page_ = 0;                         ///< Channel.
  std::unique_ptr<FoxgloveChannels> foxglove_;
  std::vector<std::unique_ptr<ChannelReader>> readers_;  ///< Of each of its channels, by id.
  std::map<std::string, std::uint64_t> files_;
  int number_ = 0;           ///< Of the file.
  std::int64_t now_ns_ = 0;  ///< What the service told last.
  std::int64_t newest_ns_ = std::numeric_limits<std::int64_t>::min();  ///< In the file.
  bool has_agents_ = false;                                            ///< In the file.
  std::int64_t chunk_due_ns_ = 0;                                      ///< By the wall clock.
};

}  // namespace collision::client
