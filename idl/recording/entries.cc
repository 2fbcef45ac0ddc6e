#include "idl/recording/entries.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/stubs/logging.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "idl/identity.h"

namespace collision::wire {
namespace {

/// A varint of a length that may be: at most 7 bits each.
constexpr int kLengthBytesMax = 5;

/// The field `checksum` as it is at the end of an entry: its tag, then 8 bytes.
constexpr char kChecksumTag = 15 << 3 | 1;
constexpr std::size_t kChecksumBytes = 9;

void AppendLength(std::uint64_t length, std::string* bytes) {
  for (; length > 0x7f; length >>= 7) bytes->push_back(static_cast<char>(length | 0x80));
  bytes->push_back(static_cast<char>(length));
}

}  // namespace

void AppendEntry(const std::string& serialised, std::string* bytes) {
  AppendLength(serialised.size() + kChecksumBytes, bytes);
  bytes->append(serialised);
  bytes->push_back(kChecksumTag);
  std::uint64_t checksum = Fnv1a(serialised);
  for (int i = 0; i < 8; ++i, checksum >>= 8) bytes->push_back(static_cast<char>(checksum));
}

void AppendEntry(const v1::RecordingEntry& entry, std::string* bytes) {
  AppendEntry(entry.SerializeAsString(), bytes);
}

EntryReader::EntryReader(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
}

bool EntryReader::Next(v1::RecordingEntry* entry) {
  if (!error_.empty()) return false;
  before_ = offset_;
  std::uint64_t length = 0;
  if (file_.peek() == std::ifstream::traits_type::eof() && !file_.bad()) return false;
  if (!ReadLength(&length)) return false;
  std::string bytes(length, '\0');
  if (!file_.read(bytes.data(), static_cast<std::streamsize>(length))) return FailAtEnd();
  const google::protobuf::LogSilencer silent;  // the error below reports it
  if (!entry->ParseFromString(bytes)) {
    return Fail(offset_ == 0 ? "not a recording" : "damaged: not a recording entry");
  }
  if (!Fits(bytes, *entry)) return Fail("damaged: it does not fit its checksum");
  offset_ = static_cast<std::uint64_t>(file_.tellg());
  return true;
}

bool EntryReader::Fits(const std::string& bytes, const v1::RecordingEntry& entry) {
  if (offset_ == 0) is_checksummed_ = entry.has_checksum();
  if (!entry.has_checksum()) return !is_checksummed_;
  if (bytes.size() < kChecksumBytes || bytes[bytes.size() - kChecksumBytes] != kChecksumTag) {
    return false;
  }
  const std::string_view all = bytes;
  return entry.checksum() == Fnv1a(all.substr(0, all.size() - kChecksumBytes));
}

bool EntryReader::ReadLength(std::uint64_t* length) {
  for (int i = 0; i < kLengthBytesMax; ++i) {
    const int byte = file_.get();
    if (byte == std::ifstream::traits_type::eof()) return FailAtEnd();
    *length |= static_cast<std::uint64_t>(byte & 0x7f) << (7 * i);
    if ((byte & 0x80) == 0) {
      return *length <= kEntryBytesMax ||
             Fail("damaged: an entry of " + std::to_string(*length) + " bytes");
    }
  }
  return Fail("damaged: not a valid entry length");
}

bool EntryReader::Refuse(const std::string& what) {
  offset_ = before_;
  return Fail(what);
}

bool EntryReader::FailAtEnd() {
  is_cut_off_ = true;
  return Fail("cut off");
}

bool EntryReader::Fail(const std::string& what) {
  error_ = path_ + ": byte " + std::to_string(offset_) + ": " + what;
  return false;
}

}  // namespace collision::wire
