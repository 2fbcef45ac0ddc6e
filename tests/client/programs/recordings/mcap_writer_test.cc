// Goal:   files are what the format says, byte for byte; what cannot be written is told.
// Method: a tiny file against bytes by hand and a checksum bit by bit; larger ones are taken apart
//         by hand.
#include "client/programs/recordings/mcap_writer.h"

#include "tests/client/programs/recordings/mcap_records.h"
#include "tests/support/temporary_path.h"

namespace collision::client {
namespace {

using namespace std::string_literals;

const std::string kMcapMagic = "\x89MCAP0\r\n"s;

std::string LittleEndian(std::uint64_t number, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i));
  return bytes;
}

std::string TextOf(const std::string& text) { return LittleEndian(text.size(), 4) + text; }

std::string RecordOf(int opcode, const std::string& content) {
  return LittleEndian(static_cast<std::uint64_t>(opcode), 1) + LittleEndian(content.size(), 8) +
         content;
}

/// CRC-32 as zlib has it, bit by bit.
std::uint32_t CrcOf(const std::string& bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0xedb88320 : crc >> 1;
  }
  return ~crc;
}

TEST(McapWriter, AFileWithMetadataAloneIsAsByHand) {
  const std::string path = TemporaryPath("metadata.mcap");
  McapWriter writer(path);
  writer.WriteMetadata("collision", {{"a", "1"}, {"b", "22"}});
  writer.Close();

  const std::string header = kMcapMagic + RecordOf(1, TextOf("") + TextOf("collision"));
  const std::string pairs = TextOf("a") + TextOf("1") + TextOf("b") + TextOf("22");
  const std::string metadata = RecordOf(12, TextOf("collision") + TextOf(pairs));
  const std::string data = header + metadata;
  const std::string data_end = RecordOf(15, LittleEndian(CrcOf(data), 4));
  const std::uint64_t summary_begin = data.size() + data_end.size();
  // Messages, schemas, channels, attachments, metadata, chunks, first and last time, counts.
  const std::string statistics = RecordOf(
      11, LittleEndian(0, 8) + LittleEndian(0, 2) + LittleEndian(0, 4) + LittleEndian(0, 4) +
              LittleEndian(1, 4) + LittleEndian(0, 4) + LittleEndian(0, 16) + TextOf(""));
  const std::string index = RecordOf(
      13, LittleEndian(header.size(), 8) + LittleEndian(metadata.size(), 8) + TextOf("collision"));
  const std::string groups =
      RecordOf(14, "\x0b"s + LittleEndian(summary_begin, 8) + LittleEndian(statistics.size(), 8)) +
      RecordOf(14, "\x0d"s + LittleEndian(summary_begin + statistics.size(), 8) +
                       LittleEndian(index.size(), 8));
  const std::uint64_t groups_begin = summary_begin + statistics.size() + index.size();
  const std::string footer = "\x02"s + LittleEndian(20, 8) + LittleEndian(summary_begin, 8) +
                             LittleEndian(groups_begin, 8);
  const std::string summary = statistics + index + groups + footer;
  EXPECT_EQ(BytesOfFile(path),
            data + data_end + summary + LittleEndian(CrcOf(summary), 4) + kMcapMagic);
}

