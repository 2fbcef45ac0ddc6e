// Files that are written one after another in a folder, the oldest out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "idl/recording/kept_files.h"
#include "server/process/write_all.h"

namespace collision::server {

/// How much is kept.
struct RollingLimits {
  std::uint64_t bytes_max = 0;  ///< Of all files together.
  std::int64_t keep_ns = 0;     ///< Older ones are removed; 0: none for its age.
};

/// Where files are kept, and how much of them.
struct RollingPlace {
  std::string folder;
  std::string world_and_domain;  ///< "lab.0"
  const char* suffix = "";
  RollingLimits limits = {};
};

/// Beyond so many the oldest goes, too: a service that starts again and again leaves small ones.
inline constexpr std::size_t kRollingFilesMax = 4096;

/// The files of one world in a folder: one is being written, and locked (flock), the others are
/// former ones. The oldest that no service writes to goes when there is more than `bytes_max`, when
/// it is older than `keep_ns`, and when the disk is full; those of a clock that was ahead by more
/// than a day go first. What cannot be written is left out whole: a file always ends with what one
/// Append() wrote, unless the process was killed within it. No fsync: a machine that loses its
/// power may lose the last half minute. Throws nothing. One thread.
class RollingFiles {
 public:
  explicit RollingFiles(RollingPlace place) : place_(std::move(place)) {}
  ~RollingFiles() { Close(); }
  RollingFiles(const RollingFiles&) = delete;
  RollingFiles& operator=(const RollingFiles&) = delete;

  /// Begins a file of this wall time, or the next millisecond where there is one of that name, and
  /// makes the folder if it is missing. Requires that none is open. False: see error().
  bool Begin(std::int64_t wall_ns);

  /// Goes on with a former file, of which so many bytes are good: the others are cut off.
  bool Continue(const wire::KeptFile& file, std::uint64_t bytes);

  /// Appends to the open file, whole or not at all. False: see error(); the file stays open. One
  /// that somebody has removed takes nothing more.
  bool Append(const std::string& bytes, std::int64_t wall_ns);

  void Close();

  /// Count from the next Append() on.
  void SetLimits(RollingLimits limits);

  const RollingPlace& place() const { return place_; }
  bool is_open() const { return file_ >= 0; }
  bool is_removed() const { return is_open() && IsRemoved(file_); }  ///< By somebody else.
  std::uint64_t bytes() const { return bytes_; }                     ///< Of the open file.
  const std::string& path() const { return path_; }

  /// One line with path and cause of what failed last.
  const std::string& error() const { return error_; }

 private:
  bool Open(const std::string& path, int flags, std::uint64_t bytes);
  int Write(const std::string& bytes);
  std::vector<wire::KeptFile> FormerFiles() const;
  void DropOld(std::int64_t wall_ns);
  bool DropOldest();
  bool Fail(const std::string& path, int error_number);

  RollingPlace place_;
  int file_ = -1;
  std::string path_;
  std::uint64_t bytes_ = 0;         ///< Of the open file.
  std::uint64_t former_bytes_ = 0;  ///< Of all others, when last looked at.
  std::int64_t begun_ns_ = 0;       ///< Wall time, in the name of the file begun last.
  std::int64_t looked_ns_ = 0;      ///< Wall time; when last looked.
  std::string error_;
};

}  // namespace collision::server
