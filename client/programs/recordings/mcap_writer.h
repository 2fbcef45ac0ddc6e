// Files of the format MCAP, version 0 (mcap.dev/spec).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace collision::client {

/// Writes an MCAP file: chunks compressed with zstd, indexes, statistics, and a checksum of each
/// part. A chunk is written when it is large, or when EndChunk() says so: what a crash leaves is
/// whole up to there for readers that read from the begin. One thread.
class McapWriter {
 public:
  static constexpr std::size_t kChunkBytes = 1 << 20;  ///< Of messages, before compression.

  struct Schema {
    std::string name, encoding, data;
  };

  struct Channel {
    std::uint16_t schema = 0;  ///< 0: none.
    std::string topic, message_encoding;
  };

  /// Replaces the file. Throws std::runtime_error, with path and cause, as all below do, if it
  /// cannot be written.
  explicit McapWriter(const std::string& path);
  /// Closes it; what then fails is not told.
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Returns its id, from 1. Throws std::length_error beyond 65535.
  std::uint16_t Add(const Schema& schema);
  /// Likewise, from 0.
  std::uint16_t Add(const Channel& channel);

  /// Requires that there is such a channel. Times in ns; they need not be in order.
  void Write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
             const std::string& data);

  /// A record of names and values beside the messages.
  void WriteMetadata(const std::string& name, const std::map<std::string, std::string>& values);

  /// Writes the chunk that is begun.
  void EndChunk();

  /// Ends the chunk, and writes index and footer.
  void Close();

  const std::string& path() const;
  std::uint64_t messages() const;
  std::uint64_t bytes() const;  ///< In the file, without the chunk that is begun.

 private:
  class File;
  std::unique_ptr<File> file_;
};

}  // namespace collision::client
