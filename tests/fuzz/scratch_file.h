// A file for what reads files only.
#pragma once

#include <string>

#include "tests/fuzz/fuzzed_data.h"

namespace collision::fuzz {

/// Under a name of this process alone, in a folder of its own, in memory where the system has such;
/// both go with the object.
class ScratchFile {
 public:
  /// Throws std::runtime_error if it cannot be written.
  ScratchFile(const std::string& name, Bytes bytes);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string folder_;
  std::string path_;
};

}  // namespace collision::fuzz
