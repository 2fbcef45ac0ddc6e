// A folder of files that are written whole, read whole, and removed when it is full.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace collision::server {

/// Files in a folder; each takes a place in the file system, however small it is.
inline constexpr std::size_t kTreeFilesMax = 16384;

/// So often a folder is listed anew, for the files of other processes.
inline constexpr std::uint64_t kWritesPerListing = 256;

/// Files named *.tree in one folder. Other files are left alone, except those that this class wrote
/// aside and could not rename because its process died. It follows no symbolic link and waits at no
/// pipe. One thread at a time.
class TreeFolder {
 public:
  /// Makes the folder and those above it if they are missing. Throws std::runtime_error, with the
  /// path and the cause, if that fails or the folder cannot be read.
  TreeFolder(std::string path, std::uint64_t bytes_max, std::size_t files_max = kTreeFilesMax);

  /// The bytes of a file, which counts as used; nullopt: there is none, and *fault is empty, or it
  /// cannot be read, and *fault says why.
  std::optional<std::string> Read(const std::string& name, std::string* fault) const;

  /// Makes room for a file and puts it in place atomically. False, with the cause in *fault: the
  /// file was not written; an earlier file of this name is still there, unless it was removed to
  /// make room.
  bool Write(const std::string& name, const std::string& bytes, std::string* fault);

  /// The size of all files when they were last listed, with what was written and removed since.
  std::uint64_t bytes() const { return bytes_; }

  /// Files removed to make room.
  std::uint64_t removed() const { return removed_; }

  const std::string& path() const { return path_; }

 private:
  using Used = std::pair<std::int64_t, std::string>;  ///< When [ns], name.

  void RemoveLeftovers() const;
  void List();
  void Note(const std::string& name, std::uint64_t bytes, std::int64_t used_ns);
  void Forget(const std::string& name);

  /// Removes the files used least lately until there is room for one more of `bytes`, or, without
  /// one, until the limits hold; of files used at the same time, the first by name. Costs O(log
  /// files) and a look at each file that is removed or was used since it was noted.
  void MakeRoom(std::optional<std::uint64_t> bytes);
  void RemoveOrNote(const std::string& name);

  const std::string path_;
  const std::uint64_t bytes_max_;
  const std::size_t files_max_;
  std::map<std::string, std::pair<std::uint64_t, std::int64_t>> files_;  ///< Bytes, noted use [ns].
  std::set<Used> by_use_;                                                ///< The same files.
  std::uint64_t bytes_ = 0;
  std::uint64_t removed_ = 0;
  std::uint64_t written_ = 0;  ///< Makes the names of files written aside unique.
};

}  // namespace collision::server
