#include "client/programs/recordings/mcap_writer.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace collision::client {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr char kCompression[] = "zstd";
constexpr int kCompressionLevel = 3;
constexpr std::size_t kIdsMax = 65535;

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

/// Little-endian numbers and texts, one behind the other.
class Bytes {
 public:
  template <class Number>
  Bytes& Put(Number number) {
    static_assert(std::is_unsigned_v<Number>);
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i));
    }
    return *this;
  }
  Bytes& Raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  /// With its length before it.
  template <class Length = std::uint32_t>
  Bytes& Text(std::string_view text) {
    return Put(static_cast<Length>(text.size())).Raw(text);
  }

  const std::string& str() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string Record(Opcode opcode, std::string_view content) {
  return Bytes()
      .Put(static_cast<std::uint8_t>(opcode))
      .Put(std::uint64_t{content.size()})
      .Raw(content)
      .str();
}

std::uint32_t Checksum(std::string_view bytes, std::uint32_t so_far = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(so_far, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string Compressed(const std::string& bytes) {
  std::string compressed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(compressed.data(), compressed.size(), bytes.data(),
                                         bytes.size(), kCompressionLevel);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  compressed.resize(size);
  return compressed;
}

/// The earliest and the latest of some times; 0, 0 of none.
struct TimeRange {
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max(), end = 0;

  void Take(std::uint64_t time) {
    begin = std::min(begin, time);
    end = std::max(end, time);
  }
  void Put(Bytes* bytes) const { bytes->Put(std::min(begin, end)).Put(end); }
};

}  // namespace

class McapWriter::File {
 public:
  explicit File(const std::string& path) : path_(path) {
    stream_.open(path, std::ios::binary | std::ios::trunc);
    if (!stream_) Fail();
    Write(kMagic);
    Write(Record(Opcode::kHeader, Bytes().Text("").Text("collision").str()));
  }

  std::uint16_t Add(const Schema& schema) {
    const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
    if (schemas_.size() == kIdsMax) throw std::length_error(path_ + ": too many schemas");
    schemas_.push_back(
        Record(Opcode::kSchema,
               Bytes().Put(id).Text(schema.name).Text(schema.encoding).Text(schema.data).str()));
    chunk_ += schemas_.back();
    return id;
  }

  std::uint16_t Add(const Channel& channel) {
    const auto id = static_cast<std::uint16_t>(channels_.size());
    if (channels_.size() == kIdsMax) throw std::length_error(path_ + ": too many channels");
    channels_.push_back(Record(Opcode::kChannel, Bytes()
                                                     .Put(id)
                                                     .Put(channel.schema)
                                                     .Text(channel.topic)
                                                     .Text(channel.message_encoding)
                                                     .Text("")
                                                     .str()));
    counts_.push_back(0);
    chunk_ += channels_.back();
    return id;
  }

  void Write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
             const std::string& data) {
    index_[channel].emplace_back(log_time, chunk_.size());
    chunk_times_.Take(log_time);
    chunk_ += Record(Opcode::kMessage, Bytes()
                                           .Put(channel)
                                           .Put(static_cast<std::uint32_t>(counts_.at(channel)++))
                                           .Put(log_time)
                                           .Put(publish_time)
                                           .Raw(data)
                                           .str());
    ++messages_;
    if (chunk_.size() >= kChunkBytes) EndChunk();
  }

  void WriteMetadata(const std::string& name, const std::map<std::string, std::string>& values) {
    Bytes pairs;
    for (const auto& [key, value] : values) pairs.Text(key).Text(value);
    const std::string record =
        Record(Opcode::kMetadata, Bytes().Text(name).Text(pairs.str()).str());
    metadata_.push_back(
        Record(Opcode::kMetadataIndex,
               Bytes().Put(offset_).Put(std::uint64_t{record.size()}).Text(name).str()));
    Write(record);
  }

  void EndChunk() {
    if (chunk_.empty()) return;
    const std::string compressed = Compressed(chunk_);
    Bytes content;
    chunk_times_.Put(&content);
    content.Put(std::uint64_t{chunk_.size()})
        .Put(Checksum(chunk_))
        .Text(kCompression)
        .Text<std::uint64_t>(compressed);
    const std::uint64_t begin = offset_;
    Write(Record(Opcode::kChunk, content.str()));
    const std::uint64_t length = offset_ - begin;
    const std::uint64_t indexes_begin = offset_;
    Bytes offsets;
    for (const auto& [channel, entries] : index_) {
      offsets.Put(channel).Put(offset_);
      WriteMessageIndex(channel, entries);
    }
    Bytes index;
    chunk_times_.Put(&index);
    index.Put(begin)
        .Put(length)
        .Text(offsets.str())
        .Put(offset_ - indexes_begin)
        .Text(kCompression)
        .Put(std::uint64_t{compressed.size()})
        .Put(std::uint64_t{chunk_.size()});
    chunks_.push_back(Record(Opcode::kChunkIndex, index.str()));
    if (!index_.empty()) times_.Take(chunk_times_.begin), times_.Take(chunk_times_.end);
    chunk_.clear();
    index_.clear();
    chunk_times_ = {};
    stream_.flush();
    if (!stream_) Fail();
  }

  void Close() {
    if (std::exchange(is_closed_, true)) return;
    EndChunk();
    Write(Record(Opcode::kDataEnd, Bytes().Put(checksum_).str()));
    const std::uint64_t begin = offset_;
    checksum_ = 0;
    Bytes groups;
    WriteGroup(Opcode::kSchema, schemas_, &groups);
    WriteGroup(Opcode::kChannel, channels_, &groups);
    WriteGroup(Opcode::kStatistics, {Statistics()}, &groups);
    WriteGroup(Opcode::kChunkIndex, chunks_, &groups);
    WriteGroup(Opcode::kMetadataIndex, metadata_, &groups);
    const std::uint64_t offsets_begin = offset_;
    Write(groups.str());
    // The checksum of the summary includes the footer up to itself.
    constexpr std::uint64_t kFooterBytes = 20;
    Write(Bytes()
              .Put(static_cast<std::uint8_t>(Opcode::kFooter))
              .Put(kFooterBytes)
              .Put(begin)
              .Put(offsets_begin)
              .str());
    Write(Bytes().Put(checksum_).Raw(kMagic).str());
    stream_.close();
    if (!stream_) Fail();
  }

  const std::string& path() const { return path_; }
  std::uint64_t messages() const { return messages_; }
  std::uint64_t bytes() const { return offset_; }

 private:
  using IndexEntry = std::pair<std::uint64_t, std::uint64_t>;  ///< Log time, place in the chunk.

  void WriteMessageIndex(std::uint16_t channel, const std::vector<IndexEntry>& entries) {
    Bytes pairs;
    for (const auto& [time, place] : entries) pairs.Put(time).Put(place);
    Write(Record(Opcode::kMessageIndex, Bytes().Put(channel).Text(pairs.str()).str()));
  }

  std::string Statistics() const {
    Bytes counts;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] > 0) counts.Put(static_cast<std::uint16_t>(i)).Put(counts_[i]);
    }
    Bytes all;
    all.Put(messages_)
        .Put(static_cast<std::uint16_t>(schemas_.size()))
        .Put(static_cast<std::uint32_t>(channels_.size()))
        .Put(std::uint32_t{0})
        .Put(static_cast<std::uint32_t>(metadata_.size()))
        .Put(static_cast<std::uint32_t>(chunks_.size()));
    times_.Put(&all);
    return Record(Opcode::kStatistics, all.Text(counts.str()).str());
  }

  /// Records of one kind, and where they are.
  void WriteGroup(Opcode opcode, const std::vector<std::string>& records, Bytes* groups) {
    if (records.empty()) return;
    const std::uint64_t begin = offset_;
    for (const std::string& record : records) Write(record);
    groups->Raw(Record(
        Opcode::kSummaryOffset,
        Bytes().Put(static_cast<std::uint8_t>(opcode)).Put(begin).Put(offset_ - begin).str()));
  }

  void Write(std::string_view bytes) {
    stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream_) Fail();
    offset_ += bytes.size();
    checksum_ = Checksum(bytes, checksum_);
  }

  [[noreturn]] void Fail() const {
    throw std::runtime_error(path_ + ": cannot be written: " + std::strerror(errno));
  }

  std::string path_;
  std::ofstream stream_;
  std::uint64_t offset_ = 0;
  std::uint32_t checksum_ = 0;  ///< Of the data section, then of the summary.
  std::vector<std::string> schemas_, channels_, chunks_, metadata_;  ///< Records of the summary.
  std::vector<std::uint64_t> counts_;                                ///< Messages, by channel.
  std::uint64_t messages_ = 0;
  TimeRange times_;
  std::string chunk_;  ///< Records of the chunk that is begun.
  TimeRange chunk_times_;
  std::map<std::uint16_t, std::vector<IndexEntry>> index_;  ///< Likewise.
  bool is_closed_ = false;
};

McapWriter::McapWriter(const std::string& path) : file_(std::make_unique<File>(path)) {}

McapWriter::~McapWriter() {
  try {
    Close();
  } catch (const std::exception&) {
    return;
  }
}

std::uint16_t McapWriter::Add(const Schema& schema) { return file_->Add(schema); }

std::uint16_t McapWriter::Add(const Channel& channel) { return file_->Add(channel); }

void McapWriter::Write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
                       const std::string& data) {
  file_->Write(channel, log_time, publish_time, data);
}

void McapWriter::WriteMetadata(const std::string& name,
                               const std::map<std::string, std::string>& values) {
  file_->WriteMetadata(name, values);
}

void McapWriter::EndChunk() { file_->EndChunk(); }

void McapWriter::Close() { file_->Close(); }

const std::string& McapWriter::path() const { return file_->path(); }

std::uint64_t McapWriter::messages() const { return file_->messages(); }

std::uint64_t McapWriter::bytes() const { return file_->bytes(); }

}  // namespace collision::client
