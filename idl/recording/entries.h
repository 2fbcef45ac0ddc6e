// The entries of recordings and of journals of contacts (idl/recording.proto), as bytes.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "idl/recording.pb.h"

namespace collision::wire {

/// A state is some 250 bytes, so that all states of 100,000 agents are below this; a length beyond
/// it is something else read as one.
inline constexpr std::uint64_t kEntryBytesMax = 64 << 20;

/// Appends an entry that is serialised already, without a checksum: its length, itself, its
/// checksum. Requires that it is within kEntryBytesMax.
void AppendEntry(const std::string& serialised, std::string* bytes);

/// Likewise.
void AppendEntry(const v1::RecordingEntry& entry, std::string* bytes);

/// Reads a file, entry by entry, up to its end or to the first entry that is damaged or cut off.
/// One thread.
class EntryReader {
 public:
  /// Throws std::runtime_error, with path and cause, if the file cannot be read.
  explicit EntryReader(const std::string& path);

  /// False at the end, and where the file is damaged: see error().
  bool Next(v1::RecordingEntry* entry);

  /// Where the next entry begins: up to here all is whole.
  std::uint64_t offset() const { return offset_; }

  /// The entry that Next() gave last is not what it should be. Returns false.
  bool Refuse(const std::string& what);

  /// The entry at the end is not there as a whole, and nothing comes behind it.
  bool is_cut_off() const { return is_cut_off_; }

  /// One line with file, byte offset and cause. Empty while all is well.
  const std::string& error() const { return error_; }

  const std::string& path() const { return path_; }

 private:
  bool ReadLength(std::uint64_t* length);
  bool Fits(const std::string& bytes, const v1::RecordingEntry& entry);
  bool FailAtEnd();
  bool Fail(const std::string& what);

  std::string path_;
  std::ifstream file_;
  std::uint64_t before_ = 0, offset_ = 0;  ///< Where the last and the next entry begin.
  bool is_checksummed_ = false;            ///< The first entry is: then all are.
  bool is_cut_off_ = false;
  std::string error_;
};

}  // namespace collision::wire