TEST(McapWriter, AChunkHasItsRecordsTimesAndChecksum) {
  const std::string path = TemporaryPath("chunk.mcap");
  McapWriter writer(path);
  ASSERT_EQ(writer.Add(McapWriter::Schema{"v1.Thing", "protobuf", "\x01\x02"}), 1);
  ASSERT_EQ(writer.Add(McapWriter::Channel{1, "thing", "protobuf"}), 0);
  ASSERT_EQ(writer.Add(McapWriter::Channel{0, "/page", "own"}), 1);
  writer.Write(0, 30, 5, "first");
  writer.Write(1, 10, 6, "second");
  writer.Write(0, 20, 7, "");
  EXPECT_EQ(writer.messages(), 3u);
  writer.Close();
  writer.Close();

  const std::string schemas = RecordOf(
      3, LittleEndian(1, 2) + TextOf("v1.Thing") + TextOf("protobuf") + TextOf("\x01\x02"));
  const auto channel = [](int id, int schema, const char* topic, const char* encoding) {
    return RecordOf(4, LittleEndian(id, 2) + LittleEndian(schema, 2) + TextOf(topic) +
                           TextOf(encoding) + TextOf(""));
  };
  const auto message = [](int id, int sequence, int log, int publish, const char* text) {
    return RecordOf(5, LittleEndian(id, 2) + LittleEndian(sequence, 4) + LittleEndian(log, 8) +
                           LittleEndian(publish, 8) + text);
  };
  const std::string channels = channel(0, 1, "thing", "protobuf") + channel(1, 0, "/page", "own");
  const std::string head = schemas + channels;
  const std::string first = message(0, 0, 30, 5, "first"), second = message(1, 0, 10, 6, "second");
  const std::string plain = head + first + second + message(0, 1, 20, 7, "");

  const std::vector<McapRecord> records = McapRecordsOfFile(path);
  McapFields chunk(records.at(1).content);
  EXPECT_EQ(records[1].opcode, 6);
  EXPECT_EQ(chunk.Number(8), 10u) << "the earliest";
  EXPECT_EQ(chunk.Number(8), 30u) << "the latest";
  EXPECT_EQ(chunk.Number(8), plain.size());
  EXPECT_EQ(chunk.Number(4), CrcOf(plain));
  EXPECT_EQ(chunk.Text(), "zstd");
  // Where the messages of each channel are in the chunk.
  EXPECT_EQ(records[2].opcode, 7);
  EXPECT_EQ(records[2].content,
            LittleEndian(0, 2) +
                TextOf(LittleEndian(30, 8) + LittleEndian(head.size(), 8) + LittleEndian(20, 8) +
                       LittleEndian(head.size() + first.size() + second.size(), 8)));
  EXPECT_EQ(records[3].content,
            LittleEndian(1, 2) +
                TextOf(LittleEndian(10, 8) + LittleEndian(head.size() + first.size(), 8)));
  EXPECT_EQ(records[4].opcode, 15);
  // The summary repeats schemas and channels.
  EXPECT_EQ(RecordOf(3, records[5].content), schemas);
  EXPECT_EQ(RecordOf(4, records[6].content) + RecordOf(4, records[7].content), channels);
  McapFields index(records[9].content);
  EXPECT_EQ(records[9].opcode, 8);
  index.Bytes(16);
  EXPECT_EQ(index.Number(8), records[1].begin);
  EXPECT_EQ(index.Number(8), records[2].begin - records[1].begin);
  EXPECT_EQ(index.Text(), LittleEndian(0, 2) + LittleEndian(records[2].begin, 8) +
                              LittleEndian(1, 2) + LittleEndian(records[3].begin, 8));
  EXPECT_EQ(index.Number(8), records[4].begin - records[2].begin);
}

// Goal:   a chunk ends when it is large, or when it is told to; then what is there is whole.
TEST(McapWriter, ChunksEndWhenTheyAreLargeAndWhenTheyAreTold) {
  const std::string path = TemporaryPath("chunks.mcap");
  McapWriter writer(path);
  const std::uint16_t channel = writer.Add(McapWriter::Channel{0, "a", "own"});
  const auto chunks = [&path] {
    const std::string bytes = BytesOfFile(path);
    int count = 0;
    if (bytes.empty()) return count;
    for (const McapRecord& record : McapRecordsIn(bytes, kMcapMagicBytes)) {
      count += record.opcode == 6;
    }
    return count;
  };
  writer.Write(channel, 1, 1, std::string(McapWriter::kChunkBytes - 200, 'x'));
  EXPECT_EQ(chunks(), 0);
  writer.Write(channel, 2, 2, std::string(200, 'x'));
  EXPECT_EQ(chunks(), 1) << "it is large";
  writer.EndChunk();
  EXPECT_EQ(chunks(), 1) << "there is nothing to write";
  writer.Write(channel, 3, 3, "x");
  writer.EndChunk();
  EXPECT_EQ(chunks(), 2);
  writer.Close();
  const auto messages = McapMessagesOf(path);
  ASSERT_EQ(messages.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(messages[i].sequence, i);
}

TEST(McapWriter, WhatCannotBeWrittenIsToldWithPathAndCause) {
  const auto sentence_of = [](const auto& act) -> std::string {
    try {
      act();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing was told";
  };
  const std::string nowhere = TemporaryPath("nowhere") + "/run.mcap";
  EXPECT_EQ(sentence_of([&] { const McapWriter writer(nowhere); }),
            nowhere + ": cannot be written: No such file or directory");
  EXPECT_EQ(sentence_of([] {
              McapWriter full("/dev/full");
              full.Write(full.Add(McapWriter::Channel{0, "a", "own"}), 1, 1, "x");
              full.EndChunk();
            }),
            "/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(sentence_of([] { McapWriter("/dev/full").Close(); }),
            "/dev/full: cannot be written: No space left on device");
}

}  // namespace
}  // namespace collision::client
