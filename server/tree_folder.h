// A folder of files that are written whole, read whole, and removed when there are too many.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace collision::server {

/// Files named *.tree. Others in the folder are left alone, but for what this class wrote aside and,
/// since its process died, never named. Nothing follows symbolic links or waits at pipes.
class TreeFolder {
 public:
  /// Makes the folder, with those above it, if need be. Throws std::runtime_error with the path and
  /// the cause if that fails, or if it cannot be looked into.
  TreeFolder(std::string path, std::uint64_t bytes_max);

  /// The bytes of a file, which counts as used; nullopt: there is none, and *fault is empty, or it
  /// cannot be read, and *fault says why.
  std::optional<std::string> Read(const std::string& name, std::string* fault) const;

  /// Puts a file in place, at once as a whole, after making room for it. False, with the cause in
  /// *fault: it could not, and what was there before is there still, or has made room.
  bool Write(const std::string& name, const std::string& bytes, std::string* fault);

  /// Of its files, when they were last counted.
  std::uint64_t bytes() const { return bytes_; }

  /// Files, to make room.
  std::uint64_t removed() const { return removed_; }

  const std::string& path() const { return path_; }

 private:
  void RemoveLeftovers() const;

  /// Removes the files used least lately until there is room for `bytes` more; of files used at the
  /// same time, the first by name.
  void MakeRoom(std::uint64_t bytes);

  const std::string path_;
  const std::uint64_t bytes_max_;
  std::uint64_t bytes_ = 0;
  std::uint64_t removed_ = 0;
  std::uint64_t written_ = 0;  ///< So that no two files aside are named alike.
};

}  // namespace collision::server
