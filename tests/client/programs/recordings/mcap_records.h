// MCAP files, read by hand (mcap.dev/spec), independently of what writes them.
#pragma once

#include <gtest/gtest.h>
#include <zstd.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace collision::client {

inline constexpr std::size_t kMcapMagicBytes = 8, kMcapRecordHead = 9;

/// Little-endian numbers and texts, one behind the other.
class McapFields {
 public:
  explicit McapFields(std::string bytes) : bytes_(std::move(bytes)) {}

  std::uint64_t Number(std::size_t size) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
      number |= std::uint64_t{static_cast<unsigned char>(bytes_.at(at_ + i))} << (8 * i);
    }
    at_ += size;
    return number;
  }
  std::string Bytes(std::uint64_t size) {
    EXPECT_LE(at_ + size, bytes_.size());
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  /// With its length before it.
  std::string Text(std::size_t length_size = 4) { return Bytes(Number(length_size)); }
  std::string Rest() { return Bytes(bytes_.size() - at_); }
  bool is_over() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

struct McapRecord {
  int opcode = 0;
  std::uint64_t begin = 0;  ///< In the file, or in the chunk.
  std::string content;
};

inline std::vector<McapRecord> McapRecordsIn(const std::string& bytes, std::size_t at = 0) {
  std::vector<McapRecord> records;
  McapFields fields(bytes.substr(at));
  while (!fields.is_over()) {
    McapRecord& record = records.emplace_back();
    record.begin = at;
    record.opcode = static_cast<int>(fields.Number(1));
    record.content = fields.Text(8);
    at += kMcapRecordHead + record.content.size();
  }
  return records;
}

inline std::string BytesOfFile(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

/// The records of a whole file, without the magic at both ends.
inline std::vector<McapRecord> McapRecordsOfFile(const std::string& path) {
  const std::string bytes = BytesOfFile(path);
  EXPECT_GE(bytes.size(), 2 * kMcapMagicBytes) << path;
  return McapRecordsIn(bytes.substr(0, bytes.size() - kMcapMagicBytes), kMcapMagicBytes);
}

struct McapMessage {
  std::string topic;
  std::uint64_t sequence = 0, log_time = 0, publish_time = 0;
  std::string data;
};

/// Those of all chunks, in the order of the file.
inline std::vector<McapMessage> McapMessagesOf(const std::string& path) {
  std::vector<McapMessage> messages;
  std::map<std::uint64_t, std::string> topics;
  for (const McapRecord& chunk : McapRecordsOfFile(path)) {
    if (chunk.opcode != 6) continue;
    McapFields head(chunk.content);
    head.Bytes(16);
    std::string plain(head.Number(8), '\0');
    head.Bytes(4);
    EXPECT_EQ(head.Text(), "zstd");
    const std::string packed = head.Text(8);
    EXPECT_EQ(ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size()),
              plain.size());
    for (const McapRecord& record : McapRecordsIn(plain)) {
      McapFields fields(record.content);
      const std::uint64_t id = fields.Number(2);
      if (record.opcode == 4) {
        fields.Number(2);
        topics[id] = fields.Text();
      } else if (record.opcode == 5) {
        McapMessage& message = messages.emplace_back();
        message.topic = topics.at(id);
        message.sequence = fields.Number(4);
        message.log_time = fields.Number(8);
        message.publish_time = fields.Number(8);
        message.data = fields.Rest();
      }
    }
  }
  return messages;
}

}  // namespace collision::client
