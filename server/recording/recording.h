// What --record writes and --replay reads (idl/recording.proto).
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "idl/recording.pb.h"
#include "idl/recording/entries.h"
#include "server/claim/service_claim.h"

namespace collision::server {

/// Keeps what each step of the daemon saw.
class BatchSink {
 public:
  virtual ~BatchSink() = default;

  /// Keeps a batch before it is applied. False: it could not be kept, nor will any later one; the
  /// daemon ends without applying it, or goes on unrecorded (on_recording_failure).
  [[nodiscard]] virtual bool Record(const v1::RecordedBatch& batch) = 0;

  /// One line on why Record() failed. Empty while all is well.
  virtual std::string error() const = 0;
};

/// All of a batch but its inputs.
void CopyTimes(const v1::RecordedBatch& from, v1::RecordedBatch* to);

/// Hands on a batch as entries of at most wire::kEntryBytesMax, of which all but the last are
/// `continued`, until `write` returns false. Returns what it returned last. An input that is larger
/// alone is an entry of its own, which cannot be read.
bool WriteInParts(const v1::RecordedBatch& batch,
                  const std::function<bool(const v1::RecordingEntry&)>& write);

/// Former recordings that are kept beside a new one of the same name.
inline constexpr int kFormerRecordingsMax = 3;

/// Renames a recording to FILE.1, after FILE.1 to FILE.2 and so on; the oldest is replaced. Does
/// nothing where FILE is no regular file, or an empty one. Throws std::runtime_error if it cannot.
void KeepFormerRecordings(const std::string& file);

/// Writes a recording to a file: a header with the complete configuration, then the batches, each
/// as one entry or, beyond 64 MiB, as several, of which all but the last are `continued`
/// (idl/recording.proto). Each entry has a checksum.
///
/// Each batch has been handed to the operating system when Record() returns: a crash of the daemon
/// loses nothing, a crash of the machine at most its page cache. The file needs no closing entry;
/// it is whole after every batch. A batch that cannot be written is taken off the end of the file.
/// One thread, except for HoldWrites().
class RecordingWriter final : public BatchSink {
 public:
  /// Replaces the file and writes the header; `config` is complete. Errors call it `name`; empty:
  /// by its path. Throws std::runtime_error if it cannot.
  RecordingWriter(const std::string& path, const v1::Config& config, const ClaimOptions& claim = {},
                  const std::string& name = {});
  ~RecordingWriter() override;
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  [[nodiscard]] bool Record(const v1::RecordedBatch& batch) override;

  /// File, offset, cause.
  std::string error() const override { return error_; }

  /// Waits for a write in progress; while the lock is held none begins. For a thread that is about
  /// to end the process: the file then ends with a whole batch. Any thread.
  [[nodiscard]] std::unique_lock<std::mutex> HoldWrites() { return std::unique_lock(writing_); }

 private:
  bool Write(const v1::RecordingEntry& entry);

  std::mutex writing_;
  std::string path_;
  int file_ = -1;
  std::uint64_t offset_ = 0;
  std::string error_;
};

/// Where batches come from.
class BatchSource {
 public:
  virtual ~BatchSource() = default;

  /// The next batch, whole; nothing at the end of what can be read.
  virtual std::optional<v1::RecordedBatch> Next() = 0;
};

/// Reads a recording, or a segment of the flight recorder, entry by entry. Used by one thread.
class RecordingReader final : public BatchSource {
 public:
  /// Reads the header. Throws std::runtime_error, with file and byte offset, if the file is no
  /// recording.
  explicit RecordingReader(const std::string& path);

  /// As recorded: complete, with every default.
  const v1::Config& config() const { return config_; }

  /// Likewise.
  const ClaimOptions& claim() const { return claim_; }

  /// Its number within one start of the service, from 1; 0: it is no segment.
  std::uint32_t segment() const { return segment_; }

  /// Whether the next segment begins with the batch that follows the last one here: known once
  /// Next() has given nothing.
  bool continues() const { return end_ && end_->continues(); }

  /// Nothing at the end and at the first entry that is cut off or damaged: see error().
  std::optional<v1::RecordedBatch> Next() override;

  /// One line with file, byte offset and cause. Empty while all is well.
  const std::string& error() const { return error_.empty() ? entries_.error() : error_; }

 private:
  std::optional<v1::RecordedBatch> NextPart();
  std::string EndsAt(const std::string& what) const;

  wire::EntryReader entries_;
  v1::Config config_;
  ClaimOptions claim_;
  std::uint32_t segment_ = 0;
  std::optional<v1::RecordingEnd> end_;
  std::string error_;
};

}  // namespace collision::server
